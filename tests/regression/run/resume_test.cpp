#include <algorithm>
#include <csignal>
#include <thread>

#include "io/table.hpp"
#include "same_run.hpp"

/// A run that was stopped, wherever and however, ends with the bytes of the one that was not.
namespace livebed {
namespace {

using Resume = Program;

const std::string one = "--threads 1 ";
constexpr int ok = 0, command_line = 2, input_output = 5, stopped_by_limit = 6;

TEST_F(Resume, from_many_stops_on_changing_threads_gives_the_unbroken_run) {
  ASSERT_EQ(run(one + small_run("0.12", "whole")).exit, ok);
  // The limit counts the packing, so this one stops after the first step of the spin-up.
  const Result first = run("--threads 2 " + small_run("0.12", "parts --wall-limit 1e-6"));
  EXPECT_EQ(first.exit, stopped_by_limit) << first.err;
  EXPECT_EQ(io::read_table(*this / "parts/series.csv").rows(), 0u);
  expect_contains(content(*this / "parts/summary.json"), {"\"ended\": \"stopped by the wall-time limit\""});
  // One step, one more, some, some more, the rest.
  for (const std::string limited :
       {"--threads 1 resume parts --wall-limit 1e-6", "--threads 2 resume parts --wall-limit 1e-6",
        "--threads 1 resume parts --wall-limit 0.2", "--threads 2 resume parts --wall-limit 0.2"}) {
    const Result result = run(limited);
    EXPECT_TRUE(result.exit == stopped_by_limit || result.exit == ok) << result.err;
  }
  EXPECT_EQ(run("--threads 2 resume parts --quiet").exit, ok);
  expect_same_run(*this / "whole", *this / "parts");
}

TEST_F(Resume, after_ctrl_c_gives_the_unbroken_run) {
  const std::string preset = " --set preset=livebed --set pipe.boundary_layer=laminar";
  ASSERT_EQ(run("--threads 2 " + small_run("0.15", "whole" + preset)).exit, ok);
  ASSERT_EQ(run(one + small_run("0.15", "parts --wall-limit 1e-6" + preset)).exit, stopped_by_limit);
  const pid_t child = start({"--threads", "1", "resume", "parts", "--quiet"});
  // As soon as there is a row, the grains are moving.
  const auto lines = [&] {
    const std::string series = content(*this / "parts/series.csv");
    return std::count(series.begin(), series.end(), '\n');
  };
  for (int n = 0; n < 20000 && lines() < 2; ++n) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_EQ(::kill(child, SIGINT), 0);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT);
  const std::string last = content(*this / "parts/log.txt");
  expect_contains(last, {"stopped by a signal"});
  EXPECT_LT(io::read_table(*this / "parts/series.csv").column("time_s").back(), 0.14);
  ASSERT_EQ(run(one + "resume parts --quiet").exit, ok);
  expect_same_run(*this / "whole", *this / "parts");
}

TEST_F(Resume, with_sand_that_leaves_and_enters_gives_the_unbroken_run) {
  const auto live = [](const std::string& end, const std::string& out) {
    return "run '" LIVEBED_SOURCE_DIR
           "/cases/quick' --no-bed-cache --quiet --set preset=livebed --set bed.supply=equilibrium"
           " --set current.theta=0.4 --set grains.sleep=true --set mesh.length=0.2 --set mesh.height=0.06"
           " --set pipe.x=0.13 --set bed.count=800 --set time.spin_up=0.05 --set output.series_every=0.005"
           " --set output.checkpoint_every=0.1 --set time.end=" +
           end + " --out " + out;
  };
  ASSERT_EQ(run("--threads 2 " + live("0.2", "whole")).exit, ok);
  ASSERT_EQ(run(one + live("0.13", "parts")).exit, ok);
  ASSERT_EQ(run(one + "resume parts --quiet --until 0.2").exit, ok);
  const std::string summary = content(*this / "whole/summary.json");
  expect_contains(summary, {"\"supply\"", "\"entered\""});
  EXPECT_EQ(summary.find("\"entered\": 0,"), std::string::npos) << summary;
  expect_same_run(*this / "whole", *this / "parts");
}

TEST_F(Resume, from_a_stop_at_the_release_gives_the_unbroken_run) {
  const std::string one_step = " --set bed.count=500 --set time.spin_up=1e-6";
  ASSERT_EQ(run(one + small_run("0.05", "whole", one_step)).exit, ok);
  ASSERT_EQ(run(one + small_run("0.05", "parts --wall-limit 1e-6", one_step)).exit, stopped_by_limit);
  ASSERT_EQ(run(one + "resume parts --quiet").exit, ok);
  EXPECT_GT(io::read_table(*this / "parts/series.csv").column("drag_N_m")[0], 0.0);
  expect_same_run(*this / "whole", *this / "parts");
}

TEST_F(Resume, until_a_later_end_gives_the_longer_run) {
  ASSERT_EQ(run(one + small_run("0.12", "whole")).exit, ok);
  ASSERT_EQ(run(one + small_run("0.05", "parts")).exit, ok);
  ASSERT_EQ(run(one + "resume parts --quiet --until 0.12").exit, ok);
  expect_same_run(*this / "whole", *this / "parts");
}

TEST_F(Resume, until_may_be_given_again_to_a_case_in_scour_time_scales) {
  ASSERT_EQ(run(one + "run " + small_case + " --quiet --out parts --set time.end_over_T=0.2").exit, ok);
  for (const std::string end : {"0.04", "0.06"}) {
    const Result result = run(one + "resume parts --quiet --until " + end);
    EXPECT_EQ(result.exit, ok) << result.err;
    EXPECT_GE(io::read_table(*this / "parts/series.csv").column("time_s").back(), std::stod(end));
    expect_contains(content(*this / "parts/case.resolved.toml"), {"\nend = " + end + "  # s"});
  }
  const Result past = run(one + "resume parts --quiet --until 0.05");
  EXPECT_EQ(past.exit, command_line);
  expect_contains(past.err, {"--until 0.05", "before the checkpoint at t = 0.06"});
}

TEST_F(Resume, of_a_finished_run_changes_nothing) {
  ASSERT_EQ(run(one + small_run("0.02", "whole")).exit, ok);
  fs::copy(*this / "whole", *this / "again", fs::copy_options::recursive);
  ASSERT_EQ(run(one + "resume again --quiet").exit, ok);
  expect_same_run(*this / "whole", *this / "again");
}

TEST_F(Resume, passes_over_a_damaged_checkpoint_and_says_so) {
  ASSERT_EQ(run(one + small_run("0.12", "whole")).exit, ok);
  fs::copy(*this / "whole", *this / "hurt", fs::copy_options::recursive);
  const fs::path newest = run::list_checkpoints(*this / "hurt").back();
  fs::resize_file(newest, fs::file_size(newest) / 2);
  const Result result = run(one + "resume hurt");
  EXPECT_EQ(result.exit, ok) << result.err;
  expect_contains(result.err, {newest.filename().string(), "trying the checkpoint before"});
  expect_contains(content(*this / "hurt/log.txt"), {"trying the checkpoint before"});
  // The damaged one is set aside, so that it cannot be taken for the last good one.
  EXPECT_TRUE(fs::remove(newest.string() + ".damaged"));
  expect_same_run(*this / "whole", *this / "hurt");
}

TEST_F(Resume, with_no_readable_checkpoint_is_refused) {
  ASSERT_EQ(run(one + small_run("0.04", "hurt")).exit, ok);
  for (const fs::path& file : run::list_checkpoints(*this / "hurt")) fs::resize_file(file, 1000);
  const auto before = everything_in(*this / "hurt");
  const Result hurt = run(one + "resume hurt --quiet");
  EXPECT_EQ(hurt.exit, input_output);
  expect_contains(hurt.err, {"hurt/checkpoints/step_"});

  fs::create_directory(*this / "empty");
  const Result empty = run("resume empty");
  EXPECT_EQ(empty.exit, input_output);
  expect_contains(empty.err, {"empty holds no checkpoint"});
  EXPECT_TRUE(fs::is_empty(*this / "empty"));
  EXPECT_EQ(run("resume nowhere").exit, input_output);
  EXPECT_FALSE(fs::exists(*this / "nowhere"));
}

TEST_F(Resume, with_grains_asleep_gives_the_unbroken_run) {
  const std::string sleepy = small_start + " --set grains.sleep=true --set current.theta=0.06";
  ASSERT_EQ(run("--threads 1 " + small_run("0.3", "whole", sleepy)).exit, ok);
  ASSERT_EQ(run("--threads 2 " + small_run("0.13", "parts", sleepy)).exit, ok);
  for (const std::string end : {"0.21", "0.3"}) ASSERT_EQ(run(one + "resume parts --quiet --until " + end).exit, ok);
  const std::string still = datasets_of(run::list_checkpoints(*this / "parts").back()).at("/grains/fluid_still");
  EXPECT_GT(std::count(still.begin(), still.end(), '\1'), 50) << "hardly anybody sleeps";
  expect_same_run(*this / "whole", *this / "parts");
}

TEST_F(Resume, is_not_needed_for_the_same_bits_on_other_threads) {
  for (const std::string preset : {"livebed", "mbs2d"}) {
    ASSERT_EQ(run("--threads 1 " + small_run("0.08", preset + "1 --set preset=" + preset)).exit, ok);
    ASSERT_EQ(run("--threads 2 " + small_run("0.08", preset + "2 --set preset=" + preset)).exit, ok);
    expect_same_run(*this / (preset + "1"), *this / (preset + "2"));
  }
}

}  // namespace
}  // namespace livebed
