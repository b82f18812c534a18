#include "report/page_data.hpp"

#include <algorithm>
#include <numeric>

#include "base/fault.hpp"
#include "report/analysis.hpp"
#include "report/frame.hpp"
#include "report/pack.hpp"
#include "report/references.hpp"

namespace livebed::report {

namespace {

using nlohmann::ordered_json;

/// Mao's (1986) experiment in the run's lengths and times over T; null for another case.
ordered_json measurements(const RunFolder& run) {
  if (!is_maos_case(run)) return nullptr;
  const io::Table depth = io::parse_table(mao_depth, "data/mao1986_livebed_depth.csv");
  const io::Table lines = io::parse_table(mao_profiles, "data/mao1986_livebed_profiles.csv");
  ordered_json profiles = ordered_json::array();
  for (double at : mao_profile_times) {
    ordered_json x, y;
    for (std::size_t n = 0; n < lines.rows(); ++n)
      if (lines.column("t_s")[n] == at) x.push_back(lines.column("x_D")[n]), y.push_back(lines.column("y_bed_D")[n]);
    profiles.push_back({{"t_s", at}, {"x_over_D", x}, {"y_over_D", y}});
  }
  return {{"name", "Mao (1986), 0.36 mm sand"},
          {"T_s", mao_time_scale},
          {"t_s", depth.column("t_s")},
          {"S_over_D", depth.column("S_over_D")},
          {"profiles", profiles}};
}

/// The rows `first`, `first + k`, ... with the smallest k that leaves at most `most`, and the last one.
std::vector<std::size_t> chosen_rows(std::size_t rows, std::size_t first, std::size_t most) {
  std::vector<std::size_t> chosen;
  if (first >= rows) return chosen;
  const std::size_t step = (rows - first + most - 1) / most;
  for (std::size_t n = first; n < rows; n += step) chosen.push_back(n);
  if (chosen.back() != rows - 1) chosen.push_back(rows - 1);
  return chosen;
}

std::vector<double> picked(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> out;
  for (std::size_t n : rows) out.push_back(values[n]);
  return out;
}

}  // namespace

std::vector<std::size_t> all_frames(const RunFolder& run) {
  std::vector<std::size_t> frames(run.fields.size());
  std::iota(frames.begin(), frames.end(), std::size_t{0});
  return frames;
}

ordered_json describe(const RunFolder& run, const std::vector<std::size_t>& frames) {
  ordered_json shown = ordered_json::array();
  for (std::size_t n : frames) shown.push_back({{"n", n}, {"t_s", run.fields[n].time}});
  const auto or_null = [](auto given, auto value) { return given ? ordered_json(value) : ordered_json(nullptr); };
  ordered_json pipe;
  if (run.pipe) pipe = {{"x_m", run.pipe->x}, {"y_m", run.pipe->y}, {"D_m", run.pipe->diameter}};
  return {{"title", run.title},
          {"folder", std::filesystem::weakly_canonical(run.path).filename().string()},
          {"pipe", pipe},
          {"T_s", or_null(run.time_scale.has_value(), run.time_scale.value_or(0))},
          {"theta", or_null(run.theta > 0, run.theta)},
          {"mean_speed_m_s", or_null(run.mean_speed > 0, run.mean_speed)},
          {"d_m", or_null(run.grain_diameter > 0, run.grain_diameter)},
          {"frames", shown},
          {"summary", run.summary},
          {"measured", measurements(run)},
          {"missing", run.missing},
          {"case", run.case_text},
          {"log", run.log_end}};
}

std::string pack_series(const RunFolder& run, std::size_t first, std::size_t most) {
  Pack pack;
  const std::size_t rows = run.series ? run.series->rows() : 0;
  pack.head = {{"rows", rows}, {"first", first}};
  const std::vector<std::size_t> chosen = chosen_rows(rows, first, most);
  if (run.series)
    for (std::size_t c = 0; c < run.series->names.size(); ++c)
      pack.floats(run.series->names[c], picked(run.series->columns[c], chosen));
  return pack.str();
}

std::string pack_bed(const RunFolder& run, std::size_t first, std::size_t most) {
  Pack pack;
  const std::size_t rows = run.bed ? run.bed->time.size() : 0;
  pack.head = {{"rows", rows}, {"first", first}};
  if (!run.bed) return pack.str();
  pack.head["level_m"] = run.original_level();
  const std::vector<std::size_t> chosen = chosen_rows(rows, first, most);
  std::vector<double> y;
  for (std::size_t n : chosen) y.insert(y.end(), run.bed->y[n].begin(), run.bed->y[n].end());
  pack.floats("time", picked(run.bed->time, chosen));
  pack.floats("x", run.bed->x);
  pack.shorts("y", y);
  return pack.str();
}

std::string pack_motion(const NearBed& near_bed) {
  Pack pack;
  if (near_bed.empty()) return pack.str();
  const FrameMeasures mean = near_bed.mean_flux();
  pack.head = {{"nx", mean.nx}, {"ny", mean.ny}, {"dx", mean.dx}, {"dy", mean.dy}};
  pack.floats("flux", mean.flux);
  return pack.str();
}

std::string pack_frame(const RunFolder& run, std::size_t n) {
  if (n >= run.fields.size())
    base::fail(base::Exit::input_output, "{} has no frame {}; there are {}", run.path.string(), n, run.fields.size());
  io::Grid water = io::read_vtr(run.path / run.fields[n].file);
  water.time = run.fields[n].time;
  const auto grains = std::find_if(run.grains.begin(), run.grains.end(),
                                   [&](const io::TimedFile& file) { return file.time == water.time; });
  if (grains == run.grains.end()) return pack_frame(water, nullptr);
  const io::Points points = io::read_vtp(run.path / grains->file);
  return pack_frame(water, &points);
}

}  // namespace livebed::report
