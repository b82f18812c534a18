#include "run/simulation.hpp"

#include <chrono>
#include <cmath>

#include "base/fault.hpp"
#include "base/loops.hpp"
#include "case/check.hpp"
#include "grains/measures.hpp"
#include "run/sampling.hpp"

namespace livebed::run {

namespace {

using Seconds = std::chrono::duration<double>;
using WallClock = std::chrono::steady_clock;

/// Adds the wall time of its life to a sum.
class Stopwatch {
public:
  explicit Stopwatch(double& sum) : sum_(sum), start_(WallClock::now()) {}
  ~Stopwatch() { sum_ += Seconds(WallClock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

private:
  double& sum_;
  WallClock::time_point start_;
};

flow::Mesh mesh_of(const casefile::Case& c) { return flow::make_mesh(c.flow.mesh, c.flow.pipe); }

grains::Circle circle_of(const flow::PipeParams& pipe) { return {pipe.present, pipe.x, pipe.y, pipe.diameter}; }

}  // namespace

Simulation::Start Simulation::prepare(const casefile::Case& given) {
  Start start{given, {}, {}};
  if (given.grains.count == 0) return start;
  grains::Packing packing = grains::pack(given.grains);
  start.bed = std::move(packing.bed);
  start.convergence = std::move(packing.convergence);
  casefile::derive_at_level(start.resolved, measured_level(given, start.bed));
  if (given.flow.pipe.present) {
    const auto lowering = grains::place_pipe(start.bed, circle_of(start.resolved.flow.pipe));
    const double before = start.convergence.empty() ? 0.0 : start.convergence.back().time;
    for (grains::SettleRow row : lowering) {
      row.time += before;
      start.convergence.push_back(row);
    }
  }
  return start;
}

Simulation::Simulation(const casefile::Case& resolved, grains::Bed bed)
    : case_(resolved),
      bed_(std::move(bed)),
      flow_(resolved.flow, mesh_of(resolved), flow::make_boundary(mesh_of(resolved), resolved.flow)),
      coupler_(resolved.coupling, flow_.mesh(), flow_.at_u(), flow_.at_v(), resolved.grains.diameter,
               resolved.flow.density, resolved.flow.viscosity),
      solid_(flow_.mesh().nx, flow_.mesh().ny) {
  flow_.start();
}

double Simulation::time() const {
  return clock_.released ? static_cast<double>(clock_.grain_steps) * case_.grains.step
                         : flow_.state.time - case_.time.spin_up;
}

void Simulation::spin_up_step() {
  const double dt = flow_.step_limit();
  if (has_grains()) {
    Stopwatch watch(wall_.exchange);
    coupler_.load_flow(bed_.state, flow_.state, dt, true);
  }
  {
    Stopwatch watch(wall_.flow);
    report_ = flow_.advance(dt);
  }
  last_step_ = dt;
  ++clock_.flow_steps;
  check_finite();
}

void Simulation::release() { clock_.released = true; }

void Simulation::step() {
  const double grain_step = case_.grains.step;
  const double limit = flow_.step_limit();
  const int substeps = std::max(1, static_cast<int>(limit / grain_step));
  const double dt = substeps * grain_step;
  if (has_grains()) {
    Stopwatch watch(wall_.exchange);
    coupler_.load_flow(bed_.state, flow_.state, dt, false);
  }
  {
    Stopwatch watch(wall_.flow);
    report_ = flow_.advance(dt);
  }
  check_finite();
  if (has_grains()) {
    {
      Stopwatch watch(wall_.exchange);
      coupler_.push_grains(flow_.state, bed_.state);
    }
    bed_.pipe_impulse = {};
    {
      Stopwatch watch(wall_.grains);
      grains::advance(bed_, substeps);
    }
    grain_force_ = (1.0 / (dt * case_.grains.diameter)) * bed_.pipe_impulse;
    Stopwatch watch(wall_.exchange);
    coupler_.collect(bed_.state, flow_.state, dt);
  }
  last_step_ = dt;
  ++clock_.flow_steps;
  clock_.grain_steps += substeps;
}

void Simulation::check_finite() const {
  // One sum over what everything else follows from; the search for the place runs only when it is not finite.
  const flow::State& s = flow_.state;
  double sum = 0;
  for (int j = 0; j < s.p.ny(); ++j) {
    const double *u = s.u.row(j), *v = s.v.row(j), *p = s.p.row(j), *k = s.k.row(j), *e = s.epsilon.row(j);
    sum += base::vector_sum(0, s.p.nx(), [&](int i) { return u[i] + v[i] + p[i] + k[i] + e[i]; });
  }
  if (std::isfinite(sum)) return;
  const std::string fault = flow_.find_fault();
  base::fail(base::Exit::diverged, "t = {:.5g} s, flow step {}: {}", time(), clock_.flow_steps,
             fault.empty() ? "the sum over all cells is not finite" : fault);
}

double Simulation::flow_momentum() const {
  const flow::State& s = flow_.state;
  const base::Field& volume = flow_.at_u().inertia;
  double sum = 0;
  for (int j = 0; j < s.u.ny(); ++j) {
    const double *u = s.u.row(j), *V = volume.row(j);
    sum += base::vector_sum(1, s.u.nx(), [&](int i) { return u[i] * V[i]; });
  }
  return sum * case_.flow.density * case_.grains.diameter;
}

const base::Field& Simulation::solid_fraction() {
  if (has_grains()) coupler_.solid_fraction(bed_.state, solid_);
  return solid_;
}

}  // namespace livebed::run
