#pragma once
#include <string>

#include "report/chart.hpp"

namespace livebed::validate {

/// The chart as a file of its own: black on white, its legend below it.
std::string picture(const report::Chart& chart);

}  // namespace livebed::validate
