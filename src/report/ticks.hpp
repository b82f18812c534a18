#pragma once
#include <string>
#include <vector>

namespace livebed::report {

/// Round numbers along an axis.
struct Ticks {
  double step = 1;
  std::vector<double> places;
  /// A tick's label with as many decimals as the step needs.
  std::string text(double place) const;
};

/// Multiples of 1, 2 or 5 times a power of ten within [from, to], about `wanted` of them; none for an empty range.
Ticks ticks(double from, double to, int wanted);

}  // namespace livebed::report
