#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/near_bed.hpp"
#include "report/run_folder.hpp"

/// What the page asks for by name, as bytes: `run.json`, `series`, `bed`, `analysis.json`, `motion`, `frame/N`.  A
/// server makes each when it is asked; report.html holds them all.
namespace livebed::report {

/// Title, numbers of the case, frames (indices into the run's), summary, log, the measurements that belong to the case.
nlohmann::ordered_json describe(const RunFolder& run, const std::vector<std::size_t>& frames);
std::vector<std::size_t> all_frames(const RunFolder& run);

/// The columns of series.csv by name, head {rows, first}: rows from the `first` on, at most `most` of them (every
/// k-th).
std::string pack_series(const RunFolder& run, std::size_t first, std::size_t most);
/// The bed lines: `time` [s], `x` [m], `y` [m] ([time][x]); head and rows as above.
std::string pack_bed(const RunFolder& run, std::size_t first, std::size_t most);
/// Mean flux of sand: head {nx, ny, dx, dy}, `flux` [m/s]; empty when no frame was measured.
std::string pack_motion(const NearBed& near_bed);
/// Frame number n of the run.  Fault (input/output) when there is none or its file is damaged.
std::string pack_frame(const RunFolder& run, std::size_t n);

}  // namespace livebed::report
