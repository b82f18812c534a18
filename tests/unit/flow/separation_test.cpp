#include "flow/separation.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "flow/advance.hpp"

namespace {

using namespace livebed::flow;
using livebed::base::Vec2;

constexpr double pi = Separation::never;

/// Speeds at equal spacing over a length of one.
template <class Speed>
std::vector<double> speeds(int n, Speed&& speed) {
  std::vector<double> u;
  for (int i = 0; i <= n; ++i) u.push_back(speed(static_cast<double>(i) / n));
  return u;
}

Mesh pipe_in_box(int cells) {
  MeshParams grid;
  grid.length = 4, grid.height = 4;
  grid.cell_x = grid.cell_y = 1.0 / cells;
  PipeParams pipe;
  pipe.diameter = 1, pipe.x = 2.013, pipe.y = 1.987, pipe.layer = PipeLayer::laminar;
  return make_mesh(grid, pipe);
}

/// Pressure of the potential flow at 1 m/s round the pipe, its stagnation point `turned` upwards, into state.p.
State potential_pressure(const Mesh& m, double turned, double density) {
  State s;
  s.p = livebed::base::Field(m.nx, m.ny, 2, 0.0);
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      const double angle = std::atan2(m.centre_y(j) - m.pipe.y, -(m.centre_x(i) - m.pipe.x)) - turned;
      s.p(i, j) = 0.5 * density * (1 - 4 * std::sin(angle) * std::sin(angle));
    }
  return s;
}

/// Thwaites' own results: 0.123 for the linearly retarded stream (Howarth's solution: 0.120), 103 degrees for the
/// potential flow past a cylinder (the solution: 104.5).
TEST(Separation, of_thwaites_known_flows) {
  // A flat plate in a stream 1 - x begins with U = 1; speed 0 at the leading edge is no part of it.
  const auto retarded = thwaites_separation(speeds(4000, [](double x) { return 1 - x; }), 1.0 / 4000, 1e-6);
  ASSERT_TRUE(retarded);
  EXPECT_NEAR(*retarded, 0.123, 0.001);
  const auto cylinder =
      thwaites_separation(speeds(4000, [](double x) { return 2 * std::sin(pi * x); }), pi / 4000, 1e-6);
  ASSERT_TRUE(cylinder);
  EXPECT_NEAR(*cylinder * 180 / pi, 103.1, 0.3);
}

TEST(Separation, does_not_depend_on_viscosity_or_scale) {
  const auto speed = [](double x) { return std::sin(pi * x); };
  const double here = *thwaites_separation(speeds(500, speed), pi / 500, 1e-6);
  EXPECT_NEAR(*thwaites_separation(speeds(500, [&](double x) { return 7 * speed(x); }), pi / 500, 1e-4), here, 1e-12);
}

TEST(Separation, never_where_the_stream_quickens) {
  EXPECT_FALSE(thwaites_separation(speeds(100, [](double x) { return x; }), 0.01, 1e-6));
  EXPECT_FALSE(thwaites_separation(std::vector<double>(100, 0.0), 0.01, 1e-6));
}

TEST(Separation, is_found_from_the_pressure_in_cut_cells) {
  Params params;
  params.density = 1000, params.viscosity = 1e-6;
  for (const int cells : {18, 40}) {
    const Mesh m = pipe_in_box(cells);
    const std::vector<WallCell> wall = find_wall_cells(m);
    for (const double turned : {0.0, 0.2}) {
      State s = potential_pressure(m, turned, params.density);
      follow_separation(m, wall, params, 1e9, s);
      // A sector is 3 degrees, a cell of D/18 six.
      EXPECT_NEAR(s.separation.stagnation, turned, 6 * pi / 180) << cells;
      EXPECT_NEAR(s.separation.above * 180 / pi, 103, 9) << cells << ' ' << turned;
      EXPECT_NEAR(s.separation.below * 180 / pi, 103, 9) << cells << ' ' << turned;
    }
  }
}

TEST(Separation, comes_in_its_own_time) {
  Params params;
  const Mesh m = pipe_in_box(40);
  const std::vector<WallCell> wall = find_wall_cells(m);
  State s = potential_pressure(m, 0, params.density);
  follow_separation(m, wall, params, 1e-3, s);  // the water takes 0.5 s to pass the pipe at 2 m/s
  EXPECT_NEAR(s.separation.above, pi - 1e-3 / (separation_lag * 0.5) * (pi - 1.8), 1e-3);
  s.p.fill(3.0);  // water at rest says nothing new
  const Separation before = s.separation;
  follow_separation(m, wall, params, 1.0, s);
  EXPECT_EQ(s.separation.above, before.above);
}

TEST(Separation, holds_back_only_what_goes_on_behind_it) {
  const Separation s{0, 80 * pi / 180, 100 * pi / 180};
  const auto at = [](double degrees) { return Vec2{-std::cos(degrees * pi / 180), std::sin(degrees * pi / 180)}; };
  EXPECT_EQ(dead_water_friction(s, at(70), {1, 0}), 0);                      // before it
  EXPECT_DOUBLE_EQ(dead_water_friction(s, at(90), {2, 0}), 2 * dead_water);  // forward over the top
  EXPECT_EQ(dead_water_friction(s, at(90), {-2, 0}), 0);                     // back over the top
  EXPECT_EQ(dead_water_friction(s, at(-90), {2, 0}), 0);                     // not yet left under the bottom
  EXPECT_DOUBLE_EQ(dead_water_friction(s, at(-120), {2, 0}), 2 * dead_water);
  EXPECT_EQ(dead_water_friction({0, pi, pi}, at(179), {0, -1}), 0);  // never left
}

/// A pipe in a fast stream: the layer leaves near 80 degrees, and the drag is that of a pipe below its drag crisis, not
/// past it.  Measured is 1.2; a plane wake, which sheds in step along all of the pipe, drags more (Mittal and
/// Balachandar 1995, Phys. Fluids 7, 1841), and the box blocks a twelfth.
TEST(Separation, makes_the_drag_of_a_pipe_below_its_drag_crisis) {
  double drag[2];
  for (const bool laminar : {false, true}) {
    MeshParams grid;
    grid.length = 16, grid.height = 12, grid.cell_x = grid.cell_y = 0.05, grid.growth = 1.1;
    grid.fine_x_from = 5, grid.fine_x_to = 9, grid.fine_y_from = 5, grid.fine_y_to = 7;
    Params params;
    params.viscosity = 1.0 / 43500, params.closure = Closure::k_epsilon_realizable, params.mesh = grid;
    params.floor = Wall::slip, params.max_step = 0.1;
    params.pipe.diameter = 1, params.pipe.x = 6, params.pipe.y = 6;
    params.pipe.layer = laminar ? PipeLayer::laminar : PipeLayer::turbulent;
    const Mesh m = make_mesh(grid, params.pipe);
    Boundary b;
    b.floor = b.top = Wall::slip;
    b.inlet_u.assign(m.ny, 1.0), b.inlet_k.assign(m.ny, 1e-4), b.inlet_epsilon.assign(m.ny, 1e-5);
    Solver solver(params, m, b);
    solver.start();
    double sum = 0, time = 0;
    while (solver.state.time < 60) {
      const double dt = solver.step_limit();
      const StepReport report = solver.advance(dt);
      if (solver.state.time > 20) sum += dt * report.pipe_force.x, time += dt;
    }
    drag[laminar] = sum / time / (0.5 * params.density);
    if (laminar) {
      EXPECT_NEAR(solver.state.separation.above * 180 / pi, 82, 15);
      EXPECT_NEAR(solver.state.separation.below * 180 / pi, 82, 15);
    }
  }
  RecordProperty("drag_turbulent", std::to_string(drag[0]));
  RecordProperty("drag_laminar", std::to_string(drag[1]));
  EXPECT_LT(drag[0], 0.8);
  EXPECT_GT(drag[1], 1.1);
  EXPECT_LT(drag[1], 1.9);
}

}  // namespace
