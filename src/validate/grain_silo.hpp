#pragma once
#include <vector>

namespace livebed::validate {

/// A narrow bin between two side walls, filled by letting a lattice settle: who carries the grains?
struct SiloSetup {
  int columns = 20;            ///< width of the bin over d
  int rows = 80;               ///< of the lattice
  double friction = 0.5;       ///< between grains [-]
  double wall_friction = 0.5;  ///< at the side walls [-]; the floor has the same
  unsigned seed = 1;
};
/// One band of the bin, a few grains high.
struct SiloBand {
  double depth;     ///< of its middle below the top of the fill [m]
  double lateral;   ///< normal force of both side walls over twice its height [N/m]
  double friction;  ///< what the side walls carry over twice its height [N/m]
  double vertical;  ///< weight above its middle less what the side walls carry there, over the width [N/m]
};
struct SiloRun {
  double weight = 0;         ///< of all grains, submerged [N]
  double floor = 0;          ///< what the floor carries [N]
  double sides = 0;          ///< what the side walls carry by friction [N]
  double height = 0;         ///< of the fill [m]
  double mean_speed = 0;     ///< [m/s]
  double lateral_ratio = 0;  ///< K: lateral over vertical stress, between a fifth and four fifths of the depth [-]
  double mobilised = 0;      ///< friction over normal force of the side walls there [-]
  std::vector<SiloBand> bands;
  double seconds = 0;
  /// Share of the weight on the floor after Janssen (1895), with this K and friction.
  double janssen() const;
  double width = 0;
};
SiloRun run_silo(const SiloSetup& setup);

}  // namespace livebed::validate
