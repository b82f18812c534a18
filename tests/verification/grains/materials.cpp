#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "bodies.hpp"
#include "grains/measures.hpp"

using namespace livebed;
using namespace livebed::grains;
using namespace livebed::grains::bodies;

namespace {

/// Two grains of these diameters fly at each other without gravity; ratio of the relative speeds.
double rebound(Params p, double d0, double d1) {
  p.gravity = 0;
  const double gap = 0.1 * p.diameter, v = 0.05, apart = 0.5 * (d0 + d1) + gap;
  Bed bed = bed_of(p, {{0.05, 0.05, v}, {0.05 + apart, 0.05, -v}});
  bed.state.diameter[0] = d0, bed.state.diameter[1] = d1;
  advance(bed, static_cast<int>(gap / v / bed.params.step));
  return (body(bed, 1).u - body(bed, 0).u) / (2 * v);
}

/// A grain dropped without gravity on the floor, or on the pipe when there is one; ratio of the speeds.
double rebound_of_wall(const Params& p, bool pipe) {
  Bed bed = bed_of(p, {{0.05, 0.03 + 0.55 * p.diameter, 0, -0.05}});
  if (pipe) {
    bed.pipe = {.present = true, .x = 0.05, .y = 0.02, .diameter = 0.02};
  } else {
    bed.state.y[0] -= 0.03;
  }
  advance(bed, static_cast<int>(0.1 * p.diameter / 0.05 / bed.params.step));
  return body(bed, 0).v / 0.05;
}

/// A grain on the floor, pushed along by a steady force of `push` weights; how far it has moved after 0.2 s [d].
double pushed(Params p, double push) {
  p.restitution = 0.3, p.steps_per_contact = 50;
  p.wall_factor = 1;
  const double weight = mass(p, p.diameter) * submerged_gravity(p);
  Bed bed = bed_of(p, {{0.05, 0.5 * p.diameter - weight / p.stiffness}});
  bed.state.fluid.fx[0] = push * weight;
  advance(bed, static_cast<int>(0.2 / bed.params.step));
  return (body(bed, 0).x - 0.05) / p.diameter;
}

}  // namespace

TEST(materials, hooke_gives_any_two_sizes_the_restitution_asked_for) {
  Params p = quartz();
  p.law = Law::hooke;
  p.steps_per_contact = 2000;
  for (const double e : {0.3, 0.8}) {
    p.restitution = e;
    EXPECT_NEAR(rebound(p, p.diameter, p.diameter), e, 2e-3);
    EXPECT_NEAR(rebound(p, p.diameter, 0.4 * p.diameter), e, 2e-3);
    EXPECT_NEAR(rebound(p, 1.3 * p.diameter, 0.7 * p.diameter), e, 2e-3);
  }
  // The paper's one dashpot brakes a light grain harder.
  p.law = Law::paper;
  EXPECT_LT(rebound(p, p.diameter, 0.4 * p.diameter), 0.72);
}

TEST(materials, of_pipe_and_floor_are_their_own) {
  Params p = quartz();
  p.gravity = 0;
  p.law = Law::hooke;
  p.steps_per_contact = 2000;
  p.restitution = 0.5;
  p.floor = Floor::plane;
  for (const double stiffness : {1.0, 3.0}) {
    p.pipe.stiffness = p.bottom.stiffness = stiffness;
    EXPECT_NEAR(rebound_of_wall(p, false), 0.5, 2e-3);
    EXPECT_NEAR(rebound_of_wall(p, true), 0.5, 2e-3);
  }
  p.pipe.damping = 0;
  EXPECT_NEAR(rebound_of_wall(p, false), 0.5, 2e-3);
  EXPECT_NEAR(rebound_of_wall(p, true), 1.0, 2e-3);
  p.bottom.damping = 0, p.pipe.damping = 1;
  EXPECT_NEAR(rebound_of_wall(p, false), 1.0, 2e-3);
  EXPECT_NEAR(rebound_of_wall(p, true), 0.5, 2e-3);
}

TEST(materials, rolling_resistance_holds_a_grain_up_to_its_moment) {
  // A force at the centre turns the grain about its contact: it rolls off above mu_r times the weight, not below.
  Params p = quartz();
  p.friction = 0.8;
  p.rolling_friction = 0.3;
  EXPECT_LT(pushed(p, 0.27), 0.05);
  EXPECT_GT(pushed(p, 0.33), 0.5);
  p.bottom.rolling = 0.5;  // half of that on the floor
  EXPECT_LT(pushed(p, 0.13), 0.05);
  EXPECT_GT(pushed(p, 0.17), 0.5);
  p.bottom.rolling = 0;
  EXPECT_GT(pushed(p, 0.02), 0.5);
}

TEST(materials, rolling_resistance_spins_a_sphere_down) {
  // Pressed on the floor without friction, it turns freely but for the moment mu_r R N: omega falls by
  // (5/2) mu_r g / r a second (2/5 m r^2 of inertia).
  Params p = quartz();
  p.wall_factor = 1;
  p.restitution = 0.3;
  p.rolling_friction = 0.1;
  const double g = submerged_gravity(p), weight = mass(p, p.diameter) * g, r = 0.5 * p.diameter;
  Bed bed = bed_of(p, {{0.05, r - weight / p.stiffness, 0, 0, 200}});
  const double t = 0.05;
  advance(bed, static_cast<int>(t / bed.params.step));
  EXPECT_NEAR(body(bed, 0).omega, 200 - 2.5 * p.rolling_friction * g / r * t, 0.3);
  advance(bed, static_cast<int>(0.5 / bed.params.step));
  EXPECT_NEAR(body(bed, 0).omega, 0, 1e-3);
}

TEST(materials, every_law_keeps_momentum_to_round_off) {
  for (const Law law : {Law::paper, Law::hooke}) {
    for (const double rolling : {0.0, 0.3}) {
      Params p = quartz();
      p.gravity = 0;
      p.law = law;
      p.rolling_friction = rolling;
      p.restitution = 0.5, p.friction = 0.4, p.steps_per_contact = 50;
      std::vector<Body> swarm;
      for (int i = 0; i < 100; ++i)
        swarm.push_back({0.02 + 1.05 * p.diameter * (i % 10), 0.02 + 1.05 * p.diameter * (i / 10), std::sin(7.0 * i),
                         std::cos(3.0 * i), 50 * std::sin(5.0 * i)});
      Bed bed = bed_of(p, swarm);
      for (int i = 0; i < 100; ++i) bed.state.diameter[i] *= 1 + 0.03 * std::sin(11.0 * i);
      const base::Vec2 before = momentum(bed.params, bed.state);
      const double energy = kinetic_energy(bed.params, bed.state);
      advance(bed, 300);
      const base::Vec2 after = momentum(bed.params, bed.state);
      const double scale = 100 * mass(bed.params, p.diameter);
      EXPECT_NEAR(after.x, before.x, 1e-14 * scale);
      EXPECT_NEAR(after.y, before.y, 1e-14 * scale);
      EXPECT_LT(kinetic_energy(bed.params, bed.state), 0.9 * energy);
    }
  }
}
