#include "run/cost.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "base/loops.hpp"
#include "case/check.hpp"
#include "flow/mesh.hpp"
#include "grains/measures.hpp"
#include "run/observers.hpp"
#include "run/sampling.hpp"
#include "run/simulation.hpp"

namespace livebed::run {

namespace {

/// The gap under the pipe speeds the current up by about this much.
constexpr double speed_up_at_pipe = 2;
/// A packed stretch has at least so many grains and is at least so wide [d].
constexpr int least_grains_in_tile = 800;
constexpr double least_width_of_tile = 20;
constexpr int steps_to_join = 200;  ///< of the grains: contacts of the joined stretches build up
constexpr int first_steps = 5;      ///< of the flow, not timed: what they touch first is slow

using WallClock = std::chrono::steady_clock;
double since(WallClock::time_point start) { return std::chrono::duration<double>(WallClock::now() - start).count(); }

struct Usage {
  double cpu, memory;  ///< [s], [B]
};
Usage usage() {
  rusage u{};
  getrusage(RUSAGE_SELF, &u);
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * t.tv_usec; };
  return {seconds(u.ru_utime) + seconds(u.ru_stime), 1024.0 * static_cast<double>(u.ru_maxrss)};
}

class TemporaryFolder {
public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() / fmt::format("livebed-plan-{}", static_cast<long>(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

double smallest_width(const std::vector<double>& faces) {
  double least = faces.back();
  for (std::size_t i = 1; i < faces.size(); ++i) least = std::min(least, faces[i] - faces[i - 1]);
  return least;
}

/// A bed like that of the case, packed over a part of its length and laid side by side.
grains::Bed bed_of_tiles(const casefile::Case& c, Speeds& speeds) {
  grains::Params p = c.grains;
  p.sleep = false;
  p.pieces = 1;
  const double least_width = std::max(least_width_of_tile * p.diameter, p.length * least_grains_in_tile / p.count);
  const bool periodic = !p.side_walls && p.walls.empty();
  const int tiles = periodic ? std::max(1, static_cast<int>(p.length / least_width)) : 1;
  p.length /= tiles;
  p.count = static_cast<int>(std::lround(static_cast<double>(p.count) / tiles));
  const auto start = WallClock::now();
  const grains::Packing packing = grains::pack(p);
  speeds.packing = since(start) / packing.bed.params.count;
  grains::Bed bed = tiles > 1 ? grains::side_by_side(packing.bed, tiles) : packing.bed;
  bed.params.length = c.grains.length;
  bed.params.sleep = c.grains.sleep;
  return bed;
}

/// Wall times and steps since a moment of a simulation.
struct Lap {
  WallTimes wall;
  double time;
  std::int64_t flow_steps, grain_steps;
};
Lap lap_of(const Simulation& sim) { return {sim.wall(), sim.time(), sim.clock().flow_steps, sim.clock().grain_steps}; }

}  // namespace

Work Work::scaled(double factor) const {
  Work w = *this;
  for (double* number : {&w.grains, &w.packed, &w.cells, &w.held_steps, &w.flow_steps, &w.grain_steps})
    *number *= factor;
  w.flow_step /= factor;
  return w;
}

Work work_of(const casefile::Case& c) {
  const flow::Params& f = c.flow;
  const auto faces = [&](double length, double cell, double from, double to) {
    return flow::stretched_faces(length, cell, f.mesh.growth, from, to);
  };
  const std::vector<double> x = faces(f.mesh.length, f.mesh.cell_x, f.mesh.fine_x_from, f.mesh.fine_x_to);
  const std::vector<double> y = faces(f.mesh.height, f.mesh.cell_y, f.mesh.fine_y_from, f.mesh.fine_y_to);
  const double speed = f.current.mean_speed * (f.pipe.present ? speed_up_at_pipe : 1);
  Work w;
  w.grains = c.grains.count;
  w.packed = w.grains / c.grains.pieces;
  w.cells = static_cast<double>((x.size() - 1) * (y.size() - 1));
  w.flow_step = f.algorithm == flow::Algorithm::simple
                    ? f.max_step
                    : std::min(f.max_step, f.courant * std::min(smallest_width(x), smallest_width(y)) / speed);
  w.held_steps = std::ceil(c.time.spin_up / w.flow_step);
  w.flow_steps = std::ceil(c.time.end / w.flow_step);
  w.grain_steps = c.grains.count > 0 ? std::ceil(c.time.end / c.grains.step) : 0;
  w.series = c.time.end / c.output.series_every;
  w.frames = c.time.end / c.output.fields_every;
  w.checkpoints = c.time.end / c.output.checkpoint_every;
  return w;
}

Speeds time_model(const casefile::Case& given, double budget) {
  const auto start = WallClock::now();
  const Usage before = usage();
  Speeds speeds;
  casefile::Case c = given;
  grains::Bed bed;
  if (given.grains.count > 0) {
    bed = bed_of_tiles(given, speeds);
    casefile::derive_at_level(c, bed.params.count, measured_level(given, bed));
    if (c.flow.pipe.present) {
      flow::PipeParams& pipe = c.flow.pipe;
      const double top =
          grains::highest_grain(bed.state, c.grains.length, pipe.x, 0.5 * pipe.diameter + c.grains.diameter);
      pipe.y = std::max(pipe.y, top + 0.5 * pipe.diameter);
      bed.pipe = {true, pipe.x, pipe.y, pipe.diameter};
    }
    grains::advance(bed, steps_to_join);
  }
  const Work work = work_of(c);
  speeds.grains = work.grains, speeds.cells = work.cells;
  const double items = work.grains + work.cells;
  Simulation sim(c, std::move(bed));

  // a third of the time for the flow over the fixed bed, the rest for grains on the move
  const auto begun = WallClock::now();
  Lap lap = lap_of(sim);
  const double cpu_before = usage().cpu;
  // In processor time: where others keep the machine busy, the look is no shorter for it.
  const auto spent = [&](double share) {
    return (usage().cpu - cpu_before) / base::threads() > share * budget || since(begun) > 4 * share * budget;
  };
  for (int n = 0; sim.time() < 0 && (n < 2 * first_steps || !spent(0.3)); ++n) {
    if (n == first_steps) lap = lap_of(sim);
    sim.spin_up_step();
  }
  const double per_cell = 1 / work.cells, per_grain = work.grains > 0 ? 1 / work.grains : 0;
  const auto steps = [&] { return static_cast<double>(sim.clock().flow_steps - lap.flow_steps); };
  if (steps() > 0) {
    speeds.held_flow = (sim.wall().flow - lap.wall.flow) / steps() * per_cell;
    speeds.held_exchange = (sim.wall().exchange - lap.wall.exchange) / steps() * per_grain;
    speeds.held_step_ratio = (sim.time() - lap.time) / steps() / work.flow_step;
  }

  sim.release();
  const TemporaryFolder folder;
  Observers observers(folder.path(), sim, {});
  sim.wall().output = 0;
  observers.checkpoint(sim);
  speeds.checkpoint = sim.wall().output / items;
  observers.observe(sim);  // the first row, the first files and another checkpoint
  speeds.frame = std::max(0.0, sim.wall().output / items - 2 * speeds.checkpoint);
  sim.wall().output = 0;
  for (int n = 0; sim.time() < c.time.end && (n < 2 * first_steps || !spent(1)); ++n) {
    if (n == first_steps) lap = lap_of(sim);
    sim.step();
  }
  if (steps() > 0) {
    speeds.flow = (sim.wall().flow - lap.wall.flow) / steps() * per_cell;
    speeds.exchange = (sim.wall().exchange - lap.wall.exchange) / steps() * per_grain;
    speeds.step_ratio = (sim.time() - lap.time) / steps() / work.flow_step;
    const auto grain_steps = static_cast<double>(sim.clock().grain_steps - lap.grain_steps);
    speeds.grain = (sim.wall().grains - lap.wall.grains) / grain_steps * per_grain;
  }
  const auto row = WallClock::now();
  const int rows = 3;
  Sampler sampler(sim);
  for (int n = 0; n < rows; ++n) sampler.sample(sim);
  speeds.series = since(row) / rows;
  const Usage after = usage();
  speeds.cpu = (after.cpu - cpu_before) / since(begun);
  speeds.memory_base = before.memory;
  speeds.memory = (after.memory - before.memory) / items;
  speeds.seconds = since(start);
  return speeds;
}

Prediction predict(const Work& w, const Speeds& s) {
  const double held = w.held_steps / s.held_step_ratio, steps = w.flow_steps / s.step_ratio, items = w.grains + w.cells;
  Prediction p;
  p.packing = w.packed * s.packing;
  p.spin_up = held * (w.cells * s.held_flow + w.grains * s.held_exchange);
  p.flow = steps * w.cells * s.flow;
  p.exchange = steps * w.grains * s.exchange;
  p.grains = w.grain_steps * w.grains * s.grain;
  p.output = w.series * s.series + items * (w.frames * s.frame + w.checkpoints * s.checkpoint);
  p.flow_steps = held + steps;
  p.cpu = p.wall() * s.cpu;
  p.memory = s.memory_base + items * s.memory;
  return p;
}

}  // namespace livebed::run
