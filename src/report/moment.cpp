#include "report/moment.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/fault.hpp"
#include "report/references.hpp"

namespace livebed::report {

namespace {

/// How near t/T must be to that of a profile of Mao to show it.
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

Moment nearest_moment(const RunFolder& run, double time) {
  if (run.fields.empty())
    base::fail(base::Exit::input_output, "{} has no snapshots (flow.pvd is missing or empty)", run.path.string());
  const auto nearest = [time](const std::vector<io::TimedFile>& files) {
    return *std::min_element(files.begin(), files.end(), [time](const io::TimedFile& a, const io::TimedFile& b) {
      return std::abs(a.time - time) < std::abs(b.time - time);
    });
  };
  const io::TimedFile fields = nearest(run.fields);
  Moment moment{time, fields.time, fields.file, ""};
  for (const io::TimedFile& grains : run.grains)
    if (grains.time == fields.time) moment.grains = grains.file;
  return moment;
}

std::pair<Snapshot, SnapshotOptions> load_moment(const RunFolder& run, const Moment& moment) {
  Snapshot snapshot{io::read_vtr(run.path / moment.fields), {}, run.pipe};
  if (!moment.grains.empty()) snapshot.grains = io::read_vtp(run.path / moment.grains);
  SnapshotOptions options;
  options.title = fmt::format("t = {:.3g} s", moment.time);
  if (run.time_scale) options.title += fmt::format("   t/T = {:.2f}", moment.time / *run.time_scale);
  options.level = run.original_level();
  if (!run.bed) return {std::move(snapshot), std::move(options)};

  const BedLine line = run.bed->nearest(moment.time);
  options.overlays.push_back({{line.x.front(), line.x.back()}, {options.level, options.level}, level_colour});
  options.overlays.push_back({line.x, line.y, line_colour});
  if (run.time_scale && run.pipe)
    for (double t : mao_profile_times)
      if (std::abs(moment.time / *run.time_scale * mao_time_scale / t - 1) < profile_tolerance) {
        options.overlays.push_back(mao_profile(t, *run.pipe, options.level));
        options.title += fmt::format("   dots: Mao (1986) at {:.0f} s, t/T = {:.2f}", t, t / mao_time_scale);
      }
  return {std::move(snapshot), std::move(options)};
}

}  // namespace livebed::report
