#include "grains/sleep.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "../../verification/grains/bodies.hpp"
#include "base/loops.hpp"
#include "grains/measures.hpp"
#include "grains/packing.hpp"

using namespace livebed;
using namespace livebed::grains;

namespace {

/// A bed that has come to rest and may sleep from now on.
Bed bed_at_rest(int count = 400, double rolling_friction = 0) {
  Params p;
  p.stiffness = 5500, p.restitution = 0.3;
  p.rolling_friction = rolling_friction;
  p.length = 0.053, p.count = count;
  Bed bed = pack(p).bed;
  bed.params.sleep = true;
  return bed;
}

int falls_asleep_within(const Bed& bed) {
  return static_cast<int>(4 * bed.params.sleep_time * std::sqrt(bed.params.diameter / submerged_gravity(bed.params)) /
                          bed.params.step);
}

/// The highest grain of a bed.
int highest(const Bed& bed) {
  return static_cast<int>(std::max_element(bed.state.y.begin(), bed.state.y.end()) - bed.state.y.begin());
}

}  // namespace

TEST(sleep, comes_to_a_bed_at_rest_and_changes_nothing) {
  Bed bed = bed_at_rest();
  const double height = bed_height(bed.state);
  advance(bed, falls_asleep_within(bed));
  EXPECT_GT(share_asleep(bed.state), 0.95);
  const State before = bed.state;
  advance(bed, 5000);
  EXPECT_EQ(bed_height(bed.state), bed_height(before));
  EXPECT_NEAR(bed_height(bed.state), height, 1e-6 * height);
}

TEST(sleep, does_not_come_unless_asked_for) {
  Bed bed = bed_at_rest();
  bed.params.sleep = false;
  advance(bed, falls_asleep_within(bed));
  EXPECT_EQ(share_asleep(bed.state), 0);
  EXPECT_TRUE(bed.state.sleep.asleep.empty());
}

TEST(sleep, ends_for_those_whom_a_falling_grain_hits) {
  Bed bed = bed_at_rest();
  advance(bed, falls_asleep_within(bed));
  // A heavy blow: the highest grain is thrown down.
  const int top = highest(bed), id = bed.state.id[top];
  bed.params.sleep = false;
  advance(bed, 1);
  bed.params.sleep = true;
  const int now = bodies::place_of(bed, id);
  bed.state.v[now] = -2;
  const double x = bed.state.x[now];
  advance(bed, 400);
  int near_awake = 0, near = 0;
  for (int i = 0; i < bed.state.count(); ++i) {
    const bool close = std::abs(nearest_image(bed.state.x[i] - x, bed.params.length)) < 2 * bed.params.diameter;
    near += close && bed.state.y[i] > bed_height(bed.state) - 3 * bed.params.diameter;
    near_awake +=
        close && bed.state.y[i] > bed_height(bed.state) - 3 * bed.params.diameter && bed.state.sleep.asleep[i] == 0;
  }
  EXPECT_GT(near, 3);
  EXPECT_EQ(near_awake, near);
}

TEST(sleep, ends_when_the_current_drags) {
  Bed bed = bed_at_rest();
  advance(bed, falls_asleep_within(bed));
  const double w = mass(bed.params, bed.params.diameter) * submerged_gravity(bed.params);
  // A grain that little but its own weight presses; the highest may be wedged.
  const Array& load = bed.state.sleep.load;
  const int top = static_cast<int>(std::min_element(load.begin(), load.end()) - load.begin());
  ASSERT_EQ(bed.state.sleep.asleep[top], 1);
  const int id = bed.state.id[top];
  // Below the threshold it sleeps on, and its impulse is counted all the same.
  const double limit = bed.params.sleep_drag * load[top];
  EXPECT_GT(limit, bed.params.sleep_drag * w);
  EXPECT_LT(limit, 3 * bed.params.sleep_drag * w);
  bed.state.fluid.fx[top] = 0.5 * limit;
  bed.state.impulse_x[top] = 0;
  advance(bed, 100);
  EXPECT_EQ(bed.state.sleep.asleep[bodies::place_of(bed, id)], 1);
  EXPECT_NEAR(bed.state.impulse_x[bodies::place_of(bed, id)], 0.5 * limit * 100 * bed.params.step, 1e-12 * w);
  bed.state.fluid.fx[bodies::place_of(bed, id)] = 2 * limit;
  advance(bed, 1);
  EXPECT_EQ(bed.state.sleep.asleep[bodies::place_of(bed, id)], 0);
}

TEST(sleep, ends_from_the_top_down_when_water_lifts_the_whole_bed) {
  // Less than what presses the grains below, more than their weight: only the top feels it at once.
  Bed bed = bed_at_rest();
  advance(bed, falls_asleep_within(bed));
  const double before = share_asleep(bed.state), height = bed_height(bed.state);
  EXPECT_GT(before, 0.9);
  for (int i = 0; i < bed.state.count(); ++i)
    bed.state.fluid.fy[i] = 1.3 * mass(bed.params, bed.state.diameter[i]) * submerged_gravity(bed.params);
  const double fall = std::sqrt(2 * bed.params.diameter / submerged_gravity(bed.params));
  advance(bed, static_cast<int>(10 * fall / bed.params.step));
  EXPECT_EQ(share_asleep(bed.state), 0.0);
  EXPECT_GT(bed_height(bed.state), height + bed.params.diameter);
}

TEST(sleep, ends_when_what_a_grain_lies_on_is_taken_away) {
  // Columns between walls: when the pipe below goes, all that sleeps above has to come down.  Beds that nobody sleeps
  // in fall by 1.98 to 2.16 d, so it is the mean of five that is compared.
  constexpr unsigned beds = 5;
  Params p;
  double asleep_fell = 0, awake_fell = 0;  // means [d]
  for (unsigned seed = 1; seed <= beds; ++seed) {
    p.stiffness = 5500, p.restitution = 0.3;
    p.length = 0.053, p.count = 300, p.seed = seed;
    Bed bed = pack(p).bed;
    place_pipe(bed, {.present = true, .x = 0.025, .y = 0.0125, .diameter = 0.015});
    bed.params.sleep = true;
    advance(bed, falls_asleep_within(bed));
    EXPECT_GT(share_asleep(bed.state), 0.5);
    const double height = bed_height(bed.state);
    bed.pipe.present = false;
    Bed awake = bed;
    awake.params.sleep = false;
    const int steps = static_cast<int>(0.4 / bed.params.step);
    advance(bed, steps);
    advance(awake, steps);
    asleep_fell += (height - bed_height(bed.state)) / (beds * p.diameter);
    awake_fell += (height - bed_height(awake.state)) / (beds * p.diameter);
  }
  EXPECT_GT(awake_fell, 1.5);
  EXPECT_NEAR(asleep_fell, awake_fell, 0.25);
}

TEST(sleep, keeps_histories_of_both_sides_equal) {
  // Sleepers wake and fall asleep in a bed that is shaken again and again; no pair may forget who pushed whom.
  Bed bed = bed_at_rest(300, 0.2);
  for (int shake = 0; shake < 5; ++shake) {
    for (int i = 0; i < bed.state.count(); ++i)
      bed.state.fluid.fx[i] = shake % 2 == 0 && bed.state.x[i] < 0.02 ? 2e-4 : 0.0;
    advance(bed, 3000);
  }
  for (int i = 0; i < bed.state.count(); ++i) bed.state.fluid.fx[i] = 1e-3;  // all awake
  advance(bed, 1);
  EXPECT_EQ(share_asleep(bed.state), 0);
  const Contacts& c = bed.contacts;
  const auto slot = [&](int i, int j) {
    std::ptrdiff_t at = static_cast<std::ptrdiff_t>(c.first[i / lanes]) * lanes + i % lanes;
    while (c.neighbour[at] != j) at += lanes;
    return at;
  };
  int touching = 0;
  for (int i = 0; i < bed.state.count(); ++i) {
    for (const int j : neighbours_of(bed.state, c, i)) {
      EXPECT_EQ(c.spring[slot(i, j)], c.spring[slot(j, i)]);
      EXPECT_EQ(c.rolling[slot(i, j)], -c.rolling[slot(j, i)]);
      touching += c.spring[slot(i, j)] != 0;
    }
  }
  EXPECT_GT(touching, 200);
}

TEST(sleep, gives_the_same_bits_on_any_number_of_threads_and_after_a_break) {
  for (const Precision precision : {Precision::all_double, Precision::mixed}) {
    Bed one = bed_at_rest();
    one.params.precision = precision;
    advance(one, falls_asleep_within(one));
    for (int i = 0; i < one.state.count(); ++i)
      one.state.fluid.fx[i] = one.state.y[i] > 0.025 && one.state.x[i] < 0.02 ? 1e-4 : 0.0;
    Bed three = one, resumed = one;
    advance(one, 2000);
    base::set_threads(3);
    advance(three, 2000);
    base::set_threads(1);
    advance(resumed, 1210);
    resumed.records = {}, resumed.scratch = {};  // a checkpoint does not hold them
    advance(resumed, 2000 - 1210);
    EXPECT_GT(share_asleep(one.state), 0.2);
    EXPECT_LT(share_asleep(one.state), 0.95);
    for (const Bed* other : {&three, &resumed}) {
      EXPECT_TRUE(one.state.x == other->state.x);
      EXPECT_TRUE(one.state.v == other->state.v);
      EXPECT_TRUE(one.state.sleep.asleep == other->state.sleep.asleep);
      EXPECT_TRUE(one.contacts.spring == other->contacts.spring);
    }
  }
}
