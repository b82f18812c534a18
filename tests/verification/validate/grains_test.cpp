#include <gtest/gtest.h>

#include "validate/grain_beds.hpp"
#include "validate/grain_gas.hpp"
#include "validate/grain_impact.hpp"
#include "validate/grain_silo.hpp"

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

TEST(grains, in_mixed_precision_keep_their_energy_and_move_as_in_double) {
  const GasRun gas = run_gas({.steps = 20000, .precision = grains::Precision::mixed});
  EXPECT_GT(gas.collisions, 3000);
  EXPECT_LT(gas.drift, 1e-4);
  EXPECT_LT(std::abs(gas.momentum), 1e-5);
  for (const double rolling : {0.0, 0.25}) {
    grains::Params p;
    p.stiffness = 5500, p.restitution = 0.3, p.rolling_friction = rolling;
    p.length = 0.0424, p.count = 240;
    const PrecisionRun run = compare_precision(p, 200);
    std::printf("rolling friction %.2f: velocities within %.2g (rms %.2g) of %.2g m/s, overlaps within %.2g\n", rolling,
                run.worst, run.mean, run.speed, run.overlap);
    EXPECT_LT(run.worst, 1e-4);
    EXPECT_LT(run.mean, 2e-5);
    EXPECT_LT(run.overlap, 5e-5);
    EXPECT_GT(run.mean, 0);
  }
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

TEST(grains, steep_impacts_slide_as_measured_and_flat_ones_stick) {
  EXPECT_NEAR(run_oblique_impact(49.60, 1 / 2.6).tangential_restitution, 0.8476, 0.005);
  EXPECT_NEAR(run_oblique_impact(79.23, 1 / 2.6).tangential_restitution, 0.9695, 0.005);
  EXPECT_LT(run_oblique_impact(5, 0.87).contact_angle, 4);
  EXPECT_EQ(impact_data("experiment", "final_spin_rad_s").angle.size(), 10u);
}

TEST(grains, heap_is_steeper_with_more_friction_and_with_rolling_resistance) {
  // The sides of single heaps differ by several degrees.
  const auto angle = [](double friction, double rolling) {
    double mean = 0;
    for (const unsigned seed : {1, 2, 3, 4})
      mean += run_heap({.grains = 150, .friction = friction, .rolling_friction = rolling, .seed = seed}).angle() / 4;
    std::printf("friction %.1f, rolling %.1f: %.1f degrees\n", friction, rolling, mean);
    return mean;
  };
  const double smooth = angle(0.1, 0), rough = angle(0.5, 0), resisting = angle(0.5, 0.3);
  EXPECT_GT(smooth, 8);
  EXPECT_GT(rough, smooth + 2);
  EXPECT_GT(resisting, rough + 3);
  EXPECT_LT(resisting, 40);
}

TEST(grains, floor_and_side_walls_of_a_bin_carry_its_weight) {
  // Means: of what the side walls carry one fill has half as much again as another.
  constexpr unsigned fills = 8;
  double sides = 0, janssen = 0, ratio = 0;
  for (unsigned seed = 1; seed <= fills; ++seed) {
    const SiloRun run = run_silo({.columns = 12, .rows = 24, .seed = seed});
    EXPECT_NEAR((run.floor + run.sides) / run.weight, 1, 1e-3);
    sides += run.sides / run.weight / fills;
    janssen += (1 - run.janssen()) / fills;
    ratio += run.lateral_ratio / fills;
  }
  std::printf("side walls carry %.3f, Janssen %.3f, K %.2f\n", sides, janssen, ratio);
  EXPECT_GT(sides, 0.5 * janssen);  // his walls carry all the friction they can
  EXPECT_LT(sides, janssen);
  EXPECT_GT(ratio, 0.3);
  EXPECT_LT(ratio, 1.2);
}

}  // namespace
}  // namespace livebed::validate
