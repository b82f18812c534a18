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
  double owed = 0;                       ///< grains that should have entered and have not yet
  double time = 0;                       ///< since the ends were last looked at [s]
  std::int64_t looks = 0, left = 0, entered = 0;

  template <class Self, class Visit>
  static void each_part(Self& s, Visit&& visit) {
    visit("waiting", s.waiting), visit("waiting_diameter", s.waiting_diameter), visit("owed", s.owed);
    visit("time", s.time), visit("looks", s.looks), visit("left", s.left), visit("entered", s.entered);
  }
};

/// The sand at the ends of the box when it does not go round: what passes an end leaves the bed, and at the inlet there
/// enters nothing or what an endless approach would bring.
///
/// Equilibrium feed: as much as moves on average over a stretch of the bed well before the pipe enters at the inlet, a
/// bed that neither rises nor sinks where it is not disturbed (zero gradient of the transport).  Each grain that enters
/// takes height, velocity and spin of one that moves there, chosen with the share it has in the transport, and is set
/// higher if it would lie on others.  Grains enter that have left before; while none waits outside, the bed is owed
/// them.
///
/// The contacts of the grains go round all the same, so that neither end needs a wall: grains that slide back over the
/// inlet leave, too.
class Supply {
public:
  Supply(const casefile::Case& c);

  /// Half-width of the stretch at either end in which grains may come and go without the water noticing what they
  /// leave and take of room [m]; 0 where the sand goes round.
  double margin() const;
  /// After a coupled step of dt: lets grains leave and enter, some steps together.
  void pass_ends(grains::Bed& bed, coupling::Coupler& coupler, double dt);

  bool goes_round() const { return kind_ == casefile::Supply::periodic; }
  const SupplyState& state() const { return state_; }
  SupplyState& state() { return state_; }

private:
  std::vector<grains::Newcomer> feed(const grains::State& s, const std::vector<int>& leaving, double time);

  casefile::Supply kind_;
  double length_, diameter_, speed_;  ///< of the box [m], of a grain [m], of the water [m/s]
  double from_, to_;                  ///< the stretch whose transport enters [m]
  std::uint64_t seed_;
  SupplyState state_;
};

}  // namespace livebed::run
