#include "run/profiles.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "case/read.hpp"

namespace livebed::run {
namespace {

/// 400 grains at rest in water that leaves them alone.
Simulation still_bed(const std::vector<std::string>& more = {}) {
  std::vector<std::string> keys = {"preset=livebed",
                                   "mesh.length=0.1",
                                   "mesh.height=0.06",
                                   "pipe.present=false",
                                   "bed.count=400",
                                   "time.spin_up=0",
                                   "coupling.mode=none",
                                   "coupling.voidage=off",
                                   "output.profiles_every=0.01",
                                   "coupling.dispersion=none",
                                   "coupling.turbulence=untouched"};
  keys.insert(keys.end(), more.begin(), more.end());
  Simulation::Start start = Simulation::prepare(casefile::read_case(LIVEBED_SOURCE_DIR "/cases/quick", keys));
  Simulation sim(start.resolved, std::move(start.bed));
  sim.release();
  return sim;
}

enum Column {
  from_s,
  to_s,
  y_m,
  solid,
  grain_u,
  grain_v,
  fluid_u,
  fluid_v,
  flux,
  shear,
  pressure,
  fluid_shear,
  resolved,
  k
};

std::vector<std::vector<double>> first_window(Simulation& sim, Profiles& profiles) {
  EXPECT_FALSE(profiles.add(sim));  // t = 0 is no step
  do sim.step();
  while (!profiles.add(sim));
  return profiles.take(sim);
}

TEST(profiles, of_a_bed_at_rest_hold_its_volume_and_its_weight) {
  Simulation sim = still_bed();
  Profiles profiles(sim.resolved());
  const auto rows = first_window(sim, profiles);
  const casefile::Case& c = sim.resolved();
  const double d = c.grains.diameter, cell = d / 4, per_layer = c.flow.mesh.length * d * cell;
  ASSERT_EQ(rows.size(), 120u);
  ASSERT_EQ(rows[0].size(), profile_columns().size());
  double volume = 0, told = 0;
  for (double diameter : sim.bed().state.diameter) volume += base::sphere_volume(diameter);
  for (const auto& row : rows) told += row[solid] * per_layer;
  EXPECT_NEAR(told, volume, 5e-3 * volume);  // the lowest grains reach into the hollows of the floor

  const double weight = (c.grains.density - c.flow.density) * c.grains.gravity, area = c.flow.mesh.length * d;
  const double all = weight * volume / area;
  double above = 0;
  for (std::size_t l = rows.size(); l-- > 0;) {
    const double here = rows[l][solid] * per_layer;
    above += 0.5 * here;
    if (rows[l][y_m] > 2 * d) {  // below, the floor carries a part of the bed
      EXPECT_NEAR(rows[l][pressure], weight * above / area, 0.06 * all) << "y = " << rows[l][y_m];
      EXPECT_NEAR(rows[l][shear], 0.0, 0.01 * all) << "y = " << rows[l][y_m];
    }
    EXPECT_NEAR(rows[l][flux], 0.0, rows[l][solid] * c.grains.settled_speed) << "more than packing calls rest";
    above += 0.5 * here;
  }
  EXPECT_EQ(rows[0][from_s], 0.0);
  EXPECT_GE(rows[0][to_s], 0.01 - 1e-12);
  EXPECT_TRUE(std::isnan(rows.back()[grain_u])) << "no grain, no velocity";
}

TEST(profiles, tell_what_grains_and_water_do) {
  Simulation sim =
      still_bed({"output.profiles_x_from=0.02", "output.profiles_x_to=0.06", "output.profiles_cell=0.001"});
  Profiles profiles(sim.resolved());
  EXPECT_FALSE(profiles.add(sim));
  sim.step();
  sim.step();
  Simulation::each_part(sim, [&](flow::Solver& flow, grains::Bed& bed, auto&...) {
    flow::State& s = flow.state;
    for (int j = 0; j < s.k.ny(); ++j)
      for (int i = 0; i <= s.k.nx(); ++i) {
        s.u(i, j) = 3 * flow.mesh().centre_y(j);
        if (i < s.k.nx()) s.nut(i, j) = 1e-3, s.k(i, j) = 0.02;
        s.v(i, j) = 0;
      }
    for (int i = 0; i < bed.state.count(); ++i) {
      // Two grains of equal volume, in the mean: one up and forward, one down and back, on top of 0.1 m/s.
      const double sign = bed.state.id[i] % 2 == 0 ? 1 : -1;
      bed.state.u[i] = 0.1 + 0.02 * sign, bed.state.v[i] = 0.01 * sign;
      bed.state.diameter[i] = 2e-3;
    }
  });
  profiles.add(sim);
  const auto rows = profiles.take(sim);
  ASSERT_EQ(rows.size(), 60u);
  double solids = 0, motion = 0;
  for (const auto& row : rows) {
    EXPECT_NEAR(row[k], 0.02, 1e-12);
    EXPECT_NEAR(row[fluid_shear], 1000 * 1.001e-3 * 3, 1e-9);
    EXPECT_NEAR(row[resolved], 0, 1e-9);
    if (row[y_m] > 0.002 && row[y_m] < 0.058) {
      EXPECT_NEAR(row[fluid_u], 3 * row[y_m], 1e-9);
    }
    if (row[solid] < 0.01) continue;
    EXPECT_NEAR(row[grain_u], 0.1, 0.0201);
    EXPECT_NEAR(row[flux], row[solid] * row[grain_u], 1e-12);
    solids += row[solid], motion += row[flux];
  }
  EXPECT_NEAR(motion / solids, 0.1, 0.006);
}

TEST(profiles, windows_follow_each_other_and_go_on_from_their_sums) {
  Simulation sim = still_bed();
  Profiles whole(sim.resolved());
  whole.add(sim);
  std::vector<std::vector<double>> first, second, again;
  Profiles broken(sim.resolved());
  for (int n = 0; n < 1000 && second.empty(); ++n) {
    sim.step();
    const bool full = whole.add(sim);
    if (!first.empty() && again.empty()) {
      // One step of the second window is done; another program goes on from here.
      if (n > 0 && !full) broken.restore(whole.sums()), again = {{}};
    } else if (again.size() == 1) {
      if (broken.add(sim)) again = broken.take(sim);
    }
    if (full) (first.empty() ? first : second) = whole.take(sim);
  }
  ASSERT_EQ(second.size(), 120u);
  EXPECT_EQ(second[0][from_s], first[0][to_s]);
  ASSERT_EQ(again.size(), 120u);
  for (std::size_t l = 0; l < second.size(); ++l)
    for (std::size_t q = 0; q < second[l].size(); ++q)
      EXPECT_TRUE(second[l][q] == again[l][q] || (std::isnan(second[l][q]) && std::isnan(again[l][q])));
}

}  // namespace
}  // namespace livebed::run
