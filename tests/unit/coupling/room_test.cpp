#include "coupling/room.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace livebed::coupling {
namespace {

constexpr double cell = 1e-3, d = 1e-3, power = 3;
constexpr int nx = 40, ny = 30;

/// 40 x 30 cells of 1 mm, the lowest five rows packed.
struct Bed {
  flow::Mesh mesh;
  base::Field voids{nx, ny}, room{nx, ny};
  EddyRoom eddies{nx, ny, power, d};

  Bed() {
    flow::MeshParams grid;
    grid.length = nx * cell, grid.height = ny * cell, grid.cell_x = grid.cell_y = cell;
    flow::PipeParams pipe;
    pipe.present = false;
    mesh = flow::make_mesh(grid, pipe);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) voids(i, j) = j < 5 ? 1 - packed_solid : 1.0;
  }
  void fill(int top = ny) {
    eddies.average(mesh, voids, top);
    eddies.fill(mesh, top, room);
  }
};

TEST(room, above_a_flat_bed_is_the_height_over_it) {
  Bed bed;
  bed.fill();
  // The step out of the bed passes half a cell of it: counted at the mean of full and free.
  const double out = cell * std::pow(0.5, power);
  for (int j = 5; j < ny; ++j) EXPECT_NEAR(bed.room(20, j), out + (j - 5) * cell, 1e-12) << j;
  for (int j = 0; j < 5; ++j) EXPECT_EQ(bed.room(20, j), room_least * d) << j;
}

TEST(room, is_shorter_to_a_wall_of_sand_than_to_the_bed_below) {
  Bed bed;
  for (int j = 0; j < ny; ++j)
    for (int i = 30; i < nx; ++i) bed.voids(i, j) = 1 - packed_solid;
  bed.fill();
  // The wall's edge is smeared over 3 d to either side by the average along the current.
  EXPECT_LT(bed.room(25, 25), 4 * cell);
  EXPECT_GT(bed.room(25, 25), 0.5 * cell);
  EXPECT_GT(bed.room(5, 25), 18 * cell);
}

TEST(room, does_not_end_at_a_grain_that_flies_alone) {
  Bed bed, alone;
  alone.voids(20, 15) = 0.4;
  bed.fill(), alone.fill();
  EXPECT_GT(alone.room(20, 16), 0.9 * bed.room(20, 16));
  EXPECT_LE(alone.room(20, 16), bed.room(20, 16));
}

TEST(room, in_a_cloud_of_sand_is_less_by_what_the_sand_fills) {
  Bed bed;
  for (int j = 10; j < 20; ++j)
    for (int i = 0; i < nx; ++i) bed.voids(i, j) = 1 - 0.3 * packed_solid;
  bed.fill();
  EXPECT_NEAR(bed.room(20, 18) - bed.room(20, 12), 6 * cell * std::pow(0.7, power), 1e-12);
}

}  // namespace
}  // namespace livebed::coupling
