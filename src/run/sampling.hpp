#pragma once
#include <optional>
#include <string>
#include <vector>

#include "run/scour.hpp"
#include "run/simulation.hpp"

/// The numbers a run writes, taken from the state of a simulation.
namespace livebed::run {

/// Cells of the sampling grid over the grain diameter.
inline constexpr double sampling_cell_over_d = 0.5;

/// Mean level of a settled bed without pipe [m]: the bed line of the smoothed solid fraction.
double measured_level(const casefile::Case& c, const grains::Bed& bed);

/// The level below which the bed counts as packed, over the bed's thickness: where the packed solid fraction is read.
inline constexpr double packed_from = 0.25, packed_to = 0.75;

/// Columns of series.csv, in order.
const std::vector<std::string>& series_columns();

/// What one look at the simulation tells.
struct Sample {
  double time = 0;             ///< [s]
  double depth_over_D = 0;     ///< S/D [-]
  double theta = 0;            ///< measured [-]
  double largest_overlap = 0;  ///< of two grains over d [-]
  std::vector<double> line;    ///< bed line [m], one entry a sampling column
  std::vector<double> row;     ///< of series.csv
};

/// Takes samples of one run: holds the smoothing kernel and what the original bed was.
class Sampler {
public:
  /// Original level and packed fraction are read from the simulation's bed unless they come from a checkpoint.
  explicit Sampler(const Simulation& sim);
  struct Original {
    double level = 0, packed = 0;
  };
  const Original& original() const { return original_; }
  void restore(const Original& original) { original_ = original; }

  Sample sample(const Simulation& sim);
  const std::vector<double>& x() const { return x_; }  ///< of the bed line [m]

private:
  SolidFraction solid_;
  Original original_;
  std::vector<double> x_;
};

}  // namespace livebed::run
