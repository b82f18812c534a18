#include "grains/slabs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/loops.hpp"
#include "base/math.hpp"
#include "grains/kernels.hpp"

namespace livebed::grains {

namespace {

/// Slices that go into a slab together: neighbours in the order of the grains.
constexpr int slices_per_patch = 8;
/// Slabs narrower than a few rows of grains would be stepped one by one for nothing; so many are enough to share out.
constexpr int most_slabs = 1 << 14;

/// Where the slices of a patch are: a place of the box, and how far from it the furthest of their grains is.
struct Patch {
  double x = 0, reach = 0;
};

Patch find_patch(const Contacts& c, int count, int patch, double length) {
  const int begin = patch * slices_per_patch * lanes, end = std::min(count, begin + slices_per_patch * lanes);
  const double start = c.x_built[begin];
  double low = 0, high = 0;
  for (int i = begin; i < end; ++i) {
    const double way = nearest_image(c.x_built[i] - start, length);
    low = std::min(low, way), high = std::max(high, way);
  }
  const double x = start + 0.5 * (low + high);
  return {x < 0 ? x + length : (x >= length ? x - length : x), 0.5 * (high - low)};
}

/// Assigns every patch to a slab wide enough that no list reaches over a whole one.
void cut_slabs(Records& r, const State& s, const Contacts& c, const Reach& reach) {
  const int patches = (c.slices() + slices_per_patch - 1) / slices_per_patch;
  std::vector<Patch> all(patches);
  base::for_each_item(0, patches, [&](int p) { all[p] = find_patch(c, s.count(), p, reach.length); });
  double widest = 0;
  for (const Patch& p : all) widest = std::max(widest, p.reach);
  const double largest = base::vector_largest(0, s.count(), 0.0, [&](int i) { return s.diameter[i]; });
  const double width = 2 * widest + reach.gamma * largest + reach.skin;
  r.slabs = std::clamp(static_cast<int>(reach.length / width), 1, most_slabs);
  r.slab_of_patch.resize(patches);
  for (int p = 0; p < patches; ++p)
    r.slab_of_patch[p] = std::min(static_cast<int>(r.slabs * all[p].x / reach.length), r.slabs - 1);
  r.slabs_for = c.rebuilds;
}

/// One step of one slab: reads the one set of places and motions and writes the other.
void step_slab(const Sweep& k, Contacts& c, Records& r, int slab, bool back) {
  if (kernels().step_slices(k, c, r, r.slab_first[slab], r.slab_first[slab + 1], back)) r.slab_moved[slab] = 1;
}

void swap_levels(Records& r) {
  swap(r.place, r.place_next);
  swap(r.motion, r.motion_next);
  swap(r.compact, r.compact_next);
}

/// A step of all slices, block by block.
void step_all(const Sweep& k, Contacts& c, Records& r) {
  const int slices = static_cast<int>(r.awake.size()), blocks = static_cast<int>(r.moved.size());
  const auto step_slices = kernels().step_slices;
  base::for_each_item(0, blocks, [&](int block) {
    const int begin = block * slices_per_block;
    // Written in the rare case only: two threads that write to one line of the cache wait for each other.
    if (step_slices(k, c, r, begin, std::min(slices, begin + slices_per_block), false)) r.moved[block] = 1;
  });
  swap_levels(r);
}

/// Parts of the slabs, one a thread, with about as many slices awake in each: first slab of each part.
std::vector<int> share_out(const Records& r, int parts) {
  std::vector<int> first(parts + 1, r.slabs);
  const double all = static_cast<double>(r.awake.size());
  for (int p = 0; p < parts; ++p)
    first[p] = static_cast<int>(std::lower_bound(r.slab_first.begin(), r.slab_first.begin() + r.slabs,
                                                 static_cast<std::int32_t>(all * p / parts)) -
                                r.slab_first.begin());
  first[0] = 0;
  return first;
}

/// Steps of all slabs at once.  Each thread makes those of its part that need nothing of another part, one slab less at
/// either end in each further step; then those around its first slab that are left.  `deep`: how many steps at once.
void step_deep(const Sweep& k, Contacts& c, Records& r, const std::vector<int>& first, int deep) {
  const int parts = static_cast<int>(first.size()) - 1;
  base::for_each_item(0, parts, [&](int part) {
    const int low = first[part], high = first[part + 1];
    for (int wave = 0; wave < high - low + deep; ++wave)
      for (int step = 0; step < deep; ++step) {
        const int slab = low + wave - step;
        if (slab >= low + step && slab < high - step) step_slab(k, c, r, slab, step % 2 != 0);
      }
  });
  base::for_each_item(0, parts, [&](int part) {
    for (int step = 1; step < deep; ++step)
      for (int slab = first[part] - step; slab < first[part] + step; ++slab)
        step_slab(k, c, r, (slab + r.slabs) % r.slabs, step % 2 != 0);
  });
  if (deep % 2 != 0) swap_levels(r);
}

/// What slabs have told of grains off the leash, told of their blocks.
void tell_blocks(Records& r) {
  for (int slab = 0; slab < r.slabs; ++slab) {
    if (r.slab_moved[slab] == 0) continue;
    r.slab_moved[slab] = 0;
    for (int n = r.slab_first[slab]; n < r.slab_first[slab + 1]; ++n) r.moved[n / slices_per_block] = 1;
  }
}

/// How far from where it was listed any grain awake may be after a time [m]: a contact hands it at most twice the speed
/// of the fastest; besides, twice what pushed it in the last step and all of fluid and gravity push it on.  Infinite
/// when a number is not finite.
double furthest(const Sweep& k, const Contacts& c, Records& r, double time) {
  constexpr double without_end = std::numeric_limits<double>::infinity();
  const int slices = static_cast<int>(r.awake.size()), blocks = static_cast<int>(r.moved.size());
  const double push_r3 = k.kick_r3 / k.dt, gravity = std::abs(k.gravity), per_dt = 1.0 / k.dt;
  r.partial.assign(2 * static_cast<std::size_t>(blocks), 0.0);
  base::for_each_item(0, blocks, [&](int block) {
    double fastest = 0, pushed = 0;
    for (int n = block * slices_per_block; n < std::min(slices, (block + 1) * slices_per_block); ++n) {
      const int begin = r.awake[n] * lanes;
      for (int l = 0; l < std::min(lanes, k.count - begin); ++l) {
        const Grain at = r.grain(begin + l), before = r.grain_next(begin + l);
        const FluidPush fluid = r.fluid_push(begin + l);
        const double push = push_r3 * (std::abs(fluid.x) + std::abs(fluid.y)) / base::cube(at.r);
        const double last = per_dt * (std::abs(at.u - before.u) + std::abs(at.v - before.v));
        const double gone = std::abs(nearest_image(at.x - c.x_built[begin + l], k.reach.length)) +
                            std::abs(at.y - c.y_built[begin + l]);
        const double speed = std::abs(at.u) + std::abs(at.v) + 0.0 * at.w;
        const double way = gone + base::square(time) * (2 * last + push + gravity);
        if (!(speed <= fastest)) fastest = std::isnan(speed) ? without_end : speed;
        if (!(way <= pushed)) pushed = std::isnan(way) ? without_end : way;
      }
    }
    r.partial[2 * block] = fastest, r.partial[2 * block + 1] = pushed;
  });
  double fastest = 0, pushed = 0;
  for (int block = 0; block < blocks; ++block)
    fastest = std::max(fastest, r.partial[2 * block]), pushed = std::max(pushed, r.partial[2 * block + 1]);
  return pushed + 2 * fastest * time;
}

}  // namespace

void list_awake(Records& r, const State& s, const Contacts& c, const Reach& reach) {
  if (r.slabs_for != c.rebuilds) cut_slabs(r, s, c, reach);
  std::vector<std::int32_t>& end = r.slab_first;  // while they are filled: of each slab the next place
  end.assign(r.slabs + 2, 0);
  const int slices = static_cast<int>(r.asleep.size());
  const auto slab_of = [&](int slice) { return r.slab_of_patch[slice / slices_per_patch]; };
  for (int slice = 0; slice < slices; ++slice)
    if (r.asleep[slice] == 0) ++end[slab_of(slice) + 2];
  std::partial_sum(end.begin(), end.end(), end.begin());
  r.awake.resize(end[r.slabs + 1]);
  for (int slice = 0; slice < slices; ++slice)
    if (r.asleep[slice] == 0) r.awake[end[slab_of(slice) + 1]++] = slice;
  r.moved.assign((r.awake.size() + slices_per_block - 1) / slices_per_block, 0);
  r.slab_moved.assign(r.slabs, 0);
  r.border_known = r.motion_known = false;
}

int plan_steps(const Sweep& k, const Contacts& c, Records& r, std::int64_t bed_steps, bool first, int most) {
  const int steps = std::min(most, most_steps_at_once);
  if (first) r.plan_at = bed_steps;
  if (c.refreshed > 0 || steps < 2 || !r.motion_known || bed_steps < r.plan_at) return 1;
  const bool calm = furthest(k, c, r, steps * k.dt) < k.leash;
  r.plan_at = bed_steps + (calm ? steps : most_steps_at_once);
  return calm ? steps : 1;
}

bool sweep(const Sweep& k, Contacts& c, Records& r, int steps) {
  std::fill(r.moved.begin(), r.moved.end(), 0);
  const std::vector<int> first = steps > 1 ? share_out(r, base::threads()) : std::vector<int>();
  int deepest = 1;
  for (std::size_t part = 0; part + 1 < first.size(); ++part) {
    const int half = (first[part + 1] - first[part]) / 2;
    deepest = part == 0 ? half : std::min(deepest, half);
  }
  for (int done = 0; done < steps;) {
    const int deep = std::min(deepest, steps - done);
    if (deep > 1)
      step_deep(k, c, r, first, deep), done += deep;
    else
      step_all(k, c, r), ++done;
  }
  r.motion_known = true;
  if (deepest > 1) tell_blocks(r);
  return std::none_of(r.moved.begin(), r.moved.end(), [](std::uint8_t moved) { return moved != 0; });
}

}  // namespace livebed::grains
