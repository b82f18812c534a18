#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace livebed::run {

/// Columns of profiles.csv.
const std::vector<std::string>& profile_columns();

/// Means over time and a stretch of x, layer by layer from the floor up: what grains and water do on their way.  Adds
/// up every step, weighted with its length, until a window is full.
///
/// Solids: volumes and momenta of spheres, cut at the layers.  Stress of the grains: forces in contacts times the way
/// between the centres, laid evenly along it (Irving and Kirkwood 1950, as in Goldhirsch 2010, Granular Matter 12,
/// 239), and -rho_s <u'v'> of their own motion.  A grain belongs to the stretch by its centre, a contact by its middle.
/// Water: means over its open part; cells that the pipe cuts have no part in the stress.
class Profiles {
public:
  explicit Profiles(const casefile::Case& resolved);

  /// What a checkpoint must hold.
  struct Sums {
    std::vector<double> layers;  ///< quantity by quantity, a number for each layer
    std::vector<double> rows;    ///< of the water, a number for each row of cells
    double from = 0;             ///< begin of the window that is being filled [s]
    double seen = 0;             ///< time of the last step [s]
    std::int64_t windows = 0;    ///< written so far
  };
  const Sums& sums() const { return sums_; }
  void restore(const Sums& sums);

  /// Takes the step that has just been done; true when it has filled the window.
  bool add(const Simulation& sim);
  /// Rows of the full window, from the floor up, one a layer; begins the next one.
  std::vector<std::vector<double>> take(const Simulation& sim);

private:
  void add_grains(const grains::Bed& bed, double dt);
  void add_contacts(const grains::Bed& bed, double dt);
  void add_water(const Simulation& sim, double dt);
  double& layer(int quantity, int l) { return sums_.layers[static_cast<std::size_t>(quantity) * layers_ + l]; }
  double& row(int quantity, int j) { return sums_.rows[static_cast<std::size_t>(quantity) * rows_ + j]; }
  bool within(double x) const { return x >= x_from_ && x < x_to_; }
  /// Calls visit(layer, share) for the layers between two heights.
  template <class Visit>
  void spread(double low, double high, Visit&& visit) const;

  double x_from_, x_to_, cell_, slab_, density_, every_, first_;
  int layers_ = 0, rows_ = 0;
  std::vector<double> open_;  ///< of each layer: length of the stretch outside the pipe [m]
  Sums sums_;
};

}  // namespace livebed::run
