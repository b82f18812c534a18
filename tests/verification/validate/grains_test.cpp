#include <gtest/gtest.h>

#include "validate/grain_gas.hpp"

/// Short forms of what `livebed validate grains` runs.
namespace livebed::validate {
namespace {

TEST(grains, gas_of_a_thousand_elastic_grains_keeps_its_energy_and_momentum) {
  const GasRun run = run_gas({});
  std::printf("%lld collisions: energy within %.2g, momentum within %.2g\n", static_cast<long long>(run.collisions),
              run.drift, run.momentum);
  EXPECT_GT(run.collisions, 10000);
  EXPECT_LT(run.drift, 1e-4);
  EXPECT_LT(std::abs(run.momentum), 1e-12);
}

TEST(grains, damping_and_friction_never_add_energy) {
  for (const double restitution : {0.3, 0.6, 0.9}) {
    for (const double friction : {0.0, 0.5}) {
      const GasRun run = run_gas({.restitution = restitution, .friction = friction, .steps = 16000});
      std::printf("restitution %.1f, friction %.1f: %lld collisions, largest gain %.2g, energy left %.3f\n",
                  restitution, friction, static_cast<long long>(run.collisions), run.largest_gain, run.left);
      EXPECT_GT(run.collisions, 1000);
      EXPECT_LT(run.largest_gain, 1e-5);
      EXPECT_LT(run.left, 0.99);
      EXPECT_LT(std::abs(run.momentum), friction > 0 ? 1 : 1e-12);  // the floor rubs
    }
  }
}

}  // namespace
}  // namespace livebed::validate
