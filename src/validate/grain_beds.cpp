#include "validate/grain_beds.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <random>

#include "base/fault.hpp"
#include "grains/forces.hpp"
#include "grains/measures.hpp"

namespace livebed::validate {

namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

RestRun run_rest(grains::Params params) {
  const auto start = Clock::now();
  RestRun run;
  grains::Bed bed = grains::lattice(params);
  try {
    run.grain_time = grains::settle(bed).back().time;
    run.settled = true;
  } catch (const base::Fault& fault) {
    if (fault.code() != base::Exit::stopped_by_limit) throw;
    run.grain_time = params.settle_time;
  }
  // A few grains that roll between others lose their speed slowly: rolling costs nothing.
  constexpr double wait = 0.3, watch = 0.1;  // [s]
  grains::advance(bed, static_cast<int>(wait / bed.params.step));
  for (int look = 0; look < 20; ++look) {
    grains::advance(bed, static_cast<int>(watch / 20 / bed.params.step));
    run.mean_speed = std::max(run.mean_speed, grains::mean_speed(bed.state));
  }
  run.contacts = grains::measure_contacts(bed).per_grain;
  run.seconds = since(start);
  return run;
}

HeapRun run_heap(const HeapSetup& setup) {
  constexpr double sinking = 0.15;               // speed of a grain that sinks alone [m/s]
  constexpr double start_above = 0.06;           // the lowest grain's first place: above the heap to come [m]
  constexpr double at_rest = 1e-5, longest = 1;  // mean speed [m/s]; time it may take after the last grain [s]
  const auto begin = Clock::now();
  grains::Params p;
  p.spread = 0.3;     // no crystal, whose facets would be the slope
  p.stiffness = 200;  // overlaps of a percent at the speed of sinking
  p.restitution = 0.3;
  p.law = grains::Law::hooke;
  p.friction = setup.friction;
  p.rolling_friction = setup.rolling_friction;
  p.precision = setup.precision;
  p.wall_factor = 1;  // the floor is of grains like the others
  p.floor = grains::Floor::grains;
  p.length = 0.4;
  p.count = setup.grains;
  grains::Bed bed = grains::make_bed(grains::derive(p));
  std::mt19937_64 generator(setup.seed);
  const auto random = [&generator] { return static_cast<double>(generator() >> 11) * 0x1p-52 - 1; };  // in [-1, 1)
  grains::State& s = bed.state;
  const double middle = 0.5 * p.length, weight = grains::submerged_gravity(p);
  for (int i = 0; i < p.count; ++i) {
    s.diameter[i] = p.diameter * (1 + p.spread * random());
    s.x[i] = middle + (i % 2 == 0 ? -0.75 : 0.75) * p.diameter + 0.1 * p.diameter * random();
    s.y[i] = start_above + 1.3 * p.diameter * (i / 2);
    s.fluid.beta[i] = grains::mass(p, s.diameter[i]) * weight / sinking;
  }
  const double last_down = (start_above + 0.65 * p.diameter * p.count) / sinking;
  while (static_cast<double>(bed.steps) * bed.params.step < last_down) grains::advance(bed, 1000);
  std::fill(s.fluid.beta.begin(), s.fluid.beta.end(), 0.0);
  HeapRun run;
  do {
    grains::advance(bed, 1000);
    run.mean_speed = grains::mean_speed(s);
  } while (run.mean_speed > at_rest && static_cast<double>(bed.steps) * bed.params.step < last_down + longest);

  const double width = 2 * p.diameter;
  const int bins = static_cast<int>(p.length / width);
  std::vector<double> top(bins, 0.0);
  for (int i = 0; i < p.count; ++i) {
    double& highest = top[std::min(bins - 1, static_cast<int>(s.x[i] / p.length * bins))];
    highest = std::max(highest, s.y[i] + 0.5 * s.diameter[i]);
  }
  run.height = *std::max_element(top.begin(), top.end());
  for (int k = 0; k < bins; ++k) {
    run.x.push_back((k + 0.5) * p.length / bins - middle), run.surface.push_back(top[k]);
  }
  // The mean height of the grains of a triangle is a third of its height, their mean distance from the middle a third
  // of half its base.
  double height[2] = {0, 0}, distance[2] = {0, 0};  // sums left and right of the middle
  for (int i = 0; i < p.count; ++i) {
    const double area = base::sphere_area(s.diameter[i]), off = s.x[i] - middle;
    height[off > 0] += area * s.y[i], distance[off > 0] += area * std::abs(off);
  }
  const auto degrees = [&](int side) { return std::atan(height[side] / distance[side]) * 180 / base::pi; };
  run.left = degrees(0), run.right = degrees(1);
  run.seconds = since(begin);
  return run;
}

PrecisionRun compare_precision(const grains::Params& params, int steps) {
  constexpr double knock = 0.02;  // [m/s]
  const auto start = Clock::now();
  grains::Bed in_double = grains::pack(params).bed;
  // A radius in single precision is another one, by as much as a hundredth of what grains at rest overlap.
  for (double& diameter : in_double.state.diameter) diameter = static_cast<float>(diameter);
  grains::settle(in_double);
  for (int i = 0; i < in_double.state.count(); ++i)
    in_double.state.u[i] += knock * std::sin(1.1 * in_double.state.id[i]);
  grains::Bed mixed = in_double;
  mixed.params.precision = grains::Precision::mixed;
  for (grains::Bed* bed : {&in_double, &mixed}) grains::advance(*bed, steps);

  struct Seen {
    base::Vec2 velocity;
    std::map<int, double> overlaps;  ///< with grains of higher number
  };
  const auto look = [](const grains::Bed& bed) {
    const grains::State& s = bed.state;
    std::vector<Seen> seen(s.count());
    for (int i = 0; i < s.count(); ++i) seen[s.id[i]].velocity = {s.u[i], s.v[i]};
    grains::visit_contacts(bed, [&](const grains::TouchingPair& pair) {
      if (pair.j < 0) return;
      const auto [first, second] = std::minmax(s.id[pair.i], s.id[pair.j]);
      seen[first].overlaps[second] = pair.overlap;
    });
    return seen;
  };
  const std::vector<Seen> a = look(in_double), b = look(mixed);
  PrecisionRun run;
  double overlaps = 0;
  int contacts = 0;
  for (std::size_t id = 0; id < a.size(); ++id) {
    const double apart = base::norm(a[id].velocity - b[id].velocity);
    run.worst = std::max(run.worst, apart);
    run.mean += apart * apart;
    run.speed += base::square(base::norm(a[id].velocity));
    for (const auto& [other, overlap] : a[id].overlaps) {
      const auto found = b[id].overlaps.find(other);
      if (found == b[id].overlaps.end()) continue;
      run.overlap += base::square(overlap - found->second);
      overlaps += overlap, ++contacts;
    }
  }
  run.speed = std::sqrt(run.speed / static_cast<double>(a.size()));
  run.mean = std::sqrt(run.mean / static_cast<double>(a.size())) / run.speed;
  run.worst /= run.speed;
  run.overlap = std::sqrt(run.overlap / contacts) / (overlaps / contacts);
  run.seconds = since(start);
  return run;
}

}  // namespace livebed::validate
