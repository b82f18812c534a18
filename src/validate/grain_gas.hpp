#pragma once
#include <cstdint>
#include <vector>

#include "grains/params.hpp"

namespace livebed::validate {

/// Grains that fly about under their weight over a smooth plane, without a fluid: what collisions do to the energy.
struct GasSetup {
  int grains = 1000;
  double steps_per_contact = 200;  ///< Delta t_c of Eq. 25 over the step
  double restitution = 1;
  double friction = 0;
  int steps = 60000;
  grains::Precision precision = grains::Precision::all_double;
};
struct GasRun {
  double drift = 0;                  ///< largest distance of the energy from its first value, over that value
  double largest_gain = 0;           ///< largest rise of the energy from one look to the next, over its first value
  double left = 1;                   ///< last energy over the first
  double momentum = 0;               ///< change of the momentum along x, over sum m |u|
  std::int64_t collisions = 0;       ///< of two grains
  std::vector<double> time, energy;  ///< [s], over the first value
  double seconds = 0;                ///< wall time
};
/// Energy: translation, spin, height and normal springs; of springs along the contact nothing is counted, so only
/// frictionless grains can keep it.
GasRun run_gas(const GasSetup& setup);

}  // namespace livebed::validate
