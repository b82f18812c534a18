#pragma once
#include <string>
#include <vector>

#include "case/case.hpp"

namespace livebed::casefile {

/// The overrides "table.key=value" that give a case grains `factor` times as large at the same Shields parameter: cells
/// grow with the grains as far as the pipe lets them, the grain step with the root of the factor, and all times with
/// those of scour, so that the run still ends at the same t/T.  Box and pipe stay.
std::vector<std::string> enlarging(const Case& c, double factor);

}  // namespace livebed::casefile
