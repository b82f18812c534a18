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

Transfer::Transfer(const flow::Staggering& at, int first_column, int last_column, double half_width)
    : half_width_(half_width), first_column_(first_column), first_row_(at.j0), open_(at.volume) {
  // The volumes of u begin at the centre of cell 0, those of scalars and of v at the inlet; y likewise.
  double edge = at.shift_x ? 0.5 * at.hx[3] : 0.0;
  edges_x_.push_back(edge);
  for (int i = first_column; i <= last_column; ++i) edges_x_.push_back(edge += at.width[i + 2]);
  edge = at.shift_y ? 0.5 * at.hy[3] : 0.0;
  edges_y_.push_back(edge);
  for (int j = at.j0; j < at.j1; ++j) edges_y_.push_back(edge += at.height[j + 2]);

  double narrowest = edges_x_[1] - edges_x_[0];
  for (std::size_t k = 0; k + 1 < edges_x_.size(); ++k) narrowest = std::min(narrowest, edges_x_[k + 1] - edges_x_[k]);
  for (std::size_t k = 0; k + 1 < edges_y_.size(); ++k) narrowest = std::min(narrowest, edges_y_[k + 1] - edges_y_[k]);
  if (2 * half_width / narrowest + 2 > widest)
    base::fail(base::Exit::invalid_case,
               "coupling.kernel: half-width {:.3g} m spans more than {} cells of {:.3g} m; use a smaller kernel or "
               "larger cells",
               half_width, widest, narrowest);

  for (int j = at.j0; j < at.j1; ++j)
    for (int i = first_column; i <= last_column; ++i)
      open_(i, j) = at.volume(i, j) / (at.width[i + 2] * at.height[j + 2]);

  // Bins at least one kernel wide plus the volumes it touches at either end.
  double widest_volume = 0;
  for (std::size_t k = 0; k + 1 < edges_x_.size(); ++k)
    widest_volume = std::max(widest_volume, edges_x_[k + 1] - edges_x_[k]);
  const double length = edges_x_.back() - edges_x_.front(), wanted = 2 * half_width + 2 * widest_volume;
  const int bins = std::max(1, static_cast<int>(length / wanted));
  for (int k = 1; k < bins; ++k) bin_edges_.push_back(edges_x_.front() + length * k / bins);
  bin_first_.assign(bins + 1, 0);
}

void Transfer::bin(const grains::State& g) {
  const int n = g.count(), bins = static_cast<int>(bin_first_.size()) - 1;
  const double low = edges_x_.front(), scale = bins / (edges_x_.back() - low);
  bin_of_.resize(n);
  order_.resize(n);
  std::fill(bin_first_.begin(), bin_first_.end(), 0);
  for (int k = 0; k < n; ++k) {
    bin_of_[k] = std::clamp(static_cast<int>((g.x[k] - low) * scale), 0, bins - 1);
    ++bin_first_[bin_of_[k] + 1];
  }
  for (int b = 0; b < bins; ++b) bin_first_[b + 1] += bin_first_[b];
  for (int k = 0; k < n; ++k) order_[bin_first_[bin_of_[k]]++] = k;
  for (int b = bins; b > 0; --b) bin_first_[b] = bin_first_[b - 1];
  bin_first_[0] = 0;
}

int Transfer::span(const std::vector<double>& edges, double low, double high, int& count) {
  const int last = static_cast<int>(edges.size()) - 2;  // index of the last volume
  // Volumes are nearly even: guess, then walk.
  int a = static_cast<int>((low - edges.front()) / (edges.back() - edges.front()) * (last + 1));
  a = std::clamp(a, 0, last);
  while (a > 0 && edges[a] > low) --a;
  while (a < last && edges[a + 1] <= low) ++a;
  int b = a;
  while (b < last && edges[b + 1] < high) ++b;
  count = b - a + 1;
  return a;
}

void Transfer::footprint(double x, double y, Footprint& f) const {
  const int a = span(edges_x_, x - half_width_, x + half_width_, f.ni);
  const int b = span(edges_y_, y - half_width_, y + half_width_, f.nj);
  const auto weigh = [&](const std::vector<double>& edges, int first, int count, double center, double* weight) {
    double before = kernel_integral((edges[first] - center) / half_width_);
    for (int k = 0; k < count; ++k) {
      const double after = kernel_integral((edges[first + k + 1] - center) / half_width_);
      weight[k] = after - before;
      before = after;
    }
  };
  weigh(edges_x_, a, f.ni, x, f.wx);
  weigh(edges_y_, b, f.nj, y, f.wy);
  f.i0 = first_column_ + a;
  f.j0 = first_row_ + b;
  double sum = 0;
  for (int k = 0; k < f.nj; ++k) {
    const double* open = open_.row(f.j0 + k) + f.i0;
    double row = 0;
    for (int m = 0; m < f.ni; ++m) row += f.wx[m] * open[m];
    sum += f.wy[k] * row;
  }
  // A grain with no water anywhere around it has been driven deep into the pipe: the NaN reaches its velocity, and the
  // check of the grains names it.
  f.scale = sum > 0 ? 1.0 / sum : std::numeric_limits<double>::quiet_NaN();
}

void Transfer::gather(const base::Field& field, const grains::State& g, grains::Array& values) const {
  constexpr int block = 256;
  const int n = g.count();
  base::for_each_item(0, (n + block - 1) / block, [&](int k) {
    Footprint f;
    for (int m = k * block; m < std::min(n, (k + 1) * block); ++m) {
      footprint(g.x[m], g.y[m], f);
      double sum = 0;
      for (int b = 0; b < f.nj; ++b) {
        const double *open = open_.row(f.j0 + b) + f.i0, *v = field.row(f.j0 + b) + f.i0;
        double row = 0;
        for (int a = 0; a < f.ni; ++a) row += f.wx[a] * open[a] * v[a];
        sum += f.wy[b] * row;
      }
      values[m] = sum * f.scale;
    }
  });
}

}  // namespace livebed::coupling
