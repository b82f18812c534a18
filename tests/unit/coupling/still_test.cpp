#include "coupling/still.hpp"

#include <gtest/gtest.h>

#include "base/math.hpp"
#include "flow/staggering.hpp"

namespace livebed::coupling {
namespace {

constexpr double d = 2e-3;

/// Five grains one above the other in a box of water, all asleep; stored in the reverse order of their ids.
struct Column {
  static constexpr int count = 5;
  flow::Mesh mesh;
  Kernels at;
  StillGrains still;
  grains::State g;

  Column() {
    flow::MeshParams grid;
    grid.length = 0.04, grid.height = 0.04, grid.cell_x = grid.cell_y = d;
    mesh = flow::make_mesh(grid, {.present = false});
    at.u = Transfer(flow::Staggering::west_faces(mesh), mesh.aperture_x, 1, mesh.nx - 1, d);
    at.v = Transfer(flow::Staggering::south_faces(mesh), mesh.aperture_y, 0, mesh.nx - 1, d);
    at.c = Transfer(flow::Staggering::centres(mesh), mesh.volume, 0, mesh.nx - 1, d);
    still = StillGrains(mesh.nx, mesh.ny, count, d);
    for (int k = 0; k < count; ++k) {
      const int id = count - 1 - k;
      g.id.push_back(id), g.x.push_back(0.02), g.y.push_back(0.004 + 6e-3 * id);
      g.diameter.push_back(d * (1 + 0.1 * id)), g.fluid.beta.push_back(1 + id);
      g.sleep.asleep.push_back(1), still.damps[id] = 10 + id;
    }
  }
  /// A number of steps; asks(k) is who rests.
  template <class Asks>
  void steps(int n, Asks&& asks) {
    for (int k = 0; k < n; ++k) still.step(g, at, 0, asks);
  }
  void steps(int n) {
    steps(n, [&](int k) { return g.sleep.asleep[k] != 0; });
  }
  static double total(const base::Field& f) {
    double sum = 0;
    for (int j = 0; j < f.ny(); ++j)
      for (int i = 0; i < f.nx(); ++i) sum += f(i, j);
    return sum;
  }
  /// The sums are those of the grains that are still, and of no other.
  void expect_sums() const {
    double volume = 0, beta = 0, damping = 0;
    for (int k = 0; k < g.count(); ++k) {
      if (!is_still(g, k)) continue;
      volume += base::sphere_volume(g.diameter[k]), beta += g.fluid.beta[k], damping += still.damps[g.id[k]];
    }
    EXPECT_NEAR(total(still.solid), volume, 1e-12 * d * d * d);
    EXPECT_NEAR(total(still.damping), damping, 1e-12 * 50);
    for (const base::Field* drag : {&still.beta_u, &still.beta_v}) EXPECT_NEAR(total(*drag), beta, 1e-12 * 15);
  }
  int number() const {
    int n = 0;
    for (int k = 0; k < g.count(); ++k) n += is_still(g, k);
    return n;
  }
};

TEST(still_grains, are_summed_from_the_first_step_of_a_round) {
  Column column;
  EXPECT_EQ(column.number(), 0);
  column.steps(1, [](int k) { return k != 2; });
  EXPECT_EQ(column.number(), 4);
  EXPECT_FALSE(is_still(column.g, 2));
  column.expect_sums();
  column.steps(5);  // whoever begins to rest later waits for the next round
  EXPECT_EQ(column.number(), 4);
  column.expect_sums();
}

TEST(still_grains, that_wake_are_taken_out) {
  Column column;
  column.steps(2);
  column.g.sleep.asleep[1] = column.g.sleep.asleep[3] = 0;
  EXPECT_EQ(column.still.wake(column.g, column.at), (std::vector<int>{1, 3}));
  EXPECT_EQ(column.number(), 3);
  column.expect_sums();
  EXPECT_TRUE(column.still.wake(column.g, column.at).empty());
}

TEST(still_grains, that_leave_are_taken_out) {
  Column column;
  column.steps(1, [](int k) { return k != 2; });
  column.still.let_leave(column.g, column.at, {2, 4});
  column.g.fluid.still[4] = 0;  // gone
  column.expect_sums();
}

TEST(still_grains, near_the_surface_are_so_for_a_round_and_deep_ones_for_some) {
  Column column;
  column.steps(steps_a_round);
  // The topmost lies at 14 d: those from 4 d up are looked at anew.
  for (int k = 0; k < Column::count; ++k)
    EXPECT_EQ(is_still(column.g, k), column.g.y[k] < column.g.y[0] - surface_depth * d) << "grain " << k;
  EXPECT_EQ(column.number(), 1);
  column.expect_sums();
  column.steps(1);
  EXPECT_EQ(column.number(), 5);
  column.expect_sums();
  column.steps(rounds_of_the_deep * steps_a_round - steps_a_round - 1);
  EXPECT_EQ(column.number(), 0);
  EXPECT_EQ(Column::total(column.still.solid), 0);
}

TEST(still_grains, are_none_of_those_that_gusts_reach) {
  Column column;
  const auto asleep = [&](int k) { return column.g.sleep.asleep[k] != 0; };
  for (int round = 0; round < 2; ++round) {
    column.still.step(column.g, column.at, gust_depth, asleep);
    // The topmost lies at 14 d, the next at 11, 8, 5 and 2 d.
    for (int k = 0; k < Column::count; ++k) EXPECT_EQ(is_still(column.g, k), k >= 2) << "grain " << k;
    column.expect_sums();
    for (int n = 1; n < steps_a_round; ++n) column.still.step(column.g, column.at, gust_depth, asleep);
  }
  // One that is awake does not make a surface.
  column.g.sleep.asleep[0] = 0;
  column.still.step(column.g, column.at, gust_depth, asleep);
  for (int k = 0; k < Column::count; ++k) EXPECT_EQ(is_still(column.g, k), k >= 3) << "grain " << k;
}

TEST(still_grains, forgotten_leave_nothing) {
  Column column;
  column.steps(1);
  column.still.begin(column.g);
  EXPECT_EQ(column.number(), 0);
  column.expect_sums();
  column.steps(1);
  EXPECT_EQ(column.number(), 5);
}

}  // namespace
}  // namespace livebed::coupling
