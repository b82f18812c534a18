#include <cmath>
#include <gtest/gtest.h>

#include "flow/advance.hpp"
#include "flow/constants.hpp"
#include "flow/profiles.hpp"
#include "laminar.hpp"

/// Flows along a channel that have closed solutions: plane Poiseuille, a porous block, water at rest, uniform flow, a
/// vortex that leaves.
namespace livebed::flow {
namespace {

double parabola(double y, double height, double mean) { return 6 * mean * (y / height) * (1 - y / height); }

/// Runs until nothing changes by more than `rate` [m/s2].
void settle(Solver& flow, double rate, int most) {
  const Mesh& m = flow.mesh();
  for (int step = 0; step < most; ++step) {
    const double dt = flow.step_limit();
    flow.advance(dt);
    double change = 0;
    for (int j = 0; j < m.ny; ++j)
      for (int i = 1; i < m.nx; ++i)
        change = std::max(change, std::abs(flow.state.u(i, j) - flow.state.u_old(i, j)) / dt);
    if (change < rate) return;
  }
  ADD_FAILURE() << "not steady after " << most << " steps";
}

/// Steady plane Poiseuille flow with mean speed 1 and the parabola at the inlet.
Solver poiseuille(int ny) {
  const double height = 1, nu = 0.2;  // Re 5: the profile of the grid develops within one height
  Params p = laminar(4, height, ny, ny, nu);
  Boundary b;
  b.floor = b.top = Wall::no_slip;
  Solver flow(p, make_mesh(p.mesh, p.pipe), b);
  Boundary filled = b;
  for (int j = 0; j < flow.mesh().ny; ++j) filled.inlet_u.push_back(parabola(flow.mesh().centre_y(j), height, 1));
  filled.inlet_k = filled.inlet_epsilon = filled.inlet_u;
  Solver ready(p, flow.mesh(), filled);
  ready.start();
  settle(ready, 1e-7, 6000);
  return ready;
}

TEST(poiseuille, keeps_the_parabola_and_its_pressure_drop) {
  // On ny equal cells the flux differences have the closed solution a y (1-y) + c, with a and c below: the parabola but
  // for an error of order h^2.  Looked at half-way: the outlet face feels no friction, which shows within a height of
  // it in a flow as slow as this one.
  for (int ny : {10, 20, 40}) {
    const Solver flow = poiseuille(ny);
    const Mesh& m = flow.mesh();
    const double h2 = base::square(1.0 / ny), a = 6 * (1 + h2 / 2) / (1 + 2 * h2), c = a * h2 / 4;
    double from_grid = 0, from_parabola = 0;
    for (int j = 0; j < m.ny; ++j) {
      const double y = m.centre_y(j), u = flow.state.u(m.nx / 2, j);
      from_grid = std::max(from_grid, std::abs(u - (a * y * (1 - y) + c)));
      from_parabola = std::max(from_parabola, std::abs(u - parabola(y, 1, 1)));
    }
    const int west = 3 * m.nx / 8, east = 5 * m.nx / 8, j = m.ny / 2;
    const double slope = (flow.state.p(west, j) - flow.state.p(east, j)) / (m.centre_x(east) - m.centre_x(west));
    const double exact = 12 * flow.params().viscosity * flow.params().density;
    std::printf("ny %d: profile off the parabola %.2e, off the grid's own solution %.2e; pressure drop / exact %.5f\n",
                ny, from_parabola, from_grid, slope / exact);
    EXPECT_LT(from_grid, 2e-4);
    EXPECT_LT(from_parabola, 1.6 * h2);
    EXPECT_NEAR(slope / exact, a / 6, 1.2e-3);
  }
}

TEST(porous_block, takes_the_darcy_pressure_drop_exactly) {
  Params p = laminar(2, 0.5, 40, 10, 1e-6);
  p.floor = Wall::slip;
  p.current.profile = Profile::uniform;
  p.current.mean_speed = 0.3;
  const Mesh m = make_mesh(p.mesh, p.pipe);
  Solver flow(p, m, make_boundary(m, p));
  flow.start();
  const double beta = 5e4;
  flow.state.load.top = flow.mesh().ny;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 15; i < 25; ++i) flow.state.load.beta_u(i, j) = flow.state.load.beta_v(i, j) = beta;
  for (int step = 0; step < 200; ++step) flow.advance(0.05);
  const double drop = flow.state.p(10, 5) - flow.state.p(30, 5), exact = beta * 0.3 * 10 * 0.05;
  EXPECT_NEAR(drop / exact, 1.0, 1e-8);
  EXPECT_NEAR(flow.state.u(20, 4), 0.3, 1e-8);
  EXPECT_NEAR(flow.state.v(20, 4), 0.0, 1e-8);
}

TEST(rest, stays_at_rest_with_a_pipe_on_the_floor) {
  Params p = laminar(1, 0.4, 100, 40, 1e-6);
  p.pipe.present = true;
  p.pipe.diameter = 0.1, p.pipe.x = 0.4131, p.pipe.y = 0.05;
  p.current.profile = Profile::uniform;
  p.current.mean_speed = 0;
  p.max_step = 0.05;
  const Mesh m = make_mesh(p.mesh, p.pipe);
  Solver flow(p, m, make_boundary(m, p));
  flow.start();
  for (int step = 0; step < 20; ++step) {
    const StepReport report = flow.advance(flow.step_limit());
    EXPECT_EQ(report.pipe_force.x, 0.0);
    EXPECT_EQ(report.pipe_force.y, 0.0);
  }
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      ASSERT_EQ(flow.state.u(i, j), 0.0);
      ASSERT_EQ(flow.state.v(i, j), 0.0);
    }
}

TEST(uniform_flow, stays_uniform_on_a_stretched_grid) {
  Params p = laminar(3, 1, 60, 20, 1e-4);
  p.mesh.growth = 1.15;
  p.mesh.fine_x_from = 1, p.mesh.fine_x_to = 1.4, p.mesh.fine_y_from = 0.2, p.mesh.fine_y_to = 0.4;
  p.floor = Wall::slip;
  p.current.profile = Profile::uniform;
  p.current.mean_speed = 0.7;
  const Mesh m = make_mesh(p.mesh, p.pipe);
  Solver flow(p, m, make_boundary(m, p));
  flow.start();
  for (int step = 0; step < 100; ++step) flow.advance(flow.step_limit());
  double worst = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i <= m.nx; ++i)
      worst = std::max({worst, std::abs(flow.state.u(i, j) - 0.7), std::abs(flow.state.v(std::min(i, m.nx - 1), j))});
  EXPECT_LT(worst, 1e-12);
}

/// Lamb-Oseen pair of the stream function A exp(-r^2/2 c^2): no net circulation, so nothing far away.
double reflected(double cells_a_core) {
  const double core = 0.1, speed = 1, swirl = 0.3;
  const double h = core / cells_a_core;
  Params p = laminar(2, 2, static_cast<int>(std::lround(2 / h)), static_cast<int>(std::lround(2 / h)), 1e-4);
  p.pressure_tolerance = 1e-6;
  p.floor = Wall::slip;
  p.current.profile = Profile::uniform;
  p.current.mean_speed = speed;
  const Mesh m = make_mesh(p.mesh, p.pipe);
  const auto psi = [&](double x, double y) {
    const double r2 = base::square(x - 1.4) + base::square(y - 1.03);
    return swirl * core * std::exp(0.5 - 0.5 * r2 / base::square(core));  // largest swirl speed: `swirl`
  };
  Solver flow(p, m, make_boundary(m, p));
  flow.start();
  State& s = flow.state;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 1; i < m.nx; ++i) s.u(i, j) += (psi(m.x[i], m.y[j + 1]) - psi(m.x[i], m.y[j])) / m.dy(j);
  for (int j = 1; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) s.v(i, j) -= (psi(m.x[i + 1], m.y[j]) - psi(m.x[i], m.y[j])) / m.dx(i);
  fill_velocity_ghosts(m, flow.boundary(), s.u, s.v);
  s.u_old = s.u, s.v_old = s.v;
  while (s.time < 1.6) flow.advance(flow.step_limit());  // the core passes the outlet at 0.6
  double worst = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) worst = std::max({worst, std::abs(s.u(i, j) - speed), std::abs(s.v(i, j))});
  return worst / swirl;
}

TEST(outlet, lets_a_vortex_leave) {
  const double left = reflected(6);
  std::printf("left behind by a vortex: %.3f %% of its swirl\n", 100 * left);
  EXPECT_LT(left, 0.02);
  EXPECT_GT(left, 1e-6);  // the vortex was there
}

}  // namespace
}  // namespace livebed::flow
