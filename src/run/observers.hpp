#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "io/table.hpp"
#include "io/vtk.hpp"
#include "run/checkpoint.hpp"
#include "run/sampling.hpp"
#include "run/simulation.hpp"

namespace livebed::run {

/// What a run leaves in its folder while it goes: series.csv, bed.csv, ParaView files, checkpoints and, where the case
/// asks for them, profiles.csv, tracks.csv and contact forces.  Each has a schedule in simulated time; what has been
/// written is counted in Progress, so that a resumed run writes the same bytes.
class Observers {
public:
  /// A new folder's files (progress all zero), or the continuation of old ones cut at the offsets of the progress.
  Observers(const std::filesystem::path& folder, const Simulation& sim, const Progress& progress);

  /// Writes what is due at the present time.  Called after the release and after every step.
  void observe(Simulation& sim);
  /// Writes a checkpoint now; keeps the last two.
  void checkpoint(Simulation& sim);

  const Progress& progress() const { return progress_; }
  Progress& progress() { return progress_; }
  /// S/D of the last row of the series.
  double scour_depth() const { return scour_depth_; }
  /// S/D has stayed within time.equilibrium_change over time.equilibrium_window.
  bool at_equilibrium(const casefile::Case& c) const;

private:
  void write_series(const Simulation& sim, bool bed_due);
  void write_frame(Simulation& sim);
  void write_bed(double time, const std::vector<double>& line);
  void write_more(const Simulation& sim);

  std::filesystem::path folder_;
  Sampler sampler_;
  Progress progress_;
  io::TableWriter series_, bed_;
  io::TimeSeries flow_files_, grain_files_;
  std::optional<Profiles> profiles_;
  std::optional<io::TableWriter> profile_table_, track_table_;
  std::optional<io::TimeSeries> contact_files_;
  std::vector<double> times_, depths_;  ///< S/D so far
  double scour_depth_ = 0;
};

/// Columns of bed.csv: time and the height of the bed at each x.
std::vector<std::string> bed_columns(const std::vector<double>& x);

}  // namespace livebed::run
