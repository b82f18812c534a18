#pragma once
#include <string>
#include <vector>

#include "io/file.hpp"

/// The report reads files only, so it can be made again at any time, also while the run is going on.
namespace livebed::report {

struct Written {
  io::Path path;                     ///< report.html
  int snapshots = 0;                 ///< pictures in it
  std::vector<std::string> missing;  ///< what the run folder lacks, one sentence each
};

/// Writes <folder>/report.html: one file with everything inside (pictures, curves, style), no network needed.  Faults
/// (input/output): no run folder, damaged files, unwritable folder.
Written write_report(const io::Path& folder);

/// Writes the snapshot nearest to `time` [s] as a PNG with bed line; returns the time it shows.
double write_picture(const io::Path& folder, double time, const io::Path& out_png);

}  // namespace livebed::report
