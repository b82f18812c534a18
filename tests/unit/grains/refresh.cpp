#include "grains/refresh.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "../../verification/grains/bodies.hpp"
#include "grains/packing.hpp"

using namespace livebed;
using namespace livebed::grains;

namespace {

/// A bed over fixed grains in which every twentieth grain flies.
Bed bed_with_flyers() {
  Params p = bodies::quartz();
  p.floor = Floor::grains;
  p.restitution = 0.5;
  p.length = 0.08;
  p.count = 600;
  p.spread = 0.1;
  Bed bed = pack(p).bed;
  for (int i = 0; i < p.count; ++i) {
    if (bed.state.id[i] % 20 != 0) continue;
    bed.state.u[i] = 0.6 * std::sin(1.0 + bed.state.id[i]);
    bed.state.v[i] = 0.5;
  }
  return bed;
}

using Pairs = std::set<std::pair<int, int>>;

/// All pairs that the lists must hold, by the places where the grains were listed.
Pairs wanted(const Bed& bed) {
  const Contacts& c = bed.contacts;
  const Reach reach = reach_of(bed.params);
  Pairs pairs;
  for (int i = 0; i < bed.state.count(); ++i)
    for (int j = 0; j < bed.state.count(); ++j) {
      const double far = 0.5 * reach.gamma * (bed.state.diameter[i] + bed.state.diameter[j]) + reach.skin;
      const double dx = nearest_image(c.x_built[j] - c.x_built[i], reach.length), dy = c.y_built[j] - c.y_built[i];
      if (i != j && dx * dx + dy * dy <= far * far) pairs.insert({i, j});
    }
  return pairs;
}

}  // namespace

TEST(refresh, keeps_the_lists_of_both_sides_complete) {
  Bed bed = bed_with_flyers();
  bed.contacts.x_built.assign(bed.contacts.x_built.size(), -1);  // forces new lists of all: none left by the packing
  int grain_by_grain = 0;
  for (int look = 0; look < 60; ++look) {
    advance(bed, 40);  // in 18 looks the first flyers have left their half skin
    grain_by_grain += bed.contacts.refreshed > 0;
    Pairs found;
    for (int i = 0; i < bed.state.count(); ++i)
      for (const int j : neighbours_of(bed.state, bed.contacts, i))
        EXPECT_TRUE(found.insert({i, j}).second) << "listed twice";
    EXPECT_EQ(found, wanted(bed));
  }
  EXPECT_GT(grain_by_grain, 30);
}

TEST(refresh, moves_the_grains_as_new_lists_do) {
  Bed alone = bed_with_flyers(), all = alone;
  const std::int64_t before = alone.contacts.rebuilds;
  for (int step = 0; step < 200; ++step) {
    advance(alone, 1);
    all.contacts.x_built.assign(all.contacts.x_built.size(), -1);  // forces new lists of all
    advance(all, 1);
  }
  EXPECT_LT(alone.contacts.rebuilds, before + 20);
  for (int id = 0; id < alone.params.count; ++id) {
    const bodies::Body a = bodies::body(alone, id), b = bodies::body(all, id);
    EXPECT_NEAR(nearest_image(a.x - b.x, alone.params.length), 0, 1e-9);
    EXPECT_NEAR(a.y, b.y, 1e-9);
  }
}
