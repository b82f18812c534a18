#include "report/report.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "report/analysis.hpp"
#include "report/moment.hpp"
#include "report/page.hpp"
#include "report/page_data.hpp"

namespace livebed::report {

namespace {

constexpr std::size_t frame_bytes = 6'000'000;             ///< of all frames as they stand in the file
constexpr std::size_t most_rows = 4000, most_lines = 400;  ///< of the series and of the bed

/// All frames, or as many as fit.
std::string freeze_frames(const RunFolder& run, std::vector<std::size_t>& chosen) {
  if (run.fields.empty()) return "";
  const std::size_t last = run.fields.size() - 1;
  const auto frame = [&](std::size_t n) { return frozen(fmt::format("frame/{}", n), pack_frame(run, n)); };
  const std::string end = frame(last);
  const std::size_t count = std::clamp<std::size_t>(frame_bytes / end.size(), 2, last + 1);
  std::string all;
  for (std::size_t k = 0; k < count && last > 0; ++k) {
    const std::size_t n = k * last / std::max<std::size_t>(count - 1, 1);
    if (n == last) break;
    chosen.push_back(n);
    all += frame(n);
  }
  chosen.push_back(last);
  return all + end;
}

/// Everything but the frames.
std::string freeze(const RunFolder& run, const std::vector<std::size_t>& frames, const std::string& prefix,
                   const NearBed& near_bed) {
  return frozen(prefix + "run.json", describe(run, frames).dump()) +
         frozen(prefix + "series", pack_series(run, 0, most_rows)) +
         frozen(prefix + "bed", pack_bed(run, 0, most_lines)) +
         frozen(prefix + "analysis.json", analyse(run, near_bed).dump());
}

}  // namespace

Written write_report(const io::Path& folder) {
  const RunFolder run = read_run(folder);
  NearBed near_bed;
  near_bed.update(run);
  std::vector<std::size_t> frames;
  std::string data = freeze_frames(run, frames);
  data += freeze(run, frames, "", near_bed) + frozen("motion", pack_motion(near_bed));
  const io::Path path = folder / "report.html";
  io::write_atomically(path, page(run.title, {{"mode", "report"}}, data, ""));
  return {path, frames.size(), run.missing};
}

void write_comparison(const std::vector<io::Path>& folders, const io::Path& out_html) {
  std::string data, title = "Livebed:";
  for (std::size_t n = 0; n < folders.size(); ++n) {
    const RunFolder run = read_run(folders[n]);
    data += freeze(run, {}, fmt::format("{}/", n), NearBed());
    title += fmt::format("{} {}", n == 0 ? "" : " beside", run.path.filename().string());
  }
  io::write_atomically(out_html, page(title, {{"mode", "compare"}, {"runs", folders.size()}}, data, ""));
}

double write_picture(const io::Path& folder, double time, const io::Path& out_png) {
  const RunFolder run = read_run(folder);
  const Moment moment = nearest_moment(run, time);
  const auto [snapshot, options] = load_moment(run, moment);
  io::write_atomically(out_png, draw(snapshot, options).png());
  return moment.time;
}

}  // namespace livebed::report
