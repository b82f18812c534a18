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

Transfer::Transfer(const flow::Staggering& at, const base::Field& aperture, int first_column, int last_column,
                   double half_width)
    : half_width_(half_width), first_column_(first_column), first_row_(at.j0), open_(aperture.nx(), aperture.ny()) {
  // The volumes of u begin at the centre of cell 0, those of scalars and of v at the inlet; y likewise.
  double edge = at.shift_x ? 0.5 * at.hx[3] : 0.0;
  edges_x_.push_back(edge);
  for (int i = first_column; i <= last_column; ++i) edges_x_.push_back(edge += at.width[i + 2]);
  edge = at.shift_y ? 0.5 * at.hy[3] : 0.0;
  edges_y_.push_back(edge);
  for (int j = at.j0; j < at.j1; ++j) edges_y_.push_back(edge += at.height[j + 2]);

  const auto narrowest = [](const std::vector<double>& edges) {
    double width = edges[1] - edges[0];
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) width = std::min(width, edges[k + 1] - edges[k]);
    return width;
  };
  widest_ = static_cast<int>(2 * half_width / std::min(narrowest(edges_x_), narrowest(edges_y_))) + 2;

  for (int j = at.j0; j < at.j1; ++j)
    for (int i = first_column; i <= last_column; ++i)
      open_(i, j) = aperture(i, j) > 0 ? at.volume(i, j) / (at.width[i + 2] * at.height[j + 2]) : 0.0;

  // Bins at least one kernel wide plus the volumes it touches at either end.
  double widest_volume = 0;
  for (std::size_t k = 0; k + 1 < edges_x_.size(); ++k)
    widest_volume = std::max(widest_volume, edges_x_[k + 1] - edges_x_[k]);
  const double length = edges_x_.back() - edges_x_.front(), wanted = 2 * half_width + 2 * widest_volume;
  const int bins = std::max(1, static_cast<int>(length / wanted));
  bin_first_.assign(bins + 1, 0);
}

void Transfer::locate(const grains::Array& x, const grains::Array& y, const std::vector<int>& which) {
  const int n = static_cast<int>(which.size()), bins = static_cast<int>(bin_first_.size()) - 1;
  grain_ = which;
  footprint_.resize(n);
  bin_of_.resize(n);
  order_.resize(n);
  weight_x_.resize(static_cast<std::size_t>(n) * widest_);
  weight_y_.resize(static_cast<std::size_t>(n) * widest_);
  const double low = edges_x_.front(), scale = bins / (edges_x_.back() - low);
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

/// First volume and number of volumes between low and high; volumes are nearly even, so a guess and a walk find them.
int span(const std::vector<double>& edges, double low, double high, int& count) {
  const int last = static_cast<int>(edges.size()) - 2;
  int a = static_cast<int>((low - edges.front()) / (edges.back() - edges.front()) * (last + 1));
  a = std::clamp(a, 0, last);
  while (a > 0 && edges[a] > low) --a;
  while (a < last && edges[a + 1] <= low) ++a;
  int b = a;
  while (b < last && edges[b + 1] < high) ++b;
  count = b - a + 1;
  return a;
}

void weigh(const std::vector<double>& edges, int first, int count, double center, double half_width, double* weight) {
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
  x = std::clamp(x, edges_x_.front(), edges_x_.back());
  y = std::clamp(y, edges_y_.front(), edges_y_.back());
  Footprint& f = footprint_[n];
  double *wx = &weight_x_[static_cast<std::size_t>(n) * widest_],
         *wy = &weight_y_[static_cast<std::size_t>(n) * widest_];
  const int a = span(edges_x_, x - half_width_, x + half_width_, f.ni);
  const int b = span(edges_y_, y - half_width_, y + half_width_, f.nj);
  weigh(edges_x_, a, f.ni, x, half_width_, wx);
  weigh(edges_y_, b, f.nj, y, half_width_, wy);
  f.i0 = first_column_ + a;
  f.j0 = first_row_ + b;
  double sum = 0;
  for_each_row(n, [&](int, int ni, int, double share, const double* weight, const double* open) {
    double row = 0;
    for (int m = 0; m < ni; ++m) row += weight[m] * open[m];
    sum += share * row;
  });
  if (sum <= 0 && move_to_nearest_water(n, x, y)) return;
  // A grain with no water anywhere around it has been driven deep into the pipe: the NaN reaches its velocity, and the
  // check of the grains names it.
  const double scale = sum > 0 ? 1.0 / sum : std::numeric_limits<double>::quiet_NaN();
  for (int k = 0; k < f.nj; ++k) wy[k] *= scale;
}

bool Transfer::move_to_nearest_water(int n, double x, double y) {
  Footprint& f = footprint_[n];
  const int columns = static_cast<int>(edges_x_.size()) - 1, rows = static_cast<int>(edges_y_.size()) - 1;
  const int a = f.i0 - first_column_, b = f.j0 - first_row_;
  double nearest = std::numeric_limits<double>::infinity();
  Footprint found{0, 1, 0, 1};
  for (int j = std::max(0, b - volumes_to_water); j < std::min(rows, b + f.nj + volumes_to_water); ++j)
    for (int i = std::max(0, a - volumes_to_water); i < std::min(columns, a + f.ni + volumes_to_water); ++i) {
      if (open_(first_column_ + i, first_row_ + j) <= 0) continue;
      const double distance =
          std::hypot(0.5 * (edges_x_[i] + edges_x_[i + 1]) - x, 0.5 * (edges_y_[j] + edges_y_[j + 1]) - y);
      if (distance < nearest) nearest = distance, found.i0 = first_column_ + i, found.j0 = first_row_ + j;
    }
  if (!std::isfinite(nearest)) return false;
  f = found;
  weight_x_[static_cast<std::size_t>(n) * widest_] = 1.0;
  weight_y_[static_cast<std::size_t>(n) * widest_] = 1.0 / open_(f.i0, f.j0);
  return true;
}

}  // namespace livebed::coupling
