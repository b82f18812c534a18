#pragma once
#include <string>
#include <vector>

#include "report/chart.hpp"

namespace livebed::validate {

/// The chart as a file of its own: black on white, its legend below it.
std::string picture(const report::Chart& chart);

struct Panel {
  std::string title;
  report::Chart chart;
};

/// Charts of one size in rows of `columns`, each under its title, with one legend for all below them.
std::string panels(const std::vector<Panel>& all, int columns);

}  // namespace livebed::validate
