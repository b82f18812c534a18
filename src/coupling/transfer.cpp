#include "coupling/transfer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/fault.hpp"

namespace livebed::coupling {

namespace {

/// Integral of 15/16 (1 - s^2)^2 from -1 to s.
double kernel_integral(double s) {
  s = std::clamp(s, -1.0, 1.0);
  const double s2 = s * s;
  return 0.5 + 0.9375 * s * (1.0 + s2 * (-2.0 / 3.0 + 0.2 * s2));
}

}  // namespace

Edges::Edges(std::vector<double> at) : at_(std::move(at)) {
  narrowest_ = at_[1] - at_[0];
  for (int k = 1; k < volumes(); ++k) narrowest_ = std::min(narrowest_, at_[k + 1] - at_[k]);
  constexpr double most_bins_a_volume = 16;
  const double bins = std::ceil(std::min((last() - first()) / narrowest_, most_bins_a_volume * volumes()));
  bins_per_length_ = bins / (last() - first());
  for (int bin = 0, k = 0; bin < bins; ++bin) {
    while (k + 1 < volumes() && at_[k + 1] <= first() + bin / bins_per_length_) ++k;
    from_.push_back(std::max(0, k - 1));  // a place at a bin's very beginning may round into the bin before
  }
}

int Edges::touched_by(double length) const {
  constexpr double rounding = 1e-9;  // of edges that are sums of widths
  return std::min(volumes(), static_cast<int>(std::ceil(length / narrowest_ - rounding)) + 1);
}

double Edges::widest(int volumes) const {
  double most = 0;
  for (std::size_t k = volumes; k < at_.size(); ++k) most = std::max(most, at_[k] - at_[k - volumes]);
  return most;
}

Transfer::Transfer(const flow::Staggering& at, const base::Field& aperture, int first_column, int last_column,
                   double half_width)
    : half_width_(half_width), first_column_(first_column), first_row_(at.j0), open_(aperture.nx(), aperture.ny()) {
  // The volumes of u begin at the centre of cell 0, those of scalars and of v at the inlet; y likewise.
  std::vector<double> x{at.shift_x ? 0.5 * at.hx[3] : 0.0}, y{at.shift_y ? 0.5 * at.hy[3] : 0.0};
  for (int i = first_column; i <= last_column; ++i) x.push_back(x.back() + at.width[i + 2]);
  for (int j = at.j0; j < at.j1; ++j) y.push_back(y.back() + at.height[j + 2]);
  edges_x_ = Edges(std::move(x)), edges_y_ = Edges(std::move(y));
  columns_ = edges_x_.touched_by(2 * half_width), rows_ = edges_y_.touched_by(2 * half_width);

  for (int j = at.j0; j < at.j1; ++j)
    for (int i = first_column; i <= last_column; ++i) {
      const double open = at.volume(i, j) / (at.width[i + 2] * at.height[j + 2]);
      open_(i, j) = aperture(i, j) > 0 && open >= least_open ? open : 0.0;
    }

  // Bins as wide as the volumes of a grain, twice, for those of grains near the end of the box begin further up.
  const double length = edges_x_.last() - edges_x_.first(), wanted = 2 * edges_x_.widest(columns_);
  const int bins = std::max(1, static_cast<int>(length / wanted));
  bin_first_.assign(bins + 1, 0);
}

void Transfer::locate(const grains::Array& x, const grains::Array& y, const std::vector<int>& which) {
  const int n = static_cast<int>(which.size()), bins = static_cast<int>(bin_first_.size()) - 1;
  grain_ = which;
  footprint_.resize(n);
  bin_of_.resize(n);
  order_.resize(n);
  weights_.resize(static_cast<std::size_t>(n) * (columns_ + rows_));
  const double low = edges_x_.first(), scale = bins / (edges_x_.last() - low);
  base::for_each_item(0, (n + grains_a_block - 1) / grains_a_block, [&](int k) {
    for (int m = k * grains_a_block; m < std::min(n, (k + 1) * grains_a_block); ++m) {
      const int grain = which[m];
      locate_one(m, x[grain], y[grain]);
      bin_of_[m] = std::clamp(static_cast<int>((x[grain] - low) * scale), 0, bins - 1);
    }
  });
  std::fill(bin_first_.begin(), bin_first_.end(), 0);
  for (int k = 0; k < n; ++k) ++bin_first_[bin_of_[k] + 1];
  for (int b = 0; b < bins; ++b) bin_first_[b + 1] += bin_first_[b];
  for (int k = 0; k < n; ++k) order_[bin_first_[bin_of_[k]]++] = k;
  for (int b = bins; b > 0; --b) bin_first_[b] = bin_first_[b - 1];
  bin_first_[0] = 0;
}

namespace {

/// The first of `count` volumes that hold all that lies between low and its reach.
int first_volume(const Edges& edges, double low, int count) {
  return std::min(edges.volume_of(low), edges.volumes() - count);
}

void weigh(const Edges& edges, int first, int count, double center, double half_width, double* weight) {
  double before = kernel_integral((edges[first] - center) / half_width);
  for (int k = 0; k < count; ++k) {
    const double after = kernel_integral((edges[first + k + 1] - center) / half_width);
    weight[k] = after - before;
    before = after;
  }
}

}  // namespace

void Transfer::locate_one(int n, double x, double y) {
  // The volumes of u begin and end half a cell inside the box, those of v above the floor: a grain beyond counts at the
  // edge, or a kernel narrower than that half cell would find nothing.
  x = std::clamp(x, edges_x_.first(), edges_x_.last());
  y = std::clamp(y, edges_y_.first(), edges_y_.last());
  Footprint& f = footprint_[n];
  double *wx = weight_x(n), *wy = weight_y(n);
  const int a = first_volume(edges_x_, x - half_width_, columns_);
  const int b = first_volume(edges_y_, y - half_width_, rows_);
  weigh(edges_x_, a, columns_, x, half_width_, wx);
  weigh(edges_y_, b, rows_, y, half_width_, wy);
  f.i0 = first_column_ + a;
  f.j0 = first_row_ + b;
  f.whole = true;
  for (int k = 0; k < rows_; ++k) {
    const double* open = open_.row(f.j0 + k) + f.i0;
    for (int m = 0; m < columns_; ++m) f.whole &= open[m] == 1.0;
  }
  double sum = 0;
  with_columns([&](auto columns) {
    for_each_row(columns, n, [&](int, int, double share, const auto& weight) {
      double row = 0;
      for (int m = 0; m < columns; ++m) row += weight(m);
      sum += share * row;
    });
  });
  if (sum <= 0 && move_to_nearest_water(n, x, y)) return;
  // A grain with no water anywhere around it has been driven deep into the pipe: the NaN reaches its velocity, and the
  // check of the grains names it.
  const double scale = sum > 0 ? 1.0 / sum : std::numeric_limits<double>::quiet_NaN();
  for (int k = 0; k < rows_; ++k) wy[k] *= scale;
}

bool Transfer::move_to_nearest_water(int n, double x, double y) {
  Footprint& f = footprint_[n];
  const int columns = edges_x_.volumes(), rows = edges_y_.volumes();
  const int a = f.i0 - first_column_, b = f.j0 - first_row_;
  double nearest = std::numeric_limits<double>::infinity();
  int column = 0, row = 0;
  for (int j = std::max(0, b - volumes_to_water); j < std::min(rows, b + rows_ + volumes_to_water); ++j)
    for (int i = std::max(0, a - volumes_to_water); i < std::min(columns, a + columns_ + volumes_to_water); ++i) {
      if (open_(first_column_ + i, first_row_ + j) <= 0) continue;
      const double distance =
          std::hypot(0.5 * (edges_x_[i] + edges_x_[i + 1]) - x, 0.5 * (edges_y_[j] + edges_y_[j + 1]) - y);
      if (distance < nearest) nearest = distance, column = i, row = j;
    }
  if (!std::isfinite(nearest)) return false;
  const int first = std::min(column, columns - columns_), lowest = std::min(row, rows - rows_);
  f = {first_column_ + first, first_row_ + lowest, false};
  std::fill_n(weight_x(n), columns_ + rows_, 0.0);
  weight_x(n)[column - first] = 1.0;
  weight_y(n)[row - lowest] = 1.0 / open_(first_column_ + column, first_row_ + row);
  return true;
}

}  // namespace livebed::coupling
