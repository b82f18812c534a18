#include "grains/sizes.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "base/math.hpp"
#include "grains/laws.hpp"

using namespace livebed;
using namespace livebed::grains;

namespace {

/// Sand around 0.36 mm as sieves show it.
const Grading sand{{0.25e-3, 0.1}, {0.36e-3, 0.5}, {0.5e-3, 0.9}};

Params graded(int count, unsigned seed = 1) {
  Params p;
  p.grading = sand;
  p.stiffness = 50;
  p.restitution = 0.3;
  p.count = count;
  p.seed = seed;
  return derive(p);
}

std::string refusal(const Grading& grading) {
  try {
    check_grading(grading);
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), base::Exit::invalid_case);
    return fault.what();
  }
  return "accepted";
}

}  // namespace

TEST(sizes, of_a_sieve_curve_are_log_linear_between_its_points_and_beyond) {
  for (const SievePoint& p : sand) {
    EXPECT_NEAR(diameter_at(sand, p.passing), p.diameter, 1e-15);
    EXPECT_NEAR(passing_at(sand, p.diameter), p.passing, 1e-12);
  }
  EXPECT_NEAR(diameter_at(sand, 0.3), std::sqrt(0.25 * 0.36) * 1e-3, 1e-15);
  EXPECT_NEAR(diameter_at(sand, 0), 0.25e-3 * std::pow(0.25 / 0.36, 0.25), 1e-15);
  EXPECT_NEAR(diameter_at(sand, 1), 0.5e-3 * std::pow(0.5 / 0.36, 0.25), 1e-15);
  for (double passing = 0.02; passing < 1; passing += 0.07) {
    EXPECT_NEAR(passing_at(sand, diameter_at(sand, passing)), passing, 1e-12);
  }
  EXPECT_EQ(passing_at(sand, 0.1e-3), 0);
  EXPECT_EQ(passing_at(sand, 1e-3), 1);
}

TEST(sizes, sampled_follow_the_sieve_curve_by_mass) {
  for (const int n : {1000, 20000}) {
    const std::vector<double> d = sample_diameters(graded(n));
    double all = 0;
    for (const double one : d) all += base::cube(one);
    double worst = 0;
    for (double sieve = 0.2e-3; sieve < 0.6e-3; sieve += 0.004e-3) {
      double finer = 0;
      for (const double one : d) finer += one <= sieve ? base::cube(one) : 0;
      worst = std::max(worst, std::abs(finer / all - passing_at(sand, sieve)));
    }
    EXPECT_LT(worst, 5.0 / n) << n << " grains";  // the largest of a thousand grains holds half a percent of the mass
    EXPECT_GT(worst, 0.1 / n);
  }
}

TEST(sizes, sampled_have_the_mean_area_and_the_mean_volume_of_the_curve) {
  const Params p = graded(5000);
  double square = 0, cube = 0;
  for (const double one : sample_diameters(p)) {
    square += base::square(one) / p.count;
    cube += base::cube(one) / p.count;
    EXPECT_GE(one, smallest_diameter(p));
    EXPECT_LE(one, largest_diameter(p));
  }
  EXPECT_NEAR(cube / mean_power(p, 3), 1, 1e-10);
  EXPECT_NEAR(square / mean_power(p, 2), 1, 1e-5);

  Params even;
  even.count = 5000;
  even.spread = 0.3;
  square = cube = 0;
  for (const double one : sample_diameters(even)) {
    square += base::square(one) / even.count;
    cube += base::cube(one) / even.count;
  }
  EXPECT_NEAR(square / mean_power(even, 2), 1, 1e-7);
  EXPECT_NEAR(cube / mean_power(even, 3), 1, 1e-7);
}

TEST(sizes, sampled_depend_on_the_seed_in_their_order_alone) {
  const std::vector<double> a = sample_diameters(graded(500, 1)), b = sample_diameters(graded(500, 1)),
                            c = sample_diameters(graded(500, 2));
  EXPECT_TRUE(a == b);
  EXPECT_FALSE(a == c);
  std::vector<double> in_order = a, others = c;
  std::sort(in_order.begin(), in_order.end());
  std::sort(others.begin(), others.end());
  EXPECT_TRUE(in_order == others);
  // Large and small are mixed: the first half of the grains has the mass of half of them.
  double first = 0, all = 0;
  for (int i = 0; i < 500; ++i) (i < 250 ? first : all) += base::cube(a[i]);
  EXPECT_NEAR(first / (all + first), 0.5, 0.05);
}

TEST(sizes, equal_ones_are_equal_to_the_bit) {
  Params p;
  p.count = 100;
  p.spread = 0;
  for (const double one : sample_diameters(p)) EXPECT_EQ(one, p.diameter);
  EXPECT_EQ(smallest_diameter(p), p.diameter);
  EXPECT_EQ(largest_diameter(p), p.diameter);
  EXPECT_NEAR(mean_power(p, 3), base::cube(p.diameter), 1e-12 * base::cube(p.diameter));
}

TEST(sizes, the_smallest_grains_set_the_step_and_d50_is_the_diameter) {
  const Params p = graded(10);
  EXPECT_NEAR(p.diameter, 0.36e-3, 1e-15);
  EXPECT_NEAR(p.step * p.steps_per_contact, critical_time(mass(p, smallest_diameter(p)), p.stiffness), 1e-15);
  const double slower =
      critical_time(mass(p, p.diameter), p.stiffness) / critical_time(mass(p, smallest_diameter(p)), p.stiffness);
  EXPECT_NEAR(slower, std::pow(p.diameter / smallest_diameter(p), 1.5), 1e-9);
  EXPECT_NEAR(slower, 1.98, 0.01);
}

TEST(sizes, a_curve_out_of_order_or_too_wide_is_refused) {
  EXPECT_EQ(refusal(sand), "accepted");
  EXPECT_NE(refusal({{1e-3, 0.5}}).find("at least two"), std::string::npos);
  EXPECT_NE(refusal({{1e-3, 0.5}, {0.9e-3, 0.9}}).find("must rise"), std::string::npos);
  EXPECT_NE(refusal({{1e-3, 0.5}, {1.2e-3, 0.5}}).find("must rise"), std::string::npos);
  EXPECT_NE(refusal({{1e-3, 0.5}, {1.2e-3, 1.5}}).find("[0, 1]"), std::string::npos);
  EXPECT_NE(refusal({{0, 0.1}, {1.2e-3, 0.5}}).find("wider than 0"), std::string::npos);
  EXPECT_NE(refusal({{0.1e-3, 0}, {0.5e-3, 1}}).find("5 times the smallest"), std::string::npos);
  EXPECT_EQ(refusal({{0.1e-3, 0}, {0.4e-3, 1}}), "accepted");
}
