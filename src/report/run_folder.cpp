#include "report/run_folder.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

// The header-only parser stays in this file.
#include <toml++/toml.h>

#include "base/fault.hpp"

namespace livebed::report {

using base::Exit;
using base::fail;

namespace {

constexpr std::size_t log_lines = 30;

std::string last_lines(const std::string& text, std::size_t count) {
  std::size_t at = text.size();
  for (std::size_t n = 0; n <= count && at != text.npos && at > 0; ++n) at = text.rfind('\n', at - 1);
  return at == text.npos || at == 0 ? text : text.substr(at + 1);
}

/// Columns y_at_<x>_m of bed.csv.
BedHistory read_bed(const io::Path& path) {
  const io::Table table = io::read_table(path);
  BedHistory bed;
  bed.time = table.column("time_s");
  bed.y.assign(bed.time.size(), {});
  constexpr std::string_view before = "y_at_", after = "_m";
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    std::string_view name = table.names[c];
    if (!name.starts_with(before) || !name.ends_with(after)) continue;
    name = name.substr(before.size(), name.size() - before.size() - after.size());
    double x = 0;
    if (std::from_chars(name.data(), name.data() + name.size(), x).ec != std::errc{})
      fail(Exit::input_output, "{}: the column {} names no position", path.string(), table.names[c]);
    bed.x.push_back(x);
    for (std::size_t n = 0; n < bed.time.size(); ++n) bed.y[n].push_back(table.columns[c][n]);
  }
  return bed;
}

/// Title and numbers of the resolved case; those that follow from others stand in its table [derived].
void read_case(RunFolder& run) {
  try {
    const toml::table table = toml::parse(run.case_text);
    run.title = table.at_path("case.title").value_or(std::string{});
    const auto take = [&](const std::string& key, auto& number) {
      for (const std::string& place : {key, "derived." + key})
        if (const auto value = table.at_path(place).value<double>(); value && *value > 0) number = *value;
    };
    take("time.scale", run.time_scale);
    take("current.theta", run.theta);
    take("current.mean_speed", run.mean_speed);
    take("bed.thickness", run.bed_level);
    take("bed.level", run.bed_level);
    take("grains.diameter", run.grain_diameter);
    take("grains.d50", run.grain_diameter);
    take("flow.density", run.water_density);
    take("flow.viscosity", run.viscosity);
  } catch (const toml::parse_error& error) {
    fail(Exit::input_output, "{}/case.resolved.toml:{}: {}", run.path.string(), error.source().begin.line,
         std::string(error.description()));
  }
}

/// Is the file there?  If not, the reader is told what is missing for it.
bool present(RunFolder& run, const char* name, const char* consequence) {
  if (std::filesystem::exists(run.path / name)) return true;
  run.missing.push_back(fmt::format("{} is not there: {}.", name, consequence));
  return false;
}

}  // namespace

BedLine BedHistory::nearest(double t) const {
  std::size_t best = 0;
  for (std::size_t n = 0; n < time.size(); ++n)
    if (std::abs(time[n] - t) < std::abs(time[best] - t)) best = n;
  return {time[best], x, y[best]};
}

double RunFolder::original_level() const {
  if (summary.contains("bed_level_m") && summary["bed_level_m"].is_number()) return summary["bed_level_m"];
  const double told = bed_level > 0 ? bed_level : std::nan("");
  if (!bed || bed->time.empty()) return told;
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < bed->x.size(); ++i) {
    if (pipe && std::abs(bed->x[i] - pipe->x) < pipe->diameter / 2) continue;
    sum += bed->y.front()[i];
    ++count;
  }
  return count > 0 ? sum / count : told;
}

RunFolder read_outline(const io::Path& folder) {
  namespace fs = std::filesystem;
  if (!fs::is_directory(folder))
    fail(Exit::input_output, "{} is not a folder; give the folder that `livebed run` was told to write",
         folder.string());
  if (!fs::exists(folder / "case.resolved.toml"))
    fail(Exit::input_output, "{} is not a run folder: it has no case.resolved.toml", folder.string());

  RunFolder run;
  run.path = folder;
  run.case_text = io::read_file(folder / "case.resolved.toml");
  read_case(run);
  if (run.title.empty()) run.title = fs::weakly_canonical(folder).filename().string();

  if (present(run, "summary.json", "the run has not finished (or was stopped), so the numbers come from its series")) {
    run.summary = nlohmann::ordered_json::parse(io::read_file(folder / "summary.json"), nullptr, false);
    if (run.summary.is_discarded()) fail(Exit::input_output, "{}/summary.json is not valid JSON", folder.string());
  }
  if (present(run, "flow.pvd", "no pictures of the flow")) run.fields = io::read_pvd(folder / "flow.pvd");
  if (present(run, "grains.pvd", "no grains in the pictures")) run.grains = io::read_pvd(folder / "grains.pvd");
  if (fs::exists(folder / "pipe.vtp")) run.pipe = read_pipe(folder / "pipe.vtp");
  if (present(run, "log.txt", "no log")) run.log_end = last_lines(io::read_file(folder / "log.txt"), log_lines);
  return run;
}

RunFolder read_run(const io::Path& folder) {
  RunFolder run = read_outline(folder);
  if (present(run, "series.csv", "no curves")) run.series = io::read_table(folder / "series.csv");
  if (present(run, "bed.csv", "no bed lines")) run.bed = read_bed(folder / "bed.csv");
  if (run.bed && (run.bed->time.empty() || run.bed->x.empty())) {
    run.bed.reset();
    run.missing.emplace_back("bed.csv has no lines yet.");
  }
  if (run.series && run.series->rows() == 0) {
    run.series.reset();
    run.missing.emplace_back("series.csv has no rows yet.");
  }
  return run;
}

}  // namespace livebed::report
