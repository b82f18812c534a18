#include "report/report.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../io/expect_fault.hpp"
#include "../io/temporary_folder.hpp"
#include "report/moment.hpp"
#include "report/run_folder.hpp"
#include "synthetic_run.hpp"

namespace livebed::report {
namespace {

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST(report, a_finished_run_becomes_one_file_that_needs_nothing_else) {
  const TemporaryFolder folder;
  SyntheticRun().write(folder.path());
  const Written written = write_report(folder.path());
  EXPECT_EQ(written.path, folder / "report.html");
  EXPECT_TRUE(written.missing.empty());
  EXPECT_EQ(written.frames, 29u);
  const std::string page = io::read_file(written.path);
  EXPECT_EQ(count(page, "data-name=\"frame/"), 29u);
  for (const char* name : {"run.json", "series", "bed", "analysis.json", "motion"})
    EXPECT_EQ(count(page, fmt::format("data-name=\"{}\"", name)), 1u) << name;
  EXPECT_EQ(count(page, "<title>A hole made of &lt;formulas&gt;</title>"), 1u);
  EXPECT_EQ(count(page, "default-src 'none'"), 1u);  // the browser itself refuses whatever else it might ask for
  EXPECT_EQ(count(page, "</html>"), 1u);
  EXPECT_LT(page.size(), 8'000'000u);
}

TEST(report, of_many_large_frames_it_keeps_the_first_the_last_and_some_between) {
  const TemporaryFolder folder;
  SyntheticRun run;
  run.cells = 6;
  run.snapshots = 7;
  run.write(folder.path());
  const Written written = write_report(folder.path());
  EXPECT_GE(written.frames, 2u);
  EXPECT_LT(written.frames, 7u);
  const std::string page = io::read_file(written.path);
  EXPECT_EQ(count(page, "data-name=\"frame/"), written.frames);
  EXPECT_EQ(count(page, "data-name=\"frame/0\""), 1u);
  EXPECT_EQ(count(page, "data-name=\"frame/6\""), 1u);
  EXPECT_LT(page.size(), 9'000'000u);
}

TEST(report, a_run_that_is_going_on_shows_what_there_is_and_says_what_is_not) {
  const TemporaryFolder folder;
  SyntheticRun run;
  run.finished = false;
  run.last_time = 1.7;
  run.snapshots = 7;
  run.write(folder.path());
  std::filesystem::remove(folder / "grains.pvd");
  const Written written = write_report(folder.path());
  EXPECT_EQ(written.frames, 7u);
  ASSERT_EQ(written.missing.size(), 2u);
  EXPECT_NE(written.missing[0].find("summary.json"), std::string::npos);
  EXPECT_NE(written.missing[1].find("grains.pvd"), std::string::npos);
}

TEST(report, a_bare_run_folder_is_enough) {
  const TemporaryFolder folder;
  io::write_atomically(folder / "case.resolved.toml", "");
  const Written written = write_report(folder.path());
  EXPECT_EQ(written.frames, 0u);
  EXPECT_EQ(written.missing.size(), 6u);
}

TEST(report, a_comparison_holds_the_curves_of_each_run_and_no_frames) {
  const TemporaryFolder folder;
  for (const char* name : {"a", "b"}) SyntheticRun().write(folder / name);
  write_comparison({folder / "a", folder / "b"}, folder / "both.html");
  const std::string page = io::read_file(folder / "both.html");
  EXPECT_EQ(count(page, "<title>Livebed: a beside b</title>"), 1u);
  for (const char* name : {"0/run.json", "1/series", "1/bed", "0/analysis.json"})
    EXPECT_EQ(count(page, fmt::format("data-name=\"{}\"", name)), 1u) << name;
  EXPECT_EQ(count(page, "data-name=\"frame/"), 0u);
}

TEST(report, folders_that_are_no_run_and_damaged_files_are_refused_by_name) {
  const TemporaryFolder folder;
  expect_io_fault([&] { write_report(folder.path()); }, {"not a run folder", "case.resolved.toml"});
  expect_io_fault([&] { write_report(folder / "absent"); }, {"absent", "not a folder"});
  SyntheticRun run;
  run.snapshots = 2;
  run.write(folder.path());
  expect_io_fault([&] { write_picture(folder.path(), 0, folder / "none/a.png"); }, {"none/a.png"});
  io::write_atomically(folder / "summary.json", "{\"a\": ");
  expect_io_fault([&] { write_report(folder.path()); }, {"summary.json"});
  std::filesystem::remove(folder / "summary.json");
  io::write_atomically(folder / "case.resolved.toml", "a = = 1");
  expect_io_fault([&] { write_report(folder.path()); }, {"case.resolved.toml:1"});
}

TEST(report, the_outline_of_a_run_has_its_numbers) {
  const TemporaryFolder folder;
  const SyntheticRun synthetic;
  synthetic.write(folder.path());
  const RunFolder run = read_run(folder.path());
  ASSERT_TRUE(run.time_scale);
  EXPECT_NEAR(*run.time_scale, 0.88, 1e-12);
  EXPECT_NEAR(run.theta, 0.33, 1e-12);
  EXPECT_NEAR(run.grain_diameter, 0.002, 1e-12);
  EXPECT_NEAR(run.original_level(), synthetic.level, 1e-12);
  EXPECT_NEAR(read_outline(folder.path()).original_level(), synthetic.level, 1e-12);
  ASSERT_TRUE(run.pipe);
  EXPECT_NEAR(run.pipe->x, 0.2, 1e-6);
  EXPECT_NEAR(run.pipe->y, synthetic.pipe_y(), 1e-6);
  EXPECT_NEAR(run.pipe->diameter, 0.05, 1e-6);
  EXPECT_NEAR(nearest_moment(run, 2.03).time, 2.0286, 1e-3);
  EXPECT_THROW(nearest_moment(RunFolder{}, 0), base::Fault);
}

TEST(report, the_snapshot_shows_grains_water_pipe_and_bed_where_they_are) {
  const TemporaryFolder folder;
  SyntheticRun synthetic;
  synthetic.snapshots = 3;
  synthetic.write(folder.path());
  EXPECT_EQ(write_picture(folder.path(), 6.5, folder / "a.png"), synthetic.last_time);
  EXPECT_EQ(io::read_file(folder / "a.png").substr(0, 8), "\x89PNG\r\n\x1a\n");

  const RunFolder run = read_run(folder.path());
  auto [snapshot, options] = load_moment(run, nearest_moment(run, 0));
  options.x_from = 0;
  options.x_to = 0.5;
  options.width = 1084;  // 1000 pixels between the margins: 2 a millimetre
  options.overlays.clear();
  options.arrows = false;
  const Picture picture = draw(snapshot, options);
  const auto at = [&](double x, double y) {  // margins of 64 on the left and 34 at the top
    return picture.at(static_cast<int>(64 + 2000 * x), static_cast<int>(34 + 400 - 2000 * y));
  };
  const Colour pipe = at(0.2, synthetic.pipe_y()), water = at(0.45, 0.19), grain = at(0.0005, 0.0009);
  EXPECT_EQ(pipe.r, 225);
  EXPECT_GT(water.g, 150);  // fast water is green to yellow
  EXPECT_GT(grain.r, 200);  // grains are sand
  EXPECT_GT(grain.r, grain.b);
}

TEST(report, the_largest_speeds_are_those_of_the_data) {
  const TemporaryFolder folder;
  SyntheticRun one;
  one.snapshots = 1;
  one.write(folder.path());
  const RunFolder run = read_run(folder.path());
  const auto [snapshot, options] = load_moment(run, nearest_moment(run, 0));
  EXPECT_NEAR(largest_water_speed(snapshot), 2.1, 0.1);  // nearly twice the current on top of a cylinder
  EXPECT_NEAR(largest_grain_speed(snapshot), 0.42, 0.08);
  EXPECT_EQ(largest_grain_speed(Snapshot{snapshot.water, {}, {}}), 0);
}

}  // namespace
}  // namespace livebed::report
