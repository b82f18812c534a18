#include "flow/mapping.hpp"

#include <gtest/gtest.h>

#include "flow/constants.hpp"

namespace livebed::flow {
namespace {

Solver channel(double cell, bool pipe) {
  Params p;
  p.mesh.length = 0.6, p.mesh.height = 0.2, p.mesh.cell_x = p.mesh.cell_y = cell;
  p.pipe.present = pipe, p.pipe.x = 0.25, p.pipe.y = 0.1;
  p.floor = Wall::smooth;
  p.current.profile = Profile::smooth, p.current.shear_velocity = 0.01;
  const Mesh m = make_mesh(p.mesh, p.pipe);
  Solver flow(p, m, make_boundary(m, p));
  flow.start();
  return flow;
}

TEST(map_flow, to_the_same_grid_changes_nothing_inside) {
  Solver from = channel(0.01, true), to = channel(0.01, true);
  for (int k = 0; k < 5; ++k) from.advance(from.step_limit());
  map_flow(from, to);
  const Mesh& m = from.mesh();
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      ASSERT_NEAR(to.state.u(i, j), from.state.u(i, j), 1e-14);
      ASSERT_NEAR(to.state.v(i, j), from.state.v(i, j), 1e-14);
      ASSERT_NEAR(to.state.p(i, j), from.state.p(i, j), 1e-11);
      const double k = m.volume(i, j) > 0 ? from.state.k(i, j) : k_floor;
      ASSERT_NEAR(to.state.k(i, j), k, 1e-15);
    }
  EXPECT_EQ(to.state.step, 0);  // nothing is known of the step before
}

TEST(map_flow, is_linear_between_the_cells_and_leaves_closed_faces_at_rest) {
  Solver from = channel(0.01, false), to = channel(0.004, true);
  const Mesh &a = from.mesh(), &b = to.mesh();
  for (int j = 0; j < a.ny; ++j)
    for (int i = 0; i <= a.nx; ++i) from.state.u(i, j) = 1 + 2 * a.x[i] - 3 * a.centre_y(j);
  map_flow(from, to);
  for (int j = 2; j < b.ny - 2; ++j)
    for (int i = 1; i < b.nx; ++i) {
      const double exact = 1 + 2 * b.x[i] - 3 * b.centre_y(j);
      ASSERT_NEAR(to.state.u(i, j), b.aperture_x(i, j) > 0 ? exact : 0.0, 1e-12) << i << "," << j;
    }
}

}  // namespace
}  // namespace livebed::flow
