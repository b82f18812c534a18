#include "flow/simple.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "flow/advance.hpp"

/// Each solve of an outer iteration by itself; whole flows are in the verification tests.
namespace livebed::flow {
namespace {

/// Uniform stream of 1 m/s that comes in on the left, under drag and a driving force.
struct Stream {
  static constexpr double density = 2, drag = 0.8;
  Params params;
  Mesh mesh;
  Boundary boundary;
  State state;
  Stream() {
    params.closure = Closure::laminar;
    params.algorithm = Algorithm::simple;
    params.density = density, params.viscosity = 0.01;
    params.mesh.length = 1, params.mesh.height = 0.5, params.mesh.cell_x = 0.05, params.mesh.cell_y = 0.025;
    params.pipe.present = false;
    mesh = make_mesh(params.mesh, params.pipe);
    boundary.floor = boundary.top = Wall::slip;
    boundary.inlet_u.assign(mesh.ny, 1.0);
    state = Solver(params, mesh, boundary).state;
    state.load.top = mesh.ny;
    state.load.beta_u.fill(drag), state.load.beta_v.fill(drag);
  }
  void set_speed(double u) {
    state.u.fill(u);
    fill_velocity_ghosts(mesh, boundary, state.u, state.v);
  }
  double furthest_from(double u) const {
    double worst = 0;
    for (int j = 0; j < mesh.ny; ++j)
      for (int i = 1; i <= mesh.nx; ++i) worst = std::max(worst, std::abs(state.u(i, j) - u));
    return worst;
  }
};

/// Solves momentum so many times; returns the residuals of each.
std::vector<Residuals> iterate(Stream& s, Simple& simple, double inverse_dt, int times) {
  Workspace w(s.mesh);
  const Staggering at_u = Staggering::west_faces(s.mesh), at_v = Staggering::south_faces(s.mesh);
  std::vector<Residuals> history(times);
  for (Residuals& residuals : history) {
    simple.solve_momentum(s.mesh, s.boundary, s.params, at_u, at_v, inverse_dt, s.state, w, residuals);
    fill_velocity_ghosts(s.mesh, s.boundary, s.state.u, s.state.v);
  }
  return history;
}

TEST(residuals, name_themselves_and_their_largest) {
  const Residuals r{1.2e-3, 3.4e-3, 5.6e-2, 7.8e-4, 9.1e-4};
  EXPECT_EQ(r.largest(), 5.6e-2);
  EXPECT_EQ(r.text(), "Ux 1.20e-03, Uy 3.40e-03, p 5.60e-02, k 7.80e-04, epsilon 9.10e-04");
}

TEST(simple_momentum, leaves_a_balanced_stream_alone) {
  Stream s;
  s.state.load.force_u.fill(s.drag);
  s.set_speed(1.0);
  Simple simple(s.mesh);
  EXPECT_LT(iterate(s, simple, 0.0, 1).front().largest(), 1e-13);
  EXPECT_LT(s.furthest_from(1.0), 1e-13);
}

TEST(simple_momentum, finds_the_balance_of_drag_and_force) {
  Stream s;
  s.state.load.force_u.fill(s.drag);
  s.set_speed(3.0);
  Simple simple(s.mesh);
  EXPECT_GT(iterate(s, simple, 0.0, 1).front().u, 0.1);
  iterate(s, simple, 0.0, 300);
  EXPECT_LT(s.furthest_from(1.0), 1e-8);
}

TEST(simple_momentum, takes_an_implicit_step_of_any_length) {
  for (const double dt : {0.1, 10.0}) {
    Stream s;
    const double slowed = 1 / (1 + dt * s.drag / s.density);  // of 1 m/s by drag alone
    s.boundary.inlet_u.assign(s.mesh.ny, slowed);
    s.set_speed(1.0);
    Simple simple(s.mesh);
    simple.begin_step(s.state);
    iterate(s, simple, 1 / dt, 300);
    EXPECT_LT(s.furthest_from(slowed), 1e-8) << dt;
  }
}

TEST(simple_momentum, responds_to_a_pressure_gradient_by_its_own_diagonal) {
  // At rest, with drag alone: centre = volume (drag/density + exchange), and the exchange goes with nu.
  Stream s;
  s.params.viscosity = 1e-12;
  s.boundary.inlet_u.assign(s.mesh.ny, 0.0);
  s.params.relax_velocity = 0.5;
  s.set_speed(0.0);
  Simple simple(s.mesh);
  Workspace w(s.mesh);
  Residuals residuals;
  simple.solve_momentum(s.mesh, s.boundary, s.params, Staggering::west_faces(s.mesh), Staggering::south_faces(s.mesh),
                        0.0, s.state, w, residuals);
  EXPECT_NEAR(w.response_u(8, 8) * (s.drag / s.density) / s.params.relax_velocity, 1, 1e-6);
  EXPECT_NEAR(w.response_v(8, 8) * (s.drag / s.density) / s.params.relax_velocity, 1, 1e-6);
}

TEST(simple_pressure, has_residual_one_with_nothing_known_and_zero_at_the_solution) {
  Stream s;
  Simple simple(s.mesh);
  Workspace w(s.mesh);
  const Mesh& m = s.mesh;
  base::Field p(m.nx, m.ny);
  for (int j = 0; j <= m.ny; ++j)
    for (int i = 0; i <= m.nx; ++i) w.c_x(i, j) = i > 0 && i<m.nx, w.c_y(i, j) = j> 0 && j < m.ny;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) w.outflow(i, j) = 0.01 * ((3 * i + 5 * j) % 7 - 3);
  EXPECT_NEAR(simple.pressure_residual(m, s.density, p, w), 1, 1e-14);
  p.fill(4.0);  // the level does not count
  EXPECT_NEAR(simple.pressure_residual(m, s.density, p, w), 1, 1e-12);
  w.outflow.fill(0.0);
  EXPECT_EQ(simple.pressure_residual(m, s.density, p, w), 0);
}

TEST(simple_turbulence, takes_an_implicit_step_of_decaying_turbulence) {
  // k1 = k0 - dt e1, e1 = e0 - dt C2 e1^2/k1, without strain and walls.
  Params p;
  p.algorithm = Algorithm::simple;
  p.mesh.length = 1, p.mesh.height = 1, p.mesh.cell_x = p.mesh.cell_y = 0.1;
  p.pipe.present = false;
  Boundary b;
  b.inlet = b.outlet = false;
  b.floor = b.top = Wall::slip;
  const Mesh m = make_mesh(p.mesh, p.pipe);
  State s = Solver(p, m, b).state;
  Workspace w(m);
  Turbulence turbulence(m, b, p);
  Simple simple(m);
  const Staggering at = Staggering::centres(m);
  const double k0 = 0.02, e0 = 0.01, dt = 3;
  s.k.fill(k0), s.k_old.fill(k0), s.epsilon.fill(e0), s.epsilon_old.fill(e0);
  evaluate_walls(m, b, p, s, w);
  simple.begin_step(s);
  Residuals r;
  for (int n = 0; n < 200; ++n) simple.solve_turbulence(m, b, p, at, 1 / dt, turbulence, s, w, r);
  const double k1 = s.k(4, 5), e1 = s.epsilon(4, 5);
  EXPECT_NEAR((k1 + dt * e1) / k0, 1, 1e-9);
  EXPECT_NEAR((e1 + dt * launder_spalding.c2 * e1 * e1 / k1) / e0, 1, 1e-9);
  EXPECT_LT(k1, 0.5 * k0);
  EXPECT_NEAR(s.nut(4, 5) / (launder_spalding.c_mu * k1 * k1 / e1), 1, 1e-12);
}

}  // namespace
}  // namespace livebed::flow
