#pragma once
#include <vector>

namespace livebed::validate {

struct Line {
  std::vector<double> x, y;
};

/// Lines on which the values, given at the nodes (x[i], y[j]) as values[j * x.size() + i] and bilinear in between, have
/// the given level.  Thinned so that nothing moves by more than `tolerance`.
std::vector<Line> contour_lines(const std::vector<double>& x, const std::vector<double>& y,
                                const std::vector<double>& values, double level, double tolerance);

}  // namespace livebed::validate
