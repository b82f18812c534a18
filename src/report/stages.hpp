#pragma once
#include <vector>

#include "report/run_folder.hpp"

namespace livebed::report {

/// A snapshot that the report shows.
struct Stage {
  double wanted = 0;           ///< time asked for [s]
  double time = 0;             ///< time of the snapshot [s]
  std::string fields, grains;  ///< files, relative to the folder; grains may be empty
};

/// The snapshots nearest to the paper's stages (t/T of 0, 11, 18, 25, 50, 120 s over Mao's T) that the run has reached,
/// each once; without a time scale six evenly spread ones.
std::vector<Stage> stages(const RunFolder& run);

/// The snapshot nearest to a time.  Fault (input/output) when the run has none.
Stage nearest_stage(const RunFolder& run, double time);

/// Reads a stage and sets the view: bed line, original bed as y = 0, and Mao's profile where t/T is that of one (within
/// 15 %).
std::pair<Snapshot, SnapshotOptions> load_stage(const RunFolder& run, const Stage& stage);

}  // namespace livebed::report
