#include "grains/ends.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "grains/forces.hpp"
#include "grains/packing.hpp"

using namespace livebed;
using namespace livebed::grains;

namespace {

Params small_bed() {
  Params p;
  p.stiffness = 5500;
  p.restitution = 0.3;
  p.rolling_friction = 0.2;
  p.length = 0.053;
  p.count = 301;  // not a multiple of the lanes
  return p;
}

/// A settled bed that begins to move.
Bed bed_in_motion() {
  Bed bed = pack(small_bed()).bed;
  for (int i = 0; i < bed.state.count(); ++i) {
    bed.state.fluid.beta[i] = 2e-4;
    bed.state.fluid.u[i] = 20 * bed.state.y[i];
  }
  advance(bed, 200);
  return bed;
}

int place_of(const Bed& bed, int id) {
  const auto& ids = bed.state.id;
  return static_cast<int>(std::find(ids.begin(), ids.end(), id) - ids.begin());
}

/// Contact force on each grain that is in the bed, by id.
std::vector<base::Vec2> forces_by_id(const Bed& bed) {
  std::vector<base::Vec2> by_id(bed.params.count);
  const std::vector<base::Vec2> forces = contact_forces(bed);
  for (int i = 0; i < bed.state.count(); ++i) by_id[bed.state.id[i]] = forces[i];
  return by_id;
}

}  // namespace

TEST(ends, who_leaves_is_gone_and_all_others_feel_what_they_felt) {
  Bed bed = bed_in_motion();
  const std::vector<base::Vec2> before = forces_by_id(bed);
  const std::vector<int> gone = {7, 120, 121, 300};
  std::vector<char> beside(bed.params.count, 0);  // those that leave, and who touched them
  std::vector<int> leaving;
  for (const int id : gone) leaving.push_back(place_of(bed, id)), beside[id] = 1;
  visit_contacts(bed, [&](const TouchingPair& pair) {
    if (pair.j < 0) return;
    const int a = bed.state.id[pair.i], b = bed.state.id[pair.j];
    for (const int id : gone)
      if (a == id || b == id) beside[a] = beside[b] = 1;
  });
  exchange_grains(bed, leaving, {});
  EXPECT_EQ(bed.state.count(), bed.params.count - 4);
  check_count(bed);
  for (const int id : gone) EXPECT_EQ(place_of(bed, id), bed.state.count());
  const std::vector<base::Vec2> after = forces_by_id(bed);
  double largest = 0;
  int compared = 0;
  for (int id = 0; id < bed.params.count; ++id) {
    if (beside[id]) continue;
    ++compared;
    largest = std::max(largest, base::norm(before[id]));
    EXPECT_NEAR(after[id].x, before[id].x, 1e-12 * largest);
    EXPECT_NEAR(after[id].y, before[id].y, 1e-12 * largest);
  }
  EXPECT_GT(compared, 250);
  EXPECT_GT(largest, 0);
  advance(bed, 100);
  check_count(bed);
}

TEST(ends, newcomers_come_in_as_they_are_told) {
  Bed bed = bed_in_motion();
  const int id = 42, place = place_of(bed, id);
  const double diameter = bed.state.diameter[place];
  exchange_grains(bed, {place}, {});
  EXPECT_EQ(bed.state.count(), bed.params.count - 1);
  const Newcomer back{.x = 0.01, .y = 0.06, .u = 0.2, .v = -0.1, .omega = 3, .diameter = diameter, .id = id};
  // One leaves as another comes; afterwards the bed is whole again.
  const int other = place_of(bed, 43);
  const double other_diameter = bed.state.diameter[other];
  exchange_grains(bed, {other}, {back});
  EXPECT_EQ(bed.state.count(), bed.params.count - 1);
  exchange_grains(bed, {}, {{.x = 0.03, .y = 0.06, .u = 0, .v = 0, .omega = 0, .diameter = other_diameter, .id = 43}});
  EXPECT_EQ(bed.state.count(), bed.params.count);
  check_count(bed);
  const int now = place_of(bed, id);
  const State& s = bed.state;
  EXPECT_EQ(s.x[now], 0.01);
  EXPECT_EQ(s.y[now], 0.06);
  EXPECT_EQ(s.u[now], 0.2);
  EXPECT_EQ(s.v[now], -0.1);
  EXPECT_EQ(s.omega[now], 3);
  EXPECT_EQ(s.diameter[now], diameter);
  EXPECT_EQ(s.impulse_x[now], 0);
  advance(bed, 100);
  EXPECT_NEAR(s.x[place_of(bed, id)], 0.01 + 0.2 * 100 * bed.params.step, 1e-4);
}

TEST(ends, laps_are_counted_both_ways) {
  Params p = small_bed();
  p.count = 2;
  Bed bed = make_bed(derive(p));
  State& s = bed.state;
  s.x = {0.05, 0.002}, s.y = {0.02, 0.04}, s.u = {1.0, -0.5}, s.v = {0.0, 0.0};
  const double time = 0.1;
  const int calls = static_cast<int>(time / (20 * bed.params.step));
  for (int n = 0; n < calls; ++n) {
    std::fill(s.v.begin(), s.v.end(), 0.0);  // they do not fall
    advance(bed, 20);
  }
  // 0.1 m and 0.05 m in a box of 0.053 m.
  EXPECT_EQ(s.laps[place_of(bed, 0)], 2);
  EXPECT_EQ(s.laps[place_of(bed, 1)], -1);
}
