#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "io/table.hpp"
#include "io/vtk.hpp"
#include "same_run.hpp"

/// What a run leaves behind, and that the quick case digs its hole.
namespace livebed {
namespace {

using RunContents = Program;

constexpr double grains_of_quick = 1650, pipe_x = 0.08, D = 0.02, d = 2e-3;

void expect_good_series(const io::Table& series, double end) {
  const std::vector<std::string> columns = {"time_s",
                                            "t_over_T",
                                            "S_over_D",
                                            "depth_under_pipe_over_D",
                                            "hole_width_over_D",
                                            "mound_height_over_D",
                                            "mound_x_over_D",
                                            "grain_flux_m2_s",
                                            "drag_N_m",
                                            "lift_N_m",
                                            "theta_measured",
                                            "mass_residual",
                                            "fluid_momentum_x_N_s",
                                            "grain_momentum_x_N_s",
                                            "impulse_error_N_s",
                                            "flow_step_s",
                                            "courant",
                                            "pressure_iterations",
                                            "grain_mean_speed_m_s",
                                            "grain_max_speed_m_s",
                                            "contacts_per_grain",
                                            "overlap_max_over_d"};
  EXPECT_EQ(series.names, columns) << "scripts rely on these";
  for (std::size_t c = 0; c < series.columns.size(); ++c)
    for (double value : series.columns[c]) ASSERT_TRUE(std::isfinite(value)) << series.names[c];
  const auto& time = series.column("time_s");
  ASSERT_GT(time.size(), 3u);
  EXPECT_EQ(time.front(), 0.0);
  for (std::size_t k = 1; k < time.size(); ++k) EXPECT_GT(time[k], time[k - 1]);
  EXPECT_GE(time.back(), end - 0.011);
  EXPECT_LE(time.back(), end + 0.01);
  for (double theta : series.column("theta_measured")) EXPECT_GT(theta, 0.0);
  for (double residual : series.column("mass_residual")) EXPECT_LT(residual, 1e-4);
  for (double courant : series.column("courant")) EXPECT_LE(courant, 0.81);
}

nlohmann::json expect_good_summary(const fs::path& run) {
  const auto summary = nlohmann::json::parse(content(run / "summary.json"));
  for (const char* key : {"time_s",
                          "t_over_T",
                          "time_scale_s",
                          "scour_depth_over_D",
                          "depth_under_pipe_over_D",
                          "theta",
                          "theta_measured",
                          "bed_level_m",
                          "largest_overlap_over_d",
                          "impulse_error_N_s",
                          "wall_s",
                          "grain_steps_per_second",
                          "flow_ms_per_step",
                          "flow_steps",
                          "grain_steps",
                          "cells",
                          "grains",
                          "threads",
                          "peak_memory_MB",
                          "seed"})
    EXPECT_TRUE(summary.contains(key) && summary[key].is_number() && std::isfinite(summary[key].get<double>())) << key;
  for (const char* key : {"S_eq_over_D", "T_s"})
    EXPECT_TRUE(summary.contains(key) && (summary[key].is_null() || summary[key].is_number())) << key;
  EXPECT_EQ(summary["S_eq_over_D"].is_null(), summary["T_s"].is_null());
  for (const char* key : {"title", "ended", "case_hash", "commit"}) EXPECT_TRUE(summary[key].is_string()) << key;
  for (const char* key : {"fit", "walls", "versions"}) EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_TRUE(summary["versions"]["livebed"].is_string());
  double parts = 0;
  for (const auto& [part, seconds] : summary["walls"].items()) parts += seconds.get<double>();
  EXPECT_NEAR(parts, summary["wall_s"].get<double>(), 1e-9 * parts);
  return summary;
}

/// Mean of a column over rows with from <= t <= to.
double mean(const io::Table& series, const char* name, double from, double to) {
  const auto &time = series.column("time_s"), &values = series.column(name);
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (time[k] >= from && time[k] <= to) sum += values[k], ++count;
  EXPECT_GT(count, 0);
  return sum / count;
}

void expect_hole(const io::Table& series) {
  // No perturbation was put in: at first there is nothing but a flat bed.
  EXPECT_LT(std::abs(series.column("S_over_D").front()), 0.1);
  // The tunnel breaks through under the pipe, and a mound goes downstream while it is washed flat.
  EXPECT_LT(mean(series, "depth_under_pipe_over_D", 0, 0.05), 0.1);
  EXPECT_GT(mean(series, "depth_under_pipe_over_D", 0.3, 0.5), 0.2);
  EXPECT_GT(mean(series, "mound_height_over_D", 0.1, 0.4), 0.25);
  EXPECT_LT(mean(series, "mound_height_over_D", 0.1, 0.4), 1.2);
  EXPECT_GT(mean(series, "mound_x_over_D", 0.08, 0.12), 0.5);
  EXPECT_GT(mean(series, "mound_x_over_D", 0.35, 0.45), mean(series, "mound_x_over_D", 0.08, 0.12) + 0.3);
  // How deep: broad, for a pipe of ten grains.
  EXPECT_GT(mean(series, "S_over_D", 1.0, 1.6), 0.3);
  EXPECT_LT(mean(series, "S_over_D", 1.0, 1.6), 1.2);
  EXPECT_GT(series.column("S_over_D").back(), 0.3);
  EXPECT_LT(series.column("S_over_D").back(), 1.2);
}

void expect_bed_lines(const fs::path& run) {
  const io::Table bed = io::read_table(run / "bed.csv"), series = io::read_table(run / "series.csv");
  EXPECT_EQ(bed.names.front(), "time_s");
  EXPECT_EQ(bed.names.size(), 1u + 200u);  // half a grain apart over 0.2 m
  EXPECT_EQ(bed.names[1], "y_at_0.0005_m");
  EXPECT_EQ(bed.rows(), 31u);
  for (std::size_t c = 1; c < bed.columns.size(); ++c)
    for (double y : bed.columns[c]) {
      ASSERT_GT(y, 0.0);
      ASSERT_LT(y, 0.1);
    }
  // The hole is below the level of t = 0, the sand of it above that level further down.
  const std::size_t under = 1 + static_cast<std::size_t>(pipe_x / 1e-3);
  EXPECT_LT(bed.columns[under].back(), bed.columns[under].front() - 0.2 * D);
}

void expect_frames(const fs::path& run) {
  const auto grains = io::read_pvd(run / "grains.pvd"), flow = io::read_pvd(run / "flow.pvd");
  EXPECT_EQ(grains.size(), 16u);
  ASSERT_EQ(flow.size(), grains.size());
  const auto summary = nlohmann::json::parse(content(run / "summary.json"));
  const double pipe_y = summary["bed_level_m"].get<double>() + 0.5 * D;
  for (std::size_t n = 0; n < grains.size(); ++n) {
    EXPECT_NEAR(grains[n].time, 0.1 * static_cast<double>(n), 0.01);
    const io::Points points = io::read_vtp(run / grains[n].file);
    EXPECT_EQ(io::read_vtr(run / flow[n].file).nx(), 100);
    ASSERT_EQ(points.x.size(), grains_of_quick) << "a grain vanished or appeared";
    const auto& ids = io::array(points.data, "id").values;
    EXPECT_EQ(std::set<double>(ids.begin(), ids.end()).size(), grains_of_quick);
    for (std::size_t k = 0; k < points.x.size(); ++k) {
      ASSERT_TRUE(points.x[k] >= 0 && points.x[k] <= 0.2f && points.y[k] > 0 && points.y[k] < 0.1) << grains[n].file;
      ASSERT_GT(std::hypot(points.x[k] - pipe_x, points.y[k] - pipe_y), 0.5 * (D + d) - 0.2 * d) << grains[n].file;
    }
  }
  EXPECT_EQ(io::read_vtp(run / "pipe.vtp").x.size(), 180u);
}

/// The impulse that left the grains is in the water or on its way, in a real bed with a pipe.
void expect_closed_ledger(const fs::path& run, double most_carried) {
  const run::Restored last = run::load_checkpoint(run::list_checkpoints(run).back());
  const coupling::ImpulseLedger& ledger = last.sim.coupler().ledger();
  const double size = base::norm(ledger.to_grains);
  EXPECT_GT(size, 1e-5);
  EXPECT_LT(base::norm(ledger.error()), 1e-10 * size);
  EXPECT_LT(base::norm(ledger.carried), most_carried * size);
}

TEST_F(RunContents, of_the_quick_case_show_a_hole_and_hold_all_that_was_promised) {
  const Result result =
      run("--threads 1 run '" LIVEBED_SOURCE_DIR "/cases/quick' --out quick --quiet --set output.bed_every=0.05");
  ASSERT_EQ(result.exit, 0) << result.err;
  EXPECT_EQ(result.out, "quick/summary.json\n");
  const fs::path folder = *this / "quick";
  const io::Table series = io::read_table(folder / "series.csv");
  expect_good_series(series, 1.5);
  expect_hole(series);
  expect_bed_lines(folder);
  expect_frames(folder);
  expect_closed_ledger(folder, 0.05);
  const auto summary = expect_good_summary(folder);
  EXPECT_EQ(summary["scour_depth_over_D"], series.column("S_over_D").back());
  EXPECT_EQ(summary["depth_under_pipe_over_D"], series.column("depth_under_pipe_over_D").back());
  EXPECT_EQ(summary["grains"], grains_of_quick);
  EXPECT_EQ(summary["ended"], "end of time");
  EXPECT_LT(summary["largest_overlap_over_d"].get<double>(), 0.2);
  EXPECT_EQ(run::list_checkpoints(folder).size(), 2u);
  // The resolved case is a case again, the same one.
  const auto check = run("check quick/case.resolved.toml --json");
  EXPECT_EQ(check.exit, 0) << check.err;
  EXPECT_EQ(nlohmann::json::parse(check.out)["hash"], summary["case_hash"]);
}

TEST_F(RunContents, have_a_closed_ledger_with_implicit_exchange_too) {
  ASSERT_EQ(run("--threads 1 " + small_run("0.12", "implicit --set coupling.exchange=implicit")).exit, 0);
  expect_closed_ledger(*this / "implicit", 0.05);
}

TEST_F(RunContents, of_a_flat_bed_have_no_hole_but_everything_else) {
  const Result result = run("--threads 1 run '" LIVEBED_SOURCE_DIR
                            "/cases/flat-bed' --out flat --quiet --set mesh.length=0.12 --set mesh.height=0.06"
                            " --set bed.thickness=0.015 --set time.spin_up=0.1 --set time.end=0.1");
  ASSERT_EQ(result.exit, 0) << result.err;
  const io::Table series = io::read_table(*this / "flat/series.csv");
  expect_good_series(series, 0.1);
  for (const char* name : {"S_over_D", "depth_under_pipe_over_D", "hole_width_over_D", "mound_x_over_D", "drag_N_m",
                           "lift_N_m", "t_over_T"})
    for (double value : series.column(name)) EXPECT_EQ(value, 0.0) << name;
  EXPECT_GT(series.column("grain_flux_m2_s").back(), 1e-6);  // the sand moves
  EXPECT_LT(series.column("grain_flux_m2_s").back(), 1e-2);
  EXPECT_EQ(expect_good_summary(*this / "flat")["S_eq_over_D"], nullptr);
  EXPECT_GT(io::read_table(*this / "flat/bed.csv").rows(), 1u);
  EXPECT_FALSE(fs::exists(*this / "flat/pipe.vtp"));
  EXPECT_EQ(run("report flat").exit, 0);
  EXPECT_TRUE(fs::exists(*this / "flat/report.html"));
}

TEST_F(RunContents, of_water_alone_have_a_pipe_in_a_current) {
  ASSERT_EQ(run("--threads 1 " + small_run("0.1", "water", " --set bed.thickness=0 --set time.spin_up=0.05")).exit, 0);
  const io::Table series = io::read_table(*this / "water/series.csv");
  expect_good_series(series, 0.1);
  EXPECT_GT(series.column("drag_N_m").back(), 1.0);
  for (const char* name : {"S_over_D", "mound_x_over_D", "grain_flux_m2_s", "contacts_per_grain"})
    for (double value : series.column(name)) EXPECT_EQ(value, 0.0) << name;
  EXPECT_EQ(expect_good_summary(*this / "water")["grains"], 0);
  EXPECT_FALSE(fs::exists(*this / "water/packing.csv"));
  EXPECT_EQ(run("report water").exit, 0);
  EXPECT_TRUE(fs::exists(*this / "water/report.html"));
}

}  // namespace
}  // namespace livebed
