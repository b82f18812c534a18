#pragma once
#include <cstdint>
#include <vector>

#include "case/case.hpp"
#include "coupling/exchange.hpp"
#include "flow/advance.hpp"
#include "grains/ends.hpp"

namespace livebed::run {

/// What has passed the ends of the box since the release, and who waits outside.
struct SupplyState {
  std::vector<std::int32_t> waiting;     ///< ids of the grains outside, those that left first in front
  std::vector<double> waiting_diameter;  ///< of the same [m]
  double stretch = 0;                    ///< sand in the approach at the release, in mean grains
  double owed = 0;                       ///< mean grains that it lacks of that and the current would have brought
  double time = 0;                       ///< since the ends were last looked at [s]
  std::int64_t looks = 0, left = 0, entered = 0;

  template <class Self, class Visit>
  static void each_part(Self& s, Visit&& visit) {
    visit("waiting", s.waiting), visit("waiting_diameter", s.waiting_diameter), visit("stretch", s.stretch);
    visit("owed", s.owed), visit("time", s.time), visit("looks", s.looks), visit("left", s.left),
        visit("entered", s.entered);
  }
};

/// The sand at the ends of the box when it does not go round: what passes an end leaves the bed, and at the inlet there
/// enters nothing or what an endless approach would bring.
///
/// Equilibrium feed: what the approach, from the inlet to well before the pipe, lacks of the sand it held at the
/// release enters at the inlet, but no more than the current brings over a flat bed (Meyer-Peter and Mueller at the
/// nominal Shields number, what the preset livebed is held against).  So the bed before the pipe keeps its level, and
/// its transport can neither die out nor build up.  Each grain that enters takes height, velocity and spin of one that
/// moves there, chosen with the share it has in the transport, and is set higher if it would lie on others.  Grains
/// enter that have left before; while none waits outside, or nothing moves, the bed is owed them.
///
/// The contacts of the grains go round all the same, so that neither end needs a wall: grains that slide back over the
/// inlet leave, too.
class Supply {
public:
  Supply(const casefile::Case& c);

  /// Half-width of the stretch at either end in which grains may come and go without the water noticing what they
  /// leave and take of room [m]; 0 where the sand goes round.
  double margin() const;
  /// When the grains are released: how much sand the approach holds.
  void begin(const grains::State& s);
  /// After a coupled step of dt: lets grains leave and enter, some steps together.  theta: of the current now.
  void pass_ends(grains::Bed& bed, coupling::Coupler& coupler, double dt, double theta);

  bool goes_round() const { return kind_ == casefile::Supply::periodic; }
  const SupplyState& state() const { return state_; }
  SupplyState& state() { return state_; }

private:
  double in_approach(const grains::State& s, const std::vector<int>& leaving) const;
  std::vector<grains::Newcomer> feed(const grains::State& s, const std::vector<int>& leaving, double time);

  casefile::Supply kind_;
  double length_, diameter_, speed_;  ///< of the box [m], of a grain [m], of the water [m/s]
  double from_, to_;                  ///< newcomers are like those that move here; the approach ends at to_ [m]
  double grains_per_flux_;            ///< grains that pass in a second where q/sqrt((s-1) g d^3) is 1 [1/s]
  std::uint64_t seed_;
  SupplyState state_;
};

}  // namespace livebed::run
