#include "base/sediment.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace livebed::base {
namespace {

constexpr double s = 2.65, g = 9.81, nu = 1e-6;

TEST(sediment, dimensionless_diameter_of_quartz_in_water) {
  EXPECT_NEAR(dimensionless_diameter(1e-3, s, g, nu), 25.296, 1e-3);
  EXPECT_NEAR(dimensionless_diameter(2e-3, s, g, nu) / dimensionless_diameter(1e-3, s, g, nu), 2, 1e-12);
}

TEST(sediment, threshold_has_its_known_values_and_limits) {
  EXPECT_NEAR(critical_shields(5.059), 0.0424 + 0.0053, 2e-4);  // sand of 0.2 mm
  EXPECT_NEAR(critical_shields(0), 0.30, 1e-12);
  EXPECT_NEAR(critical_shields(1e5), 0.055, 1e-5);
}

TEST(sediment, fine_sand_falls_as_in_oil_and_gravel_by_its_weight) {
  EXPECT_NEAR(fall_speed(0.36e-3, s, g, nu), 0.05453, 1e-5);
  const double fine = 20e-6, coarse = 0.05;
  EXPECT_NEAR(fall_speed(fine, s, g, nu), 1.049 / (2 * 10.36) * (s - 1) * g * fine * fine / nu, 2e-6);
  EXPECT_NEAR(fall_speed(coarse, s, g, nu), std::sqrt(1.049 * (s - 1) * g * coarse), 1e-2);
}

TEST(sediment, rouse_number_is_fall_over_lift) { EXPECT_NEAR(rouse_number(0.02, 0.05, 0.4), 1, 1e-12); }

TEST(sediment, transport_formulas_have_their_known_values) {
  EXPECT_NEAR(meyer_peter_mueller(0.33), 1.2043, 1e-3);
  EXPECT_EQ(meyer_peter_mueller(0.04), 0);
  EXPECT_NEAR(camenen_larson(0.33, 0.045), 12 * 0.18957 * 0.54139, 1e-3);
}

TEST(sediment, regime_follows_the_threshold_and_knows_what_a_pipe_does) {
  EXPECT_EQ(regime(0.06, 0.05, true), Regime::live_bed);
  EXPECT_EQ(regime(0.04, 0.05, true), Regime::clear_water);
  EXPECT_EQ(regime(0.04, 0.05, false), Regime::no_motion);
  EXPECT_EQ(regime(0.01, 0.05, true), Regime::no_motion);
}

TEST(sediment, equilibrium_depth_falls_with_the_gap_and_is_unknown_for_a_buried_pipe) {
  EXPECT_EQ(equilibrium_depth(0)->over_D, 0.6);
  EXPECT_EQ(equilibrium_depth(0)->scatter, 0.2);
  EXPECT_NEAR(equilibrium_depth(1)->over_D, 0.625 * std::exp(-0.6), 1e-12);
  EXPECT_EQ(equilibrium_depth(1)->scatter, 0);
  EXPECT_FALSE(equilibrium_depth(-0.3));
  EXPECT_FALSE(equilibrium_depth(2.5));
}

TEST(sediment, time_scale_of_maos_experiment_and_of_enlarged_grains) {
  EXPECT_NEAR(scour_time_scale(0.05, 0.00036, s, g, 0.33), 11.546, 1e-3);
  EXPECT_NEAR(scour_time_scale(0.05, 0.00036, s, g, 0.33) / scour_time_scale(0.05, 0.002, s, g, 0.33),
              std::pow(2 / 0.36, 1.5), 1e-9);
}

TEST(sediment, onset_needs_more_current_the_deeper_the_pipe_lies) {
  EXPECT_NEAR(onset_speed(0.5, s, g, 0.4, 0), std::sqrt(0.025 * g * 0.5 * 0.6 * 1.65), 1e-12);
  EXPECT_NEAR(onset_speed(0.5, s, g, 0.4, 0.25) / onset_speed(0.5, s, g, 0.4, 0), std::exp(2.25), 1e-9);
}

}  // namespace
}  // namespace livebed::base
