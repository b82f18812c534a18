#include <cmath>
#include <gtest/gtest.h>

#include "grains/measures.hpp"
#include "grains/packing.hpp"
#include "grains/sizes.hpp"

using namespace livebed;
using namespace livebed::grains;

namespace {

/// Sand of many sizes, the contacts of the default preset.
Params graded_bed(const Grading& grading, int count) {
  Params p;
  p.grading = grading;
  p.stiffness = 200;
  p.restitution = 0.3;
  p.steps_per_contact = 30;
  p.floor = Floor::grains;
  p.count = count;
  p.length = 40 * diameter_at(grading, 0.5);
  return p;
}

const Grading sand{{0.25e-3, 0.1}, {0.36e-3, 0.5}, {0.5e-3, 0.9}};
/// As wide as is allowed, and most grains are small.
const Grading widest{{0.2e-3, 0}, {0.8e-3, 1}};

}  // namespace

TEST(graded, bed_comes_to_rest_and_its_floor_carries_it) {
  for (const Grading& grading : {sand, widest}) {
    Params p = graded_bed(grading, 500);
    p.floor = Floor::plane;
    Packing packing = pack(p);
    Bed& bed = packing.bed;
    EXPECT_LT(mean_speed(bed.state), 1e-5);
    advance(bed, 2000);
    EXPECT_LT(mean_speed(bed.state), 1e-5);
    double weight = 0, carried = 0;
    for (int i = 0; i < bed.state.count(); ++i) {
      weight += mass(bed.params, bed.state.diameter[i]) * submerged_gravity(bed.params);
      carried += p.wall_factor * p.stiffness * std::max(0.0, 0.5 * bed.state.diameter[i] - bed.state.y[i]);
    }
    EXPECT_NEAR(carried, weight, 2e-3 * weight);
    const ContactMeasures contacts = measure_contacts(bed);
    EXPECT_GT(contacts.per_grain, 2.5);
    EXPECT_LT(contacts.per_grain, 4);
    EXPECT_LT(contacts.largest_overlap, 4 * static_overlap(bed.params, bed_height(bed.state)));
    EXPECT_GT(contacts.largest_overlap, 0.5 * static_overlap(bed.params, bed_height(bed.state)));
    const double filled = solid_thickness(bed.params, bed.state) / bed_height(bed.state);
    EXPECT_GT(filled, 0.78);
    EXPECT_LT(filled, 0.9);
  }
}

TEST(graded, momentum_of_a_loose_heap_changes_by_the_fluids_impulse_alone) {
  Params p = graded_bed(widest, 400);
  p.gravity = 0;
  p.steps_per_contact = 40;
  Bed bed = lattice(p);
  for (int i = 0; i < bed.state.count(); ++i) {
    bed.state.y[i] += 1;
    bed.state.u[i] = 0.5 * std::sin(1.7 * i);
    bed.state.v[i] = 0.5 * std::cos(2.3 * i);
    bed.state.fluid.beta[i] = 1e-5 * bed.state.diameter[i] / p.length;
    bed.state.fluid.u[i] = 0.2;
  }
  const base::Vec2 before = momentum(bed.params, bed.state);
  double overlap = 0;
  for (int look = 0; look < 30; ++look) {
    advance(bed, 100);
    overlap = std::max(overlap, measure_contacts(bed).largest_overlap);
  }
  const base::Vec2 change = momentum(bed.params, bed.state) - before, given = fluid_impulse(bed.state);
  const double size = std::abs(given.x) + std::abs(before.x) + std::abs(before.y);
  EXPECT_GT(overlap, 1e-4);
  EXPECT_GT(given.x, 1e-3 * size);
  EXPECT_NEAR(change.x, given.x, 1e-12 * size);
  EXPECT_NEAR(change.y, given.y, 1e-12 * size);
}
