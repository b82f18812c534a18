#include <cmath>
#include <gtest/gtest.h>

#include "bodies.hpp"
#include "grains/measures.hpp"
#include "grains/packing.hpp"
#include "grains/sizes.hpp"

using namespace livebed;
using namespace livebed::grains;
using namespace livebed::grains::bodies;

namespace {

/// A small bed with the contacts of the default preset.
Params livebed_bed(int columns, int rows) {
  Params p;
  p.stiffness = 5500;
  p.restitution = 0.3;
  p.length = 1.06 * columns * p.diameter;
  p.count = columns * rows;
  return p;
}

/// The paper's contacts: equal disks on a floor of grains, alpha = 1, spring in tension and spring limit to the letter.
Params mbs2d_bed(int columns, int rows) {
  Params p = livebed_bed(columns, rows);
  p.length = 1.01 * columns * p.diameter;
  p.spread = 0;
  p.restitution = 0;
  p.damping = 1;
  p.steps_per_contact = 60;
  p.inertia = Inertia::disk;
  p.tension = Tension::spring;
  p.friction_limit = FrictionLimit::spring_force;
  p.floor = Floor::grains;
  return p;
}

double weight(const Params& p, double d) { return mass(p, d) * submerged_gravity(p); }

}  // namespace

TEST(bed, grain_at_rest_sinks_its_weight_over_the_wall_spring) {
  Params p = quartz();
  p.restitution = 0.5;
  Bed bed = bed_of(p, {{0.01, 0.5 * p.diameter}});
  advance(bed, 20000);
  const double sunk = weight(bed.params, p.diameter) / (p.wall_factor * p.stiffness);
  EXPECT_NEAR(0.5 * p.diameter - body(bed, 0).y, sunk, 1e-6 * sunk);
}

TEST(bed, column_of_grains_is_pressed_by_what_lies_above) {
  Params p = quartz();
  p.restitution = 0.3;
  p.steps_per_contact = 40;
  std::vector<Body> column;
  const int n = 6;
  for (int i = 0; i < n; ++i) column.push_back({0.01, (i + 0.5) * p.diameter});
  Bed bed = bed_of(p, column);
  advance(bed, 40000);
  const double sunk = weight(bed.params, p.diameter) / p.stiffness;
  for (int i = 1; i < n; ++i) {
    const double overlap = p.diameter - (body(bed, i).y - body(bed, i - 1).y);
    EXPECT_NEAR(overlap, (n - i) * sunk, 1e-6 * sunk) << "below grain " << i;
  }
  EXPECT_NEAR(0.5 * p.diameter - body(bed, 0).y, n * sunk / p.wall_factor, 1e-6 * sunk);
  EXPECT_NEAR(measure_contacts(bed).largest_overlap * p.diameter, (n - 1) * sunk, 1e-6 * sunk);
  EXPECT_NEAR(static_overlap(bed.params, n * p.diameter) * p.diameter, n * sunk, 1e-12 * sunk);
}

TEST(bed, grain_rests_in_the_hollow_of_a_floor_of_grains) {
  Params p = quartz();
  p.restitution = 0.3;
  p.steps_per_contact = 40;
  p.friction = 0.5;
  p.floor = Floor::grains;
  const double spacing = p.length / std::round(p.length / p.diameter);
  // Above every hollow around the seam: the fixed grains alternate across it.
  for (const double hollow : {0.0, 1.0, 2.0, 48.0, 49.0}) {
    Bed bed = bed_of(p, {{hollow * spacing, 1e-3}});
    advance(bed, 40000);
    const double y = std::sqrt(base::square(p.diameter) - base::square(0.5 * spacing)) - 0.5 * p.diameter;
    EXPECT_NEAR(body(bed, 0).y, y, 1e-5 * p.diameter);
    EXPECT_NEAR(std::abs(nearest_image(body(bed, 0).x - hollow * spacing, p.length)), 0, 1e-5 * p.diameter);
  }
}

TEST(bed, grain_driven_over_a_floor_of_grains_never_falls_through) {
  Params p = quartz();
  p.restitution = 0.5;
  p.steps_per_contact = 40;
  p.friction = 0.5;
  p.floor = Floor::grains;
  Bed bed = bed_of(p, {{0.05, 2e-3}});
  bed.state.fluid.beta[0] = 1e-3;
  bed.state.fluid.u[0] = 1;
  double lowest = 1, travelled = 0;
  for (int look = 0; look < 4000; ++look) {
    const double before = body(bed, 0).x;
    advance(bed, 20);
    lowest = std::min(lowest, body(bed, 0).y);
    travelled += nearest_image(body(bed, 0).x - before, p.length);
  }
  EXPECT_GT(travelled, 2 * p.length);
  EXPECT_GT(lowest, 0.35 * p.diameter);
}

TEST(bed, sinking_grain_follows_linear_drag) {
  Params p = quartz();
  Bed bed = bed_of(p, {{0.01, 1.0}});
  const double m = mass(bed.params, p.diameter), time = 0.01;
  bed.state.fluid.beta[0] = m / time;
  const double terminal = submerged_gravity(p) * time;
  const int steps = static_cast<int>(std::lround(2 * time / bed.params.step));
  advance(bed, steps);
  const double t = steps * bed.params.step;
  EXPECT_NEAR(body(bed, 0).v, -terminal * (1 - std::exp(-t / time)), 1e-3 * terminal);
  // The impulse of the drag is what the weight gave and the grain does not carry.
  EXPECT_NEAR(fluid_impulse(bed.state).y, m * body(bed, 0).v + m * submerged_gravity(p) * t, 1e-11 * m * terminal);
  advance(bed, 20 * steps);
  EXPECT_NEAR(body(bed, 0).v, -terminal, 1e-9 * terminal);
}

TEST(bed, grain_takes_up_the_current_however_strong_the_drag) {
  Params p = quartz();
  p.gravity = 0;
  Bed bed = bed_of(p, {{0.01, 1.0}});
  bed.state.fluid.beta[0] = 1e6 * mass(bed.params, p.diameter) / bed.params.step;  // explicit drag would explode
  bed.state.fluid.u[0] = 0.7;
  advance(bed, 3);
  EXPECT_NEAR(body(bed, 0).u, 0.7, 1e-5);
  // The impulse is made of the way the grain went, which the rounding of its place limits: here a million times more
  // than with a drag that a grain step resolves.
  const double ulp = std::nextafter(0.01, 1) - 0.01;
  EXPECT_NEAR(fluid_impulse(bed.state).x, mass(bed.params, p.diameter) * body(bed, 0).u,
              4 * bed.state.fluid.beta[0] * ulp);
}

TEST(bed, momentum_of_a_loose_heap_changes_by_the_fluids_impulse_alone) {
  Params p = livebed_bed(12, 10);
  p.gravity = 0;
  Bed bed = lattice(p);
  for (int i = 0; i < bed.state.count(); ++i) {
    bed.state.y[i] += 1;
    bed.state.u[i] = 0.1 * std::sin(1.7 * i);
    bed.state.v[i] = 0.1 * std::cos(2.3 * i);
    bed.state.omega[i] = 50 * std::sin(0.7 * i);
    bed.state.fluid.beta[i] = 1e-4;
    bed.state.fluid.u[i] = 0.2;
    bed.state.fluid.fy[i] = 1e-5;
  }
  const base::Vec2 before = momentum(bed.params, bed.state);
  double overlap = 0;
  for (int look = 0; look < 30; ++look) {
    advance(bed, 100);
    overlap = std::max(overlap, measure_contacts(bed).largest_overlap);
  }
  const base::Vec2 change = momentum(bed.params, bed.state) - before, given = fluid_impulse(bed.state);
  EXPECT_GT(overlap, 1e-4);
  EXPECT_GT(given.x, 1e-5);
  EXPECT_NEAR(change.x, given.x, 1e-13 * given.x * 10);
  EXPECT_NEAR(change.y, given.y, 1e-13 * given.x * 10);
}

TEST(bed, both_sides_of_every_contact_remember_the_same_bits) {
  const Bed settled = pack(livebed_bed(12, 8)).bed;
  for (const Precision precision : {Precision::all_double, Precision::mixed}) {
    Bed bed = settled;
    bed.params.precision = precision;
    for (int i = 0; i < bed.state.count(); ++i) bed.state.u[i] += 0.005 * std::sin(1.1 * bed.state.id[i]);
    advance(bed, 200);
    const Contacts& c = bed.contacts;
    const auto spring = [&](int i, int j) {
      for (int row = c.first[i / lanes]; row < c.last[i / lanes]; ++row) {
        const int slot = row * lanes + i % lanes;
        if (c.neighbour[slot] == j) return c.spring[slot];
      }
      ADD_FAILURE() << j << " is not in the list of " << i;
      return 0.0;
    };
    int remembered = 0;
    for (int i = 0; i < bed.state.count(); ++i) {
      for (const int j : neighbours_of(bed.state, c, i)) {
        EXPECT_EQ(spring(i, j), spring(j, i));
        remembered += spring(i, j) != 0;
      }
    }
    EXPECT_GT(remembered, bed.state.count() / 2);
  }
}

TEST(bed, comes_to_rest_with_the_contacts_of_both_presets) {
  for (const Params& p : {livebed_bed(20, 12), mbs2d_bed(20, 12)}) {
    Packing packing = pack(p);
    Bed& bed = packing.bed;
    ASSERT_GT(packing.convergence.size(), 10u);
    EXPECT_GT(packing.convergence.front().mean_speed, 100 * p.settled_speed);
    EXPECT_LT(mean_speed(bed.state), 1e-5);
    double worst = 0;
    for (int look = 0; look < 20; ++look) {  // and stays so without any fluid
      advance(bed, 500);
      worst = std::max(worst, mean_speed(bed.state));
    }
    EXPECT_LT(worst, 1e-5);
    EXPECT_LT(measure_contacts(bed).largest_overlap, 5e-3);
    EXPECT_GT(measure_contacts(bed).per_grain, 2.9);
    // A plane packing of circles fills 0.78 (the square lattice) to 0.9069 (the densest).
    const double filled = solid_thickness(bed.params, bed.state) / bed_height(bed.state);
    EXPECT_GT(filled, 0.75);
    EXPECT_LT(filled, 0.93);
  }
}

TEST(bed, full_damping_at_twenty_steps_a_contact_shakes_for_ever) {
  Params p = mbs2d_bed(20, 12);
  p.steps_per_contact = 20;
  p.settle_time = 0.5;
  try {
    pack(p);
    FAIL() << "the bed came to rest";
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), base::Exit::stopped_by_limit);
    EXPECT_NE(std::string(fault.what()).find("contact.steps"), std::string::npos) << fault.what();
  }
}

TEST(bed, one_grain_in_a_thousand_may_tremble_and_not_two) {
  // Grains at rest on the floor, and others pressed between so many walls that the step is too long for their dashpots.
  const auto wedged = [](int trembling) {
    Params p = quartz();
    p.restitution = 0.3;
    p.friction = 0.55;
    p.rolling_friction = 0.25;
    p.steps_per_contact = 20;
    std::vector<Body> grains;
    for (int i = 0; i < 1200; ++i) grains.push_back({1.2 * (i + 0.5) * p.diameter, 0.5 * p.diameter});
    p.length = (1200 * 1.2 + 10 * trembling) * p.diameter;
    for (int i = 0; i < trembling; ++i) {
      const double x = p.length - (10 * i + 5) * p.diameter;
      grains.push_back({x, 0.5 * p.diameter, 0.0, 0.0, 100.0});
      for (double side : {-0.45, -0.45, -0.45, 0.45}) {
        const double at = x + side * p.diameter;
        p.walls.push_back({{at, 0.0}, {at, 3 * p.diameter}});
      }
    }
    return bed_of(p, grains);
  };
  Bed one = wedged(1);
  const SettleRow last = settle(one).back();
  EXPECT_GT(last.mean_speed, one.params.settled_speed);
  EXPECT_NEAR(last.max_speed, 1201 * last.mean_speed, 0.1 * last.max_speed);
  Bed two = wedged(2);
  EXPECT_THROW(settle(two), base::Fault);
}

TEST(bed, floor_carries_the_weight_of_the_bed) {
  Packing packing = pack(livebed_bed(20, 12));
  const Bed& bed = packing.bed;
  double total = 0, carried = 0;
  for (int i = 0; i < bed.state.count(); ++i) {
    total += weight(bed.params, bed.state.diameter[i]);
    carried +=
        bed.params.wall_factor * bed.params.stiffness * std::max(0.0, 0.5 * bed.state.diameter[i] - bed.state.y[i]);
  }
  EXPECT_NEAR(carried, total, 2e-3 * total);
}

TEST(bed, pipe_comes_down_on_the_bed_and_into_it_without_knocks) {
  Packing packing = pack(livebed_bed(40, 14));
  const double level = bed_height(packing.bed.state), D = 0.02, x = 0.5 * packing.bed.params.length;
  double height_touched = 0, height_embedded = 0;
  for (const double gap : {0.0, -0.5}) {
    Bed bed = packing.bed;
    const Circle target{.present = true, .x = x, .y = level + (0.5 + gap) * D, .diameter = D};
    const auto rows = place_pipe(bed, target);
    EXPECT_EQ(bed.pipe.y, target.y);
    EXPECT_LT(rows.front().max_speed, 0.3);
    EXPECT_LT(mean_speed(bed.state), 1e-5);
    double deepest = 0;
    for (int i = 0; i < bed.state.count(); ++i) {
      const double distance = std::hypot(bed.state.x[i] - x, bed.state.y[i] - target.y);
      deepest = std::max(deepest, 0.5 * (D + bed.state.diameter[i]) - distance);
    }
    EXPECT_LT(deepest, 0.02 * bed.params.diameter);
    EXPECT_LT(measure_contacts(bed).largest_overlap, 0.02);
    const bool embedded = gap < 0;
    (embedded ? height_embedded : height_touched) = bed_height(bed.state);
    // What the grains give the pipe from now on is the force of a bed at rest: it may press, not pull.
    bed.pipe_impulse = {};
    advance(bed, 1000);
    const double force = bed.pipe_impulse.y / (1000 * bed.params.step);
    EXPECT_GE(force, -1e-9);
    EXPECT_TRUE(force > 1e-5 || !embedded) << force;  // one that lies on the bed may find itself between grains
  }
  // The grains made way: half the pipe's area, lifted by some millimetres, less what the bed was compacted.
  EXPECT_GT(height_embedded, height_touched + 1e-4);
  EXPECT_LT(height_embedded, height_touched + 3e-3);
}

TEST(bed, pipe_receives_what_a_grain_loses) {
  Params p = quartz();
  p.gravity = 0;
  p.friction = 0.3;
  p.restitution = 0.6;
  Bed bed = bed_of(p, {{0.0385, 0.05, 0.2, 0.01}});
  bed.pipe = {.present = true, .x = 0.05, .y = 0.053, .diameter = 0.02};
  const base::Vec2 before = momentum(bed.params, bed.state);
  for (int k = 0; k < 300; ++k) advance(bed, 50);
  const base::Vec2 lost = before - momentum(bed.params, bed.state);
  EXPECT_GT(lost.x, 1e-7);
  EXPECT_NEAR(bed.pipe_impulse.x, lost.x, 1e-12 * lost.x);
  EXPECT_NEAR(bed.pipe_impulse.y, lost.y, 1e-12 * lost.x);
}

TEST(bed, solids_flux_counts_volumes_in_a_slab_one_grain_thick) {
  Params p = quartz();
  Bed bed = bed_of(p, {{0.01, 0.5, 0.3}, {0.05, 0.5, 0.1}});
  EXPECT_NEAR(solids_flux(bed.params, bed.state), base::sphere_volume(2e-3) * 0.4 / (0.1 * 2e-3), 1e-15);
}
