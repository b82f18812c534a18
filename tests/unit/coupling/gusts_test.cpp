#include "coupling/gusts.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "coupling/eddies.hpp"

namespace livebed::coupling {
namespace {

constexpr double C_T = 0.2, nu = 1e-6;

/// 70 x 20 cells of 1 mm x 1 mm; eddies of 1 mm with k = 0.001 everywhere and no grains.
struct Water {
  flow::Mesh mesh;
  flow::State state;
  base::Field packed{70, 20};

  explicit Water(const flow::PipeParams& pipe = no_pipe()) {
    flow::MeshParams grid;
    grid.length = 0.07, grid.height = 0.02, grid.cell_x = grid.cell_y = 1e-3;
    mesh = flow::make_mesh(grid, pipe);
    state.k = base::Field(70, 20), state.epsilon = base::Field(70, 20);
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 70; ++i) put(i, j, 0.001, 0.001);
  }
  static flow::PipeParams no_pipe() {
    flow::PipeParams pipe;
    pipe.present = false;
    return pipe;
  }
  void put(int i, int j, double k, double size) { state.k(i, j) = k, state.epsilon(i, j) = k * std::sqrt(k) / size; }
  Gusts gusts() const {
    Gusts g(70, 20);
    g.fill(mesh, state, packed, 20, C_T, nu);
    return g;
  }
};

TEST(gusts, are_those_of_the_place_where_the_eddies_are_alike) {
  const Water water;
  const Gusts g = water.gusts();
  for (int j : {0, 7, 19}) {
    EXPECT_EQ(g.k(3, j), 0.001);
    EXPECT_EQ(g.time(3, j), Eddies::life_time(C_T, 0.001, water.state.epsilon(3, j), nu));
  }
}

TEST(gusts, of_large_eddies_reach_down_as_far_as_these_are_large) {
  Water water;
  water.put(66, 12, 0.05, 0.0065);
  const Gusts g = water.gusts();
  const double lasts = Eddies::life_time(C_T, 0.05, water.state.epsilon(66, 12), nu);
  for (int j = 6; j <= 12; ++j) {
    EXPECT_EQ(g.k(66, j), 0.05) << j;
    EXPECT_EQ(g.time(66, j), lasts) << j;
  }
  for (int j : {5, 0, 13, 19}) EXPECT_EQ(g.k(66, j), 0.001) << j;
  EXPECT_EQ(g.k(65, 10), 0.001);
}

TEST(gusts, leave_stronger_ones_below_them_alone) {
  Water water;
  water.put(5, 12, 0.05, 0.02);
  water.put(5, 6, 0.08, 0.0025);
  const Gusts g = water.gusts();
  EXPECT_EQ(g.k(5, 7), 0.05);
  EXPECT_EQ(g.k(5, 6), 0.08);
  EXPECT_EQ(g.k(5, 4), 0.08);
}

TEST(gusts, enter_the_room_that_grains_leave_and_no_packed_bed) {
  Water water;
  water.put(5, 12, 0.05, 0.05);
  water.packed(5, 4) = 0.25, water.packed(5, 3) = 0.9999, water.packed(5, 2) = 1.1;
  const Gusts g = water.gusts();
  EXPECT_EQ(g.k(5, 5), 0.05);
  EXPECT_EQ(g.k(5, 4), 0.75 * 0.05);
  EXPECT_EQ(g.k(5, 3), 0.001);
  EXPECT_EQ(g.time(5, 3), Eddies::life_time(C_T, 0.001, water.state.epsilon(5, 3), nu));
  EXPECT_EQ(g.k(5, 2), 0.001);
}

TEST(gusts, do_not_reach_through_a_pipe) {
  flow::PipeParams pipe;
  pipe.present = true, pipe.diameter = 0.006, pipe.x = 0.035, pipe.y = 0.01;
  Water water(pipe);
  for (int i : {34, 5}) water.put(i, 16, 0.05, 0.05);
  const Gusts g = water.gusts();
  EXPECT_EQ(g.k(34, 14), 0.05);
  EXPECT_EQ(g.k(34, 3), 0.001);
  EXPECT_EQ(g.k(5, 3), 0.05);
}

}  // namespace
}  // namespace livebed::coupling
