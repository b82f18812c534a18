#pragma once
#include <vector>

#include "base/vec2.hpp"
#include "grains/laws.hpp"
#include "grains/neighbours.hpp"
#include "grains/state.hpp"

namespace livebed::grains {

constexpr double far_away = 1e9;  ///< where nobody is [m]

/// What a grain shows to its neighbours, packed so that one load fetches it.
struct Place {
  double x, y;  ///< centre [m]
  double r;     ///< radius [m]
  double w;     ///< speed of its surface from its spin, omega r [m/s]; a stored product, so that w_i + w_j = w_j + w_i
};
struct Motion {
  double u, v;  ///< [m/s]
};

/// What the eight grains of a slice keep to themselves, side by side so that a step reads one stream.  The fluid's
/// force is push - beta u, so its impulse follows from the time and the way since the slice was filled: no step writes
/// it.
struct alignas(64) Own {
  using Eight = double[lanes];
  Eight omega;                 ///< changes with the step
  Eight push_x, push_y, beta;  ///< push: f + beta U [N]
};

/// The same in mixed precision: all that a grain shows in one load, and what it keeps to itself.  Its spin is w alone.
struct Compact {
  double x, y;
  float r, w, u, v;
};
struct alignas(32) CompactOwn {
  using Eight = float[lanes];
  Eight push_x, push_y, beta;
};

/// What the records say of one grain, whatever their precision.
struct Grain {
  double x, y, r, w, u, v;
};
/// What the fluid does to it: its force is (x, y) - beta (u, v).
struct FluidPush {
  double x, y, beta;
};

/// The grains in the form the force loop reads.  Two sets of places and motions: a step reads one and writes the other,
/// so that no slice sees a neighbour that has already moved.  Between fill_records and read_records all that changes
/// with a step lives here alone, in memory that the making of new lists uses, too.
struct Records {
  bool mixed = false;  ///< compact is in use, else place, motion and own
  base::Lease<Place> place, place_next;
  base::Lease<Motion> motion, motion_next;
  base::Lease<Own> own;
  base::Lease<Compact> compact, compact_next;
  base::Lease<CompactOwn> compact_own;
  base::Lease<std::int64_t> filled_at;   ///< of each slice: steps of the bed when it was filled
  std::vector<std::uint8_t> asleep;      ///< of each slice: it is passed over
  std::vector<std::int32_t> awake;       ///< slices that are not, slab by slab along x
  std::vector<std::int32_t> border;      ///< those asleep with a neighbour awake, in order; see border_known
  bool border_known = false;             ///< neither slices nor neighbours have changed since it was found
  std::vector<std::uint8_t> turn;        ///< of each slice: it wakes or falls asleep
  std::vector<std::int64_t> slept_from;  ///< of each sleeping slice: step up to which its impulses are counted
  std::int64_t call_began = 0;           ///< steps of the bed when advance was called
  std::int64_t filled_for = -1;          ///< number of the lists (Contacts::rebuilds) all slices were filled for
  std::vector<std::uint8_t> moved;       ///< of each block of slices awake: some grain is off the leash
  Array pipe_impulse_x, pipe_impulse_y;  ///< of each slice since the last collection [N s]

  // Slabs along the current (slabs.hpp).
  int slabs = 0;
  std::int64_t slabs_for = -1;              ///< number of the lists they were cut for
  std::vector<std::int32_t> slab_of_patch;  ///< of each patch of slices
  std::vector<std::int32_t> slab_first;     ///< of each slab: where its slices begin in `awake`; and the end
  std::vector<std::uint8_t> slab_moved;     ///< as `moved`, of each slab
  std::int64_t plan_at = 0;                 ///< step of the bed at which the fastest grain is looked for again
  bool motion_known = false;                ///< motion_next holds the motion before the last step
  std::vector<double> partial;              ///< scratch

  /// Whether they have been filled since the lists were made.
  bool hold(const Contacts& c) const { return !filled_at.empty() && filled_for == c.rebuilds; }

  Grain grain(int i) const { return grain_of(place, motion, compact, i); }
  Grain grain_next(int i) const { return grain_of(place_next, motion_next, compact_next, i); }
  FluidPush fluid_push(int i) const {
    const auto push = [l = i % lanes](const auto& of) { return FluidPush{of.push_x[l], of.push_y[l], of.beta[l]}; };
    return mixed ? push(compact_own[i / lanes]) : push(own[i / lanes]);
  }

private:
  Grain grain_of(const base::Lease<Place>& places, const base::Lease<Motion>& motions,
                 const base::Lease<Compact>& compacts, int i) const {
    if (mixed) return {compacts[i].x, compacts[i].y, compacts[i].r, compacts[i].w, compacts[i].u, compacts[i].v};
    return {places[i].x, places[i].y, places[i].r, places[i].w, motions[i].u, motions[i].v};
  }
};

inline constexpr int slices_per_block = 8;  ///< what one thread takes at a time
/// The constants of a step.
struct Sweep {
  int count;  ///< of grains
  Law law;
  Contact pair, bottom, pipe_wall;
  Reach reach;
  Floor floor;
  double floor_spacing;  ///< between the fixed grains of the floor [m]
  double gravity;        ///< of a submerged grain, downwards [m/s2]
  double dt;             ///< [s]
  double leash;          ///< a grain that has gone further than this since it was listed must be listed anew [m]
  double kick_r3;        ///< dt / m of a grain times the cube of its radius [m3 s/kg]
  double spin;           ///< m r^2 / I [-]
  Circle pipe;
  std::vector<Segment> walls;  ///< further ones
};

/// Constants from complete parameters (derive) for a bed of so many grains.
Sweep make_sweep(const Params& p, const Circle& pipe, int count);

/// Fills the records from the state, those of sleeping slices once for each new lists, and clears the pipe's impulse.
/// steps: of the bed so far.
void fill_records(const State& s, const Contacts& c, std::int64_t steps, Records& r, base::Arena& memory);

/// The same for one slice, asleep or not.
void fill_slice(const State& s, int slice, std::int64_t steps, Records& r);

/// What the steps have changed in the slices that are awake, back into the state, and their impulses.
void read_records(const Sweep& k, std::int64_t steps, const Records& r, State& s);

/// The same for one slice, asleep or not.
void read_slice(const Sweep& k, std::int64_t steps, const Records& r, int slice, State& s);

/// What the grains gave the pipe since the records were filled [N s], summed in the order of the slices.
base::Vec2 collect_pipe_impulse(Records& r);

}  // namespace livebed::grains
