#include "report/sweep.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../io/expect_fault.hpp"
#include "../io/temporary_folder.hpp"
#include "io/table.hpp"

namespace livebed::report {
namespace {

/// What a run leaves for a sweep: S = depth t/10, drag 2 in the first half and 4 after it, lift -1 with one peak of -7.
void write_run(const io::Path& folder, double depth, const std::string& ended, const std::string& S_eq,
               double last = 10) {
  io::make_folder(folder);
  io::TableWriter series(folder / "series.csv", {"time_s", "t_over_T", "S_over_D", "drag_N_m", "lift_N_m"});
  for (double t = 0; t <= last; t += 0.5)
    series.row(std::vector<double>{t, t / 2, depth * t / 10, t < last / 2 ? 2.0 : 4.0, t == 1 ? -7.0 : -1.0});
  if (!ended.empty())
    io::write_atomically(folder / "summary.json",
                         fmt::format(R"({{"ended": "{}", "time_scale_s": 2, "scour_depth_over_D": {}, "S_eq_over_D": {},
                           "T_s": {}, "fit": {{"S_eq_over_D": 0.7, "T_s": 3}}, "theta_measured": 0.3, "wall_s": 12}})",
                                     ended, depth, S_eq, S_eq == "null" ? "null" : "1.5"));
}

/// Two values of theta with three seeds each: of the first all three have ended, of the second one, and one has failed.
class SweepOfRuns : public testing::Test {
protected:
  void SetUp() override {
    plan.title = "A sweep of <formulas>";
    plan.columns = {"current.theta", "coupling.drag"};
    plan.combinations = {{"0.2", "paper"}, {"0.3", "a,b"}};
    for (std::size_t c = 0; c < 2; ++c)
      for (long long seed = 1; seed <= 3; ++seed) {
        const std::string name = fmt::format("{}-{}", c, seed);
        plan.runs.push_back({name, folder / name, c, seed, ""});
      }
    write_run(folder / "0-1", 0.5, "equilibrium", "0.5");
    write_run(folder / "0-2", 0.6, "end of time", "null");
    write_run(folder / "0-3", 0.7, "equilibrium", "0.6", 8);
    write_run(folder / "1-1", 0.9, "end of time", "null");
    write_run(folder / "1-2", 0.4, "stopped by a signal", "null");
    plan.runs[4].fault = "k = nan";
  }
  const TemporaryFolder folder;
  SweepPlan plan;
};

TEST(sweep, spreads_count_only_what_is_there) {
  const Spread three = spread_of({1.0, std::nullopt, 2.0, 6.0});
  EXPECT_EQ(three.n, 3);
  EXPECT_EQ(three.mean, 3.0);
  EXPECT_NEAR(three.sd, std::sqrt(7.0), 1e-15);
  EXPECT_EQ(three.least, 1.0);
  EXPECT_EQ(three.most, 6.0);
  EXPECT_EQ(spread_of({std::nullopt}).n, 0);
  EXPECT_EQ(spread_of({-2.0}).sd, 0.0);
  EXPECT_EQ(spread_of({-2.0}).most, -2.0);
}

TEST_F(SweepOfRuns, takes_its_numbers_from_the_files_alone) {
  EXPECT_EQ(state_of(folder / "0-1"), RunState::ended);
  EXPECT_EQ(state_of(folder / "1-2"), RunState::unfinished);
  EXPECT_EQ(state_of(folder / "1-3"), RunState::waiting);
  const RunNumbers run = read_numbers(folder / "0-1");
  const std::vector<std::optional<double>> told = {0.5, 1.5, 0.7, 3.0, 0.5, 0.3, 4.0, -1.0, 4.0, 7.0, 12.0};
  EXPECT_EQ(run.values, told);
  EXPECT_EQ(read_numbers(folder / "0-2").values[0], std::nullopt);
  io::write_atomically(folder / "0-1/summary.json", "{");
  expect_io_fault([&] { read_numbers(folder / "0-1"); }, {"0-1/summary.json is not valid JSON"});
}

TEST_F(SweepOfRuns, gives_mean_and_band_of_the_seeds_that_have_ended) {
  const Sweep sweep = gather(plan);
  const Spread &S_eq = sweep.spreads[0][0], &depth = sweep.spreads[0][4];
  EXPECT_EQ(S_eq.n, 2);
  EXPECT_NEAR(S_eq.mean, 0.55, 1e-15);
  EXPECT_EQ(depth.n, 3);
  EXPECT_NEAR(depth.mean, 0.6, 1e-15);
  EXPECT_NEAR(depth.sd, 0.1, 1e-15);
  EXPECT_EQ(sweep.spreads[1][0].n, 0);
  EXPECT_EQ(sweep.spreads[1][4].n, 1);
  EXPECT_EQ(sweep.spreads[1][4].mean, 0.9);
}

TEST_F(SweepOfRuns, leaves_a_table_with_a_row_a_combination) {
  const std::string csv = sweep_csv(gather(plan));
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < csv.size();) {
    const std::size_t end = csv.find('\n', at);
    lines.push_back(csv.substr(at, end - at));
    at = end + 1;
  }
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_TRUE(
      lines[0].starts_with("current.theta,coupling.drag,runs,ended,S_eq_over_D_n,S_eq_over_D_mean,S_eq_over_D_sd,"
                           "S_eq_over_D_min,S_eq_over_D_max,T_s_n"))
      << lines[0];
  EXPECT_TRUE(lines[1].starts_with("0.2,paper,3,3,2,0.55,0.0707106")) << lines[1];
  EXPECT_TRUE(lines[2].starts_with("0.3,\"a,b\",3,1,0,,,,,0,,,,,1,0.7,,0.7,0.7")) << lines[2];
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), ','), std::count(lines[1].begin(), lines[1].end(), ','));
}

TEST_F(SweepOfRuns, leaves_json_with_null_for_what_was_not_reached) {
  const auto json = sweep_json(gather(plan));
  const auto& first = json["combinations"][0];
  EXPECT_EQ(first["values"]["current.theta"], 0.2);
  EXPECT_EQ(first["values"]["coupling.drag"], "paper");
  EXPECT_EQ(first["S_eq_over_D"]["n"], 2);
  EXPECT_EQ(first["runs"][1]["S_eq_over_D"], nullptr);
  EXPECT_EQ(first["runs"][1]["state"], "ended");
  const auto& second = json["combinations"][1];
  EXPECT_EQ(second["S_eq_over_D"]["mean"], nullptr);
  EXPECT_EQ(second["scour_depth_over_D"]["sd"], nullptr);
  EXPECT_EQ(second["runs"][1]["state"], "failed");
  EXPECT_EQ(second["runs"][1]["fault"], "k = nan");
  EXPECT_EQ(second["runs"][2]["state"], "waiting");
}

TEST_F(SweepOfRuns, leaves_a_page_with_its_charts_and_says_what_is_not_in_the_means) {
  write_sweep(gather(plan), folder.path());
  const std::string page = io::read_file(folder / "sweep.html");
  const auto count = [&](const std::string& word) {
    int n = 0;
    for (auto at = page.find(word); at != page.npos; at = page.find(word, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<figure>"), 4);              // two keys, two combinations
  EXPECT_EQ(count("<path class=\"band\""), 4);  // S_eq of the first (a line's width) twice, in time twice
  EXPECT_EQ(count("A sweep of &lt;formulas&gt;"), 2);
  EXPECT_EQ(count("<li>1-2 failed: k = nan</li>"), 1);
  EXPECT_EQ(count("<li>1-3 is not begun</li>"), 1);
  EXPECT_EQ(count("<li>0-2 ended before S/D was steady"), 1);
  EXPECT_EQ(count("0.55 ± 0.071 (2 of 3)"), 1);
  EXPECT_EQ(count("not reached"), 2);  // S_eq and T of the second
  EXPECT_EQ(count("</html>"), 1);
  EXPECT_EQ(io::read_file(folder / "sweep.csv"), sweep_csv(gather(plan)));
}

TEST(sweep, a_sweep_of_seeds_alone_has_one_chart_of_depth_in_time) {
  const TemporaryFolder folder;
  write_run(folder / "1", 0.5, "equilibrium", "0.5");
  const SweepPlan plan{"seeds", {}, {{}}, {{"seed=1", folder / "1", 0, 1, ""}}};
  const std::string page = sweep_page(gather(plan));
  EXPECT_EQ(page.find("Depth against"), page.npos);
  EXPECT_NE(page.find("seed 1</span>"), page.npos);
  EXPECT_TRUE(sweep_csv(gather(plan)).starts_with("runs,ended,"));
}

}  // namespace
}  // namespace livebed::report
