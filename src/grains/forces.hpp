#pragma once
#include <functional>

#include "base/vec2.hpp"
#include "grains/advance.hpp"

/// The forces in the contacts of a bed, for those who watch it: nothing here moves a grain or a history.
namespace livebed::grains {

/// What a grain touches besides other grains.
inline constexpr int the_floor = -1, the_pipe = -2;

/// A contact as the coming step will find it.
struct TouchingPair {
  int i;                      ///< a grain, by its place in the storage
  int j;                      ///< the other grain, or the_floor, the_pipe
  base::Vec2 branch;          ///< from the centre of i to that of j, or to the point where it touches floor or pipe [m]
  base::Vec2 direction;       ///< unit vector from i to the other
  double overlap;             ///< [m]
  double normal;              ///< f_n, positive: pushes the two apart [N]
  double tangential;          ///< f_s on i along (-n_y, n_x) [N]
  base::Vec2 force() const {  ///< on i [N]; the other feels the opposite
    return {-normal * direction.x - tangential * direction.y, tangential * direction.x - normal * direction.y};
  }
};

/// Calls visit for every contact between two grains once (i before j in the storage), then for those with floor and
/// pipe; walls of bed.walls and bed.side_walls are not among them.  The laws are those of the force loop, Eq. 20-24;
/// the bed must have been advanced at least once.
void visit_contacts(const Bed& bed, const std::function<void(const TouchingPair&)>& visit);

/// Sum of the contact forces on each grain [N], in the order of the storage.
std::vector<base::Vec2> contact_forces(const Bed& bed);

}  // namespace livebed::grains
