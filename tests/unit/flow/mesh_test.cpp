#include "flow/mesh.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "base/math.hpp"
#include "flow/pipe.hpp"
#include "flow/staggering.hpp"

namespace livebed::flow {
namespace {

TEST(stretched_faces, are_equal_without_growth) {
  const std::vector<double> x = stretched_faces(2, 0.1, 1, 0, 0);
  ASSERT_EQ(x.size(), 21u);
  for (int i = 0; i <= 20; ++i) EXPECT_NEAR(x[i], 0.1 * i, 1e-14);
}

TEST(stretched_faces, fill_the_length_with_cells_that_grow_outside_the_window) {
  const double growth = 1.1, h = 0.01;
  const std::vector<double> x = stretched_faces(3, h, growth, 1, 1.5);
  const int n = static_cast<int>(x.size()) - 1;
  EXPECT_EQ(n % 2, 0);  // the pressure solver halves it
  EXPECT_EQ(x.front(), 0.0);
  EXPECT_EQ(x.back(), 3.0);
  for (int i = 1; i < n; ++i) {
    const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
    EXPECT_GT(before, 0);
    EXPECT_LT(std::max(before, after) / std::min(before, after), 1.02 * growth) << i;
    if (x[i - 1] > 1 && x[i + 1] < 1.5) {
      EXPECT_NEAR(after, h, 0.02 * h);
    }
  }
  EXPECT_GT(x[1] - x[0], 5 * h);
}

TEST(stretched_faces, refuse_what_is_no_grid) {
  for (const auto [length, h, growth] : {std::array{-1.0, 0.1, 1.0}, {1.0, 0.0, 1.0}, {1.0, 0.1, 0.9}}) {
    try {
      stretched_faces(length, h, growth, 0, 0);
      ADD_FAILURE() << length << " " << h << " " << growth;
    } catch (const base::Fault& fault) {
      EXPECT_EQ(fault.code(), base::Exit::invalid_case);
    }
  }
}

Mesh mesh_with_pipe(double x, double y, double d, double growth = 1) {
  MeshParams grid;
  grid.length = 1, grid.height = 0.6, grid.cell_x = 0.02, grid.cell_y = 0.015, grid.growth = growth;
  grid.fine_x_from = 0.3, grid.fine_x_to = 0.6, grid.fine_y_from = 0.1, grid.fine_y_to = 0.4;
  PipeParams pipe;
  pipe.diameter = d, pipe.x = x, pipe.y = y;
  return make_mesh(grid, pipe);
}

TEST(mesh, distances_fit_the_faces) {
  const Mesh m = mesh_with_pipe(0.4, 0.3, 0.1, 1.1);
  for (int i = 0; i < m.nx; ++i) {
    EXPECT_NEAR(m.dx(i), m.x[i + 1] - m.x[i], 1e-15);
    EXPECT_NEAR(m.centre_x(i), 0.5 * (m.x[i + 1] + m.x[i]), 1e-15);
    EXPECT_NEAR(m.dx_face(i), m.centre_x(i) - m.centre_x(i - 1), 1e-15);
  }
  for (int j = 0; j < m.ny; ++j) EXPECT_NEAR(m.dy_face(j), m.centre_y(j) - m.centre_y(j - 1), 1e-15);
  EXPECT_NEAR(m.centre_x(-1), -m.centre_x(0), 1e-15);
  EXPECT_NEAR(m.centre_y(m.ny) - m.height(), m.height() - m.centre_y(m.ny - 1), 1e-15);
}

TEST(circle_in_rectangle, has_the_closed_areas) {
  using base::pi;
  EXPECT_NEAR(circle_in_rectangle(-2, 2, -2, 2, 1), pi, 1e-14);
  EXPECT_NEAR(circle_in_rectangle(0, 2, 0, 2, 1), pi / 4, 1e-14);
  EXPECT_NEAR(circle_in_rectangle(-0.5, 0.5, -0.5, 0.5, 1), 1, 1e-14);
  EXPECT_NEAR(circle_in_rectangle(1, 2, -1, 1, 1), 0, 1e-14);
  // Segment beyond x = 1/2: pi/3 - sqrt(3)/4.
  EXPECT_NEAR(circle_in_rectangle(0.5, 2, -2, 2, 1), pi / 3 - std::sqrt(3.0) / 4, 1e-14);
}

struct Place {
  const char* name;
  double x, y, d, growth;
};

class CutPipe : public ::testing::TestWithParam<Place> {};

TEST_P(CutPipe, has_the_area_and_closed_surface_of_a_circle) {
  const Place place = GetParam();
  const Mesh m = mesh_with_pipe(place.x, place.y, place.d, place.growth);
  double area = 0, length = 0;
  base::Vec2 sum;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      EXPECT_GE(m.volume(i, j), 0);
      EXPECT_LE(m.volume(i, j), 1);
      area += (1 - m.volume(i, j)) * m.dx(i) * m.dy(j);
      length += m.wall_length(i, j);
      sum.x += wall_vector(m, i, j).x, sum.y += wall_vector(m, i, j).y;
      if (m.volume(i, j) == 0) {
        EXPECT_EQ(m.aperture_x(i, j) + m.aperture_x(i + 1, j) + m.aperture_y(i, j) + m.aperture_y(i, j + 1), 0);
      }
      if (m.wall_length(i, j) > 0) {
        EXPECT_GE(m.wall_distance(i, j), 0.25 * std::min(m.dx(i), m.dy(j)));
      }
    }
  const double circle = 0.25 * base::pi * base::square(place.d);
  EXPECT_NEAR(area / circle, 1, 1e-4);
  EXPECT_NEAR(length / (base::pi * place.d), 1, 0.01);  // chords are shorter than arcs
  EXPECT_NEAR(sum.x, 0, 1e-14);
  EXPECT_NEAR(sum.y, 0, 1e-14);
}

TEST_P(CutPipe, without_slivers_is_a_little_larger) {
  const Place place = GetParam();
  const Mesh all = mesh_with_pipe(place.x, place.y, place.d, place.growth);
  PipeParams pipe = all.pipe;
  pipe.least_open = volume_least_among_grains;
  const Mesh m = make_mesh(all.x, all.y, pipe);
  int closed = 0;
  double area = 0, length = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      closed += m.volume(i, j) == 0 && all.volume(i, j) > 0;
      EXPECT_EQ(m.volume(i, j), all.volume(i, j) < pipe.least_open ? 0 : all.volume(i, j));
      area += (1 - m.volume(i, j)) * m.dx(i) * m.dy(j);
      length += m.wall_length(i, j);
    }
  const double circle = 0.25 * base::pi * base::square(place.d);
  EXPECT_GT(closed, 0);
  EXPECT_GT(area / circle, 1);
  EXPECT_LT(area / circle, 1.002);
  EXPECT_NEAR(length / (base::pi * place.d), 0.98, 0.03);
}

INSTANTIATE_TEST_SUITE_P(places, CutPipe,
                         ::testing::Values(Place{"on_the_grid", 0.4, 0.3, 0.2, 1},
                                           Place{"off_the_grid", 0.40713, 0.29871, 0.2, 1},
                                           Place{"touching_the_floor", 0.4137, 0.1, 0.2, 1},
                                           Place{"stretched", 0.4137, 0.2, 0.21, 1.1}),
                         [](const auto& place) { return place.param.name; });

TEST(cut_pipe, half_below_the_floor_leaves_half_a_circle) {
  const Mesh m = mesh_with_pipe(0.4137, 0.0, 0.2);
  double area = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) area += (1 - m.volume(i, j)) * m.dx(i) * m.dy(j);
  EXPECT_NEAR(area / (0.125 * base::pi * 0.04), 1, 1e-4);
}

TEST(staggering, covers_the_open_area_and_lets_water_balance) {
  const Mesh m = mesh_with_pipe(0.40713, 0.29871, 0.2, 1.1);
  const Staggering u = Staggering::west_faces(m), c = Staggering::centres(m);
  double open = 0, at_u = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      open += m.volume(i, j) * m.dx(i) * m.dy(j);
      EXPECT_NEAR(c.volume(i, j), m.volume(i, j) * m.dx(i) * m.dy(j), 1e-15);
      EXPECT_NEAR(c.area_x(i, j), m.aperture_x(i, j) * m.dy(j), 1e-15);
      // Between two whole faces the mean of both cells, towards a closed one nothing: its wall has that friction.
      const double here = m.aperture_x(i, j), below = m.aperture_x(i, j - 1);
      const double mean = 0.5 * (m.aperture_y(i - 1, j) + m.aperture_y(i, j)) * m.dx_face(i);
      if (here <= 0 || below <= 0) {
        EXPECT_EQ(u.area_y(i, j), 0);
      } else if (here >= 1 && below >= 1) {
        EXPECT_NEAR(u.area_y(i, j), mean, 1e-15);
      } else {  // open parts of cut faces are nearer or, where both are cut, not much further apart
        EXPECT_GE(u.area_y(i, j), 0.9 * mean);
        EXPECT_LE(u.area_y(i, j), 2.0001 * mean);
      }
      EXPECT_NEAR(u.open(i, j) * u.whole(i, j), m.aperture_x(i, j) * m.dx_face(i) * m.dy(j), 1e-15);
      EXPECT_GE(u.inertia(i, j), u.volume(i, j));
      EXPECT_GT(c.inertia(i, j), 0);
    }
  for (int j = 0; j < m.ny; ++j) {
    for (int i = 1; i < m.nx; ++i) at_u += u.volume(i, j);
    at_u += 0.5 * (m.dx(0) + m.dx(m.nx - 1)) * m.dy(j);  // the halves at both ends
  }
  EXPECT_NEAR(at_u, open, 1e-12);
}

TEST(share_wall, gives_all_of_the_surface_to_open_faces) {
  const Mesh m = mesh_with_pipe(0.40713, 0.29871, 0.2, 1.1);
  double length = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) length += m.wall_length(i, j);
  for (bool west : {true, false}) {
    double shared = 0;
    for (const WallPart& part : share_wall(m, west)) {
      EXPECT_GT((west ? m.aperture_x : m.aperture_y)(part.i, part.j), 0);
      EXPECT_GT(part.distance, 0);
      EXPECT_LT(part.distance, 1.5 * std::max(m.dx(part.i), m.dy(part.j)));
      shared += part.length;
    }
    EXPECT_NEAR(shared / length, 1, 0.01);  // cells with neither face open keep theirs to themselves
  }
}

TEST(hand_on, leaves_nothing_in_closed_volumes) {
  const Mesh m = mesh_with_pipe(0.40713, 0.29871, 0.2, 1.1);
  for (bool west : {true, false}) {
    const base::Field& aperture = west ? m.aperture_x : m.aperture_y;
    base::Field shares(m.nx, m.ny);
    for (const HandedOn& h : hand_on(m, west)) {
      EXPECT_EQ(aperture(h.from_i, h.from_j), 0);
      EXPECT_GT(aperture(h.to_i, h.to_j), 0);
      EXPECT_EQ(std::abs(h.to_i - h.from_i) + std::abs(h.to_j - h.from_j), 1);
      shares(h.from_i, h.from_j) += h.share;
    }
    int closed = 0;
    for (int j = 0; j < m.ny; ++j)
      for (int i = 0; i < m.nx; ++i)
        if (shares(i, j) > 0) {
          EXPECT_NEAR(shares(i, j), 1, 1e-14);
          ++closed;
        }
    EXPECT_GT(closed, 10);
  }
}

}  // namespace
}  // namespace livebed::flow
