#include "base/spectrum.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"

namespace livebed::base {
namespace {

/// A tone of frequency 0.237 with a weaker one of twice that and a drift, at uneven times.
void make_signal(std::vector<double>& t, std::vector<double>& s) {
  double at = 0;
  for (int k = 0; at < 100; ++k) {
    t.push_back(at);
    s.push_back(3 + 0.002 * at + 0.5 * std::sin(2 * pi * 0.237 * at) + 0.1 * std::sin(4 * pi * 0.237 * at));
    at += 0.05 + 0.03 * std::sin(0.7 * k);
  }
}

TEST(spectrum, finds_the_frequency_far_between_its_lines) {
  std::vector<double> t, s;
  make_signal(t, s);
  EXPECT_NEAR(peak_frequency(power_spectrum(t, s, 1)), 0.237, 2e-4);  // lines are 2.5e-3 apart
}

TEST(spectrum, its_integral_is_the_variance) {
  std::vector<double> t, s;
  make_signal(t, s);
  const Spectrum spectrum = power_spectrum(t, s, 1);
  double power = 0;
  for (double p : spectrum.power) power += p * (spectrum.frequency[1] - spectrum.frequency[0]);
  EXPECT_NEAR(power / square(time_rms(t, s)), 1, 0.05);
  EXPECT_NEAR(time_rms(t, s), std::sqrt(0.5 * (0.25 + 0.01) + square(0.2) / 12), 0.01);
  EXPECT_NEAR(time_mean(t, s), 3.1, 0.01);
}

TEST(spectrum, crossings_are_a_period_apart) {
  std::vector<double> t, s;
  make_signal(t, s);
  const std::vector<double> up = upward_crossings(t, s);
  EXPECT_NEAR(static_cast<double>(up.size()), 23.5, 1);
  EXPECT_NEAR((up.back() - up.front()) / static_cast<double>(up.size() - 1), 1 / 0.237, 0.02);
}

TEST(spectrum, of_a_constant_has_no_peak) {
  std::vector<double> t, s;
  for (int k = 0; k < 200; ++k) t.push_back(k), s.push_back(2);
  EXPECT_EQ(peak_frequency(power_spectrum(t, s, 0.4)), 0);
}

}  // namespace
}  // namespace livebed::base
