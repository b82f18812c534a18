#include "grains/walls.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "../../verification/grains/bodies.hpp"
#include "base/fault.hpp"
#include "base/math.hpp"
#include "grains/laws.hpp"
#include "grains/measures.hpp"

using namespace livebed;
using namespace livebed::grains;
using namespace livebed::grains::bodies;

namespace {

/// Elastic, smooth, weightless: what a wall does to the direction alone.
Params weightless() {
  Params p = quartz();
  p.gravity = 0;
  p.wall_factor = 1;
  return p;
}

double speed(const Body& b) { return std::hypot(b.u, b.v); }

}  // namespace

TEST(walls, are_pieces_that_know_their_neighbours) {
  Params p = quartz();
  p.walls = {{{0, 0}, {1, 0}, {1, 1}, {0, 0}}, {{2, 0}, {2, 3}}};
  const std::vector<Segment> all = make_segments(p);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].before, 2) << "a closed line goes round";
  EXPECT_EQ(all[2].after, 0);
  EXPECT_EQ(all[1].before, 0);
  EXPECT_EQ(all[3].before, -1);
  EXPECT_EQ(all[3].after, -1);
  EXPECT_DOUBLE_EQ(all[3].along(5, 1.5), 0.5);
}

TEST(walls, that_are_none_are_refused) {
  Params p = quartz();
  p.walls = {{{0, 0}}};
  EXPECT_THROW(make_segments(p), base::Fault);
  p.walls = {{{0, 0}, {1, 0}, {1, 0}}};
  EXPECT_THROW(make_segments(p), base::Fault);
}

TEST(walls, reflect_a_grain_from_either_side) {
  Params p = weightless();
  p.walls = {{{0.04, 0.02}, {0.06, 0.04}}};  // 45 degrees
  for (const double side : {-1.0, 1.0}) {
    const double reach = 0.6 * p.diameter * std::sqrt(2.0);
    Bed bed = bed_of(p, {{0.05, 0.03 + side * 2 * reach, 0, -side * 0.1}});
    advance(bed, static_cast<int>(4 * reach / 0.1 / bed.params.step));
    EXPECT_NEAR(body(bed, 0).v, 0, 2e-4);
    EXPECT_NEAR(body(bed, 0).u, -side * 0.1, 2e-4);
  }
}

TEST(walls, touch_a_grain_once_at_a_corner_that_points_at_it) {
  // A grain that lands on the tip of a roof is thrown straight back: two contacts would make the spring twice as stiff.
  Params p = weightless();
  p.walls = {{{0.045, 0.015}, {0.05, 0.02}, {0.055, 0.015}}};
  Bed bed = bed_of(p, {{0.05, 0.02 + 0.51 * p.diameter, 0, -0.1}});
  double deepest = 0;
  const int steps = static_cast<int>(critical_time(mass(p, p.diameter), p.stiffness) / bed.params.step);
  for (int k = 0; k < 2 * steps; ++k) {
    advance(bed, 1);
    deepest = std::max(deepest, 0.02 + 0.5 * p.diameter - body(bed, 0).y);
  }
  EXPECT_NEAR(body(bed, 0).v, 0.1, 1e-4);
  EXPECT_NEAR(deepest, 0.1 * std::sqrt(mass(p, p.diameter) / p.stiffness), 1e-3 * deepest);
}

TEST(walls, carry_a_grain_in_a_hollow_with_two_contacts) {
  // In a groove of 45 degrees either side carries weight / sqrt(2).
  Params p = quartz();
  p.restitution = 0.3;
  p.steps_per_contact = 50;
  p.wall_factor = 1;
  p.walls = {{{0.04, 0.03}, {0.05, 0.02}, {0.06, 0.03}}};
  const double up = 0.5 * p.diameter * std::sqrt(2.0);
  Bed bed = bed_of(p, {{0.05, 0.02 + up, 0, 0}});
  advance(bed, 40000);
  const double weight = mass(p, p.diameter) * submerged_gravity(p);
  EXPECT_NEAR(up - (body(bed, 0).y - 0.02), weight / p.stiffness, 1e-3 * weight / p.stiffness);
  EXPECT_LT(speed(body(bed, 0)), 1e-8);
}

TEST(walls, keep_the_spring_of_a_grain_at_rest_through_new_lists) {
  // A rough slope holds a grain that cannot roll, for as long as its spring is kept: tan 20 degrees < mu.
  Params p = quartz();
  p.restitution = 0.3, p.steps_per_contact = 50;
  p.friction = 0.6, p.rolling_friction = 0.6;
  p.wall_factor = 1;
  const double slope = std::tan(20 * base::pi / 180), normal = std::hypot(1.0, slope);
  p.walls = {{{0.02, 0.01}, {0.08, 0.01 + 0.06 * slope}}};
  Bed bed = bed_of(p, {{0.05, 0.01 + 0.03 * slope + 0.5 * p.diameter * normal, 0, 0}});
  advance(bed, 20000);
  const Body before = body(bed, 0);
  for (int k = 0; k < 20; ++k) {
    rebuild(bed.state, bed.contacts, bed.scratch, reach_of(bed.params), bed.pipe, make_segments(bed.params));
    advance(bed, 500);
  }
  EXPECT_NEAR(body(bed, 0).x, before.x, 1e-6 * p.diameter);
  EXPECT_NEAR(body(bed, 0).y, before.y, 1e-6 * p.diameter);
}

TEST(walls, at_the_sides_keep_the_grains_in_and_apart) {
  Params p = weightless();
  p.side_walls = true;
  p.length = 0.05;
  // One grain at each wall: through the period they would be in each other.
  Bed bed = bed_of(p, {{0.45 * p.diameter, 0.05, 0, 0}, {p.length - 0.51 * p.diameter, 0.05, 0.3, 0}});
  const double energy = kinetic_energy(bed.params, bed.state) + 0.5 * p.stiffness * base::square(0.05 * p.diameter);
  advance(bed, 40000);
  EXPECT_NEAR(kinetic_energy(bed.params, bed.state), energy, 2e-3 * energy);
  for (int id : {0, 1}) {
    EXPECT_GT(body(bed, id).x, 0.3 * p.diameter);
    EXPECT_LT(body(bed, id).x, p.length - 0.3 * p.diameter);
  }
  EXPECT_GT(std::abs(body(bed, 1).u), 0.05);
}
