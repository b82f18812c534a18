#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/table.hpp"
#include "io/vtk.hpp"
#include "report/snapshot.hpp"

namespace livebed::report {

/// The bed at one time.
struct BedLine {
  double time = 0;           ///< [s]
  std::vector<double> x, y;  ///< [m]
};

/// All lines of a run.
struct BedHistory {
  std::vector<double> time;            ///< [s]
  std::vector<double> x;               ///< [m]
  std::vector<std::vector<double>> y;  ///< [m], [time][x]
  BedLine nearest(double t) const;
};

/// What a run has left in its folder so far; everything but the resolved case may be missing.
struct RunFolder {
  io::Path path;
  std::string case_text;  ///< case.resolved.toml
  std::string title;
  std::optional<double> time_scale;  ///< T [s]
  double theta = 0;                  ///< nominal [-], 0 when the case tells none
  double mean_speed = 0;             ///< of the current over the depth [m/s], 0 when the case tells none
  double bed_level = 0;              ///< [m], 0 when the case tells none
  double grain_diameter = 0;         ///< d [m], d50 of a grading, 0 when the case tells none
  double water_density = 1000;       ///< [kg/m3]
  double viscosity = 1e-6;           ///< nu [m2/s]
  std::optional<Pipe> pipe;          ///< from pipe.vtp
  nlohmann::ordered_json summary;    ///< null while the run is not finished
  std::optional<io::Table> series;
  std::optional<BedHistory> bed;
  std::vector<io::TimedFile> fields, grains;  ///< of flow.pvd and grains.pvd
  std::string log_end;                        ///< last lines of log.txt
  std::vector<std::string> missing;           ///< sentences for the reader

  /// Level of the bed at t = 0 [m]: summary.json's, or the mean of the first line outside the pipe, or the case's; NaN
  /// without any.
  double original_level() const;
};

/// Reads all but the tables: what is cheap enough to look at every second while the run is going on.  Fault
/// (input/output) when the folder is no run folder or a file in it is damaged.
RunFolder read_outline(const io::Path& folder);
/// Reads the whole folder.
RunFolder read_run(const io::Path& folder);

}  // namespace livebed::report
