#include "io/table.hpp"
#include "same_run.hpp"

/// When a run cannot go on: which exit code, what is said, and what must stay as it was.
namespace livebed {
namespace {

using RunFaults = Program;

constexpr int ok = 0, invalid_case = 3, diverged = 4, input_output = 5, stopped_by_limit = 6;
const std::string one = "--threads 1 ";

TEST_F(RunFaults, a_folder_with_anything_in_it_is_never_written_to) {
  fs::create_directory(*this / "mine");
  std::ofstream(*this / "mine/notes.txt") << "keep me";
  const auto before = everything_in(*this / "mine");
  const Result result = run(one + "run " + small_case + " --out mine");
  EXPECT_EQ(result.exit, input_output);
  expect_contains(result.err, {"mine exists already", "--out", "livebed resume mine"});
  EXPECT_EQ(everything_in(*this / "mine"), before);
}

TEST_F(RunFaults, a_folder_that_cannot_be_made_is_told) {
  std::ofstream(*this / "file") << "not a folder";
  const Result result = run(one + "run " + small_case + " --out file/run");
  EXPECT_EQ(result.exit, input_output);
  expect_contains(result.err, {"file/run"});
  if (::geteuid() != 0) {
    fs::create_directory(*this / "locked");
    fs::permissions(*this / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_EQ(run(one + "run " + small_case + " --out locked/run").exit, input_output);
    fs::permissions(*this / "locked", fs::perms::owner_all);
  }
}

TEST_F(RunFaults, a_bad_case_leaves_no_folder) {
  EXPECT_EQ(run(one + "run " + small_case + " --set grains.diameter=-1 --out new").exit, invalid_case);
  EXPECT_FALSE(fs::exists(*this / "new"));
}

TEST_F(RunFaults, a_full_disk_leaves_the_older_files_whole) {
  ASSERT_EQ(run(one + small_run("0.12", "whole")).exit, ok);
  ASSERT_EQ(run(one + small_run("0.12", "full --wall-limit 1e-6")).exit, stopped_by_limit);
  const auto checkpoints = run::list_checkpoints(*this / "full");
  ASSERT_EQ(checkpoints.size(), 1u);
  const std::string before = content(checkpoints[0]);
  // Files may grow to 64 kB, which a checkpoint does not fit into: as if the disk were full.
  ASSERT_GT(before.size(), 100000u);
  const Result result = run(one + "resume full --quiet", "ulimit -f 128 &&");
  EXPECT_EQ(result.exit, input_output);
  expect_contains(result.err, {"full/checkpoints/step_", "File too large"});
  expect_contains(content(*this / "full/log.txt"), {"File too large"});
  EXPECT_EQ(run::list_checkpoints(*this / "full"), checkpoints);
  EXPECT_TRUE(content(checkpoints[0]) == before);
  for (const auto& file : everything_in(*this / "full")) EXPECT_FALSE(file.first.ends_with(".part")) << file.first;
  // With room again the run goes on as if nothing had been.
  ASSERT_EQ(run(one + "resume full --quiet").exit, ok);
  expect_same_run(*this / "whole", *this / "full");
}

TEST_F(RunFaults, a_diverging_run_says_where_and_when_and_what_to_go_back_to) {
  // Drag as strong as this cannot lag behind by a step.
  const Result result = run(one + small_run("0.12", "wild --set flow.viscosity=1"));
  EXPECT_EQ(result.exit, diverged);
  const auto checkpoints = run::list_checkpoints(*this / "wild");
  ASSERT_FALSE(checkpoints.empty());
  const std::string good = "last good checkpoint: wild/checkpoints/" + checkpoints.back().filename().string();
  expect_contains(result.err, {"t = 0", "flow step ", "x = ", "y = ", "largest speed was", "in cell (", good});
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  expect_contains(content(*this / "wild/log.txt"), {good});
  EXPECT_EQ(run::load_checkpoint(checkpoints.back()).sim.bed().state.count(), 500);
  EXPECT_TRUE(fs::exists(*this / "wild/case.resolved.toml"));
}

}  // namespace
}  // namespace livebed
