#pragma once
#include <vector>

#include "grains/packing.hpp"

/// Beds and heaps of a few hundred grains that tell whether contacts add up to sand.
namespace livebed::validate {

/// Does a settled bed come to rest and stay at rest?
struct RestRun {
  bool settled = false;   ///< within settle_time
  double mean_speed = 0;  ///< mean over the grains, its largest 0.3 to 0.4 s after settling [m/s]
  double grain_time = 0;  ///< until it was settled [s]
  double contacts = 0;    ///< touching grains a grain
  double seconds = 0;     ///< wall time
};
RestRun run_rest(grains::Params params);

/// Grains of 2 mm that sink slowly, two abreast, onto a rough floor and pile up.
struct HeapSetup {
  int grains = 600;
  double friction = 0.5;
  double rolling_friction = 0;
  unsigned seed = 1;
  grains::Precision precision = grains::Precision::all_double;
};
struct HeapRun {
  double left = 0, right = 0;      ///< slope of the flanks [degrees]
  double height = 0;               ///< of the top [m]
  double mean_speed = 0;           ///< at the end [m/s]
  std::vector<double> x, surface;  ///< from the middle, of bins two grains wide [m]
  double seconds = 0;
  double angle() const { return 0.5 * (left + right); }
};
HeapRun run_heap(const HeapSetup& setup);

/// The same settled bed, knocked, in double and in mixed precision.
struct PrecisionRun {
  double worst = 0;    ///< largest difference of the velocities of a grain, over the root mean square of all velocities
  double mean = 0;     ///< root mean square of those differences, over the same
  double speed = 0;    ///< that root mean square [m/s]
  double overlap = 0;  ///< root mean square difference of overlaps that both have, over the mean overlap
  double seconds = 0;
};
PrecisionRun compare_precision(const grains::Params& params, int steps);

}  // namespace livebed::validate
