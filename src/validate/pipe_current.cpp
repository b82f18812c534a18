#include "validate/pipe_current.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

#include "base/curves.hpp"
#include "base/fault.hpp"
#include "base/math.hpp"
#include "base/spectrum.hpp"
#include "base/version.hpp"
#include "flow/mapping.hpp"
#include "flow/momentum_balance.hpp"
#include "flow/profiles.hpp"

namespace livebed::validate {

using base::square;

namespace {

constexpr double D = pipe_diameter, U0 = depth_mean_speed, turnover = D / U0;
constexpr double courant = 0.8;
constexpr double settle = 20;          ///< on the own grid after a start from a coarser one [D/U0]
constexpr double box_half = 0.6;       ///< [D]
constexpr double steady_below = 2e-3;  ///< rms lift coefficient that counts as none [-]

const char* name_of(flow::Closure closure) {
  switch (closure) {
    case flow::Closure::k_epsilon:
      return "k-epsilon";
    case flow::Closure::k_epsilon_realizable:
      return "realizable";
    case flow::Closure::k_omega:
      return "k-omega";
    case flow::Closure::k_omega_sst:
      return "k-omega-sst";
    case flow::Closure::laminar:
      break;
  }
  return "laminar";
}

flow::Params params(const PipeSetup& c) {
  flow::Params p;
  p.density = water_density;
  p.viscosity = U0 * D / reynolds_D;
  p.closure = c.closure;
  p.convection = c.convection;
  p.courant = courant;
  p.max_step = 0.1 * turnover;
  p.floor = flow::Wall::smooth;
  p.mesh.length = box_length * D, p.mesh.height = c.depth * D;
  p.mesh.cell_x = box_length * D / c.nx, p.mesh.cell_y = box_depth * D / c.ny;
  if (c.depth > box_depth) {
    p.mesh.growth = 1.05;
    p.mesh.fine_x_to = p.mesh.length;
    p.mesh.fine_y_to = box_depth * D;
  }
  p.pipe.diameter = D;
  p.pipe.x = pipe_from_inlet * D, p.pipe.y = (c.gap_ratio + 0.5) * D;
  p.pipe.gap_ratio = c.gap_ratio;
  p.pipe.layer = c.layer;
  p.current.profile = c.profile;
  p.current.mean_speed = U0;
  p.current.shear_velocity = flow::shear_velocity_from_mean(
      flow::Profile::smooth, U0, (c.profile_depth > 0 ? c.profile_depth : c.depth) * D, 0.0, p.viscosity);
  return p;
}

/// u or v at a point [m], bilinear.
double sample(const std::vector<double>& xs, const std::vector<double>& ys, const base::Field& f, double x, double y) {
  const auto cell = [](const std::vector<double>& nodes, double s) {
    const auto next = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, s);
    return static_cast<int>(next - nodes.begin()) - 1;
  };
  const int i = cell(xs, x), j = cell(ys, y);
  const double a = (x - xs[i]) / (xs[i + 1] - xs[i]), b = (y - ys[j]) / (ys[j + 1] - ys[j]);
  return (1 - b) * ((1 - a) * f(i, j) + a * f(i + 1, j)) + b * ((1 - a) * f(i, j + 1) + a * f(i + 1, j + 1));
}

/// Stream function [U0 D] at the nodes of the window, 0 on the floor.
std::vector<double> stream_function(const flow::Mesh& m, const base::Field& u, int i0, int i1, int j1) {
  std::vector<double> psi;
  std::vector<double> sum(i1 - i0 + 1, 0.0);
  for (int j = 0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i) {
      psi.push_back(sum[i - i0] / (U0 * D));
      sum[i - i0] += m.aperture_x(i, j) * u(i, j) * m.dy(j);
    }
  return psi;
}

flow::Solver make_solver(const PipeSetup& setup) {
  const flow::Params p = params(setup);
  const flow::Mesh mesh = flow::make_mesh(p.mesh, p.pipe);
  return {p, mesh, flow::make_boundary(mesh, p)};
}

void advance_by(flow::Solver& flow, double time) {
  const double end = flow.state.time + time;
  while (flow.state.time < end) flow.advance(flow.step_limit());
}

/// First flow of the record: developed on the usual grid when the own one is finer.
void develop(flow::Solver& flow, const PipeSetup& setup) {
  if (setup.nx <= work_nx) {
    flow.start();
    advance_by(flow, setup.spin_up * turnover);
    return;
  }
  PipeSetup coarse = setup;
  coarse.nx = work_nx, coarse.ny = work_ny;
  flow::Solver before = make_solver(coarse);
  before.start();
  advance_by(before, setup.spin_up * turnover);
  flow::map_flow(before, flow);
  advance_by(flow, settle * turnover);
}

/// Zero crossing between floor_x[k-1] and floor_x[k].
double crossing(const std::vector<double>& x, const std::vector<double>& f, std::size_t k) {
  return x[k] - f[k] / (f[k] - f[k - 1]) * (x[k] - x[k - 1]);
}

}  // namespace

std::string PipeSetup::name() const {
  std::string text = fmt::format("{}-e{}-h{}-{}x{}", name_of(closure), gap_ratio, depth, nx, ny);
  if (profile == flow::Profile::uniform) text += "-uniform";
  if (profile_depth > 0) text += fmt::format("-profile{}", profile_depth);
  if (convection == flow::Convection::hybrid) text += "-hybrid";
  if (layer == flow::PipeLayer::laminar) text += "-laminar-layer";
  if (record != PipeSetup{}.record) text += fmt::format("-record{}", record);
  return text;
}

std::string PipeSetup::text() const {
  return fmt::format(
      "pipe 10 D from the inlet, e/D {}, Re_D {}, box {} D x {} D, {} x {} cells over the lowest 3.5 D{}, {}, {} inlet "
      "of mean speed U0 over {} D, smooth floor and pipe, {} layer on the pipe, symmetry lid, {} convection, Courant "
      "{}, {} D/U0 before "
      "the record of {} D/U0{}",
      gap_ratio, reynolds_D, box_length, depth, nx, ny, depth > box_depth ? ", growing by 1.05 above" : "",
      name_of(closure), profile == flow::Profile::uniform ? "uniform" : "smooth log-law",
      profile_depth > 0 ? profile_depth : depth, layer == flow::PipeLayer::laminar ? "laminar" : "turbulent",
      convection == flow::Convection::hybrid ? "hybrid" : "bounded", courant, spin_up, record,
      nx > work_nx ? fmt::format(" (spin-up on {} x {}, then {} D/U0 on the grid itself)", work_nx, work_ny, settle)
                   : "");
}

PipeRun run_pipe(const PipeSetup& setup, const Tell& tell) {
  const auto start = std::chrono::steady_clock::now();
  flow::Solver flow = make_solver(setup);
  const flow::Params& p = flow.params();
  const flow::Mesh& m = flow.mesh();
  const flow::State& s = flow.state;
  develop(flow, setup);

  PipeRun run;
  run.nx = m.nx, run.ny = m.ny;
  run.commit = base::commit();
  const double px = m.pipe.x, py = m.pipe.y, force_unit = 0.5 * p.density * square(U0) * D;
  const std::vector<double> xc(m.xc.begin() + 2, m.xc.end() - 2), yc(m.yc.begin() + 2, m.yc.end() - 2);
  run.axis_speed = base::interpolate(yc, flow.boundary().inlet_u, py) / U0;
  run.inlet_shear = p.density * square(p.current.shear_velocity);
  const bool with_box = py > 1.1 * box_half * D;
  const flow::Box box = with_box ? flow::box_around_pipe(m, box_half * D) : flow::Box{};

  int i0 = 0, i1 = 0, j1 = 0;
  while (m.x[i0] < px + window_from * D) ++i0;
  while (m.x[i1] < px + window_to * D) ++i1;
  while (m.y[j1] < window_height * D) ++j1;
  for (int i = i0; i <= i1; ++i) run.window_x.push_back((m.x[i] - px) / D);
  for (int j = 0; j <= j1; ++j) run.window_y.push_back(m.y[j] / D);

  base::Field mean_u(m.nx, m.ny);
  std::vector<double> shear(m.nx, 0.0);
  base::Vec2 through, inside_before;
  const double began = s.time, end = began + setup.record * turnover;
  int snapshot = 0;
  double told = 0;
  if (with_box) inside_before = flow::momentum_inside(p, m, s, box);
  while (s.time < end) {
    const double dt = flow.step_limit();
    const flow::StepReport step = flow.advance(dt);
    run.steps += 1;
    run.t.push_back((s.time - began) / turnover);
    run.drag.push_back(step.pipe_force.x / force_unit);
    run.lift.push_back(step.pipe_force.y / force_unit);
    const auto u_at = [&](double x, double y) { return sample(m.x, yc, s.u, px + x * D, y) / U0; };
    run.u_above.push_back(u_at(0.5, py + 0.65 * D));
    run.u_below.push_back(u_at(0.5, std::max(0.5 * setup.gap_ratio, 0.05) * D));
    run.u_wake.push_back(u_at(2, py + 0.5 * D));
    run.v_wake.push_back(sample(xc, m.y, s.v, px + 2 * D, py) / U0);
    for (int j = 0; j < m.ny; ++j)
      for (int i = 0; i <= m.nx; ++i) mean_u(i, j) += dt * s.u(i, j);
    for (int i = 0; i < m.nx; ++i)
      shear[i] += dt * p.density * std::copysign(square(flow.floor_shear_velocity(i)), s.u(i, 0) + s.u(i + 1, 0));
    if (with_box) through = through + dt * flow::momentum_inflow(p, m, s, box);
    while (snapshot < snapshots && s.time > end - (snapshots - snapshot) * snapshot_distance * turnover)
      run.psi[snapshot++] = stream_function(m, s.u, i0, i1, j1);
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > told + 120) {
      told = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      tell(fmt::format("  {}: {:.0f} of {:.0f} D/U0 after {:.0f} s", setup.name(), run.t.back(), setup.record, told));
    }
  }
  if (const std::string fault = flow.find_fault(); !fault.empty())
    base::fail(base::Exit::diverged, "{}: {}", setup.name(), fault);
  const double length = s.time - began;
  if (with_box)
    run.cd_box = (through.x - flow::momentum_inside(p, m, s, box).x + inside_before.x) / (length * force_unit);
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i <= m.nx; ++i) mean_u(i, j) /= length;
  for (int i = 0; i < m.nx; ++i) {
    run.floor_x.push_back((xc[i] - px) / D);
    run.shear.push_back(shear[i] / length / run.inlet_shear);
    const double u = 0.5 * (mean_u(i, 0) + mean_u(i + 1, 0));
    run.shear_viscous.push_back(p.density * p.viscosity * u / yc[0] / run.inlet_shear);
    run.axis_u.push_back(sample(m.x, yc, mean_u, xc[i], py) / U0);
  }
  for (int j = 0; j < m.ny; ++j) {
    run.section_y.push_back(yc[j] / D);
    for (std::size_t k = 0; k < sections.size(); ++k)
      run.section_u[k].push_back(sample(m.x, yc, mean_u, px + sections[k] * D, yc[j]) / U0);
  }
  run.psi_mean = stream_function(m, mean_u, i0, i1, j1);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

PipeNumbers measure(const PipeRun& run) {
  PipeNumbers n;
  n.cd = base::time_mean(run.t, run.drag);
  n.cl = base::time_mean(run.t, run.lift);
  n.cl_rms = base::time_rms(run.t, run.lift);
  constexpr double highest = 1.0;  // Strouhal number
  if (n.cl_rms > steady_below) {
    n.strouhal = peak_frequency(base::power_spectrum(run.t, run.lift, highest));
    n.strouhal_wake = peak_frequency(base::power_spectrum(run.t, run.v_wake, highest));
    n.periods = n.strouhal * (run.t.back() - run.t.front());
    constexpr std::size_t stretch = 5;
    const std::vector<double> up = base::upward_crossings(run.t, run.lift);
    for (std::size_t k = stretch; k < up.size(); ++k) {
      const double st = stretch / (up[k] - up[k - stretch]);
      n.slowest = k == stretch ? st : std::min(n.slowest, st);
      n.fastest = std::max(n.fastest, st);
    }
  }
  double far = 0, count = 0;
  bool behind = false;
  for (std::size_t k = 1; k < run.floor_x.size(); ++k) {
    const double x = run.floor_x[k], width = x - run.floor_x[k - 1];
    if (x > -8 && x < -5) far += run.shear[k], count += 1;
    if (std::abs(x) < 1 && run.shear[k] > n.peak_shear) n.peak_shear = run.shear[k], n.peak_at = x;
    if (x > -5 && x < 0 && run.shear[k] < 0) n.eddy_before += width;
    if (x < 0 || (run.shear[k] < 0) == (run.shear[k - 1] < 0)) continue;
    if (!behind) n.separation = crossing(run.floor_x, run.shear, k);
    behind = true;
    n.reattachment = crossing(run.floor_x, run.shear, k);
  }
  n.far_shear = far / count;
  for (std::size_t k = 1; k < run.floor_x.size(); ++k)
    if (run.floor_x[k] > 0.5 && run.axis_u[k - 1] < 0 && run.axis_u[k] >= 0)
      n.wake_end = crossing(run.floor_x, run.axis_u, k);
  return n;
}

}  // namespace livebed::validate
