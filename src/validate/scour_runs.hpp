#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "validate/result.hpp"

/// Runs of scour that take minutes to hours: each kept in a folder of its own, made or gone on with by the same
/// command.
namespace livebed::validate {

/// What a run left: depth and bed lines in time, 0 when the grains were let go.
struct Scour {
  unsigned seed = 0;
  casefile::Case resolved;
  std::string commit;
  double wall = 0;                         ///< [s]
  std::vector<double> t, depth;            ///< [s], S/D
  std::vector<double> x, t_lines;          ///< from the pipe's centre [D], [s]
  std::vector<std::vector<double>> lines;  ///< over the original bed [D]
};

/// The run of a case kept in a folder; what is missing of it is made first, until a signal.  A run that fails is told,
/// and what there is of it is what there is.  Empty when that ends before its grains were let go.  Throws Fault:
/// input/output when the folder holds a run of another case, and where files cannot be read or written.
std::optional<Scour> scour(const casefile::Case& c, const std::filesystem::path& folder, const Tell& tell);

/// A row that fails: a run asked for is not there.
Row missing(const std::string& name);

/// Mean S/D over [from, to] s; NaN where the run has nothing.
double mean_depth(const Scour& s, double from, double to);
/// When the mean of S over `span` seconds about a moment first reaches a level, from line to line [s]; NaN when it
/// never does.  A single look may find the bed deeper for a moment by a fifth of D.
double first_time(const Scour& s, double S_over_D, double span);
/// The bed line nearest to a time [s], at Scour::x.
const std::vector<double>& line_at(const Scour& s, double t);
/// Who made the run, in a line.
std::string run_told(const Scour& s);

}  // namespace livebed::validate
