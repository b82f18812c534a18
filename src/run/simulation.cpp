#include "run/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/fault.hpp"
#include "base/loops.hpp"
#include "case/check.hpp"
#include "grains/measures.hpp"
#include "io/lammps.hpp"
#include "run/sampling.hpp"
#include "run/shear.hpp"

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

/// Where the flow was fastest before the step under way, as a sentence: what diverges can be seen coming there.  A
/// number that is not finite counts as the fastest.
std::string fastest_place(const flow::Mesh& m, const flow::State& s) {
  double largest = -1;
  int at_i = 0, at_j = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      const double speed = std::hypot(s.u_old(i, j), s.v_old(i, j));
      if (speed <= largest) continue;
      largest = speed, at_i = i, at_j = j;
      if (!std::isfinite(speed)) i = m.nx, j = m.ny;
    }
  return fmt::format("before this step the largest speed was {:.3g} m/s in cell ({},{}), x = {:.4g} m, y = {:.4g} m",
                     largest, at_i, at_j, m.centre_x(at_i), m.centre_y(at_j));
}

/// The grains of bed.file, come to rest under the contacts of this case and, when it tells a thickness, cut to it.
grains::Packing bed_of_file(const casefile::Case& given, const grains::Params& awake, const grains::OnLook& on_look) {
  const io::LammpsBed file = io::read_lammps(given.bed_file);
  const auto refuse = [&](const std::string& why) {
    base::fail(base::Exit::invalid_case, "bed.file = {}: {}", given.bed_file, why);
  };
  constexpr double round_off = 1e-9;
  if (std::abs(file.length - awake.length) > round_off * awake.length)
    refuse(fmt::format("its box is {} m long, mesh.length = {} m", file.length, awake.length));
  const int count = static_cast<int>(file.x.size());
  if (given.is_given("bed.count") && count != given.grains.count)
    refuse(fmt::format("it holds {} grains, not bed.count = {}", count, given.grains.count));
  grains::Params p = awake;
  p.count = count;
  grains::Packing packing{.bed = grains::make_bed(p), .convergence = {}};
  grains::State& s = packing.bed.state;
  std::copy(file.x.begin(), file.x.end(), s.x.begin()), std::copy(file.y.begin(), file.y.end(), s.y.begin());
  std::copy(file.u.begin(), file.u.end(), s.u.begin()), std::copy(file.v.begin(), file.v.end(), s.v.begin());
  std::copy(file.omega.begin(), file.omega.end(), s.omega.begin());
  std::copy(file.diameter.begin(), file.diameter.end(), s.diameter.begin());
  packing.convergence = grains::settle(packing.bed, on_look);
  if (p.thickness > 0) {
    const double before = packing.convergence.back().time;
    for (grains::SettleRow row : grains::level(packing.bed, p.thickness, on_look)) {
      row.time += before;
      packing.convergence.push_back(row);
    }
  }
  return packing;
}

}  // namespace

Simulation::Start Simulation::prepare(const casefile::Case& given, const BedCache& packed,
                                      const grains::OnLook& on_look) {
  Start start{given, {}, {}};
  if (given.grains.count == 0) return start;
  const bool from_file = !given.bed_file.empty();
  const BedCache& cache = from_file ? BedCache() : packed;  // a file's name does not tell what is in it
  grains::Params awake = given.grains;                      // nobody sleeps before the bed has come to rest
  awake.sleep = false;
  awake.precision = grains::Precision::all_double;
  const std::string key = packing_key(given);
  grains::Packing packing = cache.get(
      key, awake, [&] { return from_file ? bed_of_file(given, awake, on_look) : grains::pack(awake, on_look); });
  const int count = packing.bed.params.count;
  if (given.is_given("bed.count") && count != given.grains.count) {
    base::fail(base::Exit::invalid_case,
               "the bed cut to bed.cut = {} m holds {} grains, not bed.count = {}; give bed.thickness instead of both",
               given.cut, count, given.grains.count);
  }
  casefile::derive_at_level(start.resolved, count, measured_level(given, packing.bed));
  if (given.flow.pipe.present) {
    const grains::Circle pipe = circle_of(start.resolved.flow.pipe);
    const std::string with_pipe = fmt::format("{}pipe at {} m, {} m, {} m wide\n", key, pipe.x, pipe.y, pipe.diameter);
    packing = cache.get(with_pipe, awake, [&] {
      const double before = packing.convergence.back().time;
      for (grains::SettleRow row : grains::place_pipe(packing.bed, pipe, grains::lowering_speed, on_look)) {
        row.time += before;
        packing.convergence.push_back(row);
      }
      return packing;
    });
  }
  start.bed = std::move(packing.bed);
  start.convergence = std::move(packing.convergence);
  start.bed.params.sleep = given.grains.sleep;
  start.bed.params.precision = given.grains.precision;
  return start;
}

Simulation::Simulation(const casefile::Case& resolved, grains::Bed bed)
    : case_(resolved),
      bed_(std::move(bed)),
      flow_(resolved.flow, mesh_of(resolved), flow::make_boundary(mesh_of(resolved), resolved.flow)),
      full_inlet_{flow_.boundary().inlet_u, flow_.boundary().inlet_k, flow_.boundary().inlet_epsilon},
      supply_(resolved),
      coupler_(resolved.coupling, flow_,
               {resolved.grains.diameter, resolved.grains.density, resolved.grains.added_mass, resolved.flow.viscosity,
                resolved.grains.count, resolved.grains.seed, supply_.margin()}),
      solid_(flow_.mesh().nx, flow_.mesh().ny) {
  if (case_.flow.current.rise > 0) scale_inlet(full_inlet_, risen_share(0, case_.flow.current.rise), flow_);
  flow_.start();
}

void Simulation::set_end(double end) {
  std::replace(case_.given.begin(), case_.given.end(), std::string("time.end_over_T"), std::string("time.end"));
  case_.time.end = end;
  case_.time.end_over_T = case_.time_scale > 0 ? end / case_.time_scale : 0.0;
}

double Simulation::time() const {
  return clock_.released ? static_cast<double>(clock_.grain_steps) * case_.grains.step
                         : flow_.state.time - case_.time.spin_up;
}

void Simulation::spin_up_step() {
  const double dt = flow_.step_limit();
  if (has_grains()) {
    Stopwatch watch(wall_.exchange);
    coupler_.load_flow(bed_.state, flow_, dt, true);
  }
  advance_flow(dt);
  if (has_grains()) coupler_.hold(bed_.state);
  last_step_ = dt;
  ++clock_.flow_steps;
}

void Simulation::release() {
  clock_.released = true;
  coupler_.let_go(bed_.state);
  std::fill(bed_.state.laps.begin(), bed_.state.laps.end(), 0);
  supply_.begin(bed_.state);
}

void Simulation::step() {
  const double grain_step = case_.grains.step;
  const double limit = std::min(flow_.step_limit(), coupler_.step_limit(bed_.state));
  const int substeps = std::max(1, static_cast<int>(limit / grain_step));
  const double dt = substeps * grain_step;
  if (has_grains()) {
    Stopwatch watch(wall_.exchange);
    coupler_.load_flow(bed_.state, flow_, dt, false);
  }
  advance_flow(dt);
  if (has_grains()) {
    {
      Stopwatch watch(wall_.exchange);
      coupler_.push_grains(flow_, bed_.state, dt);
    }
    advance_grains(substeps);
    grain_force_ = (1.0 / (dt * case_.grains.diameter)) * bed_.pipe_impulse;
    Stopwatch watch(wall_.exchange);
    coupler_.collect(bed_.state, flow_, dt);
    const double rise = case_.flow.current.rise;
    supply_.pass_ends(bed_, coupler_, dt, case_.theta * (rise > 0 ? base::square(risen_share(time(), rise)) : 1.0));
  }
  last_step_ = dt;
  ++clock_.flow_steps;
  clock_.grain_steps += substeps;
}

void Simulation::advance_flow(double dt) {
  Stopwatch watch(wall_.flow);
  const double rise = case_.flow.current.rise;
  if (rise > 0) scale_inlet(full_inlet_, risen_share(time(), rise), flow_);
  try {
    report_ = flow_.advance(dt);
    check_finite();
    if (case_.flow.current.profile == flow::Profile::recycled) recycle_inlet(case_, case_.bed_thickness, dt, flow_);
  } catch (const base::Fault& fault) {
    fail_here(fault);
  }
}

void Simulation::advance_grains(int substeps) {
  Stopwatch watch(wall_.grains);
  bed_.pipe_impulse = {};
  try {
    grains::advance(bed_, substeps);
  } catch (const base::Fault& fault) {
    fail_here(fault);
  }
}

void Simulation::fail_here(const base::Fault& fault) const {
  base::fail(fault.code(), "t = {:.5g} s, flow step {}: {}; {}", time(), clock_.flow_steps, fault.what(),
             fastest_place(flow_.mesh(), flow_.state));
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
  base::fail(base::Exit::diverged, "{}", fault.empty() ? "the sum over all cells is not finite" : fault);
}

double Simulation::flow_momentum() const {
  const flow::State& s = flow_.state;
  const flow::Staggering& at = flow_.at_u();
  double sum = 0;
  for (int j = at.j0; j < at.j1; ++j) {
    const double *u = s.u.row(j), *inertia = at.inertia_.row(j), *width = at.width.data() + 2;
    sum += at.height[j + 2] * base::vector_sum(at.i0, at.i1, [&](int i) { return u[i] * inertia[i] * width[i]; });
  }
  return sum * case_.flow.density * case_.grains.diameter;
}

const base::Field& Simulation::solid_fraction() {
  if (has_grains()) coupler_.solid_fraction(bed_.state, solid_);
  return solid_;
}

}  // namespace livebed::run
