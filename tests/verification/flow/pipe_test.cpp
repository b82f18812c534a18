#include "flow/pipe.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/loops.hpp"
#include "flow/advance.hpp"
#include "flow/constants.hpp"

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
