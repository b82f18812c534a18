#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "run/profiles.hpp"
#include "run/sampling.hpp"
#include "run/simulation.hpp"

namespace livebed::run {

/// What a run remembers beside the simulation: how far its outputs are, and sums for the summary.
struct Progress {
  std::int64_t series_rows = 0, bed_rows = 0, frames = 0, checkpoints = 0;  ///< written so far
  std::uint64_t series_offset = 0, bed_offset = 0;                          ///< bytes of the tables
  Sampler::Original original;
  double theta_sum = 0, theta_time = 0;  ///< integral of the measured theta since the release, and its length [s]
  double asleep_sum = 0;                 ///< integral of the share of grains asleep over the same time [s]
  double largest_overlap = 0;            ///< of two grains over d, so far
  double start_wall = 0;                 ///< wall time of packing and pipe placing [s]

  // of outputs that a case asks for
  std::int64_t track_times = 0, contact_frames = 0;      ///< written so far
  std::uint64_t profiles_offset = 0, tracks_offset = 0;  ///< bytes of their tables
  Profiles::Sums profiles;
  std::vector<std::int32_t> tracked;  ///< ids of the grains followed
};

/// Everything a run needs to go on with the same bits, in one HDF5 file written atomically.  The resolved case,
/// versions and the instruction set are in it: resuming with another program is told in a note.
void save_checkpoint(const std::filesystem::path& file, Simulation& sim, const Progress& progress);

/// A restored run.  Throws Fault (input/output) naming file and dataset when something is missing or damaged.
struct Restored {
  Simulation sim;
  Progress progress;
  std::string note;  ///< what differs between the program that wrote it and this one; empty when nothing does
};
Restored load_checkpoint(const std::filesystem::path& file);

/// Checkpoints of a run folder, oldest first.
std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& run_folder);
std::filesystem::path checkpoint_path(const std::filesystem::path& run_folder, std::int64_t flow_step);

}  // namespace livebed::run
