#pragma once
#include <filesystem>
#include <string>

namespace livebed::app {

/// Serves the page of a run that is about to begin in a process of its own, so that the run computes as if nobody
/// watched, and the page outlives it: it is served until the run is over and no page has asked for 20 s.  Returns a
/// line that says where.  Fault as of serve().
std::string watch_from_beside(const std::filesystem::path& folder, int port);

}  // namespace livebed::app
