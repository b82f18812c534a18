#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/file.hpp"

/// What many runs of one case say together: mean and band over seeds for each combination of swept keys.
namespace livebed::report {

/// One run of a sweep, as it was asked for.
struct SweepRun {
  std::string name;
  io::Path folder;              ///< need not exist yet
  std::size_t combination = 0;  ///< of SweepPlan::combinations
  long long seed = 0;
  std::string fault;  ///< why it failed; empty when it did not
};

struct SweepPlan {
  std::string title;
  std::vector<std::string> columns;                    ///< a swept key each, with its unit: "grains.diameter_m"
  std::vector<std::vector<std::string>> combinations;  ///< values of these: numbers in SI units, or words
  std::vector<SweepRun> runs;
};

/// The numbers taken from each run, in the order of RunNumbers::values.  Means of forces are over the second half of
/// the series.
inline constexpr const char* sweep_quantities[] = {
    "S_eq_over_D",    "T_s",      "fit_S_eq_over_D", "fit_T_s",          "scour_depth_over_D",
    "theta_measured", "drag_N_m", "lift_N_m",        "largest_drag_N_m", "largest_lift_N_m",
    "wall_s"};

/// How far a run has come.
enum class RunState { waiting, unfinished, ended };
const char* word_of(RunState state);

/// What one run has left in its folder.
struct RunNumbers {
  RunState state = RunState::waiting;
  std::string ended;                          ///< why it ended, in its own words
  std::vector<std::optional<double>> values;  ///< one a quantity; empty where the run does not tell it
  double time_scale = 0;                      ///< T [s], 0 without
  std::vector<double> time, S_over_D;         ///< [s], [-]
};

/// Has the run in this folder come to its end (of time or at equilibrium)?  False when it was stopped or has not begun.
RunState state_of(const io::Path& folder);
/// Reads summary.json and series.csv.  Fault (input/output) when one of them is damaged.
RunNumbers read_numbers(const io::Path& folder);

/// Over the seeds that tell a number; all but n are meaningless when n = 0, and sd (of the sample) when n = 1.
struct Spread {
  int n = 0;
  double mean = 0, sd = 0, least = 0, most = 0;
};
Spread spread_of(const std::vector<std::optional<double>>& values);

struct Sweep {
  SweepPlan plan;
  std::vector<RunNumbers> runs;              ///< [plan.runs]
  std::vector<std::vector<Spread>> spreads;  ///< [plan.combinations][sweep_quantities]; of ended runs alone
};
Sweep gather(SweepPlan plan);

/// One row a combination: its values, runs asked for and ended, then <quantity>_n, _mean, _sd, _min, _max.  What no run
/// tells is an empty cell.
std::string sweep_csv(const Sweep& sweep);
/// The same and each run, what is not there as null.
nlohmann::ordered_json sweep_json(const Sweep& sweep);
/// One page with its charts (sweep_page.cpp).
std::string sweep_page(const Sweep& sweep);
/// Writes sweep.csv, sweep.json and sweep.html into the folder.
void write_sweep(const Sweep& sweep, const io::Path& folder);

}  // namespace livebed::report
