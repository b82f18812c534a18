#include "validate/flat_bed.hpp"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

#include "base/sediment.hpp"

namespace livebed::validate {
namespace {

FlatBedSetup small() {
  FlatBedSetup s;
  s.theta = 0.4, s.length = 40, s.bed = 6, s.depth = 20;
  s.spin_up = 2, s.begin = 0.5, s.end = 1.5;
  return s;
}

TEST(flat_bed, is_moved_by_the_current_asked_for) {
  const FlatBedSetup setup = small();
  const FlatBedRun run = run_flat_bed(setup);
  EXPECT_NEAR(run.theta / setup.theta, 1, 0.25);  // of 1 s; the speed follows within seconds
  // Within a factor of three of Meyer-Peter and Mueller even so.
  const double ratio = run.einstein(setup) / base::meyer_peter_mueller(run.theta);
  EXPECT_GT(ratio, 1 / 3.0);
  EXPECT_LT(ratio, 3.0);
  // Grains and water: packed below and still, none above and fast, grains slower than water where they move.
  ASSERT_EQ(run.y.size(), run.solid.size());
  EXPECT_NEAR(run.level / setup.diameter, setup.bed, 0.5);
  EXPECT_NEAR(run.solid[4], 0.55, 0.06);
  EXPECT_NEAR(run.u[4], 0, 0.02);
  EXPECT_EQ(run.solid.back(), 0);
  EXPECT_GT(run.u.back(), 0.6);
  // Where they carry most; in the thin cloud above a layer may hold a grain or two that an eddy has thrown.
  std::size_t moving = 0;
  for (std::size_t n = 0; n < run.y.size(); ++n)
    if (run.solid[n] * run.grain_u[n] > run.solid[moving] * run.grain_u[moving]) moving = n;
  EXPECT_GT(run.grain_u[moving], 0.05);
  EXPECT_LT(run.grain_u[moving], run.u[moving]);
}

TEST(flat_bed, is_kept_for_its_setup) {
  const std::string folder = testing::TempDir() + "kept_flat_beds";
  std::filesystem::remove_all(folder);
  FlatBedSetup setup = small();
  setup.theta = 0.05, setup.spin_up = 0.02, setup.begin = 0, setup.end = 0.02;
  int made = 0, kept = 0;
  const Tell tell = [&](const std::string& line) { ++(line.find("kept") == std::string::npos ? made : kept); };
  const FlatBedRun first = kept_flat_bed(setup, folder, tell), again = kept_flat_bed(setup, folder, tell);
  EXPECT_EQ(made, 1);
  EXPECT_EQ(kept, 1);
  EXPECT_EQ(first.flux, again.flux);
  EXPECT_EQ(first.solid, again.solid);
  setup.seed = 2;
  EXPECT_NE(kept_flat_bed(setup, folder, tell).flux, first.flux);
  EXPECT_EQ(made, 2);
}

}  // namespace
}  // namespace livebed::validate
