#include "flow/momentum_balance.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "base/math.hpp"
#include "flow/advance.hpp"

namespace livebed::flow {
namespace {

using base::square;

/// Water everywhere on a stretched grid, and flows written into it by formulas.
struct Water {
  Params params;
  Mesh mesh;
  State state;
  explicit Water(bool pipe = false) {
    params.density = 2.5, params.viscosity = 0.3, params.closure = Closure::laminar;
    params.mesh.length = 2, params.mesh.height = 1.2, params.mesh.cell_x = 0.05, params.mesh.cell_y = 0.04;
    params.mesh.growth = 1.1, params.mesh.fine_x_from = 0.6, params.mesh.fine_x_to = 1.2;
    params.mesh.fine_y_from = 0.3, params.mesh.fine_y_to = 0.8;
    params.pipe.present = pipe;
    params.pipe.diameter = 0.3, params.pipe.x = 0.913, params.pipe.y = 0.571;
    mesh = make_mesh(params.mesh, params.pipe);
    Boundary closed;
    closed.inlet = closed.outlet = false;
    state = Solver(params, mesh, closed).state;
  }
  template <class U, class V, class P>
  void set(U&& u, V&& v, P&& p) {
    const Mesh& m = mesh;
    for (int j = 0; j <= m.ny; ++j)
      for (int i = 0; i <= m.nx; ++i) {
        state.u(i, j) = u(m.x[i], m.centre_y(j));
        state.v(i, j) = v(m.centre_x(i), m.y[j]);
        state.p(i, j) = p(m.centre_x(i), m.centre_y(j));
      }
  }
  base::Vec2 inflow(const Box& box) const { return momentum_inflow(params, mesh, state, box); }
};
const auto none = [](double, double) { return 0.0; };

TEST(box_around_pipe, is_the_smallest_box_of_cells_that_reaches_far_enough) {
  const Water water(true);
  const Mesh& m = water.mesh;
  const Box box = box_around_pipe(m, 0.22);
  EXPECT_LE(m.x[box.i0], 0.913 - 0.22);
  EXPECT_GT(m.x[box.i0 + 1], 0.913 - 0.22);
  EXPECT_GE(m.x[box.i1], 0.913 + 0.22);
  EXPECT_LT(m.x[box.i1 - 1], 0.913 + 0.22);
  EXPECT_LE(m.y[box.j0], 0.571 - 0.22);
  EXPECT_GT(m.y[box.j0 + 1], 0.571 - 0.22);
  EXPECT_GE(m.y[box.j1], 0.571 + 0.22);
  EXPECT_LT(m.y[box.j1 - 1], 0.571 + 0.22);
}

TEST(box_around_pipe, must_lie_inside_the_grid) {
  const Water water(true);
  try {
    box_around_pipe(water.mesh, 0.6);  // 0.571 above the floor
    FAIL() << "the box reaches below the floor";
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), base::Exit::internal);
  }
}

TEST(momentum_inflow, of_uniform_flow_is_nothing) {
  Water water;
  water.set([](double, double) { return 1.7; }, [](double, double) { return -0.4; },
            [](double, double) { return 12.0; });
  const base::Vec2 force = water.inflow({5, 20, 4, 15});
  EXPECT_NEAR(force.x, 0, 1e-13);
  EXPECT_NEAR(force.y, 0, 1e-13);
}

TEST(momentum_inflow, holds_the_pressure_on_the_sides) {
  Water water;
  water.set(none, none, [](double x, double y) { return 3 * x - 7 * y; });
  const Mesh& m = water.mesh;
  const Box box{5, 20, 4, 15};
  const double area = (m.x[box.i1] - m.x[box.i0]) * (m.y[box.j1] - m.y[box.j0]);
  const base::Vec2 force = water.inflow(box);
  EXPECT_NEAR(force.x, -3 * area, 1e-12);
  EXPECT_NEAR(force.y, 7 * area, 1e-12);
}

TEST(momentum_inflow, is_what_a_stagnation_flow_needs_to_turn) {
  // u = a x, v = -a y: rho times the integral of u du/dx + v du/dy = a^2 x, and of a^2 y.
  Water water;
  const double a = 1.3;
  water.set([a](double x, double) { return a * x; }, [a](double, double y) { return -a * y; }, none);
  const Mesh& m = water.mesh;
  const Box box{5, 20, 4, 15};
  const double x0 = m.x[box.i0], x1 = m.x[box.i1], y0 = m.y[box.j0], y1 = m.y[box.j1];
  const base::Vec2 force = water.inflow(box);
  const double scale = water.params.density * a * a;
  EXPECT_NEAR(force.x, -scale * 0.5 * (square(x1) - square(x0)) * (y1 - y0), 1e-12);
  EXPECT_NEAR(force.y, -scale * 0.5 * (square(y1) - square(y0)) * (x1 - x0), 1e-12);
}

TEST(momentum_inflow, lets_friction_carry_the_pressure_drop_of_a_channel) {
  // nu + nut = 0.5: u = G/(2 rho 0.5) y (h - y) under dp/dx = -G.
  Water water;
  water.state.nut.fill(0.2);
  const double G = 4, factor = G / (2 * water.params.density * 0.5);
  water.set([&](double, double y) { return factor * y * (1.2 - y); }, none, [&](double x, double) { return -G * x; });
  const Mesh& m = water.mesh;
  for (const Box& box : {Box{5, 20, 4, 15}, Box{3, 4, 7, 8}}) {
    const double area = (m.x[box.i1] - m.x[box.i0]) * (m.y[box.j1] - m.y[box.j0]);
    // Exact where rows are equal; differences over unequal rows are of first order here.
    EXPECT_NEAR(water.inflow(box).x / (G * area), 0, 0.02);
    EXPECT_NEAR(water.inflow(box).y, 0, 1e-12);
  }
}

TEST(momentum_inside, is_that_of_the_water) {
  for (const bool pipe : {false, true}) {
    Water water(pipe);
    water.set([](double, double) { return 2.0; }, [](double, double) { return -3.0; }, none);
    const Mesh& m = water.mesh;
    const Box box = pipe ? box_around_pipe(m, 0.22) : Box{5, 20, 4, 15};
    const double area =
        (m.x[box.i1] - m.x[box.i0]) * (m.y[box.j1] - m.y[box.j0]) - (pipe ? 0.25 * base::pi * square(0.3) : 0.0);
    const base::Vec2 inside = momentum_inside(water.params, m, water.state, box);
    // Openings of faces stand for volumes of cells: equal to the second order.
    EXPECT_NEAR(inside.x / (water.params.density * 2 * area), 1, pipe ? 0.01 : 1e-13);
    EXPECT_NEAR(inside.y / (water.params.density * -3 * area), 1, pipe ? 0.01 : 1e-13);
  }
}

}  // namespace
}  // namespace livebed::flow
