#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "same_run.hpp"

/// A sweep runs side by side, goes on after whatever stopped it, and gives what single runs give.
namespace livebed {
namespace {

class Sweep : public Program {
protected:
  std::string sweep(const std::string& rest, const std::string& end = "0.1") const {
    return "sweep " + small_case + " --no-bed-cache --out swept --set time.end=" + end + " " + rest;
  }
  /// Starts one that would take long and waits until both its runs have a checkpoint after t = 0.
  pid_t begin_long(const std::string& end) const {
    std::vector<std::string> words{"sweep",          LIVEBED_SOURCE_DIR "/cases/quick",
                                   "--no-bed-cache", "--quiet",
                                   "--out",          "swept",
                                   "--seeds",        "1,2",
                                   "--jobs",         "2"};
    for (const char* key : {"mesh.length=0.12", "mesh.height=0.06", "pipe.x=0.05", "bed.count=500", "time.spin_up=0.05",
                            "output.series_every=0.005", "output.bed_every=0.02", "output.fields_every=0.04",
                            "output.checkpoint_every=0.03"})
      words.insert(words.end(), {"--set", key});
    words.insert(words.end(), {"--set", "time.end=" + end});
    const pid_t child = start(words);
    const auto both = [&] {
      return run::list_checkpoints(*this / "swept/runs/seed=1").size() > 1 &&
             run::list_checkpoints(*this / "swept/runs/seed=2").size() > 1;
    };
    for (int n = 0; n < 2000 && !both(); ++n) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(both());
    return child;
  }
  nlohmann::json result() const { return nlohmann::json::parse(content(*this / "swept/sweep.json")); }
};

TEST_F(Sweep, gives_what_single_runs_give_and_is_kept) {
  const Result first = run(sweep("--seeds 1,2 --set current.theta=0.2,0.33 --jobs 2"));
  ASSERT_EQ(first.exit, 0) << first.err;
  expect_contains(first.out, {"swept/sweep.csv", "swept/sweep.json", "swept/sweep.html"});
  expect_contains(first.err,
                  {"2 combinations, 4 runs: 0 have ended before, 4 to do, 2 at a time", "4 of 4: current.theta=0."});
  ASSERT_EQ(run(small_run("0.1", "alone", small_start + " --set bed.seed=2 --set current.theta=0.2")).exit, 0);
  expect_same_run(*this / "alone", *this / "swept/runs/current.theta=0.2,seed=2");
  const auto json = result();
  ASSERT_EQ(json["combinations"].size(), 2u);
  for (const auto& combination : json["combinations"]) {
    EXPECT_EQ(combination["scour_depth_over_D"]["n"], 2);
    EXPECT_EQ(combination["S_eq_over_D"]["n"], 0);  // a tenth of a second is not the end of a hole
    EXPECT_EQ(combination["S_eq_over_D"]["mean"], nullptr);
    EXPECT_GT(combination["drag_N_m"]["mean"], 0.0);
  }
  const auto alone = nlohmann::json::parse(content(*this / "alone/summary.json"));
  EXPECT_EQ(json["combinations"][0]["runs"][1]["scour_depth_over_D"], alone["scour_depth_over_D"]);

  // Again: nothing is run, the tables are made from the files; with one more seed that alone is run.
  const auto before = everything_in(*this / "swept");
  fs::remove(*this / "swept/sweep.csv");
  const Result again = run(sweep("--seeds 1,2 --set current.theta=0.2,0.33 --json"));
  EXPECT_EQ(again.exit, 0) << again.err;
  EXPECT_EQ(nlohmann::json::parse(again.out), json);
  EXPECT_TRUE(everything_in(*this / "swept") == before);
  const Result more = run(sweep("--seeds 1,2,3 --set current.theta=0.33,0.2"));
  expect_contains(more.err, {"4 have ended before, 2 to do"});
  EXPECT_EQ(result()["combinations"][0]["scour_depth_over_D"]["n"], 3);
}

TEST_F(Sweep, interrupted_stops_every_run_with_a_checkpoint_and_goes_on_to_the_same_end) {
  const pid_t child = begin_long("0.5");
  ::kill(child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 128 + SIGINT);
  for (const char* seed : {"1", "2"})
    expect_contains(content(*this / "swept/runs" / (std::string("seed=") + seed) / "summary.json"),
                    {"\"ended\": \"stopped by a signal\""});
  EXPECT_EQ(result()["combinations"][0]["scour_depth_over_D"]["n"], 0);
  EXPECT_EQ(result()["combinations"][0]["runs"][0]["state"], "unfinished");
  fs::remove_all(*this / "swept/runs/seed=2/checkpoints");  // as if it had not come so far

  const Result second = run(sweep("--seeds 1,2 --jobs 1", "0.5"));
  ASSERT_EQ(second.exit, 0) << second.err;
  EXPECT_EQ(result()["combinations"][0]["scour_depth_over_D"]["n"], 2);
  expect_contains(content(*this / "swept/runs/seed=1/log.txt"), {"resuming at t = "});
  for (const std::string seed : {"1", "2"}) {
    ASSERT_EQ(run(small_run("0.5", "alone" + seed, small_start + " --set bed.seed=" + seed)).exit, 0);
    expect_same_run(*this / ("alone" + seed), *this / ("swept/runs/seed=" + seed));
  }
}

TEST_F(Sweep, killed_leaves_runs_that_stop_by_themselves) {
  const pid_t child = begin_long("50");
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  const auto left = [&](const fs::path& run) {  // "running" is the last file that a run removes
    return fs::exists(run / "summary.json") && !fs::exists(run / "running");
  };
  const auto stopped = [&] { return left(*this / "swept/runs/seed=1") && left(*this / "swept/runs/seed=2"); };
  for (int n = 0; n < 2000 && !stopped(); ++n) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(stopped());
}

TEST_F(Sweep, a_failed_run_is_named_and_loses_no_other) {
  ASSERT_EQ(run(sweep("--seeds 1,2 --quiet")).exit, 0);
  fs::remove(*this / "swept/runs/seed=1/summary.json");
  for (const auto& file : run::list_checkpoints(*this / "swept/runs/seed=1")) std::ofstream(file) << "damaged";
  const Result damaged = run(sweep("--seeds 1,2,3"));
  EXPECT_EQ(damaged.exit, 5);
  expect_contains(damaged.err, {"failed: seed=1: ", "checkpoints/step_", "the same command goes on"});
  EXPECT_EQ(result()["combinations"][0]["scour_depth_over_D"]["n"], 2);
  EXPECT_EQ(result()["combinations"][0]["runs"][0]["state"], "failed");
}

TEST_F(Sweep, refuses_a_changed_case_and_a_foreign_folder_and_touches_nothing) {
  ASSERT_EQ(run(sweep("--seeds 1 --quiet")).exit, 0);
  const auto before = everything_in(folder());
  const Result changed = run(sweep("--seeds 1", "0.2"));
  EXPECT_EQ(changed.exit, 5);
  expect_contains(changed.err, {"seed=1 has changed: time.end = 0.2, not 0.1", "give another folder with --out"});
  const Result foreign = run("sweep " + small_case + " --out swept/runs/seed=1");
  EXPECT_EQ(foreign.exit, 5);
  expect_contains(foreign.err, {"swept/runs/seed=1 exists already and is not the folder of a sweep"});
  const Result invalid = run(sweep("--seeds 1 --set current.theta=0.2,-1"));
  EXPECT_EQ(invalid.exit, 3);
  expect_contains(invalid.err, {"current.theta = -1", "nothing was run"});
  EXPECT_TRUE(everything_in(folder()) == before);
}

}  // namespace
}  // namespace livebed
