#pragma once
#include <string>

#include "io/file.hpp"

namespace livebed::io {

/// The script that shows the run in this folder in ParaView (python/paraview-state.py, which is built in).
std::string paraview_state(const Path& run);

}  // namespace livebed::io
