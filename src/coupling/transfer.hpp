#pragma once
#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "base/field.hpp"
#include "base/loops.hpp"
#include "flow/staggering.hpp"
#include "grains/state.hpp"

namespace livebed::coupling {

/// Edges of a row of volumes of any widths [m], and a table that finds the volume of a place at once.
class Edges {
public:
  Edges() = default;
  explicit Edges(std::vector<double> at);
  double operator[](int k) const { return at_[k]; }
  int volumes() const { return static_cast<int>(at_.size()) - 1; }
  double first() const { return at_.front(); }
  double last() const { return at_.back(); }
  /// Most volumes that a length can touch.
  int touched_by(double length) const;
  /// Largest length of so many volumes side by side [m].
  double widest(int volumes) const;
  /// The volume that x is in, or the nearest one.
  int volume_of(double x) const {
    const int bin =
        std::clamp(static_cast<int>((x - first()) * bins_per_length_), 0, static_cast<int>(from_.size()) - 1);
    int k = from_[bin];
    while (k + 1 < volumes() && at_[k + 1] <= x) ++k;
    return k;
  }

private:
  std::vector<double> at_;
  double narrowest_ = 0, bins_per_length_ = 0;
  std::vector<int> from_;  // the volume in which a bin of the table begins
};

/// A volume less open than this exchanges nothing with grains [-]: one grain would fill the sliver of water that it
/// holds, and what the grain does to so little of it has no bounds.
inline constexpr double least_open = 0.25;

/// Spreads what belongs to grains over control volumes of the grid, and averages the grid's values at grains, with one
/// and the same kernel: (1 - s^2)^2 of the distance s over the half-width, integrated over each volume, so that the
/// size of the cells does not matter (they may be smaller than a grain).  Weights are proportional to the open part of
/// a volume, nothing for slivers, and sum to one: nothing is lost at pipe, floor and ends.
class Transfer {
public:
  Transfer() = default;
  /// at: the volumes; aperture: a volume whose own face is closed receives nothing; first, last column that may
  /// receive; half_width of the kernel [m].
  Transfer(const flow::Staggering& at, const base::Field& aperture, int first_column, int last_column,
           double half_width);

  /// Computes the weights of the grains n in `which`, at (x[n], y[n]), and sorts them into bins of columns; two bins
  /// apart share no volume.  To be called when grains have moved or changed places, before gather and scatter, which
  /// are about these grains alone.
  void locate(const grains::Array& x, const grains::Array& y, const std::vector<int>& which);

  /// values[m][n] = kernel mean of field m at grain n, for several fields at once.
  template <std::size_t M>
  void gather(const std::array<const base::Field*, M>& fields, const std::array<grains::Array*, M>& values) const {
    const int n = static_cast<int>(footprint_.size());
    with_columns([&](auto columns) {
      base::for_each_item(0, (n + grains_a_block - 1) / grains_a_block, [&](int block) {
        for (int k = block * grains_a_block; k < std::min(n, (block + 1) * grains_a_block); ++k) {
          std::array<double, M> sum{};
          for_each_row(columns, k, [&](int i0, int j, double wy, const auto& wx) {
            for (std::size_t m = 0; m < M; ++m) {
              const double* v = fields[m]->row(j) + i0;
              double row = 0;
              for (int a = 0; a < columns; ++a) row += wx(a) * v[a];
              sum[m] += wy * row;
            }
          });
          for (std::size_t m = 0; m < M; ++m) (*values[m])[grain_[k]] = sum[m];
        }
      });
    });
  }
  void gather(const base::Field& field, grains::Array& values) const {
    gather(std::array{&field}, std::array{&values});
  }

  /// field(i,j) += sum over grains of weight x values(n), for several fields at once: values(n) returns an array of M.
  /// The order of additions is fixed whatever the number of threads.
  template <std::size_t M, class Values>
  void scatter(const std::array<base::Field*, M>& fields, Values&& values) const {
    const int bins = static_cast<int>(bin_first_.size()) - 1;
    with_columns([&](auto columns) {
      for (int parity = 0; parity < 2; ++parity)
        base::for_each_item(0, (bins - parity + 1) / 2, [&](int half) {
          const int bin = 2 * half + parity;
          for (int k = bin_first_[bin]; k < bin_first_[bin + 1]; ++k) {
            const int n = order_[k];
            const std::array<double, M> value = values(grain_[n]);
            for_each_row(columns, n, [&](int i0, int j, double wy, const auto& wx) {
              for (std::size_t m = 0; m < M; ++m) {
                double* to = fields[m]->row(j) + i0;
                const double share = wy * value[m];
                for (int a = 0; a < columns; ++a) to[a] += share * wx(a);
              }
            });
          }
        });
    });
  }

private:
  static constexpr int grains_a_block = 256;

  /// Where the volumes of a grain begin: columns_ x rows_ of them, as many as a kernel can touch anywhere.  Those that
  /// it does not touch have no weight; numbers that change from grain to grain would cost more than they spare.
  struct Footprint {
    int i0, j0;
    bool whole;  ///< all of them are entirely open
  };
  /// Calls work(columns_), the usual numbers as constants to the compiler.
  template <class Work>
  void with_columns(Work&& work) const {
    switch (columns_) {
      case 1:
        return work(std::integral_constant<int, 1>{});
      case 2:
        return work(std::integral_constant<int, 2>{});
      case 3:
        return work(std::integral_constant<int, 3>{});
      case 4:
        return work(std::integral_constant<int, 4>{});
      case 5:
        return work(std::integral_constant<int, 5>{});
      case 6:
        return work(std::integral_constant<int, 6>{});
      default:
        return work(columns_);
    }
  }
  /// Calls visit(first column, row, weight along y, weight along x of each column times its open fraction) once for
  /// each row of volumes of the nth grain.
  template <class Columns, class Visit>
  void for_each_row(Columns columns, int n, Visit&& visit) const {
    const Footprint& f = footprint_[n];
    const double* wy = weight_y(n);
    const auto wx = weights_along_x(columns, n);
    if (f.whole) {
      for (int b = 0; b < rows_; ++b) visit(f.i0, f.j0 + b, wy[b], [&wx](int a) { return wx[a]; });
    } else {
      for (int b = 0; b < rows_; ++b) {
        const double* open = open_.row(f.j0 + b) + f.i0;
        visit(f.i0, f.j0 + b, wy[b], [&wx, open](int a) { return wx[a] * open[a]; });
      }
    }
  }
  template <int columns>
  std::array<double, columns> weights_along_x(std::integral_constant<int, columns>, int n) const {
    std::array<double, columns> wx;
    std::copy_n(weight_x(n), columns, wx.begin());
    return wx;
  }
  const double* weights_along_x(int, int n) const { return weight_x(n); }
  double* weight_x(int n) { return &weights_[static_cast<std::size_t>(n) * (columns_ + rows_)]; }
  double* weight_y(int n) { return weight_x(n) + columns_; }
  const double* weight_x(int n) const { return &weights_[static_cast<std::size_t>(n) * (columns_ + rows_)]; }
  const double* weight_y(int n) const { return weight_x(n) + columns_; }
  void locate_one(int n, double x, double y);
  /// The nth grain, all of whose kernel is in closed volumes, as beside a pipe in cells larger than itself, belongs to
  /// the nearest volume with water; false when there is none within volumes_to_water of the kernel.
  bool move_to_nearest_water(int n, double x, double y);
  static constexpr int volumes_to_water = 3;

  double half_width_ = 0;
  int first_column_ = 0, first_row_ = 0;
  int columns_ = 0, rows_ = 0;  // most volumes that a kernel touches along x and along y
  Edges edges_x_, edges_y_;     // of the volumes that may receive
  base::Field open_;            // open fraction of each
  std::vector<Footprint> footprint_;
  std::vector<int> grain_;  // which grain each is
  std::vector<double>
      weights_;  // columns_ along x and rows_ along y of each grain; those along y hold the normalisation
  std::vector<int> bin_first_, order_, bin_of_;
};

/// Of the same grains over the volumes of u, of v and of scalars.
struct Kernels {
  Transfer u, v, c;
  void locate(const grains::Array& x, const grains::Array& y, const std::vector<int>& which) {
    for (Transfer* at : {&u, &v, &c}) at->locate(x, y, which);
  }
};

}  // namespace livebed::coupling
