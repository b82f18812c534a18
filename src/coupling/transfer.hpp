#pragma once
#include <array>
#include <vector>

#include "base/field.hpp"
#include "flow/staggering.hpp"
#include "grains/state.hpp"

namespace livebed::coupling {

/// Spreads what belongs to grains over control volumes of the grid, and averages the grid's values at grains, with one
/// and the same kernel: (1 - s^2)^2 of the distance s over the half-width, integrated over each volume, so that the
/// size of the cells does not matter (they may be smaller than a grain).  Weights are proportional to the open part of
/// a volume and sum to one: nothing is lost at pipe, floor and ends.
class Transfer {
public:
  Transfer() = default;
  /// at: the volumes; first, last column that may receive; half_width of the kernel [m].
  Transfer(const flow::Staggering& at, int first_column, int last_column, double half_width);

  /// Sorts the grains into bins of columns that two bins apart share no volume.  Call when grains have moved.
  void bin(const grains::State& g);

  /// values[n] = kernel mean of the field at grain n.
  void gather(const base::Field& field, const grains::State& g, grains::Array& values) const;

  /// field(i,j) += sum over grains of weight x values(n), for several fields at once: values(n) returns an array of M.
  /// The order of additions is fixed whatever the number of threads.
  template <std::size_t M, class Values>
  void scatter(const grains::State& g, const std::array<base::Field*, M>& fields, Values&& values) const;

private:
  static constexpr int widest = 48;  // volumes a kernel may span in one direction
  struct Footprint {
    int i0, ni, j0, nj;
    double wx[widest], wy[widest];
    double scale;  // one over the sum of weight x openness
  };
  void footprint(double x, double y, Footprint& f) const;
  static int span(const std::vector<double>& edges, double low, double high, int& count);

  double half_width_ = 0;
  int first_column_ = 0, first_row_ = 0;
  std::vector<double> edges_x_, edges_y_;  // of the volumes that may receive
  base::Field open_;                       // open fraction of each
  std::vector<double> bin_edges_;
  std::vector<int> bin_first_, order_, bin_of_;
};

}  // namespace livebed::coupling

#include "coupling/transfer_scatter.hpp"
