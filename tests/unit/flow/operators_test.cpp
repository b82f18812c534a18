#include "flow/operators.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "flow/momentum.hpp"

namespace livebed::flow {
namespace {

Mesh graded_mesh() {
  MeshParams grid;
  grid.length = 1, grid.height = 0.7, grid.cell_x = 0.02, grid.cell_y = 0.03, grid.growth = 1.1;
  grid.fine_x_from = 0.3, grid.fine_x_to = 0.5, grid.fine_y_from = 0.1, grid.fine_y_to = 0.3;
  PipeParams pipe;
  pipe.present = false;
  return make_mesh(grid, pipe);
}

/// Every node of a place, ghosts included, from f(x, y).
template <class F>
base::Field sample(const Mesh& m, const Staggering& at, F&& f) {
  base::Field out(m.nx, m.ny);
  for (int j = -1; j <= m.ny; ++j)
    for (int i = -1; i <= m.nx; ++i) {
      const double x = at.shift_x ? (i < 0 ? -m.x[1] : m.x[i]) : m.centre_x(i);
      const double y = at.shift_y ? (j < 0 ? -m.y[1] : m.y[j]) : m.centre_y(j);
      out(i, j) = f(x, y);
    }
  for (int i = -2; i < m.nx + 2; ++i) out(i, -2) = out(i, -1), out(i, m.ny + 1) = out(i, m.ny);
  for (int j = -2; j < m.ny + 2; ++j) out(-2, j) = out(-1, j), out(m.nx + 1, j) = out(m.nx, j);
  return out;
}

FaceFlow uniform_flow(const Mesh& m, double u, double v) {
  const base::Field f(m.nx, m.ny);
  FaceFlow flow{f, f, f, f};
  flow.u.fill(u), flow.v.fill(v);
  for (int j = -2; j < m.ny + 2; ++j)
    for (int i = -2; i < m.nx + 2; ++i) flow.qx(i, j) = u * m.dy(j), flow.qy(i, j) = v * m.dx(i);
  return flow;
}

class Convect : public ::testing::TestWithParam<std::tuple<Convection, int, double, double>> {};

TEST_P(Convect, a_line_is_carried_exactly) {
  const auto [scheme, place, u, v] = GetParam();
  const Mesh m = graded_mesh();
  const Staggering at = place == 0   ? Staggering::centres(m)
                        : place == 1 ? Staggering::west_faces(m)
                                     : Staggering::south_faces(m);
  const base::Field phi = sample(m, at, [](double x, double y) { return 3 + 2 * x - 5 * y; });
  const base::Field rate(m.nx, m.ny), gamma(m.nx, m.ny, 2, 1.0);  // gamma so large that hybrid is central
  base::Field out(m.nx, m.ny);
  RowScratch scratch(m);
  convect(m, at, scheme, uniform_flow(m, u, v), phi, rate, gamma, 1e-3, scratch, out);
  const double exact = -(2 * u - 5 * v);
  for (int j = at.j0 + 2; j < at.j1 - 2; ++j)
    for (int i = at.i0 + 2; i < at.i1 - 2; ++i) {
      // Faces between unequal cells are not in the middle of the nodes: central weights and slopes know that.
      const double volume = at.width[i + 2] * at.height[j + 2];
      ASSERT_NEAR(out(i, j) / volume, exact, 1e-9) << i << "," << j;
    }
}

INSTANTIATE_TEST_SUITE_P(places, Convect,
                         ::testing::Combine(::testing::Values(Convection::bounded, Convection::hybrid),
                                            ::testing::Values(0, 1, 2), ::testing::Values(0.8, -0.8),
                                            ::testing::Values(0.3, -0.3)));

TEST(convect, moves_but_never_makes) {
  // Sum over all volumes = what passes the rim.
  const Mesh m = graded_mesh();
  const Staggering at = Staggering::centres(m);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(0, 1);
  base::Field phi(m.nx, m.ny);
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) phi(i, j) = value(random);
  FaceFlow flow = uniform_flow(m, 1, -0.5);
  for (int j = -2; j < m.ny + 2; ++j) flow.qx(0, j) = flow.qx(m.nx, j) = 0;  // a closed box
  for (int i = -2; i < m.nx + 2; ++i) flow.qy(i, 0) = flow.qy(i, m.ny) = 0;
  const base::Field rate(m.nx, m.ny), gamma(m.nx, m.ny);
  base::Field out(m.nx, m.ny);
  RowScratch scratch(m);
  for (Convection scheme : {Convection::bounded, Convection::hybrid}) {
    convect(m, at, scheme, flow, phi, rate, gamma, 1e-3, scratch, out);
    double sum = 0, size = 0;
    for (int j = 0; j < m.ny; ++j)
      for (int i = 0; i < m.nx; ++i) sum += out(i, j), size += std::abs(out(i, j));
    EXPECT_GT(size, 0.1);
    EXPECT_LT(std::abs(sum), 1e-13 * size);
  }
}

TEST(solve_lines, invert_their_own_matrices) {
  const Mesh m = graded_mesh();
  const Staggering at = Staggering::west_faces(m);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> value(0, 1);
  base::Field base_factor(m.nx, m.ny, 2, 1.0), conductance(m.nx, m.ny), given(m.nx, m.ny), scratch(m.nx, m.ny);
  for (int j = 0; j <= m.ny; ++j)
    for (int i = 0; i <= m.nx; ++i) {
      conductance(i, j) = value(random);
      if (i < m.nx && j < m.ny) base_factor(i, j) = 1 + value(random), given(i, j) = value(random) - 0.5;
    }
  const double dt = 0.01;
  for (bool along_x : {true, false}) {
    base::Field phi = given;
    if (along_x)
      solve_lines_x(at, base_factor, conductance, dt, phi, scratch);
    else
      solve_lines_y(at, base_factor, conductance, dt, phi, scratch);
    for (int j = at.j0; j < at.j1; ++j)
      for (int i = at.i0; i < at.i1; ++i) {
        const double scale = dt / at.inertia(i, j);
        const double before = scale * conductance(i, j),
                     after = scale * (along_x ? conductance(i + 1, j) : conductance(i, j + 1));
        const bool first = along_x ? i == at.i0 : j == at.j0, last = along_x ? i == at.i1 - 1 : j == at.j1 - 1;
        const double left = first ? 0 : along_x ? phi(i - 1, j) : phi(i, j - 1);
        const double right = last ? 0 : along_x ? phi(i + 1, j) : phi(i, j + 1);
        ASSERT_NEAR((base_factor(i, j) + before + after) * phi(i, j) - before * left - after * right, given(i, j),
                    1e-12)
            << i << "," << j;
      }
  }
}

TEST(center_face_flow, goes_half_a_step_ahead_of_the_last_two_levels) {
  const Mesh m = graded_mesh();
  State s;
  const base::Field f(m.nx, m.ny);
  s.u = s.v = s.u_old = s.v_old = f;
  s.u.fill(3), s.u_old.fill(1), s.v.fill(-1), s.v_old.fill(-2);
  s.step = 0.1;
  FaceFlow face{f, f, f, f};
  center_face_flow(m, s, 0.2, face);  // twice the step before: ahead by the whole difference
  EXPECT_NEAR(face.u(3, 4), 5, 1e-14);
  EXPECT_NEAR(face.v(3, 4), 0, 1e-14);
  EXPECT_NEAR(face.qx(3, 4), 5 * m.dy(4), 1e-14);
  s.step = 0;  // the first step knows one level
  center_face_flow(m, s, 0.2, face);
  EXPECT_NEAR(face.u(3, 4), 3, 1e-14);
}

}  // namespace
}  // namespace livebed::flow
