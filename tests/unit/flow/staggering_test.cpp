#include "flow/staggering.hpp"

#include <cmath>
#include <gtest/gtest.h>

/// Control volumes of the three staggerings; what the pipe does to them is in mesh_test.cpp, too.
namespace livebed::flow {
namespace {

Mesh stretched(bool pipe) {
  MeshParams grid;
  grid.length = 1, grid.height = 0.6, grid.cell_x = 0.02, grid.cell_y = 0.015, grid.growth = 1.15;
  grid.fine_x_from = 0.3, grid.fine_x_to = 0.6, grid.fine_y_from = 0.1, grid.fine_y_to = 0.4;
  PipeParams p;
  p.present = pipe;
  p.diameter = 0.2, p.x = 0.40713, p.y = 0.29871;
  return make_mesh(grid, p);
}

TEST(staggering, puts_nodes_on_centres_or_faces) {
  const Mesh m = stretched(false);
  const Staggering c = Staggering::centres(m), u = Staggering::west_faces(m), v = Staggering::south_faces(m);
  for (int i = 2; i < m.nx - 2; ++i) {
    EXPECT_NEAR(c.width[i + 2], m.dx(i), 1e-15);
    EXPECT_NEAR(c.hx[i + 2], m.dx_face(i), 1e-15);
    EXPECT_NEAR(u.width[i + 2], m.centre_x(i) - m.centre_x(i - 1), 1e-15);
    EXPECT_NEAR(u.hx[i + 2], m.x[i] - m.x[i - 1], 1e-15);
    for (const Staggering& at : {c, u, v}) {
      EXPECT_NEAR(at.to_west[i + 2] + at.from_west[i + 2], at.hx[i + 2], 1e-15);
      EXPECT_NEAR(at.per_hx[i + 2] * at.hx[i + 2], 1, 1e-14);
      EXPECT_NEAR(at.per_width[i + 2] * at.width[i + 2], 1, 1e-14);
    }
  }
  // v differs from the centres in y alone.
  EXPECT_EQ(c.width, v.width);
  EXPECT_EQ(c.height, u.height);
  for (int j = 2; j < m.ny - 2; ++j) EXPECT_NEAR(v.height[j + 2], m.centre_y(j) - m.centre_y(j - 1), 1e-15);
  EXPECT_EQ(u.i0, 1);
  EXPECT_EQ(u.j0, 0);
  EXPECT_EQ(v.i0, 0);
  EXPECT_EQ(v.j0, 1);
  EXPECT_EQ(c.i0 + c.j0, 0);
}

TEST(staggering, is_open_all_over_without_a_pipe) {
  const Mesh m = stretched(false);
  for (const Staggering& at : {Staggering::centres(m), Staggering::west_faces(m), Staggering::south_faces(m)})
    for (int j = at.j0; j < at.j1; ++j)
      for (const base::SharedRows* rows :
           {&at.open_volume, &at.inertia_, &at.per_inertia, &at.open, &at.open_x, &at.open_y})
        for (int i = at.i0; i < at.i1; ++i) ASSERT_EQ((*rows)(i, j), 1.0) << i << "," << j;
}

TEST(staggering, shares_carry_the_flux_of_both_cell_faces) {
  // Through the south face of a volume of u goes half of what goes through the south faces of the two cells.
  const Mesh m = stretched(false);
  const Staggering u = Staggering::west_faces(m), v = Staggering::south_faces(m), c = Staggering::centres(m);
  const auto flow_rate = [](double s) { return std::sin(7 * s) + 2; };
  for (int i = 1; i < m.nx; ++i) {
    const double before = flow_rate(m.centre_x(i - 1)), here = flow_rate(m.centre_x(i));
    const double flux = (u.share_x_before[i + 2] * before + u.share_x[i + 2] * here) * u.width[i + 2];
    EXPECT_NEAR(flux, 0.5 * (before * m.dx(i - 1) + here * m.dx(i)), 1e-14) << i;
  }
  for (int j = 1; j < m.ny; ++j) {
    const double before = flow_rate(m.centre_y(j - 1)), here = flow_rate(m.centre_y(j));
    const double flux = (v.share_y_before[j + 2] * before + v.share_y[j + 2] * here) * v.height[j + 2];
    EXPECT_NEAR(flux, 0.5 * (before * m.dy(j - 1) + here * m.dy(j)), 1e-14) << j;
  }
  // Where both "faces" are the same one, its flux counts once.
  EXPECT_NEAR(c.share_x_before[10] + c.share_x[10], 1, 1e-15);
  EXPECT_NEAR(u.share_y_before[10] + u.share_y[10], 1, 1e-15);
}

TEST(staggering, no_volume_is_much_lighter_than_its_openings) {
  // What flows through the open faces of a sliver in a step must not exceed what is in it many times.
  const Mesh m = stretched(true);
  for (const Staggering& at : {Staggering::centres(m), Staggering::west_faces(m), Staggering::south_faces(m)}) {
    int cut = 0;
    for (int j = at.j0; j < at.j1; ++j)
      for (int i = at.i0; i < at.i1; ++i) {
        const int a = i - at.shift_x, b = j - at.shift_y;
        const double west = 0.5 * (m.aperture_x(a, b) + m.aperture_x(i, j));
        const double south = 0.5 * (m.aperture_y(a, b) + m.aperture_y(i, j));
        const double inertia = at.inertia_(i, j);
        ASSERT_GE(inertia, 0.5 * std::max(west, south)) << i << "," << j;
        ASSERT_GE(inertia, at.open_volume(i, j));
        ASSERT_LE(inertia, 1.0 + 1e-12);
        ASSERT_NEAR(at.per_inertia(i, j) * inertia, 1, 1e-14);
        cut += at.open_volume(i, j) > 0 && at.open_volume(i, j) < 1;
      }
    EXPECT_GT(cut, 20);
  }
}

TEST(staggering, lets_no_friction_act_across_a_closed_face) {
  const Mesh m = stretched(true);
  const Staggering u = Staggering::west_faces(m), v = Staggering::south_faces(m);
  int closed = 0;
  for (int j = 1; j < m.ny; ++j)
    for (int i = 1; i < m.nx; ++i)
      for (const Staggering* at : {&u, &v})
        if (at->open(i, j) <= 0) {
          ASSERT_EQ(at->open_x(i, j) + at->open_x(i + 1, j) + at->open_y(i, j) + at->open_y(i, j + 1), 0.0);
          ++closed;
        }
  EXPECT_GT(closed, 50);
}

TEST(find_wall_cells, lists_each_cell_with_surface_once_row_by_row) {
  const Mesh m = stretched(true);
  const std::vector<WallCell> cells = find_wall_cells(m);
  std::size_t count = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i)
      if (m.wall_length(i, j) > 0) {
        ASSERT_LT(count, cells.size());
        EXPECT_EQ(cells[count].i, i);
        EXPECT_EQ(cells[count].j, j);
        ++count;
      }
  EXPECT_EQ(count, cells.size());
  EXPECT_GT(count, 20u);
  EXPECT_TRUE(find_wall_cells(stretched(false)).empty());
}

}  // namespace
}  // namespace livebed::flow
