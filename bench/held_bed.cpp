#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "case/read.hpp"
#include "run/checkpoint.hpp"
#include "run/simulation.hpp"

/// The water alone, started anew over the bed that a run has reached: does its pipe shed there, with another closure or
/// grid?  Prints time [s], drag and lift on the pipe [N/m].
namespace {

using namespace livebed;

/// Sand that moves faster is thought away [m/s]: it would stand in the water like posts.
constexpr double at_rest = 0.05;

/// The bed at rest, what moved spread thinly below the lid, where it does not matter.
grains::Bed hold(grains::Bed bed, const casefile::Case& c) {
  grains::State& s = bed.state;
  const double length = c.flow.mesh.length, d = c.grains.diameter;
  double x = d, y = c.flow.mesh.height - d;
  for (int i = 0; i < s.count(); ++i) {
    if (std::hypot(s.u[i], s.v[i]) > at_rest) {
      s.x[i] = x, s.y[i] = y;
      x += 2 * d;
      if (x > length - d) x = d, y -= 2 * d;
    }
    s.u[i] = s.v[i] = 0;
  }
  return bed;
}

void go(const std::string& run, double seconds, double every, const std::vector<std::string>& overrides) {
  const auto saved = run::list_checkpoints(run);
  if (saved.empty()) base::fail(base::Exit::input_output, "{} has no checkpoint; give the folder of a run", run);
  const run::Restored restored = run::load_checkpoint(saved.back());
  const casefile::Case c = casefile::read_case(run + "/case.resolved.toml", overrides);
  run::Simulation sim(c, hold(restored.sim.bed(), c));
  const double start = sim.flow().state.time;
  std::puts("time_s,drag_N_m,lift_N_m");
  for (double next = 0; sim.flow().state.time - start < seconds;) {
    sim.spin_up_step();
    const double time = sim.flow().state.time - start;
    if (time < next) continue;
    const base::Vec2 force = sim.last_report().pipe_force;
    std::printf("%.5f,%.6g,%.6g\n", time, force.x, force.y);
    next += every;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("the water alone over the bed that a run has reached");
  std::string run;
  double seconds = 2, every = 0.005;
  std::vector<std::string> overrides;
  app.add_option("RUN", run, "folder of a run")->required();
  app.add_option("--seconds", seconds, "how long")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--every", every, "[s] between two lines")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--set", overrides, "override a key of the run's case: --set flow.closure=k_omega_sst (repeatable)");
  CLI11_PARSE(app, argc, argv);
  try {
    go(run, seconds, every, overrides);
  } catch (const base::Fault& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return static_cast<int>(fault.code());
  }
}
