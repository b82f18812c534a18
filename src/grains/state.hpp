#pragma once
#include <cstdint>
#include <vector>

#include "base/aligned.hpp"

namespace livebed::grains {

using Array = base::AlignedVector<double>;

/// The pipe as the grains see it: a circle they cannot enter.
struct Circle {
  bool present = false;
  double x = 0, y = 0, diameter = 0;  ///< [m]
};

/// What the fluid does to each grain during the coming sub-steps: the force is f + beta (U - u_p).  Filled by coupling.
struct FluidForce {
  Array u, v;    ///< fluid velocity at the grain [m/s]
  Array beta;    ///< linearised drag [N s/m]
  Array fx, fy;  ///< further force [N]
};

/// Who sleeps and what would wake it (sleep.hpp); empty when nobody may sleep.
struct Sleep {
  std::vector<std::int32_t> asleep;  ///< 1 = asleep
  std::vector<std::int32_t>
      calm;              ///< looks in a row at which it had hardly moved; asleep: minus those with another force
  Array x_look, y_look;  ///< where it was at the last look [m]
  Array contact_x, contact_y, twist;  ///< contact forces when it fell asleep [N]
  Array fluid_x, fluid_y;             ///< force of the fluid then [N]
  Array load;                         ///< its weight and half the sum of the normal forces on it then [N]
};

/// Everything that changes with time, one entry a grain, in the order of the storage: grains are sorted in space
/// whenever the neighbour lists are rebuilt, and every array moves with them; id names a grain for life.
struct State {
  Array x, y;      ///< centre [m], 0 <= x < length
  Array u, v;      ///< velocity [m/s]
  Array omega;     ///< spin [1/s], counter-clockwise positive
  Array diameter;  ///< [m]
  std::vector<std::int32_t> id;
  FluidForce fluid;
  Array impulse_x, impulse_y;  ///< what the fluid gave the grain since the last reset [N s]
  Sleep sleep;

  int count() const { return static_cast<int>(x.size()); }
};

}  // namespace livebed::grains
