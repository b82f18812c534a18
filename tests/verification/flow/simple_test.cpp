#include <cmath>
#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "flow/advance.hpp"
#include "flow/profiles.hpp"
#include "laminar.hpp"

/// SIMPLE against the projection algorithm, against itself with other relaxation, and in time.
namespace livebed::flow {
namespace {

Params cavity_params(int n) {
  Params p = laminar(1, 1, n, n, 0.01);  // Re 100
  p.max_step = 0.02;
  p.tolerance = 1e-8;
  p.outer_iterations = 500;
  p.pressure_tolerance = 1e-6;
  return p;
}
Boundary cavity_walls() {
  Boundary b;
  b.inlet = b.outlet = false;
  b.west = b.east = b.floor = b.top = Wall::no_slip;
  b.top_speed = 1;
  return b;
}
Solver cavity(const Params& p) {
  const Mesh m = make_mesh(p.mesh, p.pipe);
  Solver flow(p, m, cavity_walls());
  flow.start();
  return flow;
}

Params pipe_params(int nx, int ny) {
  // Re_D about 10^4 in a box of 30 D x 3.5 D, e/D = 0.3.
  Params p;
  p.viscosity = 1e-6;
  p.mesh.length = 1.5, p.mesh.height = 0.175, p.mesh.cell_x = 1.5 / nx, p.mesh.cell_y = 0.175 / ny;
  p.pipe.diameter = 0.05, p.pipe.x = 0.5, p.pipe.y = 0.04;
  p.floor = Wall::smooth;
  p.current.profile = Profile::smooth, p.current.shear_velocity = 0.0094;
  p.pressure_tolerance = 1e-4;
  return p;
}
Solver past_pipe(const Params& p) {
  const Mesh m = make_mesh(p.mesh, p.pipe);
  Solver flow(p, m, make_boundary(m, p));
  flow.start();
  return flow;
}
double coefficient(double force) { return force / (0.5 * 1000 * base::square(0.197) * 0.05); }

TEST(simple, finds_the_steady_cavity_of_the_projection) {
  Params p = cavity_params(32);
  Solver marched = cavity(p);
  while (marched.state.time < 25) marched.advance(marched.step_limit());
  p.algorithm = Algorithm::simple;
  Solver steady = cavity(p);
  const auto history = steady.solve_steady(3000);
  const double off = distance(steady.mesh(), steady.state.u, steady.state.v, marched.state.u, marched.state.v);
  double lowest = 0;
  for (int j = 0; j < 32; ++j) lowest = std::min(lowest, steady.state.u(16, j));
  std::printf("cavity: %zu outer iterations, rms difference %.2e of the lid, least u %.4f (Ghia -0.2109)\n",
              history.size(), off, lowest);
  EXPECT_LT(history.back().largest(), p.tolerance);
  EXPECT_GT(history.front().largest(), 0.1);
  // Not zero: the face values of the projection run half a step ahead.
  EXPECT_LT(off, 1e-3);
  EXPECT_NEAR(lowest, -0.2109, 0.004);
}

TEST(simple, converges_to_the_same_flow_whatever_the_relaxation) {
  Params p = cavity_params(24);
  p.algorithm = Algorithm::simple;
  p.tolerance = 1e-10;
  Solver a = cavity(p);
  p.relax_velocity = 0.5, p.relax_pressure = 0.5;
  Solver b = cavity(p);
  EXPECT_LT(a.solve_steady(3000).back().largest(), 1e-10);
  EXPECT_LT(b.solve_steady(3000).back().largest(), 1e-10);
  EXPECT_LT(distance(a.mesh(), a.state.u, a.state.v, b.state.u, b.state.v), 1e-8);
  EXPECT_GT(distance(a.mesh(), a.state.u, a.state.v, b.state.u, b.state.v), 0);
}

TEST(simple, is_of_first_order_in_time) {
  const auto at_end = [](double dt) {
    Params p = cavity_params(16);
    p.algorithm = Algorithm::simple;
    p.tolerance = 1e-9;
    p.relax_velocity = 0.9, p.relax_pressure = 0.5;
    Solver flow = cavity(p);
    for (int n = 0; n < std::lround(0.4 / dt); ++n) EXPECT_LT(flow.advance(dt).residuals.largest(), 1e-9);
    return flow.state;
  };
  const State a = at_end(0.1), b = at_end(0.05), c = at_end(0.025);
  const Mesh m = make_mesh(cavity_params(16).mesh, cavity_params(16).pipe);
  const double order = std::log2(distance(m, a.u, a.v, b.u, b.v) / distance(m, b.u, b.v, c.u, c.v));
  std::printf("order in time %.3f\n", order);
  EXPECT_NEAR(order, 1.0, 0.15);
}

TEST(simple, takes_steps_of_any_length) {
  // Courant numbers of 20 and 2000; a step without end is the steady flow.
  Params p = pipe_params(120, 20);
  p.convection = Convection::hybrid;
  p.algorithm = Algorithm::simple;
  p.outer_iterations = 1500;
  p.tolerance = 1e-4;
  Solver steady = past_pipe(p);
  EXPECT_LT(steady.solve_steady(3000).back().largest(), 1e-4);
  const double drag = coefficient(steady.pipe_force().x);
  for (double dt : {1.0, 100.0}) {
    Solver flow = past_pipe(p);
    StepReport report;
    for (int n = 0; n < (dt < 10 ? 30 : 3); ++n) report = flow.advance(dt);
    std::printf("dt %.0f s, Courant %.0f: Cd %.5f, steady %.5f, %d outer iterations: %s\n", dt, report.courant,
                coefficient(report.pipe_force.x), drag, report.outer_iterations, report.residuals.text().c_str());
    EXPECT_NEAR(coefficient(report.pipe_force.x) / drag, 1, 5e-3);
    EXPECT_EQ(flow.find_fault(), "");
  }
}

TEST(simple, finds_the_same_steady_turbulent_channel_as_the_projection) {
  Params p = pipe_params(60, 24);
  p.pipe.present = false;
  p.max_step = 1;
  Solver marched = past_pipe(p);
  while (marched.state.time < 40) marched.advance(marched.step_limit());
  p.algorithm = Algorithm::simple;
  p.tolerance = 1e-7;
  Solver steady = past_pipe(p);
  EXPECT_LT(steady.solve_steady(1000).back().largest(), 1e-7);
  for (int i = 5; i < 60; i += 6) {
    EXPECT_NEAR(steady.floor_shear_velocity(i) / marched.floor_shear_velocity(i), 1, 2e-3) << i;
    for (int j : {1, 6, 12, 20}) {
      EXPECT_NEAR(steady.state.u(i, j) / marched.state.u(i, j), 1, 2e-3);
      EXPECT_NEAR(steady.state.k(i, j) / marched.state.k(i, j), 1, 0.02);
      EXPECT_NEAR(steady.state.nut(i, j) / marched.state.nut(i, j), 1, 0.02);
    }
  }
}

/// Mean drag, rms of the lift and Strouhal number of the second half of a record.
struct Shedding {
  double drag = 0, lift_rms = 0, strouhal = 0;
};
Shedding shed(Solver& flow, double end) {
  std::vector<double> time, drag, lift;
  while (flow.state.time < end) {
    const StepReport r = flow.advance(flow.step_limit());
    if (flow.state.time < 0.5 * end) continue;
    time.push_back(flow.state.time), drag.push_back(coefficient(r.pipe_force.x)),
        lift.push_back(coefficient(r.pipe_force.y));
  }
  const auto mean = [&](const std::vector<double>& a) {
    double sum = 0;
    for (std::size_t n = 1; n < a.size(); ++n) sum += (time[n] - time[n - 1]) * 0.5 * (a[n] + a[n - 1]);
    return sum / (time.back() - time.front());
  };
  Shedding s;
  s.drag = mean(drag);
  const double middle = mean(lift);
  std::vector<double> crossings, squares;
  for (std::size_t n = 0; n < lift.size(); ++n) {
    squares.push_back(base::square(lift[n] - middle));
    if (n > 0 && lift[n - 1] < middle && lift[n] >= middle) crossings.push_back(time[n]);
  }
  s.lift_rms = std::sqrt(mean(squares));
  if (crossings.size() > 1) s.strouhal = (crossings.size() - 1) / (crossings.back() - crossings.front()) * 0.05 / 0.197;
  return s;
}

TEST(simple, sheds_the_vortices_of_the_projection) {
  Params p = pipe_params(180, 32);
  p.closure = Closure::k_omega_sst;
  Solver fast = past_pipe(p);
  const Shedding projection = shed(fast, 8);
  p.algorithm = Algorithm::simple;
  p.max_step = 0.01;
  p.relax_velocity = 0.9, p.relax_pressure = 0.6, p.relax_turbulence = 0.9;
  Solver slow = past_pipe(p);
  const Shedding implicit = shed(slow, 8);
  std::printf("projection Cd %.3f, Cl rms %.3f, St %.4f; SIMPLE %.3f, %.3f, %.4f\n", projection.drag,
              projection.lift_rms, projection.strouhal, implicit.drag, implicit.lift_rms, implicit.strouhal);
  EXPECT_NEAR(implicit.drag / projection.drag, 1, 0.05);
  EXPECT_NEAR(implicit.strouhal / projection.strouhal, 1, 0.05);
  EXPECT_LT(implicit.lift_rms, projection.lift_rms);  // a step of first order in time damps the wake
  EXPECT_GT(implicit.lift_rms, 1e-3);
}

TEST(simple, says_what_a_steady_flow_needs) {
  Solver flow = cavity(cavity_params(8));
  try {
    flow.solve_steady(10);
    FAIL() << "the projection has no steady mode";
  } catch (const base::Fault& fault) {
    EXPECT_NE(std::string(fault.what()).find("flow.algorithm = \"simple\""), std::string::npos);
  }
}

}  // namespace
}  // namespace livebed::flow
