#pragma once
#include <functional>
#include <vector>

#include "grains/advance.hpp"

namespace livebed::grains {

/// One look at a bed that comes to rest.
struct SettleRow {
  double time;        ///< since the grains were let go [s]
  double mean_speed;  ///< [m/s]
  double max_speed;   ///< [m/s]
  double height;      ///< bed_height [m]
};

/// Is told every look while grains settle; what it throws ends that.
using OnLook = std::function<void(const SettleRow&)>;

struct Packing {
  Bed bed;
  std::vector<SettleRow> convergence;
};

/// The grains of the paper's Sec. 4.3 before they are let go: rows of a square lattice that fill the length, a gap of
/// lattice_gap d between the largest possible grains, diameters after sample_diameters and seeded shifts of at most
/// half the gap, which only break the symmetry.  Same seed, same bits.
Bed lattice(const Params& given);

/// Grains as dense as they will lie (packing_fraction) but in no order: each starts at random in its own box of a grid
/// and is pushed out of its neighbours without friction and weight.  A bed that starts so hardly falls: it settles in
/// half the time, and denser.  Same seed, same bits.
Bed scattered(const Params& given);

/// Lets the grains of a bed come to rest under their submerged weight: in a thick fluid until the mean speed is below
/// settled_speed, then in none, until it has stayed so for ten looks in a row.  A bed that gets no slower is at rest,
/// too, when all but one grain in a thousand are below ten times settled_speed: single wedged ones may tremble for ever
/// and shake the others a little.  Fluid forces and impulses are zero afterwards.  Throws Fault (stopped by limit) with
/// the last speeds and what to do when settle_time passes before, or already when more of the bed shakes without
/// getting slower.
std::vector<SettleRow> settle(Bed& bed, const OnLook& on_look = {});

/// Brings a bed at rest to a level [m]: heaps more grains onto it where its mean level is not well above, takes away
/// every grain whose centre is higher, and lets the rest settle anew.  The number of grains changes; contacts between
/// those that stay remember what they did.
std::vector<SettleRow> level(Bed& bed, double height, const OnLook& on_look = {});

/// Makes a bed at rest: lattice or scattered (start), settle and, when a thickness is given, level; the number of
/// grains then follows from it.  A bed of pieces is one of them packed so and copied side by side, settled again: a
/// long bed in little more than the time of a short one, that repeats itself.
Packing pack(const Params& given, const OnLook& on_look = {});

/// Copies of a bed side by side, a long bed in the time a short one takes to pack.  The period makes the seams fit.
/// Contacts remember what those of the tile do.
Bed side_by_side(const Bed& tile, int tiles);

inline constexpr double lowering_speed = 0.05;  ///< [m/s]

/// Brings the pipe to its place.  Grains bulge above the nominal bed by half a diameter or more and an embedded pipe
/// meets many of them, so it starts above them and is lowered at `speed` [m/s], slow enough that they make way without
/// knocks, in a thick fluid; then the bed settles again.  Returns the convergence of that.  Throws as settle does, and
/// Fault (invalid case) when the pipe would reach through the floor.
std::vector<SettleRow> place_pipe(Bed& bed, const Circle& target, double speed = lowering_speed,
                                  const OnLook& on_look = {});

}  // namespace livebed::grains
