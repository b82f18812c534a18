#include "validate/grain_silo.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "grains/measures.hpp"
#include "grains/packing.hpp"

namespace livebed::validate {

namespace {

/// What a side wall does to a grain at rest [N].
struct Push {
  double lateral = 0, upward = 0;
};

/// Springs of the side walls' contacts, grain by grain; nothing moves, so there are no dashpots.  The wall turns a
/// grain along t = (-n_y, n_x), n pointing at the wall.
std::vector<Push> side_wall_pushes(const grains::Bed& bed) {
  const grains::State& s = bed.state;
  const grains::Contacts& c = bed.contacts;
  const double spring = grains::wall_contact(bed.params, bed.params.bottom).k_n;
  std::vector<Push> pushes(s.count());
  for (int i = 0; i < s.count(); ++i) {
    const bool left = s.x[i] < 0.5 * bed.params.length;
    const double gap = left ? s.x[i] : bed.params.length - s.x[i];
    pushes[i].lateral = spring * std::max(0.0, 0.5 * s.diameter[i] - gap);
    const int slice = i / grains::lanes;
    for (int row = c.wall_first[slice]; row < c.wall_first[slice + 1]; ++row) {
      const double along = c.piece_spring[row * grains::lanes + i % grains::lanes];
      pushes[i].upward += left ? -along : along;
    }
  }
  return pushes;
}

}  // namespace

double SiloRun::janssen() const {
  // Two walls: the stress grows until 2 mu K sigma carries the weight of a layer.
  const double depths = 2 * mobilised * lateral_ratio * height / width;
  return depths > 0 ? (1 - std::exp(-depths)) / depths : 1;
}

SiloRun run_silo(const SiloSetup& setup) {
  constexpr int bands = 16, loading_steps = 200;
  constexpr double loading_time = 0.5;  // [s]
  const auto start = std::chrono::steady_clock::now();
  grains::Params p;
  p.law = grains::Law::hooke;
  p.stiffness = 5500;
  p.restitution = 0.3;
  p.friction = setup.friction;
  p.bottom = {.stiffness = 1, .damping = 1, .friction = setup.wall_friction / setup.friction, .rolling = 1};
  p.side_walls = true;
  p.seed = setup.seed;
  p.length = (setup.columns + 1) * p.diameter * (1 + p.spread);
  p.count = setup.columns * setup.rows;
  p.settled_speed = 1e-6;
  p.settle_time = 20;
  // Settled under half the weight and then slowly loaded with all of it, so that every grain slides down its wall a
  // little: Janssen's friction has to be called up.
  const double gravity = p.gravity;
  p.gravity = 0.5 * gravity;
  grains::Bed bed = grains::pack(p).bed;
  for (int step = 1; step <= loading_steps; ++step) {
    bed.params.gravity = gravity * (0.5 + 0.5 * step / loading_steps);
    grains::advance(bed, static_cast<int>(loading_time / loading_steps / bed.params.step));
  }
  grains::settle(bed);
  const grains::Params& full = bed.params;
  const grains::State& s = bed.state;

  SiloRun run;
  run.width = full.length;
  run.mean_speed = grains::mean_speed(s);
  const double floor_spring = grains::wall_contact(full, full.bottom).k_n, g = grains::submerged_gravity(full);
  const std::vector<Push> pushes = side_wall_pushes(bed);
  run.height = grains::bed_height(s);
  for (int k = 0; k < bands; ++k) run.bands.push_back({(k + 0.5) * run.height / bands, 0, 0, 0});
  for (int i = 0; i < s.count(); ++i) {
    const double weight = grains::mass(full, s.diameter[i]) * g;
    run.weight += weight;
    run.floor += floor_spring * std::max(0.0, 0.5 * s.diameter[i] - s.y[i]);
    run.sides += pushes[i].upward;
    const double depth = run.height - s.y[i];
    for (SiloBand& band : run.bands) {
      if (depth < band.depth) band.vertical += (weight - pushes[i].upward) / run.width;
    }
    if (depth < 0 || depth >= run.height) continue;
    SiloBand& band = run.bands[static_cast<int>(depth / run.height * bands)];
    band.lateral += pushes[i].lateral * bands / (2 * run.height);
    band.friction += pushes[i].upward * bands / (2 * run.height);
  }
  double lateral = 0, vertical = 0, friction = 0;
  for (const SiloBand& band : run.bands) {
    if (band.depth < 0.2 * run.height || band.depth > 0.8 * run.height) continue;
    lateral += band.lateral, vertical += band.vertical, friction += band.friction;
  }
  run.lateral_ratio = lateral / vertical, run.mobilised = friction / lateral;
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace livebed::validate
