#include "flow/pipe.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/loops.hpp"
#include "flow/advance.hpp"
#include "flow/constants.hpp"
#include "flow/momentum_balance.hpp"
#include "laminar.hpp"

/// Mass, momentum and bits of turbulent flow past a pipe wherever it lies.
namespace livebed::flow {
namespace {

/// A current over a rough floor past a pipe of 0.05 m on a grid of 5 mm.
Params current_past_pipe(double x, double y) {
  Params p;
  p.mesh.length = 0.6, p.mesh.height = 0.2, p.mesh.cell_x = p.mesh.cell_y = 0.005;
  p.pipe.diameter = 0.05, p.pipe.x = x, p.pipe.y = y, p.pipe.wall = Wall::smooth;
  p.floor = Wall::rough, p.floor_roughness = 0.001;
  p.current.profile = Profile::rough, p.current.roughness = 0.001, p.current.shear_velocity = 0.04;
  p.pressure_tolerance = 1e-8;
  return p;
}

Solver make_solver(const Params& p) {
  const Mesh m = make_mesh(p.mesh, p.pipe);
  Solver flow(p, m, make_boundary(m, p));
  flow.start();
  return flow;
}

double inflow(const Solver& flow, int i) {
  const Mesh& m = flow.mesh();
  double q = 0;
  for (int j = 0; j < m.ny; ++j) q += m.aperture_x(i, j) * flow.state.u(i, j) * m.dy(j);
  return q;
}

/// Largest net outflow of a cell over the inflow of the box.
double worst_outflow(const Solver& flow) {
  const Mesh& m = flow.mesh();
  const State& s = flow.state;
  double worst = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i)
      worst = std::max(worst,
                       std::abs((m.aperture_x(i + 1, j) * s.u(i + 1, j) - m.aperture_x(i, j) * s.u(i, j)) * m.dy(j) +
                                (m.aperture_y(i, j + 1) * s.v(i, j + 1) - m.aperture_y(i, j) * s.v(i, j)) * m.dx(i)));
  return worst / inflow(flow, 0);
}

struct Place {
  const char* name;
  double x, y;
  int steps;
};

class PipePlaces : public ::testing::TestWithParam<Place> {};

TEST_P(PipePlaces, lose_no_water) {
  const Place place = GetParam();
  Solver flow = make_solver(current_past_pipe(place.x, place.y));
  const double in = inflow(flow, 0);
  double worst_mass = 0, worst_cell = 0, early = 0, late = 0, worst_through = 0;
  for (int step = 0; step < place.steps; ++step) {
    const StepReport report = flow.advance(flow.step_limit());
    worst_mass = std::max(worst_mass, report.mass_residual);
    worst_cell = std::max(worst_cell, worst_outflow(flow));
    worst_through = std::max(worst_through, std::abs(inflow(flow, flow.mesh().nx) / in - 1));
    if (step < place.steps / 10) early = std::max(early, worst_outflow(flow));
    if (step >= place.steps - place.steps / 10) late = std::max(late, worst_outflow(flow));
  }
  EXPECT_EQ(flow.find_fault(), "");
  EXPECT_LT(worst_mass, 1e-5);     // the solver's tolerance is on the pressure's residual, 1e-8
  EXPECT_LT(worst_cell, 1e-7);     // of the whole inflow, in any cell
  EXPECT_LT(worst_through, 1e-7);  // what goes in comes out
  EXPECT_LT(late, 10 * early + 1e-10);
  // The pipe is in the way: it is pushed downstream.
  EXPECT_GT(flow.pipe_force().x, 0.0);
  double k_least = 1, e_least = 1;
  for (int j = 0; j < flow.mesh().ny; ++j)
    for (int i = 0; i < flow.mesh().nx; ++i) {
      k_least = std::min(k_least, flow.state.k(i, j));
      e_least = std::min(e_least, flow.state.epsilon(i, j));
    }
  EXPECT_GE(k_least, k_floor);
  EXPECT_GE(e_least, epsilon_floor);
}

INSTANTIATE_TEST_SUITE_P(places, PipePlaces,
                         ::testing::Values(Place{"free", 0.2, 0.1, 1000}, Place{"touching_the_floor", 0.2, 0.025, 1000},
                                           Place{"gap_below_a_cell", 0.2013, 0.027, 300},
                                           Place{"off_the_grid", 0.2017, 0.0613, 300},
                                           Place{"half_below_the_floor", 0.2017, 0.0031, 300},
                                           Place{"sliver_gap", 0.2, 0.02501, 300}),
                         [](const auto& place) { return place.param.name; });

/// Steady drag on a pipe in a free laminar stream, Re 40, some cells off the grid, by the surface and by the momentum
/// of a box around it.
TEST(pipe_flow, surface_and_momentum_of_a_box_give_the_same_force) {
  for (double off : {0.0, 0.13, 0.27}) {
    const int cells = 12;  // a diameter
    Params p = laminar(16, 12, 1, 1, 1.0 / 40);
    p.density = 1;
    p.floor = Wall::slip;
    p.pressure_tolerance = 1e-6;
    p.mesh.cell_x = p.mesh.cell_y = 1.0 / cells, p.mesh.growth = 1.1;
    p.mesh.fine_x_from = 5, p.mesh.fine_x_to = 7.5, p.mesh.fine_y_from = 5, p.mesh.fine_y_to = 7;
    p.pipe.present = true, p.pipe.wall = Wall::no_slip;
    p.pipe.diameter = 1, p.pipe.x = 6 + off / cells, p.pipe.y = 6 + 0.7 * off / cells;
    p.current.profile = Profile::uniform, p.current.mean_speed = 1;
    Solver flow = make_solver(p);
    while (flow.state.time < 25) flow.advance(flow.step_limit());
    const double surface = flow.pipe_force().x,
                 box = momentum_inflow(p, flow.mesh(), flow.state, box_around_pipe(flow.mesh(), 1.2)).x;
    std::printf("drag coefficient by the surface %.4f, by the momentum of a box %.4f\n", 2 * surface, 2 * box);
    EXPECT_NEAR(surface / box, 1, 0.01);
    EXPECT_NEAR(2 * box, 1.73, 0.03);  // wherever the pipe lies; 1.5-1.58 without sides, which are 12 diameters apart
  }
}

TEST(pipe_flow, surface_and_box_agree_in_turbulent_flow) {
  for (Wall wall : {Wall::smooth, Wall::rough}) {
    Params p = current_past_pipe(0.2017, 0.0913);
    p.mesh.cell_x = p.mesh.cell_y = 0.0025;
    p.pressure_tolerance = 1e-6;
    p.pipe.wall = wall, p.pipe.roughness = 0.0005;
    Solver flow = make_solver(p);
    const Box box = box_around_pipe(flow.mesh(), 0.06);
    while (flow.state.time < 1.5) flow.advance(flow.step_limit());
    const double from = flow.state.time, inside = momentum_inside(p, flow.mesh(), flow.state, box).x;
    double surface = 0, through = 0;
    while (flow.state.time < 2.0) {
      const double dt = flow.step_limit();
      surface += dt * flow.advance(dt).pipe_force.x;
      through += dt * momentum_inflow(p, flow.mesh(), flow.state, box).x;
    }
    through -= momentum_inside(p, flow.mesh(), flow.state, box).x - inside;
    std::printf("turbulent: mean force on the surface %.4f N/m, from the box %.4f N/m\n",
                surface / (flow.state.time - from), through / (flow.state.time - from));
    EXPECT_NEAR(surface / through, 1, 0.01);
    EXPECT_GT(surface, 0);
  }
}

TEST(pipe_flow, same_bits_with_two_threads) {
  std::vector<Solver> runs;
  for (int threads : {1, 2}) {
    base::set_threads(threads);
    Solver flow = make_solver(current_past_pipe(0.2017, 0.0413));
    for (int step = 0; step < 3; ++step) flow.advance(flow.step_limit());
    runs.push_back(flow);
  }
  base::set_threads(1);
  const State &a = runs[0].state, &b = runs[1].state;
  EXPECT_EQ(a.u.storage(), b.u.storage());
  EXPECT_EQ(a.v.storage(), b.v.storage());
  EXPECT_EQ(a.p.storage(), b.p.storage());
  EXPECT_EQ(a.k.storage(), b.k.storage());
  EXPECT_EQ(a.epsilon.storage(), b.epsilon.storage());
}

TEST(pipe_flow, turbulence_stays_positive_in_a_violent_start) {
  Params p = current_past_pipe(0.2017, 0.0413);
  p.current.shear_velocity = 0.4;  // a jet of 10 m/s into water at rest
  const Mesh m = make_mesh(p.mesh, p.pipe);
  Solver flow(p, m, make_boundary(m, p));
  p.max_step = 1e-3;
  for (int step = 0; step < 300; ++step) {
    flow.advance(std::min(1e-3, flow.step_limit()));
    for (int j = 0; j < m.ny; ++j)
      for (int i = 0; i < m.nx; ++i) {
        ASSERT_GE(flow.state.k(i, j), k_floor);
        ASSERT_GE(flow.state.epsilon(i, j), epsilon_floor);
        ASSERT_LE(flow.state.nut(i, j), nut_over_nu_most * p.viscosity);
      }
    ASSERT_EQ(flow.find_fault(), "") << "step " << step;
  }
}

}  // namespace
}  // namespace livebed::flow
