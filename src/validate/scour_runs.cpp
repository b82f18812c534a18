#include "validate/scour_runs.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/approach.hpp"
#include "base/fault.hpp"
#include "case/check.hpp"
#include "case/read.hpp"
#include "case/resolved.hpp"
#include "io/file.hpp"
#include "io/table.hpp"
#include "run/bed_cache.hpp"
#include "run/checkpoint.hpp"
#include "run/execute.hpp"

namespace livebed::validate {

namespace {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Throws Fault (input or output) when the folder holds a run of another case; another end is none.
void check_same_case(const casefile::Case& wanted, const fs::path& folder) {
  const casefile::Case kept = casefile::read_case(folder / "case.resolved.toml");
  casefile::Case same = wanted;
  same.time.end = kept.time.end;
  casefile::derive_at_level(same, kept.grains.count, kept.bed_thickness);
  if (casefile::hash(same) != casefile::hash(kept))
    base::fail(base::Exit::input_output,
               "{} holds a run of another case than this program's (compare its case.resolved.toml); move it away, and "
               "the same command makes the run anew",
               folder.string());
}

/// Runs or resumes what is missing, until a signal.
void finish(const casefile::Case& c, const fs::path& folder, const Tell& tell) {
  run::Options options;
  options.bed_cache = run::default_bed_cache();
  options.say = tell;
  double told = -1;
  options.progress = [&](double t, double end, double depth, double speed, double left) {
    if (t < told + 0.01 * end) return;
    told = t;
    tell(fmt::format("{}: t = {:.2f} of {:.2f} s, S/D = {:.3f}, {:.2g} s/s, {:.1f} h left", folder.filename().string(),
                     t, end, depth, speed, left / 3600));
  };
  base::Exit exit = base::Exit::ok;
  if (run::list_checkpoints(folder).empty()) {
    fs::remove_all(folder);  // stopped while its grains settled
    try {
      exit = run::execute(c, folder, options);
    } catch (const base::Fault& fault) {
      if (fault.code() != base::Exit::signal) throw;
      exit = fault.code();
    }
  } else {
    check_same_case(c, folder);
    const fs::path summary = folder / "summary.json";
    const bool ended =
        fs::exists(summary) && nlohmann::json::parse(io::read_file(summary)).value("time_s", -1.0) >= c.time.end;
    if (!ended) exit = run::resume(folder, c.time.end, options);
  }
  if (exit == base::Exit::signal)
    tell(fmt::format("{} was stopped before its end: this is what there is so far; the same command goes on with it",
                     folder.string()));
}

Scour read(const fs::path& folder) {
  Scour s;
  s.resolved = casefile::read_case(folder / "case.resolved.toml");
  s.seed = s.resolved.grains.seed;
  const nlohmann::json summary = nlohmann::json::parse(io::read_file(folder / "summary.json"));
  s.commit = summary.value("commit", ""), s.wall = summary.value("wall_s", 0.0);
  const io::Table series = io::read_table(folder / "series.csv"), bed = io::read_table(folder / "bed.csv");
  s.t = series.column("time_s"), s.depth = series.column("S_over_D");
  s.t_lines = bed.column("time_s");
  const double D = s.resolved.flow.pipe.diameter;
  std::vector<const std::vector<double>*> columns;
  for (const std::string& name : bed.names)
    if (name.starts_with("y_at_")) {
      s.x.push_back((std::stod(name.substr(5)) - s.resolved.flow.pipe.x) / D);
      columns.push_back(&bed.column(name));
    }
  for (std::size_t n = 0; n < s.t_lines.size(); ++n) {
    std::vector<double> line;
    for (const std::vector<double>* column : columns) line.push_back(((*column)[n] - s.resolved.bed_thickness) / D);
    s.lines.push_back(std::move(line));
  }
  return s;
}

}  // namespace

std::optional<Scour> scour(const casefile::Case& c, const fs::path& folder, const Tell& tell) {
  if (run::stop_signal() == 0) {
    try {
      finish(c, folder, tell);
    } catch (const base::Fault& fault) {
      // A run that cannot be made must not cost what the others have; one that is in the way must be told.
      if (fault.code() == base::Exit::input_output) throw;
      tell(fmt::format("{} failed: {}", folder.string(), fault.what()));
    }
  }
  if (!fs::exists(folder / "summary.json")) return std::nullopt;
  Scour s = read(folder);
  if (s.t.empty() || s.t_lines.empty()) return std::nullopt;
  return s;
}

Row missing(const std::string& name) {
  Row row{name + ": runs made", 0, "-"};
  row.low = row.high = 1;
  row.reference = "it failed as told above; the others stand";
  return row;
}

double mean_depth(const Scour& s, double from, double to) {
  double sum = 0;
  int n = 0;
  for (std::size_t k = 0; k < s.t.size(); ++k)
    if (s.t[k] >= from && s.t[k] <= to) sum += s.depth[k], ++n;
  return n > 0 ? sum / n : nan;
}

double first_time(const Scour& s, double S_over_D, double span) {
  std::vector<double> mean(s.t.size());
  std::transform(s.t.begin(), s.t.end(), mean.begin(),
                 [&](double t) { return mean_depth(s, t - 0.5 * span, t + 0.5 * span); });
  return base::time_to_reach(s.t, mean, S_over_D).value_or(nan);
}

const std::vector<double>& line_at(const Scour& s, double t) {
  const auto nearest = std::min_element(s.t_lines.begin(), s.t_lines.end(),
                                        [t](double a, double b) { return std::abs(a - t) < std::abs(b - t); });
  return s.lines[nearest - s.t_lines.begin()];
}

std::string run_told(const Scour& s) { return fmt::format("commit {}, case {}", s.commit, casefile::hash(s.resolved)); }

}  // namespace livebed::validate
