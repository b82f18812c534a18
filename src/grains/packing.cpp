#include "grains/packing.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/fault.hpp"
#include "grains/measures.hpp"
#include "grains/sizes.hpp"

namespace livebed::grains {

using base::Exit;
using base::fail;

namespace {

constexpr int looks_in_a_row = 10;   ///< below settled_speed before a bed counts as settled
constexpr double slow_enough = 100;  ///< settled speeds at which the thick fluid is taken away [-]

/// Time in which a grain falls its own diameter [s]: the measure of everything here.
double fall_time(const Params& p) { return std::sqrt(2 * p.diameter / submerged_gravity(p)); }

/// A fluid at rest that slows every grain down within `time`; none for time = 0.
void thicken(Bed& bed, double time) {
  State& s = bed.state;
  for (Array* a : {&s.fluid.u, &s.fluid.v, &s.fluid.fx, &s.fluid.fy}) std::fill(a->begin(), a->end(), 0.0);
  for (int i = 0; i < s.count(); ++i) s.fluid.beta[i] = time > 0 ? mass(bed.params, s.diameter[i]) / time : 0.0;
}

void forget_impulses(Bed& bed) {
  for (Array* a : {&bed.state.impulse_x, &bed.state.impulse_y}) std::fill(a->begin(), a->end(), 0.0);
  bed.pipe_impulse = {};
}

/// A number in [0, 1) from 53 bits of the generator; std::uniform_real_distribution differs between libraries.
double unit(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

}  // namespace

Bed lattice(const Params& given) {
  Bed bed = make_bed(derive(given));
  const Params& p = bed.params;
  const double largest = largest_diameter(p);
  const double gap = p.lattice_gap * p.diameter;
  const int columns = static_cast<int>(p.length / (p.gamma * largest + gap));
  if (columns < 2) {
    fail(Exit::invalid_case, "grains.length = {} m holds no two grains of {} m", p.length, largest);
  }
  const double pitch = p.length / columns, rise = p.gamma * largest + gap;
  std::mt19937_64 generator(p.seed);
  State& s = bed.state;
  const std::vector<double> diameters = sample_diameters(p);
  for (int i = 0; i < p.count; ++i) {
    s.diameter[i] = diameters[i];
    const double shift_x = 0.5 * gap * (unit(generator) - 0.5), shift_y = 0.5 * gap * (unit(generator) - 0.5);
    s.x[i] = (i % columns + 0.5) * pitch + shift_x;
    s.y[i] = (i / columns + 0.5) * rise + shift_y;
  }
  return bed;
}

std::vector<SettleRow> settle(Bed& bed) {
  const Params& p = bed.params;
  const double time = fall_time(p);
  const int steps = std::max(1, static_cast<int>(0.1 * time / p.step));
  std::vector<SettleRow> rows;
  bool thick = true;
  int calm = 0;
  const std::int64_t begin = bed.steps;
  thicken(bed, time);
  while (calm < looks_in_a_row) {
    advance(bed, steps);
    const double now = static_cast<double>(bed.steps - begin) * p.step;
    rows.push_back({now, mean_speed(bed.state), max_speed(bed.state), bed_height(bed.state)});
    if (thick && now > time && rows.back().mean_speed < slow_enough * p.settled_speed) {
      thick = false;
      thicken(bed, 0);
    }
    calm = !thick && rows.back().mean_speed < p.settled_speed ? calm + 1 : 0;
    if (now > p.settle_time && calm < looks_in_a_row) {
      fail(Exit::stopped_by_limit,
           "the bed has not come to rest within bed.settle_time = {} s: mean grain speed {} m/s (asked for: below {} "
           "m/s), largest {} m/s; allow more time, or use more contact.steps or less damping if the contacts shake",
           p.settle_time, rows.back().mean_speed, p.settled_speed, rows.back().max_speed);
    }
  }
  forget_impulses(bed);
  return rows;
}

Packing pack(const Params& given) {
  Packing result{.bed = lattice(given), .convergence = {}};
  result.convergence = settle(result.bed);
  return result;
}

Bed side_by_side(const Bed& tile, int tiles) {
  const int n = tile.params.count;
  Params p = tile.params;
  p.count *= tiles;
  p.length *= tiles;
  Bed bed = make_bed(p);
  for (int i = 0; i < p.count; ++i) {
    bed.state.x[i] = tile.state.x[i % n] + i / n * tile.params.length;
    bed.state.y[i] = tile.state.y[i % n];
    bed.state.diameter[i] = tile.state.diameter[i % n];
  }
  return bed;
}

std::vector<SettleRow> place_pipe(Bed& bed, const Circle& target, double speed) {
  const Params& p = bed.params;
  const double radius = 0.5 * target.diameter;
  if (target.y - radius < 0) {
    fail(Exit::invalid_case, "the pipe reaches {} m through the floor of the bed; raise it or make the bed thicker",
         radius - target.y);
  }
  const double top = highest_grain(bed.state, p.length, target.x, radius + largest_diameter(p));
  bed.pipe = target;
  bed.pipe.present = true;
  bed.pipe.y = std::max(target.y, top + radius);
  const int steps = 10;
  const double lowering = speed * p.step * steps;
  thicken(bed, fall_time(p));
  while (bed.pipe.y > target.y) {
    bed.pipe.y = std::max(target.y, bed.pipe.y - lowering);
    advance(bed, steps);
  }
  return settle(bed);
}

}  // namespace livebed::grains
