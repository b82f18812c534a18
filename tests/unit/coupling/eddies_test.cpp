#include "coupling/eddies.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "base/math.hpp"

namespace livebed::coupling {
namespace {

struct Moments {
  double mean_u = 0, mean_v = 0, square_u = 0, square_v = 0, product = 0, with_before = 0;
};

TEST(eddies, have_the_energy_of_a_stream_over_a_bed_and_the_memory_of_the_turbulence) {
  const int count = 4000;
  Eddies eddies(count, 7);
  const double k = 0.01, energy_x = Eddies::energy_across * k, energy_y = Eddies::energy_along * k;
  const Eddies::Eddy same{k, {}, 0.02};
  std::vector<double> before(count, 0.0);
  Moments m;
  const double dt = 0.005;
  for (int n = 0; n < 60; ++n) {
    m = {};
    eddies.begin_step();
    for (int g = 0; g < count; ++g) {
      const auto [u, v] = eddies.advance(g, dt, {0, 1}, same, same, 0.01);  // a stream that rises
      m.mean_u += u / count, m.mean_v += v / count;
      m.square_u += u * u / count, m.square_v += v * v / count, m.product += u * v / count;
      m.with_before += u * before[g] / count;
      before[g] = u;
    }
  }
  const double scatter = 1 / std::sqrt(count);
  EXPECT_NEAR(m.mean_u, 0, 4 * std::sqrt(energy_x) * scatter);
  EXPECT_NEAR(m.mean_v, 0, 4 * std::sqrt(energy_y) * scatter);
  EXPECT_NEAR(m.square_u, energy_x, 6 * energy_x * scatter);
  EXPECT_NEAR(m.square_v, energy_y, 6 * energy_y * scatter);
  EXPECT_NEAR(m.product, 0, 4 * std::sqrt(energy_x * energy_y) * scatter);
  EXPECT_NEAR(m.with_before, energy_x * std::exp(-dt / 0.02), 6 * energy_x * scatter);
}

TEST(eddies, along_and_across_the_stream_may_be_others) {
  const int count = 4000;
  Eddies eddies(count, 5);
  const Eddies::Eddy strong{0.04, {}, 0.05}, none{0, {}, 0.01};
  double along = 0, across = 0;
  for (int n = 0; n < 30; ++n) {
    eddies.begin_step();
    along = across = 0;
    for (int g = 0; g < count; ++g) {
      const base::Vec2 felt = eddies.advance(g, 0.01, {0.6, 0.8}, strong, none, 0.01);
      along += base::square(0.6 * felt.x + 0.8 * felt.y) / count, across += std::abs(0.8 * felt.x - 0.6 * felt.y);
    }
  }
  EXPECT_NEAR(along, Eddies::energy_along * 0.04, 6 * Eddies::energy_along * 0.04 / std::sqrt(count));
  EXPECT_LT(across, 1e-12);
}

TEST(eddies, last_as_long_as_the_turbulence_or_viscosity_says) {
  // In the stream k/epsilon is long, at a smooth wall (epsilon = 0.2 u*^4/nu) T_L is 10 nu/u*^2.
  EXPECT_DOUBLE_EQ(Eddies::life_time(0.2, 0.01, 0.005, 1e-6), 0.4);
  const double u_star = 0.04, nu = 1e-6, epsilon = 0.2 * std::pow(u_star, 4) / nu;
  EXPECT_NEAR(Eddies::life_time(0.2, 1e-5, epsilon, nu), 10 * nu / (u_star * u_star), 0.1 * nu / (u_star * u_star));
}

TEST(eddies, know_the_grain_the_step_and_the_seed_and_nothing_else) {
  const Eddies::Eddy same{0.01, {}, 0.02};
  const auto of = [&](Eddies& e, int k) { return e.advance(k, 0.01, {1, 0}, same, same, 0.01).x; };
  Eddies forwards(50, 3), backwards(50, 3), seeded(50, 4);
  std::vector<double> first(50);
  for (Eddies* e : {&forwards, &backwards, &seeded}) e->begin_step();
  for (int k = 0; k < 50; ++k) first[k] = of(forwards, k);
  for (int k = 49; k >= 0; --k) {
    EXPECT_EQ(of(backwards, k), first[k]);
    EXPECT_NE(of(seeded, k), first[k]);
    EXPECT_NE(first[k], first[(k + 1) % 50]);
  }
  forwards.begin_step();
  EXPECT_NE(of(forwards, 7), first[7]);
}

/// Grains without inertia in a closed layer whose turbulence is weak at one side stay spread evenly.
TEST(eddies, do_not_gather_where_the_turbulence_is_weak) {
  const int count = 4000;
  Eddies eddies(count, 11);
  std::vector<double> y(count);
  for (int k = 0; k < count; ++k) y[k] = (k + 0.5) / count;
  const auto sigma = [](double at) { return 0.2 + 0.8 * at; };
  const double dt = 0.01;
  for (int n = 0; n < 600; ++n) {
    eddies.begin_step();
    for (int k = 0; k < count; ++k) {
      // Across the stream the fluctuation is sqrt(energy_across k).
      const double size = std::sqrt(Eddies::energy_across), root = sigma(y[k]) / size;
      const Eddies::Eddy here{root * root, {0, 0.8 / size}, 0.1};
      y[k] += dt * eddies.advance(k, dt, {1, 0}, here, here, 0).y;
      if (y[k] < 0) y[k] = -y[k];
      if (y[k] > 1) y[k] = 2 - y[k];
    }
  }
  int low = 0;
  for (double at : y) low += at < 0.25;
  EXPECT_NEAR(low / static_cast<double>(count), 0.25, 0.05);
}

}  // namespace
}  // namespace livebed::coupling
