#include "validate/contours.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace livebed::validate {
namespace {

struct Grid {
  std::vector<double> x, y, values;
};
template <class Function>
Grid grid(Function&& f) {
  Grid g;
  for (int i = 0; i <= 60; ++i) g.x.push_back(-1.5 + 0.05 * i);
  for (int j = 0; j <= 40; ++j) g.y.push_back(-1.2 + 0.06 * j);
  for (double y : g.y)
    for (double x : g.x) g.values.push_back(f(x, y));
  return g;
}

TEST(contours, a_circle_is_one_closed_line) {
  const Grid g = grid([](double x, double y) { return std::hypot(x, y); });
  const std::vector<Line> lines = contour_lines(g.x, g.y, g.values, 0.83, 1e-3);
  ASSERT_EQ(lines.size(), 1u);
  const Line& c = lines.front();
  EXPECT_NEAR(c.x.front(), c.x.back(), 1e-12);
  EXPECT_NEAR(c.y.front(), c.y.back(), 1e-12);
  double length = 0;
  for (std::size_t k = 0; k < c.x.size(); ++k) {
    EXPECT_NEAR(std::hypot(c.x[k], c.y[k]), 0.83, 2e-3);
    if (k > 0) length += std::hypot(c.x[k] - c.x[k - 1], c.y[k] - c.y[k - 1]);
  }
  EXPECT_NEAR(length, 2 * std::acos(-1.0) * 0.83, 0.02);
}

TEST(contours, a_straight_line_crosses_the_grid_with_two_points) {
  const Grid g = grid([](double x, double y) { return x + 0.3 * y; });
  const std::vector<Line> lines = contour_lines(g.x, g.y, g.values, 0.111, 1e-6);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines.front().x.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(lines.front().x[k] + 0.3 * lines.front().y[k], 0.111, 1e-12);
}

TEST(contours, branches_of_a_hyperbola_stay_apart) {
  const Grid g = grid([](double x, double y) { return x * y; });
  EXPECT_EQ(contour_lines(g.x, g.y, g.values, 0.01, 1e-3).size(), 2u);
  EXPECT_EQ(contour_lines(g.x, g.y, g.values, 5.0, 1e-3).size(), 0u);
}

}  // namespace
}  // namespace livebed::validate
