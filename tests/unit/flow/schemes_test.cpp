#include "flow/schemes.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace livebed::flow {
namespace {

/// Nodes at unequal distances with values from f.
template <class F>
Stencil4 stencil(F&& f) {
  const double h_mm = 0.8, h = 1.0, h_pp = 1.3, to_m = 0.45;  // the face is at 0
  return {f(-to_m - h_mm), f(-to_m), f(h - to_m), f(h - to_m + h_pp), h, 1 / h_mm, 1 / h, 1 / h_pp, to_m, h - to_m};
}

TEST(limited_slope, is_second_order_where_smooth_and_zero_at_extrema) {
  EXPECT_EQ(limited_slope(1, 1), 1);
  EXPECT_EQ(limited_slope(1, -2), 0);
  EXPECT_EQ(limited_slope(0, 3), 0);
  EXPECT_EQ(limited_slope(0, 0), 0);
  EXPECT_NEAR(limited_slope(1, 3), 1.5, 1e-15);
  EXPECT_NEAR(limited_slope(-1, -3), -1.5, 1e-15);
}

TEST(bounded, takes_a_line_to_the_middle_of_the_step) {
  // phi = 2 + 3 x carried at speed c: at the face, half a step on, it is 2 - 3 c dt/2.
  const Stencil4 s = stencil([](double x) { return 2 + 3 * x; });
  for (double c : {0.7, -0.7}) EXPECT_NEAR(Bounded::face(s, c, 0.4, 0, 0, 0), 2 - 3 * c * 0.2, 1e-14) << c;
}

TEST(bounded, adds_the_change_of_the_upwind_node_alone) {
  const Stencil4 s = stencil([](double) { return 5.0; });
  EXPECT_NEAR(Bounded::face(s, 1, 0.1, 0.25, 100, 0), 5.25, 1e-14);
  EXPECT_NEAR(Bounded::face(s, -1, 0.1, 100, 0.25, 0), 5.25, 1e-14);
}

TEST(bounded, stays_between_the_nodes_of_the_face) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  int limited = 0;
  for (int n = 0; n < 2000; ++n) {
    const Stencil4 s{value(random), value(random), value(random), value(random), 1, 1, 1, 1, 0.5, 0.5};
    for (double c : {0.6, -0.6}) {
      const double face = Bounded::face(s, c, 0.5, 0, 0, 0);
      EXPECT_GE(face, std::min(s.m, s.p) - 1e-14);
      EXPECT_LE(face, std::max(s.m, s.p) + 1e-14);
      limited += face == (c > 0 ? s.m : s.p);
    }
  }
  EXPECT_GT(limited, 500);  // extrema fall back on upwind
}

/// 2 + 3 x at nodes one metre apart, the face in the middle.
const Stencil4 even{-2.5, 0.5, 3.5, 6.5, 1, 1, 1, 1, 0.5, 0.5};

TEST(hybrid, is_central_below_a_peclet_number_of_two) {
  const Stencil4& s = even;
  const double gamma = 0.5;
  EXPECT_NEAR(Hybrid::face(s, 0.99, 1, 0, 0, gamma), 2, 1e-14);
  EXPECT_NEAR(Hybrid::face(s, -0.99, 1, 0, 0, gamma), 2, 1e-14);
}

TEST(hybrid, is_upwind_without_diffusion_above_a_peclet_number_of_two) {
  const Stencil4& s = even;
  const double gamma = 0.5;
  const auto convected_and_diffused = [&](double velocity) {
    return velocity * Hybrid::face(s, velocity, 1, 0, 0, gamma) - gamma * (s.p - s.m) / s.h;
  };
  EXPECT_NEAR(convected_and_diffused(1.01), 1.01 * s.m, 1e-14);
  EXPECT_NEAR(convected_and_diffused(-1.01), -1.01 * s.p, 1e-14);
  EXPECT_NEAR(convected_and_diffused(30), 30 * s.m, 1e-13);
}

TEST(hybrid, does_not_jump_where_it_leaves_central) {
  const Stencil4& s = even;
  EXPECT_NEAR(Hybrid::face(s, 1 - 1e-9, 1, 0, 0, 0.5), Hybrid::face(s, 1 + 1e-9, 1, 0, 0, 0.5), 1e-8);
}

}  // namespace
}  // namespace livebed::flow
