#include "run/control.hpp"

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "same_run.hpp"

/// A run obeys the file `command` in its folder, tells where it stands, and computes the same for all that.
namespace livebed {
namespace {

class Control : public Program {
protected:
  /// Waits up to a minute (the sanitizers are slow) for something to become true.
  template <class Holds>
  static bool wait(Holds&& holds) {
    for (int n = 0; n < 6000 && !holds(); ++n) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return holds();
  }
  nlohmann::json status(const std::string& name) const {
    const auto json = nlohmann::json::parse(content(*this / (name + "/status.json")), nullptr, false);
    return json.is_object() ? json : nlohmann::json{{"phase", ""}, {"t_s", -1}};
  }
  bool in_phase(const std::string& name, const std::string& phase) const {
    return wait([&] { return status(name)["phase"] == phase; });
  }
  void say(const std::string& name, const std::string& word) const {
    std::ofstream(*this / (name + "/command")) << word << '\n';
    EXPECT_TRUE(wait([&] { return !fs::exists(*this / (name + "/command")); })) << word << " was not taken";
  }
  static int ended(pid_t child) {
    int status = 0;
    return ::waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  pid_t begin(const std::string& name, const std::string& end) const {
    std::vector<std::string> words{"run", LIVEBED_SOURCE_DIR "/cases/quick", "--no-bed-cache", "--quiet", "--out",
                                   name};
    for (const char* key : {"mesh.length=0.12", "mesh.height=0.06", "pipe.x=0.05", "bed.count=500", "time.spin_up=0.05",
                            "output.series_every=0.005", "output.bed_every=0.02", "output.fields_every=0.04",
                            "output.checkpoint_every=0.03"})
      words.insert(words.end(), {"--set", key});
    words.insert(words.end(), {"--set", "time.end=" + end});
    return start(words);
  }
};

TEST_F(Control, pauses_writes_checkpoints_and_goes_on_to_the_same_end) {
  ASSERT_EQ(run("--threads 1 " + small_run("0.4", "whole")).exit, 0);
  const pid_t child = begin("led", "0.4");
  ASSERT_TRUE(in_phase("led", "digging"));
  EXPECT_TRUE(run::is_running(*this / "led"));
  say("led", "pause");
  ASSERT_TRUE(in_phase("led", "paused"));
  const double paused_at = status("led")["t_s"];
  EXPECT_LT(paused_at, 0.4);
  fs::remove_all(*this / "led/checkpoints");
  fs::create_directory(*this / "led/checkpoints");
  say("led", "checkpoint");
  EXPECT_TRUE(wait([&] { return run::list_checkpoints(*this / "led").size() == 1; }));
  say("led", "dance");
  EXPECT_TRUE(wait(
      [&] { return content(*this / "led/log.txt").find("\"dance\"; there are checkpoint") != std::string::npos; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(600));  // a status later
  EXPECT_EQ(status("led")["t_s"], paused_at);
  say("led", "go");
  EXPECT_EQ(ended(child), 0);
  EXPECT_FALSE(run::is_running(*this / "led"));
  for (const char* gone : {"status.json", "running", "command"}) EXPECT_FALSE(fs::exists(*this / "led" / gone)) << gone;
  expect_same_run(*this / "whole", *this / "led");
}

TEST_F(Control, stops_as_on_a_signal_and_only_one_program_runs_a_folder) {
  const pid_t child = begin("led", "50");
  ASSERT_TRUE(in_phase("led", "digging"));
  const Result second = run("resume led --quiet");
  EXPECT_EQ(second.exit, 5);
  expect_contains(second.err, {"led is being run by another program", "livebed watch led"});
  EXPECT_TRUE(run::is_running(*this / "led"));
  say("led", "stop");
  EXPECT_EQ(ended(child), 128 + SIGTERM);
  expect_contains(content(*this / "led/summary.json"), {"\"ended\": \"stopped by a signal\""});
  EXPECT_EQ(run("resume led --quiet --wall-limit 1e-6").exit, 6);
}

TEST_F(Control, stops_on_a_signal_while_the_grains_settle) {
  const pid_t child = start({"run", LIVEBED_SOURCE_DIR "/cases/quick", "--no-bed-cache", "--out", "led", "--set",
                             "bed.settled_speed=1e-12", "--set", "bed.settle_time=1000"});
  ASSERT_TRUE(in_phase("led", "packing"));
  ::kill(child, SIGTERM);
  EXPECT_EQ(ended(child), 128 + SIGTERM);
  expect_contains(content(*this / "led/log.txt"), {"stopped while the grains settled", "remove led and run"});
  EXPECT_FALSE(run::is_running(*this / "led"));
}

TEST_F(Control, a_killed_run_leaves_no_lock) {
  const pid_t child = begin("led", "50");
  ASSERT_TRUE(wait([&] { return !run::list_checkpoints(*this / "led").empty(); }));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(fs::exists(*this / "led/status.json"));
  EXPECT_FALSE(run::is_running(*this / "led"));
  EXPECT_EQ(run("resume led --quiet --wall-limit 1e-6").exit, 6);
  EXPECT_FALSE(fs::exists(*this / "led/status.json"));
}

}  // namespace
}  // namespace livebed
