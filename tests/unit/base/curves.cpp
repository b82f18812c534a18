#include "base/curves.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace livebed::base {
namespace {

TEST(curves, interpolation_is_exact_on_straight_pieces_and_holds_the_ends) {
  const std::vector<double> x{0, 1, 3}, y{2, 4, 0};
  EXPECT_NEAR(interpolate(x, y, 0.25), 2.5, 1e-14);
  EXPECT_NEAR(interpolate(x, y, 2), 2, 1e-14);
  EXPECT_EQ(interpolate(x, y, 1), 4);
  EXPECT_EQ(interpolate(x, y, -1), 2);
  EXPECT_EQ(interpolate(x, y, 3), 0);
  EXPECT_EQ(interpolate(x, y, 9), 0);
}

TEST(curves, comparison_counts_only_the_points_inside_and_scores_the_baseline_zero) {
  const std::vector<double> x{0, 1, 2}, y{0, 2, 2}, at{-1, 0.5, 1.5, 3}, reference{9, 0.5, 3, 9};
  const auto result = compare(x, y, at, reference, 0);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->points, 2);
  EXPECT_NEAR(result->bias, (0.5 - 1) / 2, 1e-14);
  EXPECT_NEAR(result->rms, std::sqrt((0.25 + 1) / 2), 1e-14);
  EXPECT_NEAR(result->largest, 1, 1e-14);
  EXPECT_NEAR(result->skill, 1 - 1.25 / 9.25, 1e-14);
  EXPECT_NEAR(compare(x, std::vector<double>{0, 0, 0}, at, reference, 0)->skill, 0, 1e-14);
  EXPECT_FALSE(compare(x, y, std::vector<double>{5}, std::vector<double>{1}, 0));
  EXPECT_TRUE(std::isnan(compare(x, y, at, std::vector<double>{0, 0, 0, 0}, 0)->skill));
}

}  // namespace
}  // namespace livebed::base
