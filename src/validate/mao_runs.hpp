#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "validate/result.hpp"

/// Runs of one experiment of Mao's, side by side and against his.
namespace livebed::validate {

/// Where the runs of the experiment are kept, from the working folder, each a run folder.
inline constexpr const char* kept_scours = "runs/validate/mao";

struct MaoRun {
  unsigned number = 1;              ///< from 1 on
  std::string label, curve;         ///< in numbers, in figures
  std::vector<std::string> keys{};  ///< what differs from the case
  std::string says{};               ///< what it is, for the comment in the tables
};

struct Experiment {
  std::string name;       ///< of folders and files
  std::string_view text;  ///< the case
  std::string column;     ///< what the numbers of its runs are: seed, variant
  std::vector<MaoRun> runs;
  bool scaled = false;  ///< times count as t/T; numbers are told, not judged
};

/// Makes the runs or goes on with them and compares depth in time and bed lines; tables and figures of all.  Throws
/// as livebed::validate::mao does.
Result hold_against_mao(const Experiment& e, const Only& only, const Tell& tell);

/// What makes 0.7 mm grains of cases/mao, times scaled with T.
const std::vector<std::string>& keys_of_07mm();

}  // namespace livebed::validate
