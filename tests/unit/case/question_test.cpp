#include "case/question.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "case/check.hpp"
#include "case/enlarge.hpp"
#include "case/read.hpp"

namespace livebed::casefile {
namespace {

Question engineers() {
  Question q;
  q.pipe = 0.5, q.current = 0.8, q.sand = 0.2e-3;
  return q;
}

TEST(scene, of_the_engineers_question) {
  const Scene w = scene_of(engineers());
  const Expected e = expect(w);
  EXPECT_NEAR(w.mean_speed, 0.8, 1e-9);
  EXPECT_EQ(w.depth, 3);
  // u* = 0.41 U/(ln(30 h/ks) - 1) = 0.328/(ln(180000) - 1)
  EXPECT_NEAR(w.shear_velocity, 0.41 * 0.8 / (std::log(180000) - 1), 1e-5);
  EXPECT_NEAR(e.theta, 0.270, 1e-3);
  EXPECT_EQ(e.regime, base::Regime::live_bed);
  EXPECT_NEAR(e.pipe_reynolds, 4e5, 1);
  EXPECT_EQ(e.depth->over_D, 0.6);
  EXPECT_NEAR(*e.time_scale, 3904, 20);
  // S_eq (1 - exp(-t/T)) = 0.1 D
  EXPECT_NEAR(0.6 * (1 - std::exp(-*e.undermined / *e.time_scale)), 0.1, 1e-12);
  EXPECT_NEAR(*e.onset_speed, std::sqrt(0.025 * 9.81 * 0.5 * 0.6 * 1.65), 1e-9);
}

TEST(scene, larger_grains_keep_theta_and_need_more_current) {
  const Scene sand = scene_of(engineers()), grains = scene_of(engineers(), 0.01);
  EXPECT_NEAR(expect(grains).theta, expect(sand).theta, 1e-12);
  EXPECT_GT(grains.mean_speed, 3 * sand.mean_speed);
  EXPECT_LT(*expect(grains).time_scale, 0.01 * *expect(sand).time_scale);
}

TEST(expected, knows_what_no_formula_tells) {
  Question q = engineers();
  q.current = 0.05;  // too weak to move anything
  EXPECT_EQ(expect(scene_of(q)).regime, base::Regime::no_motion);
  EXPECT_FALSE(expect(scene_of(q)).depth || expect(scene_of(q)).time_scale);
  q = engineers(), q.gap_ratio = 0.5;
  EXPECT_FALSE(expect(scene_of(q)).onset_speed);  // the water passes already
  EXPECT_FALSE(expect(scene_of(q)).undermined);
  q.gap_ratio = -0.3;
  EXPECT_FALSE(expect(scene_of(q)).depth);
  EXPECT_TRUE(expect(scene_of(q)).onset_speed);
  Scene flat = scene_of(engineers());
  flat.D = 0;
  EXPECT_FALSE(expect(flat).time_scale || expect(flat).onset_speed);
}

TEST(scene, of_a_case_is_that_of_the_question_it_was_written_for) {
  for (const bool by_theta : {false, true})
    for (const double gap : {-0.25, 0.0, 0.5}) {
      Question q;
      q.pipe = 0.05, q.sand = 0.36e-3, q.gap_ratio = gap;
      if (by_theta)
        q.theta = 0.33;
      else
        q.current = 0.87;
      for (const double d : {0.36e-3, 1e-3, 2e-3}) {
        const Scene asked = scene_of(q, d), got = scene_of(read_text(case_text(q, d), "question.toml"));
        EXPECT_EQ(got.D, asked.D);
        EXPECT_EQ(got.gap_ratio, asked.gap_ratio);
        EXPECT_NEAR(got.d, asked.d, 1e-12);
        EXPECT_NEAR(got.depth, asked.depth, 1e-9);
        EXPECT_NEAR(got.mean_speed, asked.mean_speed, 1e-4 * asked.mean_speed);
        EXPECT_NEAR(got.speed_at_pipe, asked.speed_at_pipe, 1e-4 * asked.speed_at_pipe);
        EXPECT_NEAR(expect(got).theta, expect(asked).theta, 1e-4 * expect(asked).theta);
      }
    }
}

TEST(case_text, tells_of_enlarged_grains_and_only_of_those) {
  const std::string enlarged = case_text(engineers(), 0.02), real = case_text(engineers(), 0.2e-3);
  EXPECT_NE(enlarged.find("ENLARGED GRAINS: 2 cm stand for the sand of 0.2 mm"), std::string::npos) << enlarged;
  EXPECT_NE(enlarged.find("theta = 0.2697"), std::string::npos);
  EXPECT_EQ(real.find("ENLARGED"), std::string::npos);
  EXPECT_NE(real.find("mean_speed = \"0.8 m/s\""), std::string::npos);
}

TEST(case_text, has_no_notes_from_the_check) {
  const Case c = read_text(case_text(engineers(), 0.02), "question.toml");
  EXPECT_TRUE(notes(c).empty()) << notes(c).front();
  EXPECT_TRUE(c.grains.sleep);
  EXPECT_NEAR(c.time.end, 5 * c.time_scale, 1e-9);
}

TEST(enlarging, keeps_theta_pipe_and_the_end_in_scour_time_scales) {
  const std::filesystem::path file = LIVEBED_SOURCE_DIR "/cases/mao/case.toml";
  const Case c = read_case(file), larger = read_case(file, enlarging(c, 4));
  EXPECT_NEAR(larger.grains.diameter, 4 * c.grains.diameter, 1e-12);
  EXPECT_NEAR(larger.theta, c.theta, 1e-9);
  EXPECT_NEAR(larger.time.end_over_T, c.time.end_over_T, 1e-3);
  EXPECT_NEAR(larger.grains.step, 2 * c.grains.step, 1e-9);
  EXPECT_EQ(larger.flow.pipe.diameter, c.flow.pipe.diameter);
  EXPECT_NEAR(larger.grains.count, c.grains.count / 16.0, 2);
  EXPECT_NEAR(larger.time.end / larger.output.bed_every, c.time.end / c.output.bed_every, 1);
}

TEST(enlarging, works_for_every_shipped_case_and_never_coarsens_the_pipe_away) {
  const std::filesystem::path shipped = LIVEBED_SOURCE_DIR "/cases";
  for (const char* name : {"quick", "flat-bed", "mao-mbs2d", "mao-mbs2d/deep.toml", "mao-mbs2d/current.toml"}) {
    const Case c = read_case(shipped / name), larger = read_case(shipped / name, enlarging(c, 2));
    EXPECT_NEAR(larger.theta, c.theta, 1e-5) << name;
    EXPECT_NEAR(larger.grains.count, c.grains.count / 4.0, 1) << name;
  }
}

TEST(enlarging, scales_a_sieve_curve) {
  const std::string text = "[grains]\ngrading = \"1 mm: 10 %, 2 mm: 50 %, 3 mm: 90 %\"\n[current]\ntheta = 0.3\n";
  const Case c = read_text(text, "graded.toml"), larger = read_text(text, "graded.toml", enlarging(c, 1.5));
  EXPECT_NEAR(larger.grains.diameter, 3e-3, 1e-9);
  EXPECT_NEAR(larger.grains.grading.back().diameter, 4.5e-3, 1e-9);
  EXPECT_NEAR(larger.grains.grading.back().passing, 0.9, 1e-9);
}

}  // namespace
}  // namespace livebed::casefile
