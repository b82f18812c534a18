#pragma once
#include <vector>

#include "report/run_folder.hpp"

namespace livebed::report {

/// A moment of a run: the snapshot nearest to a time.
struct Moment {
  double wanted = 0;           ///< time asked for [s]
  double time = 0;             ///< time of the snapshot [s]
  std::string fields, grains;  ///< files, relative to the folder; grains may be empty
};

/// The snapshot nearest to a time.  Fault (input/output) when the run has none.
Moment nearest_moment(const RunFolder& run, double time);

/// Reads a moment and sets the view: bed line, original bed as y = 0, and Mao's profile where t/T is that of one
/// (within 15 %).
std::pair<Snapshot, SnapshotOptions> load_moment(const RunFolder& run, const Moment& moment);

}  // namespace livebed::report
