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
  /// 1 = the force is the one of the call before, and nobody asks for its impulse: most of those that sleep, which are
  /// then passed over here, too.  Empty: nobody.
  std::vector<std::int32_t> still;
};

/// Who sleeps and what would wake it (sleep.hpp); empty when nobody may sleep.
struct Sleep {
  std::vector<std::int32_t> asleep;  ///< 1 = asleep
  std::vector<std::int32_t>
      calm;              ///< looks in a row at which it had hardly moved; asleep: minus those with another force
  Array x_look, y_look;  ///< where it was at the last look [m]
  Array contact_x, contact_y, twist;  ///< contact forces when it fell asleep [N]
  Array fluid_x, fluid_y;             ///< force of the fluid then [N]
  Array load;  ///< its weight and half the sum of the normal forces on it then [N]; where that is
               ///< little among others, the mean of its slice, within bounds (sleep.cpp)
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
  Array impulse_x, impulse_y;      ///< what the fluid gave the grain since the last reset [N s]
  std::vector<std::int32_t> laps;  ///< times round the box downstream, less those upstream, since the last reset
  Sleep sleep;

  int count() const { return static_cast<int>(x.size()); }  ///< of the grains in the bed
};

/// Calls visit(array) for every array that has one entry a grain or, for what a case does without, none.
template <class Visit>
void each_grain_array(State& s, Visit&& visit) {
  visit(s.x), visit(s.y), visit(s.u), visit(s.v), visit(s.omega), visit(s.diameter), visit(s.id);
  visit(s.fluid.u), visit(s.fluid.v), visit(s.fluid.beta), visit(s.fluid.fx), visit(s.fluid.fy), visit(s.fluid.still);
  visit(s.impulse_x), visit(s.impulse_y), visit(s.laps);
  Sleep& z = s.sleep;
  visit(z.asleep), visit(z.calm), visit(z.x_look), visit(z.y_look), visit(z.contact_x), visit(z.contact_y);
  visit(z.twist), visit(z.fluid_x), visit(z.fluid_y), visit(z.load);
}

}  // namespace livebed::grains
