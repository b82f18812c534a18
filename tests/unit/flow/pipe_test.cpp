#include "flow/pipe.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "base/math.hpp"

/// The circle on the grid, cell by cell; its sums over the whole grid are in mesh_test.cpp.
namespace livebed::flow {
namespace {

using base::square;

TEST(circle_in_rectangle, is_what_points_inside_say) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> corner(-1.4, 1.0), size(0.05, 1.5);
  constexpr int n = 400;
  for (int trial = 0; trial < 40; ++trial) {
    const double x0 = corner(random), y0 = corner(random), w = size(random), h = size(random);
    int inside = 0;
    for (int b = 0; b < n; ++b)
      for (int a = 0; a < n; ++a) inside += square(x0 + (a + 0.5) / n * w) + square(y0 + (b + 0.5) / n * h) < 1;
    const double area = circle_in_rectangle(x0, x0 + w, y0, y0 + h, 1);
    EXPECT_NEAR(area / (w * h), inside / static_cast<double>(n * n), 2e-3) << x0 << " " << y0 << " " << w << " " << h;
  }
}

TEST(circle_in_rectangle, is_the_sum_of_its_parts) {
  for (double split : {-0.9, -0.2, 0.0, 0.35, 1.0}) {
    const double whole = circle_in_rectangle(-1.1, 1.2, -0.7, 1.3, 1);
    EXPECT_NEAR(circle_in_rectangle(-1.1, split, -0.7, 1.3, 1) + circle_in_rectangle(split, 1.2, -0.7, 1.3, 1), whole,
                1e-14);
    EXPECT_NEAR(circle_in_rectangle(-1.1, 1.2, -0.7, split, 1) + circle_in_rectangle(-1.1, 1.2, split, 1.3, 1),
                split > -0.7 ? whole : whole + circle_in_rectangle(-1.1, 1.2, split, -0.7, 1), 1e-14);
  }
}

/// Cells of 0.1 x 0.1 in a box of 2 x 1, a pipe of radius 0.3.
Mesh mesh_with_pipe(double x, double y) {
  MeshParams grid;
  grid.length = 2, grid.height = 1, grid.cell_x = grid.cell_y = 0.1;
  PipeParams pipe;
  pipe.diameter = 0.6, pipe.x = x, pipe.y = y;
  return make_mesh(grid, pipe);
}

TEST(cut_pipe, opens_faces_by_the_length_outside_the_circle) {
  const Mesh m = mesh_with_pipe(1.0, 0.5);
  // The face x = 0.8, 0.2 before the centre: the circle covers sqrt(0.09 - 0.04) = 0.2236 to either side of the axis.
  const double chord = std::sqrt(0.05);
  for (int j = 0; j < m.ny; ++j) {
    const double low = std::max(m.y[j], 0.5 - chord), high = std::min(m.y[j + 1], 0.5 + chord);
    EXPECT_NEAR(m.aperture_x(8, j), 1 - std::max(0.0, high - low) / 0.1, 1e-12) << j;
  }
  EXPECT_NEAR(m.aperture_x(8, 2), 0.763932, 1e-6);
  // Mirror images about the centre, and x and y change places.
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      EXPECT_NEAR(m.volume(i, j), m.volume(m.nx - 1 - i, j), 1e-12);
      EXPECT_NEAR(m.volume(i, j), m.volume(i, m.ny - 1 - j), 1e-12);
      if (i >= 5 && i < 15) {
        EXPECT_NEAR(m.aperture_x(i, j), m.aperture_y(j + 5, i - 5), 1e-12) << i << "," << j;
      }
    }
}

TEST(cut_pipe, measures_the_distance_of_the_water) {
  const Mesh m = mesh_with_pipe(1.013, 0.487);
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      const double centre = std::hypot(m.centre_x(i) - 1.013, m.centre_y(j) - 0.487) - 0.3;
      const double volume = m.volume(i, j), distance = m.wall_distance(i, j);
      if (volume == 0 || volume == 1) {
        EXPECT_NEAR(distance, centre, 1e-14) << i << "," << j;
        EXPECT_EQ(m.wall_length(i, j), 0);
        continue;
      }
      EXPECT_GT(m.wall_length(i, j), 0);
      EXPECT_LE(m.wall_length(i, j), 0.1 * std::sqrt(2.0) + 1e-12);
      EXPECT_GE(distance, 0.025 - 1e-12) << i << "," << j;                 // a quarter of a cell
      EXPECT_GE(distance, centre - 0.002) << i << "," << j;                // water is the part further away
      EXPECT_LE(distance, std::max(centre, 0.0) + 0.05) << i << "," << j;  // not by more than half a cell
    }
}

TEST(wall_vector, points_from_the_pipe_into_the_water) {
  const Mesh m = mesh_with_pipe(1.013, 0.487);
  int pieces = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      const base::Vec2 wall = wall_vector(m, i, j);
      if (m.wall_length(i, j) == 0) {
        EXPECT_NEAR(base::norm(wall), 0, 1e-14);
        continue;
      }
      const double x = m.centre_x(i) - 1.013, y = m.centre_y(j) - 0.487;
      const double cosine = (wall.x * x + wall.y * y) / (base::norm(wall) * std::hypot(x, y));
      EXPECT_GT(cosine, 0.95) << i << "," << j;
      EXPECT_NEAR(base::norm(wall), m.wall_length(i, j), 1e-14);
      ++pieces;
    }
  EXPECT_GT(pieces, 20);
}

TEST(cut_pipe, leaves_everything_open_without_a_pipe) {
  MeshParams grid;
  grid.length = 2, grid.height = 1, grid.cell_x = grid.cell_y = 0.1;
  PipeParams none;
  none.present = false;
  const Mesh m = make_mesh(grid, none);
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      ASSERT_EQ(m.volume(i, j) + m.aperture_x(i, j) + m.aperture_y(i, j), 3.0);
      ASSERT_EQ(m.wall_length(i, j) + m.wall_distance(i, j), 0.0);
    }
}

}  // namespace
}  // namespace livebed::flow
