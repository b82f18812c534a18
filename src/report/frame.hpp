#pragma once
#include <string>

#include "io/vtk.hpp"

namespace livebed::report {

/// A moment of a run for the page (a Pack): head {time, nx, ny, grains}; the grid's faces `x`, `y` [m]; in the cells, x
/// fastest, `u`, `v` [m/s], and where the file has them `p` [Pa], `solid`, `open` [-]; of the grains `grain_x`,
/// `grain_y`, `grain_d` [m], `grain_speed` [m/s].  grains may be null.
std::string pack_frame(const io::Grid& water, const io::Points* grains);

}  // namespace livebed::report
