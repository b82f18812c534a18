#include "validate/grain_gas.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "grains/measures.hpp"
#include "grains/packing.hpp"

namespace livebed::validate {

using base::square;

namespace {

constexpr int look_every = 40;  ///< steps; less than a contact lasts, so that no collision is missed

/// Pairs that touch, and what their springs and those of the floor hold [J].
struct Touching {
  std::set<std::pair<int, int>> pairs;  ///< of ids
  double energy = 0;
};
Touching touching(const grains::Bed& bed) {
  const grains::State& s = bed.state;
  const double pair = grains::pair_contact(bed.params).k_n;
  const double floor = grains::wall_contact(bed.params, bed.params.bottom).k_n;
  Touching result;
  for (int i = 0; i < s.count(); ++i) {
    result.energy += 0.5 * floor * square(std::max(0.0, 0.5 * s.diameter[i] - s.y[i]));
    for (const int j : grains::neighbours_of(s, bed.contacts, i)) {
      if (s.id[i] > s.id[j]) continue;
      const double dx = grains::nearest_image(s.x[j] - s.x[i], bed.params.length), dy = s.y[j] - s.y[i];
      const double overlap = 0.5 * (s.diameter[i] + s.diameter[j]) - std::hypot(dx, dy);
      if (overlap <= 0) continue;
      result.energy += 0.5 * pair * square(overlap);
      result.pairs.insert({s.id[i], s.id[j]});
    }
  }
  return result;
}

/// Kinetic energy with the mean of the velocities before and after a step: velocities live between the positions.
double kinetic_energy(const grains::Bed& bed, const std::vector<std::array<double, 3>>& before) {
  grains::State s;
  for (int i = 0; i < bed.state.count(); ++i) {
    const auto& [u, v, omega] = before[bed.state.id[i]];
    s.x.push_back(0);
    s.u.push_back(0.5 * (u + bed.state.u[i]));
    s.v.push_back(0.5 * (v + bed.state.v[i]));
    s.omega.push_back(0.5 * (omega + bed.state.omega[i]));
    s.diameter.push_back(bed.state.diameter[i]);
  }
  return grains::kinetic_energy(bed.params, s);
}

grains::Bed loose_grains(const GasSetup& setup) {
  constexpr int columns = 50;
  constexpr double pitch = 1.5, speed = 0.5;  // of the lattice over d; each grain's in both directions at most [m/s]
  grains::Params p;
  p.spread = 0.05;
  p.stiffness = 550;
  p.steps_per_contact = setup.steps_per_contact;
  p.restitution = setup.restitution;
  p.friction = setup.friction;
  p.precision = setup.precision;
  p.count = setup.grains;
  p.length = columns * pitch * p.diameter;
  grains::Bed bed = grains::make_bed(grains::derive(p));
  std::mt19937_64 generator(1);
  const auto random = [&generator] { return static_cast<double>(generator() >> 11) * 0x1p-52 - 1; };  // in [-1, 1)
  for (int i = 0; i < p.count; ++i) {
    bed.state.diameter[i] = p.diameter * (1 + p.spread * random());
    bed.state.x[i] = (i % columns + 0.5) * pitch * p.diameter;
    bed.state.y[i] = (i / columns + 0.5) * pitch * p.diameter;
    bed.state.u[i] = speed * random();
    bed.state.v[i] = speed * random();
  }
  return bed;
}

}  // namespace

GasRun run_gas(const GasSetup& setup) {
  const auto start = std::chrono::steady_clock::now();
  grains::Bed bed = loose_grains(setup);
  const grains::Params& p = bed.params;
  const double g = grains::submerged_gravity(p), momentum = grains::momentum(p, bed.state).x;
  double scale = 0;
  for (int i = 0; i < p.count; ++i) scale += grains::mass(p, bed.state.diameter[i]) * std::abs(bed.state.u[i]);
  GasRun run;
  std::vector<std::array<double, 3>> before(p.count);
  Touching last;
  double first = 0, previous = 0;
  while (bed.steps < setup.steps) {
    grains::advance(bed, look_every - 1);
    const Touching now = touching(bed);
    double energy = now.energy;
    for (int i = 0; i < p.count; ++i) {
      energy += grains::mass(p, bed.state.diameter[i]) * g * bed.state.y[i];
      before[bed.state.id[i]] = {bed.state.u[i], bed.state.v[i], bed.state.omega[i]};
    }
    const double time = static_cast<double>(bed.steps) * p.step;
    grains::advance(bed, 1);
    energy += kinetic_energy(bed, before);
    for (const auto& pair : now.pairs) run.collisions += last.pairs.count(pair) == 0;
    if (first == 0) first = previous = energy;
    run.drift = std::max(run.drift, std::abs(energy / first - 1));
    run.largest_gain = std::max(run.largest_gain, (energy - previous) / first);
    run.time.push_back(time), run.energy.push_back(energy / first);
    previous = energy;
    last = now;
  }
  run.left = previous / first;
  run.momentum = (grains::momentum(p, bed.state).x - momentum) / scale;
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace livebed::validate
