#include "run/shear.hpp"

#include <gtest/gtest.h>

#include "case/read.hpp"

namespace livebed::run {
namespace {

/// Water over a bed of half the box, u = speed + rate y, v = down everywhere, viscosity nu + nut.
flow::Solver sheared(const casefile::Case& c, double speed, double rate, double down, double nut) {
  const flow::Mesh mesh = flow::make_mesh(c.flow.mesh, c.flow.pipe);
  flow::Solver solver(c.flow, mesh, flow::make_boundary(mesh, c.flow));
  flow::State& s = solver.state;
  for (int j = 0; j < mesh.ny; ++j)
    for (int i = 0; i <= mesh.nx; ++i) s.u(i, j) = speed + rate * (mesh.y[j] + 0.5 * mesh.dy(j));
  for (int j = 0; j <= mesh.ny; ++j)
    for (int i = 0; i < mesh.nx; ++i) s.v(i, j) = down;
  s.nut.fill(nut);
  return solver;
}

casefile::Case case_with(bool pipe) {
  return casefile::read_text(
      "preset = \"livebed\"\n[mesh]\nlength = 0.6\nheight = 0.2\ncell_x = 0.005\ncell_y = 0.005\n[current]\ntheta = "
      "0.3\n"
      "[bed]\nthickness = 0.1\n[grains]\ndiameter = 2e-3\n[time]\nend = 1\n",
      "sheared", {std::string("pipe.present=") + (pipe ? "true" : "false")});
}

TEST(shear, measured_before_a_pipe_beside_what_the_mean_flow_carries) {
  const casefile::Case c = case_with(true);
  const double rate = 20, nut = 1e-4, stress = 1000 * (c.flow.viscosity + nut) * rate;
  const double theta = stress / (1650 * c.grains.gravity * 2e-3);
  EXPECT_NEAR(measured_shields(c, sheared(c, 0.5, rate, 0, nut), 0.1), theta, 1e-9);
  EXPECT_NEAR(measured_shields(c, sheared(c, 0.5, rate, -0.05, nut), 0.1), theta, 1e-9);
}

TEST(shear, measured_without_a_pipe_counts_all_that_is_carried_down) {
  const casefile::Case c = case_with(false);
  const double rate = 20, nut = 1e-4, down = 1e-4, speed = 0.5 + rate * 0.1;
  const double stress = 1000 * ((c.flow.viscosity + nut) * rate + speed * down);
  EXPECT_NEAR(measured_shields(c, sheared(c, 0.5, rate, -down, nut), 0.1), stress / (1650 * c.grains.gravity * 2e-3),
              1e-9);
}

}  // namespace
}  // namespace livebed::run
