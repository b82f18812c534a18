#pragma once
#include <string>

#include "report/run_folder.hpp"
#include "report/stages.hpp"

/// The parts of the page, each an HTML fragment, empty when the run has nothing for it.
namespace livebed::report {

std::string head_section(const RunFolder& run);
std::string snapshot_section(const RunFolder& run, const std::vector<Stage>& shown);
std::string depth_section(const RunFolder& run);
std::string profile_section(const RunFolder& run);
std::string series_section(const RunFolder& run);
std::string case_section(const RunFolder& run);

}  // namespace livebed::report
