#include "report/stages.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/fault.hpp"
#include "report/references.hpp"

namespace livebed::report {

namespace {

/// Stages of the paper's Fig. 11 [s] (it prints minutes; its source's time unit is the second).
constexpr double paper_stages[] = {0, 11, 18, 25, 50, 120};
/// Times of Mao's profiles [s] and how near t/T must be to show them.
constexpr double profile_times[] = {11, 25};
constexpr double profile_tolerance = 0.15;

constexpr Colour line_colour{255, 255, 255}, level_colour{120, 230, 255}, mao_colour{20, 20, 20};

/// Mao's profile in the run's coordinates [m].
Overlay mao_profile(double at, const Pipe& pipe, double level) {
  const io::Table table = io::parse_table(mao_profiles, "data/mao1986_livebed_profiles.csv");
  Overlay dots{{}, {}, mao_colour, true};
  for (std::size_t n = 0; n < table.rows(); ++n) {
    if (table.column("t_s")[n] != at) continue;
    dots.x.push_back(pipe.x + table.column("x_D")[n] * pipe.diameter);
    dots.y.push_back(level + table.column("y_bed_D")[n] * pipe.diameter);
  }
  return dots;
}

}  // namespace

Stage nearest_stage(const RunFolder& run, double time) {
  if (run.fields.empty())
    base::fail(base::Exit::input_output, "{} has no snapshots (flow.pvd is missing or empty)", run.path.string());
  const auto nearest = [time](const std::vector<io::TimedFile>& files) {
    return *std::min_element(files.begin(), files.end(), [time](const io::TimedFile& a, const io::TimedFile& b) {
      return std::abs(a.time - time) < std::abs(b.time - time);
    });
  };
  const io::TimedFile fields = nearest(run.fields);
  Stage stage{time, fields.time, fields.file, ""};
  for (const io::TimedFile& grains : run.grains)
    if (grains.time == fields.time) stage.grains = grains.file;
  return stage;
}

std::vector<Stage> stages(const RunFolder& run) {
  std::vector<Stage> chosen;
  if (run.fields.empty()) return chosen;
  const double last = run.fields.back().time;
  std::vector<double> wanted;
  if (run.time_scale) {
    for (double t : paper_stages) wanted.push_back(t / mao_time_scale * *run.time_scale);
  } else {
    for (int n = 0; n < 6; ++n) wanted.push_back(last * n / 5);
  }
  // A run may stop a little before its last stage: 5 % is the same picture.
  std::erase_if(wanted, [last](double t) { return t > 1.05 * last; });
  for (double t : wanted) {
    Stage stage = nearest_stage(run, t);
    if (chosen.empty() || chosen.back().time != stage.time) chosen.push_back(std::move(stage));
  }
  // A run that is still short of the next stage shows how far it is.
  if (chosen.back().time != last && wanted.size() < std::size(paper_stages)) chosen.push_back(nearest_stage(run, last));
  return chosen;
}

std::pair<Snapshot, SnapshotOptions> load_stage(const RunFolder& run, const Stage& stage) {
  Snapshot snapshot{io::read_vtr(run.path / stage.fields), {}, run.pipe};
  if (!stage.grains.empty()) snapshot.grains = io::read_vtp(run.path / stage.grains);
  SnapshotOptions options;
  options.title = fmt::format("t = {:.3g} s", stage.time);
  if (run.time_scale) options.title += fmt::format("   t/T = {:.2f}", stage.time / *run.time_scale);
  options.level = run.original_level();
  if (!run.bed) return {std::move(snapshot), std::move(options)};

  const BedLine line = run.bed->nearest(stage.time);
  options.overlays.push_back({{line.x.front(), line.x.back()}, {options.level, options.level}, level_colour});
  options.overlays.push_back({line.x, line.y, line_colour});
  if (run.time_scale && run.pipe)
    for (double t : profile_times)
      if (std::abs(stage.time / *run.time_scale * mao_time_scale / t - 1) < profile_tolerance) {
        options.overlays.push_back(mao_profile(t, *run.pipe, options.level));
        options.title += fmt::format("   dots: Mao (1986) at {:.0f} s, t/T = {:.2f}", t, t / mao_time_scale);
      }
  return {std::move(snapshot), std::move(options)};
}

}  // namespace livebed::report
