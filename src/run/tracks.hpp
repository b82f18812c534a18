#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "io/vtk.hpp"
#include "run/simulation.hpp"

/// Single grains and single contacts of a run, for those who want to know what they do.
namespace livebed::run {

/// Columns of tracks.csv.
const std::vector<std::string>& track_columns();

/// The ids of the grains to follow, rising: those of output.track_ids, or the output.tracks ones nearest to the level
/// of the bed [m] under the pipe's centre (in the middle of the box without a pipe).  Fault (invalid case) for an id
/// that no grain has.
std::vector<std::int32_t> choose_tracks(const Simulation& sim, double level);

/// Rows of tracks.csv at the present time, one a grain.
std::vector<std::vector<double>> track_rows(const Simulation& sim, const std::vector<std::int32_t>& ids);

/// All contacts as lines from centre to centre, or to the point where a grain touches floor or pipe, with `ids` (of the
/// second one -1: floor, -2: pipe), `normal` and `tangential` force [N] and `overlap` [m].  Across the seam of the box
/// a line leaves it.
io::Points contact_lines(const Simulation& sim);

}  // namespace livebed::run
