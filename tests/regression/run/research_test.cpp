#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "io/table.hpp"
#include "io/vtk.hpp"
#include "same_run.hpp"

/// Profiles, tracks, contact forces and beds of files: what a researcher asks a run for.
namespace livebed {
namespace {

using Research = Program;

const std::string outputs =
    " --set output.profiles_every=0.03 --set output.profiles_from=0.02 --set output.profiles_x_from=0.02"
    " --set output.profiles_x_to=0.1 --set output.tracks_every=0.01 --set output.tracks=5"
    " --set output.contacts_every=0.05 --set preset=livebed";

TEST_F(Research, outputs_go_on_without_a_gap_and_change_no_bit_of_the_run) {
  ASSERT_EQ(run(small_run("0.15", "whole" + outputs)).exit, 0);
  ASSERT_EQ(run(small_run("0.15", "parts --wall-limit 1e-6" + outputs)).exit, 6);
  const std::string csv = content(*this / "parts/tracks.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1);  // stopped before the release
  for (int n = 0; n < 3; ++n) {
    const int exit = run("resume parts --quiet --wall-limit 0.25").exit;
    EXPECT_TRUE(exit == 6 || exit == 0) << exit;
  }
  EXPECT_EQ(run("resume parts --quiet").exit, 0);
  expect_same_run(*this / "whole", *this / "parts");

  ASSERT_EQ(run(small_run("0.15", "plain --set preset=livebed")).exit, 0);
  auto with = datasets_of(run::list_checkpoints(*this / "whole").back());
  auto without = datasets_of(run::list_checkpoints(*this / "plain").back());
  EXPECT_GT(std::erase_if(with, [](const auto& set) { return set.first.starts_with("/more_output/"); }), 5u);
  with.erase("/case"), without.erase("/case");
  EXPECT_TRUE(with == without);
  for (const char* table : {"series.csv", "bed.csv"})
    EXPECT_EQ(content(*this / "whole" / table), content(*this / "plain" / table)) << table;

  const io::Table profiles = io::read_table(*this / "whole/profiles.csv");
  EXPECT_EQ(profiles.rows(), 4u * 120u);  // 0.02 + 4 x 0.03 s
  EXPECT_EQ(profiles.column("from_s")[0], 0.02);
  for (double solid : profiles.column("solid_fraction")) EXPECT_LT(solid, 0.79);
  EXPECT_GT(*std::max_element(profiles.column("solids_flux_m_s").begin(), profiles.column("solids_flux_m_s").end()),
            1e-3);

  const io::Table tracks = io::read_table(*this / "whole/tracks.csv");
  EXPECT_EQ(tracks.rows(), 16u * 5u);
  const auto& id = tracks.column("id");
  for (std::size_t n = 5; n < id.size(); ++n) EXPECT_EQ(id[n], id[n - 5]);
  for (std::size_t n = 0; n < 5; ++n) EXPECT_LT(std::abs(tracks.column("x_m")[n] - 0.05), 0.006);

  const auto frames = io::read_pvd(*this / "whole/contacts.pvd");
  ASSERT_EQ(frames.size(), 4u);
  const io::Points lines = io::read_vtp(*this / ("whole/" + frames[1].file));
  EXPECT_GT(lines.x.size(), 500u);  // two ends each
  EXPECT_EQ(io::array(lines.lines, "normal").values.size(), lines.x.size() / 2);
  for (double normal : io::array(lines.lines, "normal").values) EXPECT_GE(normal, 0.0);
}

TEST_F(Research, a_bed_goes_to_lammps_and_comes_back) {
  const std::string bed = small_box + small_start;
  const Result first = run("bed " + bed + " --out one.data --json");
  ASSERT_EQ(first.exit, 0) << first.err;
  EXPECT_EQ(nlohmann::json::parse(first.out)["grains"], 500);
  expect_contains(content(*this / "one.data"), {"500 atoms", "0 0.12 xlo xhi", "Atoms # sphere"});
  const std::string from_file = " --set bed.file=one.data --set time.end=0.05 --quiet --out ";
  const Result result = run("run " + bed + from_file + "reread");
  ASSERT_EQ(result.exit, 0) << result.err;
  // It was at rest already: it comes to rest at the same level, but for what the contacts had remembered of friction,
  // which the file does not hold: the grains settle a little further.
  ASSERT_EQ(run(small_run("0.05", "packed")).exit, 0);
  const auto level = [&](const char* name) {
    return nlohmann::json::parse(content(*this / name / "packing.json"))["level_m"].get<double>();
  };
  EXPECT_LE(level("reread"), level("packed"));
  EXPECT_NEAR(level("reread"), level("packed"), 5e-4);  // a quarter of a grain
  const std::string smooth = " --set contact.friction=0";
  ASSERT_EQ(run("bed " + bed + smooth + " --out smooth.data").exit, 0);
  ASSERT_EQ(run("run " + bed + smooth + " --set bed.file=smooth.data --set time.end=0.01 --quiet --out smooth").exit,
            0);
  ASSERT_EQ(run(small_run("0.01", "smooth_packed" + smooth)).exit, 0);
  EXPECT_NEAR(level("smooth"), level("smooth_packed"), 2e-6);
  const Result of_run = run("bed reread --out two.data");
  ASSERT_EQ(of_run.exit, 0) << of_run.err;
  expect_contains(content(*this / "two.data"), {"500 atoms"});

  const Result count = run("run " + small_box + " --set bed.count=499" + from_file + "wrong");
  EXPECT_EQ(count.exit, 3);
  expect_contains(count.err, {"bed.file = one.data: it holds 500 grains, not bed.count = 499"});
  const Result missing = run("run " + bed + " --set bed.file=none.data --quiet --out wrong2");
  EXPECT_EQ(missing.exit, 5);
  expect_contains(missing.err, {"none.data"});
  const Result ids =
      run("run " + bed + " --set output.tracks_every=0.01 --set output.track_ids='3, 500' --quiet --out w3");
  EXPECT_EQ(ids.exit, 3);
  expect_contains(ids.err, {"output.track_ids names grain 500; there are the grains 0 to 499"});
  const Result words = run("check " + bed + " --set output.track_ids='3, x' --set output.profiles_x_to=0.3");
  EXPECT_EQ(words.exit, 3);
  expect_contains(words.err, {"output.track_ids: \"x\" is no id of a grain", "output.profiles_x_to = 0.3 m"});
}

}  // namespace
}  // namespace livebed
