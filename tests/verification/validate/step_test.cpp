#include "validate/step.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

/// Short form of `livebed validate step`: few cells a step height.
namespace livebed::validate {
namespace {

TEST(step, momentum_thickness_of_a_power_law) {
  std::vector<double> y, u;
  constexpr double thickness = 1.4;
  for (double at = 0.005; at < 8; at += 0.01)
    y.push_back(at), u.push_back(std::min(1.0, std::pow(at / thickness, 1.0 / 7)));
  EXPECT_NEAR(momentum_thickness(y, u), 7.0 / 72 * thickness, 0.014);  // no point below 0.1 H: a tenth is lost
}

TEST(step, reattaches_five_heights_behind_and_recovers) {
  const StepSetup setup{flow::Closure::k_epsilon, 8};
  const StepApproach approach = approach_step(setup);
  const StepRun run = run_step(setup, approach.at_minus_4);
  const double least = *std::min_element(run.cf.begin(), run.cf.end());
  std::printf("reattachment %.3f H, Cf %.5f before, %.5f least, %.5f at the end\n", run.reattachment, approach.friction,
              least, run.cf.back());
  EXPECT_NEAR(run.reattachment, 5.0, 0.7);  // 5.15 with 16 cells a step height
  EXPECT_NEAR(approach.friction, 0.0028, 0.0004);
  EXPECT_LT(least, -1e-4);
  EXPECT_GT(least, -2e-3);
  EXPECT_NEAR(run.cf.back(), 0.0020, 0.0005);
}

}  // namespace
}  // namespace livebed::validate
