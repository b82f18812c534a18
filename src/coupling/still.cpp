#include "coupling/still.hpp"

#include <algorithm>
#include <array>

#include "base/math.hpp"

namespace livebed::coupling {

StillGrains::StillGrains(int nx, int ny, int grains, double grain_diameter) : diameter_(grain_diameter) {
  for (base::Field* sum : {&solid, &beta_u, &beta_v, &damping}) *sum = base::Field(nx, ny);
  for (grains::Array* of : {&damps, &x_, &y_, &beta_, &volume_}) of->assign(grains, 0.0);
}

void StillGrains::sum(Kernels& at, const std::vector<int>& ids, double sign) {
  if (ids.empty()) return;
  at.locate(x_, y_, ids);
  const auto drag = [&](int id) { return std::array{sign * beta_[id]}; };
  at.u.scatter(std::array{&beta_u}, drag);
  at.v.scatter(std::array{&beta_v}, drag);
  at.c.scatter(std::array{&solid, &damping}, [&](int id) { return std::array{sign * volume_[id], sign * damps[id]}; });
}

void StillGrains::add(grains::State& g, Kernels& at, const std::vector<int>& which) {
  g.fluid.still.resize(g.x.size());
  ids_.clear();
  for (const int k : which) {
    const int id = g.id[k];
    g.fluid.still[k] = 1, ids_.push_back(id);
    x_[id] = g.x[k], y_[id] = g.y[k];
    beta_[id] = g.fluid.beta[k], volume_[id] = base::sphere_volume(g.diameter[k]);
  }
  sum(at, ids_, 1);
}

const std::vector<int>& StillGrains::wake(grains::State& g, Kernels& at) {
  woken_.clear(), ids_.clear();
  if (g.sleep.asleep.empty()) return woken_;
  for (int k = 0; k < g.count(); ++k) {
    if (!is_still(g, k) || g.sleep.asleep[k] != 0) continue;
    g.fluid.still[k] = 0;
    woken_.push_back(k), ids_.push_back(g.id[k]);
  }
  sum(at, ids_, -1);
  return woken_;
}

void StillGrains::let_leave(const grains::State& g, Kernels& at, const std::vector<int>& leaving) {
  ids_.clear();
  for (const int k : leaving)
    if (is_still(g, k)) ids_.push_back(g.id[k]);
  sum(at, ids_, -1);
}

void StillGrains::forget(grains::State& g) {
  g.fluid.still.assign(g.x.size(), 0);
  for (base::Field* sum : {&solid, &beta_u, &beta_v, &damping}) sum->fill(0.0);
}

void StillGrains::unsettle_surface(grains::State& g, Kernels& at) {
  find_surface(g, [&](int k) { return is_still(g, k); });
  ids_.clear();
  for (int k = 0; k < g.count(); ++k) {
    if (!is_still(g, k) || depth(g, k) > surface_depth) continue;
    g.fluid.still[k] = 0;
    ids_.push_back(g.id[k]);
  }
  sum(at, ids_, -1);
}

}  // namespace livebed::coupling
