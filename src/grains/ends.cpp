#include "grains/ends.hpp"

namespace livebed::grains {

void exchange_grains(Bed& bed, const std::vector<int>& leaving, const std::vector<Newcomer>& entering) {
  State& s = bed.state;
  std::vector<std::int32_t>& leaves = bed.scratch.leaves;
  leaves.assign(s.x.size(), 0);
  for (const int k : leaving) leaves[k] = 1;
  for (const Newcomer& g : entering) {
    each_grain_array(s, [](auto& a) {
      if (!a.empty()) a.push_back(0);
    });
    s.x.back() = g.x, s.y.back() = g.y, s.u.back() = g.u, s.v.back() = g.v;
    s.omega.back() = g.omega, s.diameter.back() = g.diameter, s.id.back() = g.id;
    leaves.push_back(0);
  }
  const Sweep constants = make_sweep(bed.params, bed.pipe, s.count());
  rebuild(s, bed.contacts, bed.scratch, constants.reach, bed.pipe, constants.walls);
  leaves.clear();
  bed.outside += static_cast<int>(leaving.size()) - static_cast<int>(entering.size());
}

}  // namespace livebed::grains
