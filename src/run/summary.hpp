#pragma once
#include <filesystem>

#include "run/observers.hpp"
#include "run/simulation.hpp"

namespace livebed::run {

/// Writes summary.json of a run folder from its series and the counters of the simulation.  ended: why it ended.
void write_summary(const std::filesystem::path& folder, const Simulation& sim, const Progress& progress,
                   const char* ended);

}  // namespace livebed::run
