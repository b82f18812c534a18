#include "grains/slabs.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "base/loops.hpp"
#include "base/math.hpp"
#include "grains/advance.hpp"

namespace livebed::grains {
namespace {

/// Some rows of grains on one another, a long bed that nearly rests; each stands a little off the one below.
Bed long_bed(Precision precision = Precision::all_double, int columns = 400, int rows = 10) {
  Params p;
  p.precision = precision;
  p.stiffness = 5500, p.restitution = 0.3, p.spread = 0;
  p.count = columns * rows, p.length = 1.02 * columns * p.diameter;
  Bed bed = make_bed(derive(p));
  for (int i = 0; i < p.count; ++i) {
    const int row = i / columns;
    bed.state.x[i] = (i % columns + 0.5 + 0.004 * (row % 3)) * 1.02 * p.diameter;
    bed.state.y[i] = (row + 0.5) * p.diameter;
  }
  return bed;
}

std::vector<std::vector<double>> bits_of(const Bed& bed) {
  std::vector<std::vector<double>> all;
  each_array(bed, [&](const char*, const auto& a) { all.emplace_back(a.begin(), a.end()); });
  all.push_back({bed.pipe_impulse.x, bed.pipe_impulse.y, static_cast<double>(bed.contacts.rebuilds)});
  return all;
}

TEST(slabs, are_wide_enough_for_every_list) {
  Bed bed = long_bed();
  advance(bed, 1);
  const Records& r = bed.records;
  ASSERT_GE(r.slabs, 8);
  std::vector<int> slab(bed.contacts.slices());
  for (int s = 0; s < r.slabs; ++s)
    for (int n = r.slab_first[s]; n < r.slab_first[s + 1]; ++n) slab[r.awake[n]] = s;
  int beside = 0;
  for (int i = 0; i < bed.state.count(); ++i)
    for (const int j : neighbours_of(bed.state, bed.contacts, i)) {
      const int apart = std::abs(slab[i / lanes] - slab[j / lanes]);
      ASSERT_TRUE(apart <= 1 || apart == r.slabs - 1) << "grains " << i << " and " << j;
      beside += apart == 1;
    }
  EXPECT_GT(beside, 0);
}

TEST(slabs, make_steps_at_once_as_one_by_one) {
  for (const Precision precision : {Precision::all_double, Precision::mixed}) {
    Bed one_by_one = long_bed(precision);
    for (int n = 0; n < 100; ++n) advance(one_by_one, 1);
    ASSERT_EQ(one_by_one.contacts.rebuilds, 1);
    for (int threads : {1, 2, 3}) {
      base::set_threads(threads);
      Bed at_once = long_bed(precision);
      advance(at_once, 100);
      EXPECT_EQ(bits_of(at_once), bits_of(one_by_one)) << threads << " threads";
    }
    base::set_threads(1);
  }
}

TEST(slabs, make_steps_one_by_one_while_overlaps_fling_grains_away) {
  // At rest, but what is pressed into its neighbour is off its leash a few steps later.
  const auto pressed = [] {
    Bed bed = long_bed();
    for (const int i : {3650, 3700, 3990}) bed.state.y[i] -= 0.5 * bed.params.diameter;
    return bed;
  };
  Bed one_by_one = pressed();
  for (int n = 0; n < 60; ++n) advance(one_by_one, 1);
  ASSERT_GT(one_by_one.contacts.refreshed + one_by_one.contacts.rebuilds, 1);
  Bed at_once = pressed();
  advance(at_once, 60);
  EXPECT_EQ(bits_of(at_once), bits_of(one_by_one));
}

TEST(slabs, are_stepped_one_by_one_where_a_grain_is_fast) {
  Bed bed = long_bed();
  advance(bed, 1);
  const Sweep k = make_sweep(bed.params, bed.pipe, bed.state.count());
  EXPECT_EQ(plan_steps(k, bed.contacts, bed.records, bed.steps, true, 100), most_steps_at_once);
  EXPECT_EQ(plan_steps(k, bed.contacts, bed.records, bed.steps, true, 7), 7);
  bed.records.motion[1234].v = -0.5 * k.leash / (most_steps_at_once * k.dt);
  EXPECT_EQ(plan_steps(k, bed.contacts, bed.records, bed.steps, true, 100), 1);
  bed.records.motion[1234].v = bed.records.motion_next[1234].v;
  const double y = bed.records.place[1234].y;
  bed.records.place[1234].y = bed.contacts.y_built[1234] + 0.99999 * k.leash;  // nearly off
  EXPECT_EQ(plan_steps(k, bed.contacts, bed.records, bed.steps, true, 100), 1);
  bed.records.place[1234].y = y;
  EXPECT_EQ(plan_steps(k, bed.contacts, bed.records, bed.steps, true, 100), most_steps_at_once);
  bed.records.motion_next[1234].v += 0.5 * k.leash / (base::square(most_steps_at_once) * k.dt);  // pushed hard
  EXPECT_EQ(plan_steps(k, bed.contacts, bed.records, bed.steps, true, 100), 1);
  bed.records.motion_next[1234].v = bed.records.motion[1234].v;
  bed.records.motion_known = false;
  EXPECT_EQ(plan_steps(k, bed.contacts, bed.records, bed.steps, true, 100), 1);
  bed.records.motion_known = true;
  EXPECT_EQ(plan_steps(k, bed.contacts, bed.records, bed.steps, true, 100), most_steps_at_once);
  bed.records.own[100].push_x[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(plan_steps(k, bed.contacts, bed.records, bed.steps, true, 100), 1);
}

TEST(slabs, tell_of_a_grain_off_the_leash) {
  Bed bed = long_bed();
  advance(bed, 1);
  Sweep k = make_sweep(bed.params, bed.pipe, bed.state.count());
  k.leash = 0.2 * k.leash;
  bed.records.motion[1234].v = 2 * k.leash / (8 * k.dt);
  EXPECT_TRUE(sweep(k, bed.contacts, bed.records, 2));
  EXPECT_FALSE(sweep(k, bed.contacts, bed.records, 8));
}

}  // namespace
}  // namespace livebed::grains
