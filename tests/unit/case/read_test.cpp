#include "case/read.hpp"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "base/math.hpp"
#include "case/check.hpp"
#include "case/resolved.hpp"
#include "case/schema.hpp"
#include "flow/profiles.hpp"
#include "grains/laws.hpp"
#include "grains/sizes.hpp"

namespace livebed::casefile {
namespace {

const std::filesystem::path shipped = LIVEBED_SOURCE_DIR "/cases";

Case read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_text(text, "test.toml", overrides);
}

void expect_same(const Case& a, const Case& b) {
  for (const Row& row : schema()) EXPECT_EQ(row.get(a), row.get(b)) << row.name;
  EXPECT_EQ(a.given, b.given);
  EXPECT_EQ(a.flow.current.bed_level, b.flow.current.bed_level);
  EXPECT_EQ(a.grains.fluid_density, b.grains.fluid_density);
  EXPECT_EQ(a.grains.length, b.grains.length);
}

TEST(read, layers_defaults_preset_file_and_command_line) {
  const std::string text = "preset = \"mbs2d\"\n[current]\ntheta = 0.33\n[grains]\nspread = \"1 %\"\n";
  const Case file = read(text);
  EXPECT_EQ(file.grains.friction, grains::Params{}.friction);  // struct
  EXPECT_EQ(file.grains.inertia, grains::Inertia::disk);       // preset
  EXPECT_EQ(file.grains.spread, 0.01);                         // file
  const Case changed = read(text, {"grains.spread=0.2", "contact.friction=0.4", "coupling.mode=one-way"});
  EXPECT_EQ(changed.grains.spread, 0.2);
  EXPECT_EQ(changed.grains.friction, 0.4);
  EXPECT_EQ(changed.coupling.mode, coupling::Mode::one_way);
  EXPECT_EQ(changed.grains.inertia, grains::Inertia::disk);
  const Case ours = read(text, {"preset=livebed"});
  EXPECT_EQ(ours.grains.inertia, grains::Inertia::sphere);
  EXPECT_EQ(ours.grains.spread, 0.01);
}

TEST(read, takes_overrides_with_units_and_words_unquoted) {
  const Case c = read("[current]\ntheta = 0.33\n", {"grains.diameter=1.5 mm", "pipe.x=\"22 cm\"", "case.title=2 D deep",
                                                    "pipe.present=true", "bed.seed=7"});
  EXPECT_EQ(c.grains.diameter, 0.0015);
  EXPECT_EQ(c.flow.pipe.x, 0.22);
  EXPECT_EQ(c.title, "2 D deep");
  EXPECT_EQ(c.grains.seed, 7u);
}

TEST(read, an_override_replaces_the_keys_it_stands_for) {
  const Case c =
      read("preset = \"mbs2d\"\n[current]\ntheta = 0.33\n[bed]\ncount = 6240\n",
           {"current.mean_speed=0.869", "contact.restitution=0.5", "contact.tension=none", "bed.thickness=5 cm"});
  EXPECT_TRUE(c.is_given("current.mean_speed"));
  EXPECT_TRUE(c.is_given("contact.restitution"));
  EXPECT_TRUE(c.is_given("bed.thickness"));
  EXPECT_FALSE(c.is_given("current.theta"));
  EXPECT_EQ(c.flow.current.mean_speed, 0.869);
  EXPECT_EQ(c.grains.restitution, 0.5);
  EXPECT_NEAR(grains::restitution_of(c.grains.damping, c.grains.tension), 0.5, 1e-9);
}

TEST(read, bare_numbers_and_units_are_the_same_case) {
  const Case bare = read("[current]\ntheta = 0.33\n[grains]\ndiameter = 0.0015\n[flow]\nviscosity = 1.1e-6\n");
  const Case units =
      read("[current]\ntheta = \"33 %\"\n[grains]\ndiameter = \"1.5 mm\"\n[flow]\nviscosity = \"1.1 mm2/s\"\n");
  expect_same(bare, units);
  EXPECT_EQ(hash(bare), hash(units));
}

TEST(derive, the_papers_current_and_time_scale) {
  const Case c = read_case(shipped / "mao-mbs2d");
  EXPECT_NEAR(c.flow.current.shear_velocity, 0.10336, 1e-5);  // Eq. 29 at theta 0.33
  EXPECT_NEAR(c.flow.current.mean_speed, 1.46, 0.02);
  EXPECT_NEAR(c.time_scale, 0.88171, 1e-5);
  EXPECT_NEAR(c.time.end, 8 * c.time_scale, 1e-12);
  EXPECT_EQ(c.flow.current.roughness, 0.005);  // 2.5 d
  EXPECT_EQ(c.flow.floor_roughness, 0.005);
  EXPECT_EQ(c.grains.count, 6240);
  EXPECT_NEAR(c.bed_thickness, 0.0478, 1e-4);
  EXPECT_NEAR(c.flow.pipe.y, c.bed_thickness + 0.025, 1e-15);
  EXPECT_EQ(c.flow.current.bed_level, c.bed_thickness);
  EXPECT_EQ(c.grains.length, 0.5);
}

TEST(derive, the_printed_mean_speed_has_a_far_smaller_theta) {
  const Case c = read_case(shipped / "mao-mbs2d" / "current.toml");
  EXPECT_NEAR(c.theta, 0.116, 0.002);
  EXPECT_EQ(c.flow.current.mean_speed, 0.869);
}

TEST(derive, theta_mean_speed_and_shear_velocity_close_the_circle) {
  for (const std::string profile : {"rough", "smooth", "developed", "uniform"}) {
    const std::string keys = "profile = \"" + profile + "\"\n";
    const Case by_theta = read("[current]\ntheta = 0.2\n" + keys);
    const Case by_u_star =
        read("[current]\n" + keys, {"current.shear_velocity=" + written(by_theta.flow.current.shear_velocity)});
    const Case by_mean =
        read("[current]\n" + keys, {"current.mean_speed=" + written(by_theta.flow.current.mean_speed)});
    for (const Case& c : {by_u_star, by_mean}) {
      EXPECT_NEAR(c.theta, 0.2, 1e-9) << profile;
      EXPECT_NEAR(c.flow.current.shear_velocity, by_theta.flow.current.shear_velocity, 1e-9) << profile;
      EXPECT_NEAR(c.flow.current.mean_speed, by_theta.flow.current.mean_speed, 1e-9) << profile;
    }
  }
}

TEST(derive, the_mean_speed_is_the_depth_mean_of_the_log_law) {
  const Case c = read("[current]\ntheta = 0.2\n");
  const double depth = c.flow.mesh.height - c.bed_thickness, z0 = c.flow.current.roughness / 30;
  const int n = 200000;
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += flow::log_law((i + 0.5) * depth / n, c.flow.current.shear_velocity, z0) / n;
  EXPECT_NEAR(c.flow.current.mean_speed, sum, 1e-4 * sum);
}

TEST(derive, count_and_thickness_of_the_bed_close_the_circle) {
  const Case thick = read("[current]\ntheta = 0.2\n[bed]\nthickness = \"5 cm\"\n");
  const Case counted = read("[current]\ntheta = 0.2\n", {"bed.count=" + std::to_string(thick.grains.count)});
  EXPECT_NEAR(counted.bed_thickness, 0.05, 0.5 * 0.05 / thick.grains.count);
  const double area = thick.grains.count * base::pi / 4 * base::square(0.002) * (1 + 0.2 * 0.2 / 3);
  EXPECT_NEAR(area / (0.5 * 0.05), 0.82, 1e-3);
}

TEST(derive, sizes_of_a_grading) {
  const std::string current = "[current]\ntheta = 0.2\n";
  const Case by_d50 = read(current + "[grains]\nd10 = \"1.5 mm\"\nd50 = \"2 mm\"\nd90 = \"2.6 mm\"\n");
  const Case by_curve = read(current + "[grains]\ngrading = \"1.5 mm: 10 %, 2 mm: 50 %, 2.6 mm: 0.9\"\n");
  for (const Case& c : {by_d50, by_curve}) {
    EXPECT_EQ(c.grains.diameter, 0.002);
    EXPECT_EQ(c.grains.spread, 0);
    EXPECT_EQ(c.d50, 0.002);
    ASSERT_EQ(c.grains.grading.size(), 3u);
    EXPECT_EQ(c.grains.grading[2].diameter, 0.0026);
    EXPECT_NEAR(c.grains.grading[2].passing, 0.9, 1e-15);
    const double area = c.grains.count * base::pi / 4 * grains::mean_power(c.grains, 2);
    EXPECT_NEAR(area / (0.5 * 0.05), 0.82, 1e-3);
    EXPECT_EQ(c.flow.current.roughness, 2.5 * 0.002);
    expect_same(read(resolved_text(c)), c);  // and a resolved case is a case
  }
  EXPECT_EQ(by_d50.grains.step, by_curve.grains.step);
  // Grading or spread: the upper layer decides, and the resolved case knows one of them alone.
  const Case spread = read(current, {"grains.spread=0.1"});
  EXPECT_TRUE(spread.grains.grading.empty());
  EXPECT_EQ(spread.d50, spread.grains.diameter);
  EXPECT_EQ(read(current + "[grains]\ndiameter = 0.003\n", {"grains.grading=1 mm: 0, 3 mm: 1"}).grains.spread, 0);
}

TEST(derive, step_and_stiffness_close_the_circle) {
  const Case by_step = read("[current]\ntheta = 0.2\n", {"time.grain_step=10 us", "contact.steps=20"});
  // Added mass included; the smallest grains, 0.8 d, set the critical time.
  EXPECT_NEAR(by_step.grains.stiffness / (6.5e3 * base::cube(0.8)), 1, 0.02);
  const Case by_stiffness =
      read("[current]\ntheta = 0.2\n", {"contact.stiffness=" + written(by_step.grains.stiffness), "contact.steps=20"});
  EXPECT_NEAR(by_stiffness.grains.step, 1e-5, 1e-17);
}

TEST(derive, no_damping_is_a_full_rebound) {
  const Case c = read("[current]\ntheta = 0.2\n[contact]\ndamping = 0\n");
  EXPECT_EQ(c.grains.damping, 0);
  EXPECT_EQ(c.grains.restitution, 1);
}

TEST(derive, a_case_without_grains_or_pipe_has_no_time_scale) {
  for (const char* without : {"pipe.present=false", "bed.count=0", "bed.thickness=0"}) {
    const Case c = read("[current]\ntheta = 0.2\n", {without});
    EXPECT_EQ(c.time_scale, 0) << without;
    EXPECT_EQ(c.time.end_over_T, 0) << without;
    EXPECT_EQ(c.time.end, TimeParams{}.end) << without;
  }
}

TEST(notes, tell_of_a_soft_bed_a_thin_one_and_a_restless_one) {
  const Case good = read("[current]\ntheta = 0.2\n[mesh]\nheight = 0.3\n[bed]\nthickness = 0.1\n");
  EXPECT_TRUE(notes(good).empty());
  const Case soft =
      read("[current]\ntheta = 0.2\n[mesh]\nheight = 0.3\n[bed]\nthickness = 0.1\n", {"contact.stiffness=10"});
  ASSERT_EQ(notes(soft).size(), 1u);
  EXPECT_NE(notes(soft)[0].find("overlap"), std::string::npos);
  EXPECT_EQ(notes(read("preset = \"mbs2d\"\n[current]\ntheta = 0.2\n", {"contact.steps=20"})).size(), 2u);
}

TEST(notes, tell_of_a_current_that_comes_up_too_fast) {
  const char* text = "[current]\nmean_speed = 0.9\n[mesh]\nheight = 0.3\n[bed]\nthickness = 0.1\n";
  // A bed of 0.82 discs, two thirds of that spheres, of sand 1650 kg/m3 heavier than water: 8.85 kPa/m.
  EXPECT_TRUE(notes(read(text, {"current.rise=0.35"})).empty());
  const std::vector<std::string> told = notes(read(text, {"current.rise=0.2"}));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("with 0.51 of its weight"), std::string::npos) << told[0];
  EXPECT_NE(told[0].find("current.rise 0.34 s or more"), std::string::npos) << told[0];
}

class ShippedCase : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(ShippedCase, is_read_without_a_fault) {
  const Case c = read_case(GetParam());
  EXPECT_FALSE(c.title.empty());
  EXPECT_GT(c.time.end, 0);
  EXPECT_GT(c.flow.current.mean_speed, 0);
  EXPECT_EQ(c.time_scale > 0, c.flow.pipe.present);
}

TEST_P(ShippedCase, comes_back_from_its_resolved_text) {
  const Case c = read_case(GetParam());
  const Case again = read(resolved_text(c));
  expect_same(c, again);
  EXPECT_EQ(resolved_text(c), resolved_text(again));
  EXPECT_EQ(hash(c), hash(again));
}

std::vector<std::filesystem::path> shipped_cases() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shipped))
    if (entry.path().extension() == ".toml" && entry.path().parent_path() != shipped) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

INSTANTIATE_TEST_SUITE_P(cases, ShippedCase, testing::ValuesIn(shipped_cases()), [](const auto& file) {
  std::string name = std::filesystem::relative(file.param, shipped).replace_extension().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

TEST(cases, are_all_there) { EXPECT_GE(shipped_cases().size(), 5u); }

TEST(cases, deep_has_two_diameters_of_bed_under_the_same_water) {
  const Case paper = read_case(shipped / "mao-mbs2d"), deep = read_case(shipped / "mao-mbs2d" / "deep.toml");
  EXPECT_NEAR(deep.bed_thickness / deep.flow.pipe.diameter, 2, 0.02);
  EXPECT_NEAR(deep.flow.mesh.height - paper.flow.mesh.height, paper.flow.pipe.diameter, 1e-15);
}

TEST(resolved, comes_back_whatever_was_given) {
  for (const std::vector<std::string>& overrides : std::vector<std::vector<std::string>>{
           {"current.mean_speed=0.7", "contact.stiffness=2 kN/m", "contact.restitution=0.7", "time.end_over_T=3"},
           {"current.shear_velocity=0.07", "contact.damping=0", "bed.count=5000", "current.profile=smooth"},
           {"pipe.present=false", "bed.count=0", "coupling.mode=none"},
           {"case.title=a \"quoted\" \\ title", "flow.floor=slip", "preset=mbs2d"}}) {
    const Case c = read("[current]\ntheta = 0.25\n", overrides);
    expect_same(c, read(resolved_text(c)));
  }
}

TEST(resolved, comes_back_after_the_packing) {
  for (const char* bed : {"bed.count=6240", "bed.thickness=0.05"}) {
    Case c = read("[current]\nmean_speed = 0.8\n", {bed});
    const double cut = c.is_given("bed.thickness") ? 0.05 : 0;
    EXPECT_EQ(c.grains.thickness, cut);
    derive_at_level(c, 6100, 0.0431);
    EXPECT_EQ(c.grains.count, 6100);
    EXPECT_EQ(c.grains.thickness, cut);  // packed again, it becomes the same bed
    EXPECT_EQ(c.bed_thickness, 0.0431);
    EXPECT_EQ(c.flow.current.bed_level, 0.0431);
    EXPECT_EQ(c.flow.pipe.y, 0.0431 + 0.025);
    EXPECT_EQ(c.flow.current.mean_speed, 0.8);
    expect_same(c, read(resolved_text(c)));
  }
}

TEST(resolved, can_be_started_from_with_other_keys) {
  const std::string resolved = resolved_text(read("[current]\ntheta = 0.25\n"));
  const Case c = read(resolved, {"current.theta=0.3", "bed.count=5000"});
  expect_same(c, read("[current]\ntheta = 0.3\n[bed]\ncount = 5000\n", {}));
}

TEST(resolved, hash_tells_cases_apart) {
  const Case c = read("[current]\ntheta = 0.25\n");
  EXPECT_EQ(hash(c), hash(read("[current]\ntheta = 0.25\n")));
  EXPECT_NE(hash(c), hash(read("[current]\ntheta = 0.25\n", {"bed.seed=2"})));
  EXPECT_EQ(hash(c).size(), 16u);
}

TEST(resolved, cannot_be_written_where_there_is_no_folder) {
  try {
    write_resolved(read("[current]\ntheta = 0.25\n"), "no/such/folder/case.resolved.toml");
    FAIL() << "no fault";
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), base::Exit::input_output);
    EXPECT_NE(std::string(fault.what()).find("no/such/folder/case.resolved.toml"), std::string::npos);
  }
}

}  // namespace
}  // namespace livebed::casefile
