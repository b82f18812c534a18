#include "base/approach.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "base/math.hpp"

namespace livebed::base {
namespace {

TEST(approach, an_exact_approach_is_fitted_exactly) {
  std::vector<double> t, S;
  for (int k = 0; k <= 60; ++k) {
    t.push_back(0.7 * k);
    S.push_back(0.91 * (1 - std::exp(-t.back() / 11.5)));
  }
  const auto fit = fit_approach(t, S);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->S_eq, 0.91, 1e-6);
  EXPECT_NEAR(fit->T, 11.5, 1e-5);
  EXPECT_LT(fit->rms, 1e-7);
  EXPECT_NEAR(*time_to_reach(t, S, 0.91 * (1 - std::exp(-1.0))), 11.5, 0.02);
  EXPECT_FALSE(time_to_reach(t, S, 0.92));
}

TEST(approach, the_standard_errors_are_those_of_repeated_experiments) {
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0, 0.03);
  double S2 = 0, T2 = 0, claimed_S = 0, claimed_T = 0;
  const int experiments = 300;
  for (int n = 0; n < experiments; ++n) {
    std::vector<double> t, S;
    for (int k = 0; k < 50; ++k) {
      t.push_back(0.8 * k);
      S.push_back(0.9 * (1 - std::exp(-t.back() / 12)) + noise(random));
    }
    const auto fit = fit_approach(t, S);
    ASSERT_TRUE(fit);
    S2 += base::square(fit->S_eq - 0.9) / experiments;
    T2 += base::square(fit->T - 12) / experiments;
    claimed_S += fit->error_S_eq / experiments;
    claimed_T += fit->error_T / experiments;
  }
  EXPECT_NEAR(claimed_S / std::sqrt(S2), 1, 0.15);
  EXPECT_NEAR(claimed_T / std::sqrt(T2), 1, 0.15);
}

TEST(approach, a_record_that_cannot_tell_the_time_scale_is_not_fitted) {
  const std::vector<double> t{0, 1, 2, 3, 4, 5};
  EXPECT_FALSE(fit_approach(t, std::vector<double>{0, 1, 2, 3, 4, 5}));              // a straight line
  EXPECT_FALSE(fit_approach(t, std::vector<double>{0, -1, -1, -1, -1, -1}));         // the bed rises
  EXPECT_FALSE(fit_approach(std::vector<double>{0, 1}, std::vector<double>{0, 1}));  // two points
}

TEST(approach, equilibrium_needs_a_full_window_of_steady_depth) {
  std::vector<double> t, S;
  std::optional<double> when;
  for (int k = 0; k <= 600; ++k) {
    t.push_back(0.1 * k);
    S.push_back(0.9 * (1 - std::exp(-t.back() / 10)));
    if (!when && equilibrium(t, S, 5, 0.02)) when = t.back();
  }
  // means over the halves of the 5 s that end at t differ by 0.9 exp(-t/10) 4 (exp(0.25) - 1)^2 = 0.02
  ASSERT_TRUE(when);
  EXPECT_NEAR(*when, 10 * std::log(0.9 * 4 * std::pow(std::exp(0.25) - 1, 2) / 0.02), 0.3);
  EXPECT_NEAR(*equilibrium(t, S, 5, 0.02), 0.9, 0.01);
  EXPECT_FALSE(equilibrium(std::vector<double>{0, 1}, std::vector<double>{0.5, 0.5}, 5, 0.02));
}

TEST(approach, residuals_that_hang_together_widen_the_interval_as_much_as_repeated_experiments_scatter) {
  constexpr int experiments = 200;
  constexpr double memory = 0.9, sigma = 0.03;
  std::mt19937 random(5);
  std::normal_distribution<double> kick(0, sigma);
  double sum = 0, squares = 0, half_widths = 0;
  for (int n = 0; n < experiments; ++n) {
    std::vector<double> t, S;
    double noise = 0;
    for (int k = 0; k < 800; ++k) {
      t.push_back(0.01 * k);
      noise = memory * noise + std::sqrt(1 - memory * memory) * kick(random);
      S.push_back(0.6 * (1 - std::exp(-t.back())) + noise);
    }
    const auto fit = fit_approach(t, S);
    ASSERT_TRUE(fit);
    EXPECT_GT(fit->correlation, 2);
    EXPECT_LT(fit->correlation, 9);  // sqrt((1 + 0.9) / (1 - 0.9)) = 4.4
    sum += fit->S_eq, squares += fit->S_eq * fit->S_eq, half_widths += fit->error_S_eq * fit->correlation;
  }
  const double scatter = std::sqrt(squares / experiments - std::pow(sum / experiments, 2));
  EXPECT_NEAR(half_widths / experiments / scatter, 1, 0.25);
}

}  // namespace
}  // namespace livebed::base
