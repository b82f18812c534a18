#include "flow/pressure.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <tuple>

#include "base/loops.hpp"
#include "base/math.hpp"
#include "flow/mesh.hpp"

namespace livebed::flow {
namespace {

struct System {
  Mesh mesh;
  base::Field c_x, c_y, c_boundary, exact, b;
};

/// The pressure system of a mesh with a pipe; outlet: p = 0 on the east side, otherwise the pressure floats.
System make_system(const MeshParams& grid, const PipeParams& pipe, bool outlet) {
  System s{make_mesh(grid, pipe), {}, {}, {}, {}, {}};
  const Mesh& m = s.mesh;
  s.c_x = s.c_y = s.c_boundary = s.exact = s.b = base::Field(m.nx, m.ny);
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      if (i > 0) s.c_x(i, j) = m.aperture_x(i, j) * m.dy(j) / m.dx_face(i);
      if (j > 0) s.c_y(i, j) = m.aperture_y(i, j) * m.dx(i) / m.dy_face(j);
      if (outlet && i == m.nx - 1) s.c_boundary(i, j) = m.dy(j) / (0.5 * m.dx(i));
      if (m.volume(i, j) > 0)
        s.exact(i, j) = std::cos(3 * m.centre_x(i) / m.length()) * std::sin(2 * m.centre_y(j) / m.height()) +
                        0.1 * ((i * 7 + j * 3) % 5);
    }
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      double sum = s.c_boundary(i, j) * s.exact(i, j);
      if (i > 0) sum += s.c_x(i, j) * (s.exact(i, j) - s.exact(i - 1, j));
      if (i + 1 < m.nx) sum += s.c_x(i + 1, j) * (s.exact(i, j) - s.exact(i + 1, j));
      if (j > 0) sum += s.c_y(i, j) * (s.exact(i, j) - s.exact(i, j - 1));
      if (j + 1 < m.ny) sum += s.c_y(i, j + 1) * (s.exact(i, j) - s.exact(i, j + 1));
      s.b(i, j) = sum;
    }
  return s;
}

PipeParams pipe_at(double x, double y, double d) {
  PipeParams p;
  p.present = d > 0;
  p.diameter = d, p.x = x, p.y = y;
  return p;
}

struct Shape {
  const char* name;
  double length, height, cell_x, cell_y, growth, pipe_d;
  bool outlet;
};

class PressureShapes : public ::testing::TestWithParam<Shape> {};

TEST_P(PressureShapes, recovers_a_known_pressure_in_few_iterations) {
  const Shape shape = GetParam();
  MeshParams grid;
  grid.length = shape.length, grid.height = shape.height, grid.cell_x = shape.cell_x, grid.cell_y = shape.cell_y;
  grid.growth = shape.growth;
  grid.fine_x_from = 0.3 * shape.length, grid.fine_x_to = 0.6 * shape.length;
  grid.fine_y_from = 0, grid.fine_y_to = 0.4 * shape.height;
  System s = make_system(grid, pipe_at(0.4131 * shape.length, 0.37 * shape.height, shape.pipe_d), shape.outlet);
  const Mesh& m = s.mesh;
  PressureSolver solver(m.nx, m.ny);
  solver.set_coefficients(s.c_x, s.c_y, s.c_boundary);
  base::Field p(m.nx, m.ny);
  const SolveReport report = solver.solve(p, s.b, 1e-12, 60);
  EXPECT_LE(report.iterations, 32) << m.nx << " x " << m.ny;
  double mean_exact = 0, mean = 0, cells = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i)
      if (m.volume(i, j) > 0) mean_exact += s.exact(i, j), mean += p(i, j), cells += 1;
  const double shift = shape.outlet ? 0.0 : (mean_exact - mean) / cells;
  double worst = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i)
      if (m.volume(i, j) > 0) worst = std::max(worst, std::abs(p(i, j) + shift - s.exact(i, j)));
  EXPECT_LT(worst, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(meshes, PressureShapes,
                         ::testing::Values(Shape{"plain", 1, 0.5, 0.02, 0.02, 1, 0, true},
                                           Shape{"floating", 1, 0.5, 0.02, 0.02, 1, 0, false},
                                           Shape{"pipe", 1, 0.4, 0.01, 0.01, 1, 0.1, true},
                                           Shape{"floating_pipe", 1, 0.4, 0.01, 0.01, 1, 0.1, false},
                                           Shape{"stretched", 3, 0.4, 0.01, 0.004, 1.1, 0.1, true},
                                           Shape{"thin", 2, 0.1, 0.005, 0.0005, 1, 0.03, true},
                                           Shape{"odd_halves", 1, 0.3, 0.0135, 0.01, 1, 0.07, true},
                                           Shape{"large", 1.5, 0.175, 0.0025, 0.001, 1, 0.05, true}),
                         [](const auto& shape) { return shape.param.name; });

/// Cells a hundred times as wide as high, or very many along x: stiff lines, and long waves that single precision
/// cannot hold.
TEST(pressure, solves_on_flat_cells_and_in_long_boxes) {
  for (bool outlet : {true, false})
    for (const auto& [nx, ny, cell_x, cell_y] :
         {std::tuple{80, 100, 0.05, 5e-4}, {80, 100, 0.05, 5e-5}, {2000, 200, 1e-3, 5e-4}}) {
      MeshParams grid;
      grid.length = nx * cell_x, grid.height = ny * cell_y, grid.cell_x = cell_x, grid.cell_y = cell_y;
      System s = make_system(grid, PipeParams{.present = false}, outlet);
      PressureSolver solver(s.mesh.nx, s.mesh.ny);
      solver.set_coefficients(s.c_x, s.c_y, s.c_boundary);
      base::Field p(s.mesh.nx, s.mesh.ny);
      const SolveReport report = solver.solve(p, s.b, 1e-6, 60);
      EXPECT_LE(report.iterations, 16) << outlet << " " << nx << " " << cell_y;
      EXPECT_LE(report.relative(), 1e-6) << outlet << " " << nx << " " << cell_y;
      EXPECT_GT(report.iterations, 0);
    }
}

TEST(pressure, same_bits_for_any_number_of_threads) {
  MeshParams grid;
  grid.length = 1.5, grid.height = 0.35, grid.cell_x = 0.0025, grid.cell_y = 0.0025;
  System s = make_system(grid, pipe_at(0.5, 0.1, 0.05), true);
  base::Field first(s.mesh.nx, s.mesh.ny), second = first;
  for (int threads : {1, 2}) {
    base::set_threads(threads);
    PressureSolver solver(s.mesh.nx, s.mesh.ny);
    solver.set_coefficients(s.c_x, s.c_y, s.c_boundary);
    solver.solve(threads == 1 ? first : second, s.b, 1e-6, 60);
  }
  base::set_threads(1);
  for (int j = 0; j < s.mesh.ny; ++j)
    for (int i = 0; i < s.mesh.nx; ++i) ASSERT_EQ(first(i, j), second(i, j)) << i << "," << j;
}

}  // namespace
}  // namespace livebed::flow
