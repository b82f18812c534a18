#pragma once
#include <cstdint>
#include <type_traits>

#include "base/vec2.hpp"
#include "grains/contact.hpp"
#include "grains/neighbours.hpp"
#include "grains/params.hpp"
#include "grains/state.hpp"

namespace livebed::grains {

/// The grains, the walls around them and what their contacts remember.
struct Bed {
  Params params;  ///< complete (derive)
  State state;
  Circle pipe;
  Contacts contacts;
  base::Vec2 pipe_impulse;  ///< what the grains gave the pipe since the last reset [N s]
  std::int64_t steps = 0;   ///< done so far
  int outside = 0;          ///< grains of params.count that are not in the bed now (ends.hpp)

  // Filled anew by every call of advance; no part of a checkpoint.
  Records records;
  ListScratch scratch;
};

/// A bed of `count` grains at rest with every array of the right length: diameter d, all at the origin, no fluid.
Bed make_bed(const Params& complete);

/// Moves the grains by `steps` steps of params.step in the fluid forces of state.fluid, which stay as they are.  The
/// order of the grains may change: they are sorted whenever the lists are rebuilt.  The same bits for any number of
/// threads.  Costs what the grains awake cost: nobody may move a sleeper in between.  Throws Fault (diverged) naming
/// the grain, its place and the step when a number is not finite or a grain has left the box, Fault (internal) when a
/// grain is missing or, noticed when all lists are made anew, doubled.
void advance(Bed& bed, int steps);

/// Throws Fault (internal) unless every array holds all grains and no id from 0 to params.count - 1 occurs twice.
void check_count(const Bed& bed);

/// A SlotArray as visitors of each_array see it: as doubles.
template <class Slots, class Visit>
void visit_slots(const char* name, Slots& slots, Visit&& visit) {
  if constexpr (std::is_const_v<Slots>) {
    const Array values = slots.doubles();
    visit(name, values);
  } else {
    Array values = slots.doubles();
    visit(name, values);
    slots.assign(values);
  }
}

/// Calls visit(name, array) for every array a checkpoint must hold (doubles and integers), State and Contacts alike, in
/// a fixed order.  With these, Contacts::pipe_built, ::rebuilds and ::refreshed, pipe_impulse, steps and outside, a bed
/// goes on with the same bits.
template <class BedLike, class Visit>
void each_array(BedLike& bed, Visit&& visit) {
  auto& s = bed.state;
  auto& c = bed.contacts;
  visit("x", s.x), visit("y", s.y), visit("u", s.u), visit("v", s.v), visit("omega", s.omega);
  visit("diameter", s.diameter), visit("id", s.id), visit("laps", s.laps);
  visit("fluid_u", s.fluid.u), visit("fluid_v", s.fluid.v), visit("fluid_beta", s.fluid.beta);
  visit("fluid_fx", s.fluid.fx), visit("fluid_fy", s.fluid.fy), visit("fluid_still", s.fluid.still);
  visit("impulse_x", s.impulse_x), visit("impulse_y", s.impulse_y);
  visit("list_first", c.first), visit("list_last", c.last), visit("list_first_apart", c.first_apart);
  visit("list_neighbour", c.neighbour), visit_slots("list_spring", c.spring, visit);
  visit("floor_spring", c.wall_spring[slot_floor]), visit("floor_odd_spring", c.wall_spring[slot_floor_odd]);
  visit("pipe_spring", c.wall_spring[slot_pipe]), visit("list_near", c.near);
  auto& z = s.sleep;
  visit("asleep", z.asleep), visit("calm", z.calm), visit("x_look", z.x_look), visit("y_look", z.y_look);
  visit("sleep_contact_x", z.contact_x), visit("sleep_contact_y", z.contact_y), visit("sleep_twist", z.twist);
  visit("sleep_fluid_x", z.fluid_x), visit("sleep_fluid_y", z.fluid_y), visit("sleep_load", z.load);
  visit_slots("list_rolling", c.rolling, visit), visit("floor_rolling", c.wall_rolling[slot_floor]);
  visit("floor_odd_rolling", c.wall_rolling[slot_floor_odd]), visit("pipe_rolling", c.wall_rolling[slot_pipe]);
  visit("wall_place", c.wall_place), visit("wall_first", c.wall_first), visit("wall_piece", c.wall);
  visit("wall_spring", c.piece_spring), visit("wall_rolling", c.piece_rolling);
  visit("x_built", c.x_built), visit("y_built", c.y_built);
}

}  // namespace livebed::grains
