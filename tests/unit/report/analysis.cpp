#include "report/analysis.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "../io/temporary_folder.hpp"
#include "base/math.hpp"
#include "report/page_data.hpp"
#include "synthetic_run.hpp"

namespace livebed::report {
namespace {

TEST(analysis, stages_of_an_exponential_hole_begin_when_their_rules_say) {
  constexpr double T = 2, d_over_D = 0.04;
  std::vector<double> t, S;
  for (int n = 0; n <= 1600; ++n) {
    t.push_back(0.01 * n);
    S.push_back(0.6 * (1 - std::exp(-t.back() / T)));
  }
  const auto found = find_stages(t, S, S, T, d_over_D);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].name, "onset");
  EXPECT_NEAR(found[0].begins, -T * std::log(1 - d_over_D / 0.6), 0.0101);
  EXPECT_NEAR(found[1].begins, -T * std::log(1 - 0.1 / 0.6), 0.0101);
  // The rate is that of e^(-t/T), fastest once both windows of 0.2 T are full.
  EXPECT_EQ(found[2].name, "lee-wake erosion");
  EXPECT_NEAR(found[2].begins, (0.4 + std::log(5.0)) * T, 0.15 * T);
  // e^(-t/T) = 0.05 at 3.0 T, and a mean over the last 0.5 T lags by a quarter of a T.
  EXPECT_EQ(found[3].name, "equilibrium");
  EXPECT_NEAR(found[3].begins, 3.25 * T, 0.1 * T);
}

TEST(analysis, a_bed_that_never_falls_has_no_stages_and_one_still_falling_no_equilibrium) {
  std::vector<double> t, S, still;
  for (int n = 0; n <= 400; ++n) {
    t.push_back(0.01 * n);
    S.push_back(0.3 * t.back() / 4);
    still.push_back(0.001);
  }
  EXPECT_TRUE(find_stages(t, still, still, 1, 0.04).empty());
  const auto found = find_stages(t, S, S, 1, 0.04);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[1].name, "tunnel erosion");
}

TEST(analysis, of_a_run_made_of_formulas_gives_them_back) {
  const TemporaryFolder folder;
  SyntheticRun synthetic;
  synthetic.snapshots = 2;
  synthetic.write(folder.path());
  const RunFolder run = read_run(folder.path());
  EXPECT_TRUE(is_maos_case(run));
  const auto all = analyse(run, NearBed());
  EXPECT_NEAR(all["fit"]["S_eq_over_D"].get<double>(), 0.6, 1e-3);
  EXPECT_NEAR(all["fit"]["T_s"].get<double>(), 0.88, 1e-3);
  EXPECT_NEAR(all["S_eq_over_D"].get<double>(), 0.6, 0.01);
  EXPECT_EQ(all["stages"].size(), 4u);
  ASSERT_EQ(all["comparisons"].size(), 3u);
  EXPECT_EQ(all["comparisons"][0]["points"], 42);
  EXPECT_EQ(all["formulas"][0]["S_eq_over_D"], 0.6);
  // The lift is a sine of 9 rad/s.
  EXPECT_NEAR(all["spectrum"]["peak_Hz"].get<double>(), 9 / (2 * base::pi), 0.01);
  EXPECT_NEAR(all["spectrum"]["strouhal"].get<double>(), 9 / (2 * base::pi) * 0.05 / 1.4, 1e-3);
  EXPECT_GT(all["spectrum"]["share_at_peak"].get<double>(), 0.9);
  // Half a cosine dug 2 (1.2 D + S) wide; as S lies at its end, its mound at the start.
  const double S = synthetic.depth(7.1) / 0.05, eroded = S * (1.2 + S);
  EXPECT_NEAR(all["sand"]["eroded"].back().get<double>(), eroded, 0.01 * eroded);
  EXPECT_EQ(all["sand"]["eroded"].front().get<double>(), 0.0);
}

TEST(analysis, another_case_is_not_held_against_mao) {
  const TemporaryFolder folder;
  SyntheticRun synthetic;
  synthetic.D = 0.02;
  synthetic.snapshots = 1;
  synthetic.write(folder.path());
  const RunFolder run = read_run(folder.path());
  EXPECT_FALSE(is_maos_case(run));
  EXPECT_TRUE(analyse(run, NearBed())["comparisons"].empty());
  EXPECT_TRUE(describe(run, {0})["measured"].is_null());
}

/// A flat bed at 0.02 m under u = 5/s times the height above it, sand of 2 mm in a row at the surface.
RunFolder flat_run() {
  RunFolder run;
  run.grain_diameter = 0.002;
  run.water_density = 1000;
  run.viscosity = 1e-6;
  run.bed = BedHistory{{0, 1}, {0, 0.1}, {{0.02, 0.02}, {0.02, 0.02}}};
  return run;
}

TEST(near_bed, a_linear_current_over_a_row_of_grains_has_its_stress_and_flux) {
  constexpr double nut = 3e-4, shear_rate = 5, force = 2e-6, speed = 0.25;
  io::Grid water{1, {}, {}, {}};
  for (int i = 0; i <= 40; ++i) water.x.push_back(0.1 * i / 40);
  for (int j = 0; j <= 20; ++j) water.y.push_back(0.05 * j / 20);
  io::DataArray velocity{"velocity", 3, io::Store::float32, {}}, viscosity{"nut", 1, io::Store::float32, {}};
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 40; ++i) {
      const double y = 0.05 * (j + 0.5) / 20;
      velocity.values.insert(velocity.values.end(), {std::max(0.0, shear_rate * (y - 0.02)), 0.0, 0.0});
      viscosity.values.push_back(nut);
    }
  water.cells = {velocity, viscosity};
  io::Points sand;
  sand.data = {{"diameter", 1, io::Store::float32, {}},
               {"velocity", 3, io::Store::float32, {}},
               {"drag", 3, io::Store::float32, {}}};
  for (int n = 0; n < 50; ++n)
    for (double y : {0.019, 0.001}) {  // the lower row is deep in the bed and counts for the flux alone
      sand.x.push_back(0.002 * (n + 0.5));
      sand.y.push_back(y);
      sand.data[0].values.push_back(0.002);
      sand.data[1].values.insert(sand.data[1].values.end(), {y > 0.01 ? speed : 0, 0.0, 0.0});
      sand.data[2].values.insert(sand.data[2].values.end(), {force, 0.0, 0.0});
    }
  const FrameMeasures m = measure_frame(water, sand, flat_run());
  ASSERT_EQ(m.x.size(), 25u);
  for (double tau : m.in_water) EXPECT_NEAR(tau, 1000 * (1e-6 + nut) * shear_rate, 1e-9);
  double sum = 0;
  for (double tau : m.on_sand) sum += tau * 0.004 * 0.002;
  EXPECT_NEAR(sum, 50 * force, 1e-12);
  double moved = 0;
  for (double q : m.flux) moved += q * m.dx * m.dy * 0.002;
  EXPECT_NEAR(moved, 50 * speed * base::sphere_volume(0.002), 1e-15);
}

TEST(near_bed, frames_are_measured_once_and_those_of_a_run_set_back_again) {
  const TemporaryFolder folder;
  SyntheticRun synthetic;
  synthetic.snapshots = 5;
  synthetic.write(folder.path());
  RunFolder run = read_run(folder.path());
  NearBed near_bed;
  near_bed.update(run);
  EXPECT_EQ(near_bed.shear(run).frames, 2);  // of t = 5.3 and 7.1 s
  std::filesystem::remove_all(folder / "fields");
  near_bed.update(run);
  EXPECT_GT(near_bed.mean_flux().flux.size(), 100u);
  run.fields.resize(3);
  near_bed.update(run);
  EXPECT_NEAR(near_bed.shear(run).to, synthetic.last_time / 2, 1e-9);
}

}  // namespace
}  // namespace livebed::report
