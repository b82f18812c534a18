#pragma once
#include "grains/advance.hpp"

/// Grains that leave the bed and enter it while it moves: at the ends of a box whose sand does not go round.
namespace livebed::grains {

/// A grain that comes into the bed; its id is one that no grain in it has.
struct Newcomer {
  double x, y, u, v, omega;  ///< as in State
  double diameter;           ///< [m]
  std::int32_t id;
};

/// Takes the grains at the places `leaving` of the storage out of the bed and puts others in: State::count() is then
/// another one, the grains have been sorted, and every list is new.  Between two calls of advance; nobody who leaves or
/// touches a newcomer may be asleep.  Throws what rebuild throws.
void exchange_grains(Bed& bed, const std::vector<int>& leaving, const std::vector<Newcomer>& entering);

}  // namespace livebed::grains
