#include "validate/scour_runs.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "case/read.hpp"

namespace livebed::validate {
namespace {

Scour rising() {
  Scour s;
  s.seed = 3, s.commit = "abc";
  for (int n = 0; n <= 10; ++n) s.t.push_back(0.1 * n), s.depth.push_back(0.05 * n);
  s.t_lines = {0, 0.5, 1.0};
  s.lines = {{0, 0}, {-0.2, 0.1}, {-0.5, 0.3}};
  return s;
}

TEST(scour_runs, mean_depth_of_a_window) {
  const Scour s = rising();
  EXPECT_NEAR(mean_depth(s, 0.35, 0.65), 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(mean_depth(s, 1.2, 2)));
}

TEST(scour_runs, first_time_between_two_rows) {
  EXPECT_NEAR(first_time(rising(), 0.125, 0.05), 0.25, 1e-12);
  EXPECT_NEAR(first_time(rising(), 0.125, 0.25), 0.25, 1e-12);
  EXPECT_TRUE(std::isnan(first_time(rising(), 0.6, 0.05)));
}

TEST(scour_runs, first_time_passes_over_a_single_look) {
  Scour s = rising();
  s.depth[1] = 0.3;
  EXPECT_NEAR(first_time(s, 0.2, 0.05), 0.1 * 0.2 / 0.3, 1e-12);
  EXPECT_NEAR(first_time(s, 0.2, 0.25), 0.4, 1e-12);
}

TEST(scour_runs, nearest_line) {
  const Scour s = rising();
  EXPECT_EQ(line_at(s, 0.7), s.lines[1]);
  EXPECT_EQ(line_at(s, 7), s.lines[2]);
}

TEST(scour_runs, say_who_made_them) {
  EXPECT_TRUE(run_told(rising()).starts_with("commit abc, case ")) << run_told(rising());
}

/// A run that was stopped is gone on with, one of another case is not touched.
TEST(scour_runs, are_gone_on_with_when_the_case_is_the_same) {
  setenv("XDG_CACHE_HOME", testing::TempDir().c_str(), 1);  // its packed bed is not the user's
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "kept_scour";
  std::filesystem::remove_all(folder);
  const auto small = [](const char* more) {
    return casefile::read_case(LIVEBED_SOURCE_DIR "/cases/quick",
                               {"mesh.length=0.12", "mesh.height=0.06", "pipe.x=0.05", "bed.count=300",
                                "time.spin_up=0.02", "output.series_every=0.005", "output.bed_every=0.01", more});
  };
  const Tell quiet = [](const std::string&) {};
  const auto first = scour(small("time.end=0.02"), folder, quiet);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->seed, 1u);
  EXPECT_NEAR(first->t.back(), 0.02, 0.005);
  const auto longer = scour(small("time.end=0.04"), folder, quiet);
  ASSERT_TRUE(longer);
  EXPECT_NEAR(longer->t.back(), 0.04, 0.005);
  EXPECT_EQ(longer->depth[0], first->depth[0]);
  EXPECT_EQ(longer->lines.size(), longer->t_lines.size());
  EXPECT_EQ(longer->lines[0].size(), longer->x.size());
  try {
    scour(small("bed.seed=2"), folder, quiet);
    ADD_FAILURE() << "went on with a run of another case";
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), base::Exit::input_output);
    EXPECT_NE(std::string(fault.what()).find("move it away"), std::string::npos) << fault.what();
  }
}

TEST(scour_runs, that_fail_are_told_and_cost_the_others_nothing) {
  setenv("XDG_CACHE_HOME", testing::TempDir().c_str(), 1);
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "failing_scour";
  std::filesystem::remove_all(folder);
  // Grains that never come to rest so well.
  const casefile::Case c = casefile::read_case(LIVEBED_SOURCE_DIR "/cases/quick",
                                               {"mesh.length=0.12", "mesh.height=0.06", "pipe.x=0.05", "bed.count=300",
                                                "bed.settled_speed=1e-30", "bed.seed=9"});
  std::string told;
  EXPECT_FALSE(scour(c, folder, [&](const std::string& line) { told += line + "\n"; }));
  EXPECT_NE(told.find("failing_scour failed: "), std::string::npos) << told;
  EXPECT_NE(told.find("come to rest"), std::string::npos) << told;
  EXPECT_FALSE(missing("seed 3").pass());
}

}  // namespace
}  // namespace livebed::validate
