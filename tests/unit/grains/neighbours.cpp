#include "grains/neighbours.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <set>

#include "../../verification/grains/bodies.hpp"
#include "grains/packing.hpp"

using namespace livebed;
using namespace livebed::grains;

namespace {

using Pairs = std::set<std::pair<int, int>>;  ///< of ids, in both orders

/// All pairs within reach, the slow way.
Pairs brute_force(const State& s, const Reach& reach) {
  Pairs pairs;
  for (int i = 0; i < s.count(); ++i) {
    for (int j = 0; j < s.count(); ++j) {
      const double near = 0.5 * reach.gamma * (s.diameter[i] + s.diameter[j]) + reach.skin;
      double dx = std::abs(s.x[i] - s.x[j]);
      dx = std::min(dx, reach.length - dx);
      if (i != j && dx * dx + base::square(s.y[i] - s.y[j]) <= near * near) pairs.insert({s.id[i], s.id[j]});
    }
  }
  return pairs;
}

Pairs listed(const State& s, const Contacts& c) {
  Pairs pairs;
  for (int i = 0; i < s.count(); ++i) {
    for (const int j : neighbours_of(s, c, i)) {
      EXPECT_TRUE(pairs.insert({s.id[i], s.id[j]}).second) << "listed twice";
    }
  }
  return pairs;
}

/// Grains strewn at random over a box, so thin that some overlap.
State strewn(int n, double length, double height, double d, unsigned seed) {
  Params p = bodies::quartz();
  p.count = n;
  State s = make_bed(derive(p)).state;
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < n; ++i) {
    s.x[i] = length * unit(generator);
    s.y[i] = height * unit(generator);
    s.diameter[i] = d * (0.9 + 0.2 * unit(generator));
  }
  return s;
}

}  // namespace

TEST(neighbours, lists_equal_brute_force) {
  struct Box {
    int n;
    double length, height;
  };
  // One grain, part of a slice, two columns only, a flat box, a tall one, a big one.
  for (const Box& box : {Box{1, 0.1, 0.01}, Box{5, 0.006, 0.01}, Box{40, 0.0055, 0.04}, Box{64, 0.1, 0.002},
                         Box{333, 0.02, 0.1}, Box{1500, 0.2, 0.05}}) {
    for (const double gamma : {1.0, 1.04}) {
      State s = strewn(box.n, box.length, box.height, 2e-3, 7 + box.n);
      Contacts c;
      ListScratch scratch;
      const Reach reach{box.length, gamma, 0.3e-3, 0};
      rebuild(s, c, scratch, reach, {});
      EXPECT_EQ(listed(s, c), brute_force(s, reach)) << box.n << " grains";
      EXPECT_EQ(c.rebuilds, 1);
    }
  }
}

TEST(neighbours, far_flying_grains_are_found_without_cells_for_the_empty_space) {
  State s = strewn(200, 0.05, 0.05, 2e-3, 3);
  s.y[17] = 5e5;
  s.y[18] = 5e5 + 1e-3;
  s.x[18] = s.x[17];
  s.y[19] = 7;
  Contacts c;
  ListScratch scratch;
  const Reach reach{0.05, 1, 0.4e-3, 0};
  rebuild(s, c, scratch, reach, {});
  EXPECT_EQ(listed(s, c), brute_force(s, reach));
  EXPECT_EQ(listed(s, c).count({17, 18}), 1u);
  EXPECT_LT(scratch.cell_start.size(), 2000u);
}

TEST(neighbours, every_touching_pair_is_listed_while_grains_move) {
  Params p = bodies::quartz();
  p.gravity = 0;
  p.length = 0.04;
  p.count = 150;
  p.restitution = 0.9;
  p.steps_per_contact = 40;
  p.spread = 0.1;
  Bed bed = lattice(p);
  for (int i = 0; i < p.count; ++i) {
    bed.state.u[i] = 0.5 * std::sin(1.3 * i);
    bed.state.v[i] = 0.5 * std::cos(2.9 * i);
  }
  Reach touching = reach_of(bed.params);
  touching.skin = 0;
  for (int look = 0; look < 200; ++look) {
    advance(bed, 25);
    const Pairs in_lists = listed(bed.state, bed.contacts);
    for (const auto& pair : brute_force(bed.state, touching)) EXPECT_EQ(in_lists.count(pair), 1u);
  }
  EXPECT_GT(bed.contacts.rebuilds, 20);
}

TEST(neighbours, lists_hold_until_a_grain_or_the_pipe_leaves_half_a_skin) {
  State s = strewn(50, 0.05, 0.02, 2e-3, 5);
  Contacts c;
  ListScratch scratch;
  const Reach reach{0.05, 1, 0.4e-3, 0};
  Circle pipe{.present = true, .x = 0.02, .y = 0.04, .diameter = 0.02};
  EXPECT_FALSE(lists_hold(s, c, reach, pipe));
  rebuild(s, c, scratch, reach, pipe);
  EXPECT_TRUE(lists_hold(s, c, reach, pipe));
  for (const double sign : {-1.0, 1.0}) {
    State moved = s;
    moved.y[23] += sign * 0.19e-3;
    EXPECT_TRUE(lists_hold(moved, c, reach, pipe));
    moved.y[23] += sign * 0.02e-3;
    EXPECT_FALSE(lists_hold(moved, c, reach, pipe));
    Circle lowered = pipe;
    lowered.y += sign * 0.19e-3;
    EXPECT_TRUE(lists_hold(s, c, reach, lowered));
    lowered.y += sign * 0.02e-3;
    EXPECT_FALSE(lists_hold(s, c, reach, lowered));
  }
  EXPECT_FALSE(lists_hold(s, c, reach, {}));
  State lost = s;
  lost.x[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(lists_hold(lost, c, reach, pipe));
}

TEST(neighbours, crossing_the_seam_is_a_short_way) {
  EXPECT_NEAR(nearest_image(0.099, 0.1), -0.001, 1e-16);
  EXPECT_NEAR(nearest_image(-0.099, 0.1), 0.001, 1e-16);
  EXPECT_EQ(nearest_image(0.03, 0.1), 0.03);
  for (const double dx : {0.0123, 0.0777, 0.05, 0.1}) EXPECT_EQ(nearest_image(-dx, 0.1), -nearest_image(dx, 0.1));
}

TEST(neighbours, slices_near_walls_are_marked) {
  State s = strewn(400, 0.05, 0.05, 2e-3, 11);
  Contacts c;
  ListScratch scratch;
  const Circle pipe{.present = true, .x = 0.001, .y = 0.03, .diameter = 0.01};
  for (const double floor_diameter : {0.0, 2e-3}) {
    const Reach reach{0.05, 1.03, 0.4e-3, floor_diameter};
    rebuild(s, c, scratch, reach, pipe);
    for (int i = 0; i < s.count(); ++i) {
      const double contact = 0.5 * 1.03 * s.diameter[i] + reach.skin;
      const double dx = nearest_image(s.x[i] - pipe.x, reach.length), dy = s.y[i] - pipe.y;
      if (std::hypot(dx, dy) < 0.005 + contact) {
        EXPECT_TRUE(c.near[i / lanes] & near_pipe);
      }
      if (s.y[i] + 0.5 * floor_diameter < contact + 1.03 * 0.5 * floor_diameter) {
        EXPECT_TRUE(c.near[i / lanes] & near_floor);
      }
    }
    EXPECT_LT(std::count(c.near.begin(), c.near.end(), 0), c.slices());
    EXPECT_GT(std::count(c.near.begin(), c.near.end(), 0), c.slices() / 3);
  }
}

TEST(neighbours, heaped_up_and_lost_grains_are_faults_by_name) {
  const Reach reach{0.05, 1, 0.4e-3, 0};
  const auto refusal = [&](State s) {
    Contacts c;
    ListScratch scratch;
    try {
      rebuild(s, c, scratch, reach, {});
    } catch (const base::Fault& fault) {
      EXPECT_EQ(fault.code(), base::Exit::diverged);
      return std::string(fault.what());
    }
    return std::string("accepted");
  };
  State heap = strewn(60, 0.05, 0.05, 2e-3, 2);
  EXPECT_EQ(refusal(heap), "accepted");
  State lost = heap;
  lost.y[7] = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal(lost).find("grain 7 is lost"), std::string::npos) << refusal(lost);
  lost.y[7] = -0.01;
  EXPECT_NE(refusal(lost).find("grain 7 has left the box"), std::string::npos) << refusal(lost);
  for (int i = 0; i < 50; ++i) heap.x[i] = 0.02 + 1e-6 * i, heap.y[i] = 0.02;
  EXPECT_NE(refusal(heap).find("on top of each other"), std::string::npos) << refusal(heap);
}

TEST(neighbours, slices_hold_restless_or_calm_grains_or_sleepers) {
  State s = strewn(500, 0.05, 0.05, 2e-3, 11);
  std::vector<int> kind(s.count());  // of each id: 0 restless, 1 calm, 2 asleep
  for (int i = 0; i < s.count(); ++i) {
    kind[s.id[i]] = i * 7 % 3;
    s.sleep.asleep.push_back(kind[s.id[i]] == 2 ? 1 : 0);
    s.sleep.calm.push_back(kind[s.id[i]] == 1 ? 2 : 0);
  }
  Contacts c;
  ListScratch scratch;
  const Reach reach{0.05, 1, 0.4e-3, 0};
  rebuild(s, c, scratch, reach, {});
  constexpr int window = 256;  // grains that are sorted among each other
  int mixed = 0;
  for (int i = 1; i < s.count(); ++i) {
    EXPECT_TRUE(i % window == 0 || kind[s.id[i - 1]] <= kind[s.id[i]]) << i;
    if (i % lanes != 0 && kind[s.id[i - 1]] != kind[s.id[i]]) ++mixed;
  }
  EXPECT_GT(mixed, 0);
  EXPECT_LE(mixed, 2 * (s.count() / window + 1));
  EXPECT_EQ(listed(s, c), brute_force(s, reach));
}
