#include "run/observers.hpp"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>

#include "base/approach.hpp"
#include "grains/sleep.hpp"
#include "io/file.hpp"
#include "io/paraview.hpp"
#include "run/tracks.hpp"

namespace livebed::run {

namespace {

/// Is the (count+1)-th output of a schedule with this interval due?  The first is due at t = 0; the tolerance is a
/// billionth of the interval.
bool due(double time, std::int64_t count, double every) { return time >= (static_cast<double>(count) - 1e-9) * every; }

io::TableWriter open_table(const std::filesystem::path& path, const std::vector<std::string>& columns,
                           std::uint64_t offset) {
  return offset == 0 ? io::TableWriter(path, columns) : io::TableWriter(path, columns, offset);
}

}  // namespace

std::vector<std::string> bed_columns(const std::vector<double>& x) {
  std::vector<std::string> columns = {"time_s"};
  for (double xi : x) columns.push_back(fmt::format("y_at_{:.6g}_m", xi));
  return columns;
}

Observers::Observers(const std::filesystem::path& folder, const Simulation& sim, const Progress& progress)
    : folder_(folder),
      sampler_(sim),
      progress_(progress),
      series_(open_table(folder / "series.csv", series_columns(), progress.series_offset)),
      bed_(open_table(folder / "bed.csv", bed_columns(sampler_.x()), progress.bed_offset)),
      flow_files_(folder / "flow.pvd", progress.frames > 0 ? sim.time() : -1.0),
      grain_files_(folder / "grains.pvd", progress.frames > 0 ? sim.time() : -1.0) {
  if (progress.series_rows > 0) {
    sampler_.restore(progress.original);
    const io::Table table = io::read_table(folder / "series.csv");
    times_ = table.column("time_s");
    depths_ = table.column("S_over_D");
    scour_depth_ = depths_.empty() ? 0.0 : depths_.back();
  } else {
    progress_.original = sampler_.original();
  }
  io::make_folder(folder / "fields");
  io::make_folder(folder / "grains");
  io::make_folder(folder / "checkpoints");
  if (progress.frames == 0) io::write_atomically(folder / "paraview-state.py", io::paraview_state(folder));
  const casefile::OutputParams& asked = sim.resolved().output;
  if (asked.profiles_every > 0) {
    profiles_.emplace(sim.resolved());
    if (progress.profiles_offset > 0) profiles_->restore(progress.profiles);
    profile_table_.emplace(open_table(folder / "profiles.csv", profile_columns(), progress.profiles_offset));
    progress_.profiles_offset = profile_table_->offset();
  }
  if (asked.tracks_every > 0) {
    if (progress.tracked.empty()) progress_.tracked = choose_tracks(sim, progress_.original.level);
    track_table_.emplace(open_table(folder / "tracks.csv", track_columns(), progress.tracks_offset));
    progress_.tracks_offset = track_table_->offset();
  }
  if (asked.contacts_every > 0) {
    io::make_folder(folder / "contacts");
    contact_files_.emplace(folder / "contacts.pvd", progress.contact_frames > 0 ? sim.time() : -1.0);
  }
  if (progress.frames == 0 && sim.resolved().flow.pipe.present) {
    const flow::PipeParams& pipe = sim.resolved().flow.pipe;
    io::write_vtp(folder / "pipe.vtp", io::circle_line(pipe.x, pipe.y, pipe.diameter));
  }
}

void Observers::observe(Simulation& sim) {
  const auto start = std::chrono::steady_clock::now();
  const casefile::OutputParams& every = sim.resolved().output;
  const double time = sim.time();
  const bool bed_due = due(time, progress_.bed_rows, every.bed_every) && sim.resolved().grains.count > 0;
  if (due(time, progress_.series_rows, every.series_every) || bed_due) write_series(sim, bed_due);
  if (due(time, progress_.frames, every.fields_every)) write_frame(sim);
  write_more(sim);
  const bool save = due(time, progress_.checkpoints, every.checkpoint_every);
  if (save) ++progress_.checkpoints;
  sim.wall().output += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (save) checkpoint(sim);
}

void Observers::write_series(const Simulation& sim, bool bed_due) {
  const Sample sample = sampler_.sample(sim);
  const casefile::OutputParams& every = sim.resolved().output;
  if (due(sim.time(), progress_.series_rows, every.series_every)) {
    const double before = times_.empty() ? 0.0 : times_.back();
    series_.row(sample.row);
    ++progress_.series_rows;
    progress_.series_offset = series_.offset();
    times_.push_back(sample.time);
    depths_.push_back(sample.depth_over_D);
    scour_depth_ = depths_.back();
    progress_.theta_sum += (sample.time - before) * sample.theta;
    progress_.theta_time += sample.time - before;
    progress_.asleep_sum += (sample.time - before) * grains::share_asleep(sim.bed().state);
    progress_.largest_overlap = std::max(progress_.largest_overlap, sample.largest_overlap);
  }
  if (bed_due) write_bed(sim.time(), sample.line);
}

void Observers::write_bed(double time, const std::vector<double>& line) {
  std::vector<double> row = {time};
  row.insert(row.end(), line.begin(), line.end());
  bed_.row(row);
  ++progress_.bed_rows;
  progress_.bed_offset = bed_.offset();
}

void Observers::write_frame(Simulation& sim) {
  const bool grains = sim.resolved().grains.count > 0;
  const std::string flow_file = fmt::format("fields/flow_{:06d}.vtr", progress_.frames);
  const std::string grain_file = fmt::format("grains/grains_{:06d}.vtp", progress_.frames);
  io::write_vtr(folder_ / flow_file, io::flow_fields(sim.flow().mesh(), sim.flow().state,
                                                     grains ? &sim.solid_fraction() : nullptr, sim.time()));
  flow_files_.add(sim.time(), flow_file);
  if (grains) {
    io::write_vtp(folder_ / grain_file, io::grain_points(sim.bed().state, sim.time()));
    grain_files_.add(sim.time(), grain_file);
  }
  ++progress_.frames;
}

void Observers::write_more(const Simulation& sim) {
  const casefile::OutputParams& every = sim.resolved().output;
  if (profiles_ && profiles_->add(sim)) {
    for (const std::vector<double>& row : profiles_->take(sim)) profile_table_->row(row);
    progress_.profiles_offset = profile_table_->offset();
  }
  if (track_table_ && due(sim.time(), progress_.track_times, every.tracks_every)) {
    for (const std::vector<double>& row : track_rows(sim, progress_.tracked)) track_table_->row(row);
    progress_.tracks_offset = track_table_->offset();
    ++progress_.track_times;
  }
  if (contact_files_ && due(sim.time(), progress_.contact_frames, every.contacts_every)) {
    const std::string file = fmt::format("contacts/contacts_{:06d}.vtp", progress_.contact_frames);
    io::write_vtp(folder_ / file, contact_lines(sim));
    contact_files_->add(sim.time(), file);
    ++progress_.contact_frames;
  }
}

void Observers::checkpoint(Simulation& sim) {
  const auto start = std::chrono::steady_clock::now();
  series_.sync();
  bed_.sync();
  if (profile_table_) profile_table_->sync();
  if (track_table_) track_table_->sync();
  if (profiles_) progress_.profiles = profiles_->sums();
  save_checkpoint(checkpoint_path(folder_, sim.clock().flow_steps), sim, progress_);
  std::vector<std::filesystem::path> files = list_checkpoints(folder_);
  for (std::size_t k = 0; k + 2 < files.size(); ++k) std::filesystem::remove(files[k]);
  sim.wall().output += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool Observers::at_equilibrium(const casefile::Case& c) const {
  if (c.time_scale <= 0) return false;
  return base::equilibrium(times_, depths_, c.time.equilibrium_window * c.time_scale, c.time.equilibrium_change)
      .has_value();
}

}  // namespace livebed::run
