#include "flow/momentum.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "flow/advance.hpp"

namespace livebed::flow {
namespace {

/// A box of slip walls with inlet and outlet, water everywhere.
struct Box {
  Params params;
  Mesh mesh;
  Boundary boundary;
  Box() {
    params.closure = Closure::laminar;
    params.density = 2.0, params.viscosity = 0.01;
    params.mesh.length = 1, params.mesh.height = 0.5, params.mesh.cell_x = 0.05, params.mesh.cell_y = 0.025;
    params.pipe.present = false;
    mesh = make_mesh(params.mesh, params.pipe);
    boundary.floor = boundary.top = Wall::slip;
    boundary.inlet_u.assign(mesh.ny, 1.0);
  }
};

/// dt x acceleration of all rows of a component.
base::Field accelerate(Box& box, State& s, Workspace& w, const Component& c, double dt) {
  base::Field out(box.mesh.nx, box.mesh.ny);
  w.rows.over_blocks(c.at.j0, c.at.j1, [&](int ja, int jb) {
    RowScratch::Rows scratch = w.rows.rows();
    MomentumRows<Bounded> rows(box.mesh, box.boundary, box.params, s, centred_carrier(s, dt), dt, dt, w, c, scratch);
    double* kx = scratch.take();
    rows.start(ja, jb, nullptr);
    for (int j = ja; j < jb; ++j) rows.next(out.row(j), kx);
  });
  return out;
}

TEST(momentum_rows, give_pressure_force_and_drag_of_a_uniform_flow) {
  Box box;
  Solver flow(box.params, box.mesh, box.boundary);
  State s = flow.state;
  const Mesh& m = box.mesh;
  s.u.fill(1.0), s.u_old.fill(1.0);
  s.load.top = m.ny;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i <= m.nx; ++i) {
      if (i < m.nx) s.p(i, j) = 3.0 * m.centre_x(i) - 5.0 * m.centre_y(j);
      s.load.beta_u(i, j) = 0.4, s.load.force_u(i, j) = 0.7;
    }
  Workspace w(m);
  w.own_rows(s.load.top);
  evaluate_walls(m, box.boundary, box.params, s, w);
  const Staggering at_u = Staggering::west_faces(m), at_v = Staggering::south_faces(m);
  const double dt = 0.01, rho = box.params.density;
  const base::Field du = accelerate(box, s, w, u_component(at_u, s, w), dt);
  const base::Field dv = accelerate(box, s, w, v_component(at_v, s, w), dt);
  for (int j = 2; j < m.ny - 2; ++j)
    for (int i = 2; i < m.nx - 2; ++i) {
      ASSERT_NEAR(du(i, j), dt / rho * (-3.0 + 0.7 - 0.4), 1e-14) << i << "," << j;
      ASSERT_NEAR(dv(i, j), dt / rho * 5.0, 1e-14) << i << "," << j;
      ASSERT_NEAR(w.factor_u(i, j), 1 + dt * 0.4 / rho, 1e-15);
      ASSERT_NEAR(w.response_u(i, j), 1 / (1 + dt * 0.4 / rho), 1e-15);
    }
}

TEST(momentum_rows, read_no_load_above_the_grains) {
  Box box;
  Solver flow(box.params, box.mesh, box.boundary);
  State s = flow.state;
  const Mesh& m = box.mesh;
  s.load.force_u.fill(1.0);
  s.load.top = 7;
  Workspace w(m);
  w.own_rows(s.load.top);
  const Staggering at_u = Staggering::west_faces(m);
  evaluate_walls(m, box.boundary, box.params, s, w);
  const base::Field du = accelerate(box, s, w, u_component(at_u, s, w), 0.01);
  EXPECT_GT(du(5, 6), 0.0);
  EXPECT_EQ(du(5, 7), 0.0);
}

TEST(add_storage, keeps_a_uniform_quantity_uniform) {
  Box box;
  const Mesh& m = box.mesh;
  Workspace w(m);
  const Staggering at = Staggering::centres(m);
  std::vector<double> c(m.nx, 3.0), convection(m.nx, 0.0);
  add_storage(at, w, 4, c.data(), convection.data());
  EXPECT_EQ(convection[5], 0.0);  // nothing stored
  w.storage = base::Field(m.nx, m.ny);
  for (int i = 0; i < m.nx; ++i) w.storage(i, 4) = -0.2 * m.dx(i) * m.dy(4);
  add_storage(at, w, 4, c.data(), convection.data());
  // What flows out of the cell takes - div(u) c = - 0.2 c with it; this gives it back.
  EXPECT_NEAR(convection[5], 0.6, 1e-14);
}

}  // namespace
}  // namespace livebed::flow
