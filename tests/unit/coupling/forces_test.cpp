#include "coupling/forces.hpp"

#include <gtest/gtest.h>

namespace livebed::coupling {
namespace {

constexpr double rho = 1000, nu = 1e-6, d = 1e-3;

TEST(saffman_mei_lift, is_that_of_saffman_at_small_reynolds_numbers) {
  const double slip = 1e-6, omega = 1.0;  // Re = 1e-3; alpha^(1/2) = 22
  const double root = std::sqrt(0.5 * omega * d / slip), mei = (1 - 0.3314 * root) * std::exp(-1e-4) + 0.3314 * root;
  EXPECT_NEAR(saffman_mei_lift(slip, omega, d, rho, nu), 1.615 * rho * d * d * std::sqrt(nu / omega) * mei,
              1e-12 * rho * d * d * std::sqrt(nu));
  EXPECT_NEAR(mei, 1, 1e-3);
}

TEST(saffman_mei_lift, fades_at_large_reynolds_numbers) {
  const double slip = 0.1, omega = 20.0;  // Re = 100
  const double mei = 0.0524 * std::sqrt(0.5 * omega * d / slip * 100);
  EXPECT_NEAR(saffman_mei_lift(slip, omega, d, rho, nu), 1.615 * rho * d * d * std::sqrt(nu / omega) * mei,
              1e-12 * rho * d * d);
  EXPECT_EQ(saffman_mei_lift(0.0, omega, d, rho, nu), 0);
  EXPECT_EQ(saffman_mei_lift(slip, 0.0, d, rho, nu), 0);
}

TEST(share_followed, is_all_of_slow_eddies_and_none_of_fast_ones) {
  EXPECT_NEAR(share_followed(1, 1e-3, 6.0), std::exp(-1e-3), 1e-14);
  EXPECT_LT(share_followed(1, 1e-2, 1e-3), 1e-20);
  EXPECT_EQ(share_followed(0, 1e-2, 1e-3), 1);
}

}  // namespace
}  // namespace livebed::coupling
