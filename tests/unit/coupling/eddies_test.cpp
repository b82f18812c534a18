#include "coupling/eddies.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <map>

namespace livebed::coupling {
namespace {

grains::State some_grains(int count) {
  grains::State g;
  g.x.assign(count, 0.0);
  for (int k = 0; k < count; ++k) g.id.push_back(k);
  return g;
}

struct Moments {
  double mean_u = 0, mean_v = 0, square_u = 0, square_v = 0, product = 0, with_before = 0;
};

TEST(eddies, have_the_variance_and_the_memory_of_the_turbulence) {
  const int count = 4000;
  const grains::State g = some_grains(count);
  Eddies eddies(count, 7);
  const Eddies::Eddy same{0.1, 0, 0, 0.02, 0.5};
  std::vector<double> before(count, 0.0);
  Moments m;
  const double dt = 0.005;
  for (int n = 0; n < 60; ++n) {
    m = {};
    eddies.advance(
        g, dt, [&](int) { return same; },
        [&](int k, double u, double v) {
          m.mean_u += u / count, m.mean_v += v / count;
          m.square_u += u * u / count, m.square_v += v * v / count, m.product += u * v / count;
          m.with_before += u * before[k] / count;
          before[k] = u;
        });
  }
  const double scatter = 0.01 / std::sqrt(count);  // of a mean of sigma^2 = 0.01
  EXPECT_NEAR(m.mean_u, 0, 4 * 0.1 / std::sqrt(count));
  EXPECT_NEAR(m.mean_v, 0, 4 * 0.1 / std::sqrt(count));
  EXPECT_NEAR(m.square_u, 0.01, 6 * scatter);
  EXPECT_NEAR(m.square_v, 0.01, 6 * scatter);
  EXPECT_NEAR(m.product, 0, 4 * scatter);
  EXPECT_NEAR(m.with_before, 0.01 * std::exp(-dt / 0.02), 6 * scatter);
}

TEST(eddies, know_the_grain_and_not_its_place_in_storage) {
  grains::State g = some_grains(50);
  Eddies one(50, 3), other(50, 3);
  std::map<int, double> first;
  const auto same = [](int) { return Eddies::Eddy{0.1, 0, 0, 0.02, 0.5}; };
  one.advance(g, 0.01, same, [&](int k, double u, double) { first[g.id[k]] = u; });
  std::reverse(g.id.begin(), g.id.end());
  other.advance(g, 0.01, same, [&](int k, double u, double) { EXPECT_EQ(u, first[g.id[k]]); });
  Eddies seeded(50, 4);
  int equal = 0;
  seeded.advance(g, 0.01, same, [&](int k, double u, double) { equal += u == first[g.id[k]]; });
  EXPECT_EQ(equal, 0);
}

/// Grains without inertia in a closed layer whose turbulence is weak at one side stay spread evenly.
TEST(eddies, do_not_gather_where_the_turbulence_is_weak) {
  const int count = 4000;
  const grains::State g = some_grains(count);
  Eddies eddies(count, 11);
  std::vector<double> y(count);
  for (int k = 0; k < count; ++k) y[k] = (k + 0.5) / count;
  const auto sigma = [](double at) { return 0.2 + 0.8 * at; };
  const double dt = 0.01;
  for (int n = 0; n < 600; ++n)
    eddies.advance(
        g, dt,
        [&](int k) {
          return Eddies::Eddy{sigma(y[k]), 0, 0.8, 0.1, 0};
        },
        [&](int k, double, double v) {
          y[k] += dt * v;
          if (y[k] < 0) y[k] = -y[k];
          if (y[k] > 1) y[k] = 2 - y[k];
        });
  int low = 0;
  for (double at : y) low += at < 0.25;
  EXPECT_NEAR(low / static_cast<double>(count), 0.25, 0.05);
}

}  // namespace
}  // namespace livebed::coupling
