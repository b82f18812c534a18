#include "grains/forces.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "grains/measures.hpp"
#include "grains/packing.hpp"

using namespace livebed;
using namespace livebed::grains;

namespace {

/// A settled bed with a pipe in it, set in motion by a shear flow.
Bed bed_in_motion(Law law, Floor floor) {
  Params p;
  p.stiffness = 5500;
  p.restitution = 0.3;
  p.length = 0.053;
  p.count = 301;  // not a multiple of the lanes
  p.spread = 0.2;
  p.law = law;
  p.floor = floor;
  Bed bed = pack(p).bed;
  place_pipe(bed, {.present = true, .x = 0.02, .y = 0.022, .diameter = 0.015}, 0.2);
  for (int i = 0; i < bed.state.count(); ++i) {
    bed.state.fluid.beta[i] = 2e-4;
    bed.state.fluid.u[i] = 60 * bed.state.y[i];
    bed.state.fluid.fx[i] = 1e-6;
  }
  advance(bed, 400);
  return bed;
}

TEST(contact_forces, are_those_that_move_the_grains_and_the_pipe) {
  for (const Law law : {Law::paper, Law::hooke})
    for (const Floor floor : {Floor::plane, Floor::grains}) {
      Bed bed = bed_in_motion(law, floor);
      const int n = bed.state.count();
      const double dt = bed.params.step, g = submerged_gravity(bed.params);
      std::vector<base::Vec2> force(n), before(n);
      const std::vector<base::Vec2> told = contact_forces(bed);
      base::Vec2 on_pipe;
      visit_contacts(bed, [&](const TouchingPair& pair) {
        if (pair.j == the_pipe) on_pipe = on_pipe - pair.force();
      });
      double largest = 0;
      for (int i = 0; i < n; ++i) {
        force[bed.state.id[i]] = told[i];
        before[bed.state.id[i]] = {bed.state.u[i], bed.state.v[i]};
        largest = std::max(largest, base::norm(told[i]));
      }
      EXPECT_GT(largest, 1e-4);
      bed.pipe_impulse = {};
      advance(bed, 1);
      const State& s = bed.state;
      for (int i = 0; i < n; ++i) {
        // (m + dt beta) u1 = m u0 + dt (F + weight + f + beta U), solved for F.
        const double m = mass(bed.params, s.diameter[i]), beta = s.fluid.beta[i];
        const base::Vec2 u0 = before[s.id[i]];
        const double x = ((m + dt * beta) * s.u[i] - m * u0.x) / dt - s.fluid.fx[i] - beta * s.fluid.u[i];
        const double y = ((m + dt * beta) * s.v[i] - m * u0.y) / dt + m * g;
        ASSERT_NEAR(force[s.id[i]].x, x, 1e-9 * largest) << "grain " << s.id[i];
        ASSERT_NEAR(force[s.id[i]].y, y, 1e-9 * largest) << "grain " << s.id[i];
      }
      EXPECT_GT(base::norm(on_pipe), 1e-5);
      EXPECT_NEAR(on_pipe.x, bed.pipe_impulse.x / dt, 1e-9 * largest);
      EXPECT_NEAR(on_pipe.y, bed.pipe_impulse.y / dt, 1e-9 * largest);
    }
}

TEST(contact_forces, tell_every_pair_once_and_leave_the_bed_as_it_is) {
  const Bed bed = bed_in_motion(Law::paper, Floor::grains);
  const SlotArray springs = bed.contacts.spring;
  int pairs = 0;
  visit_contacts(bed, [&](const TouchingPair& pair) {
    if (pair.j < 0) return;
    ++pairs;
    EXPECT_LT(pair.i, pair.j);
    EXPECT_GT(pair.overlap, 0.0);
    EXPECT_GE(pair.normal, 0.0);
    EXPECT_NEAR(base::norm(pair.direction), 1.0, 1e-14);
    const double radii = 0.5 * (bed.state.diameter[pair.i] + bed.state.diameter[pair.j]);
    EXPECT_NEAR(base::norm(pair.branch) + pair.overlap, radii, 1e-15);
  });
  EXPECT_EQ(2.0 * pairs / bed.state.count(), measure_contacts(bed).per_grain);
  EXPECT_TRUE(springs == bed.contacts.spring);
}

}  // namespace
