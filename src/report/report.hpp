#pragma once
#include <string>
#include <vector>

#include "io/file.hpp"

/// The report reads files only, so it can be made again at any time, also while the run is going on.
namespace livebed::report {

struct Written {
  io::Path path;                     ///< report.html
  std::size_t frames = 0;            ///< of the run that are in it
  std::vector<std::string> missing;  ///< what the run folder lacks, one sentence each
};

/// Writes <folder>/report.html: the page with all its data inside, no network needed.  Of the frames it takes as many
/// as fit into some megabytes, evenly spread, the first and the last among them.  Faults (input/output): no run folder,
/// damaged files, unwritable folder.
Written write_report(const io::Path& folder);

/// Writes one page with the curves of several runs on top of each other, in the order given.
void write_comparison(const std::vector<io::Path>& folders, const io::Path& out_html);

/// Writes the snapshot nearest to `time` [s] as a PNG with bed line; returns the time it shows.
double write_picture(const io::Path& folder, double time, const io::Path& out_png);

}  // namespace livebed::report
