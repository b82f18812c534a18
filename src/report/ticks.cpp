#include "report/ticks.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace livebed::report {

std::string Ticks::text(double place) const {
  const double magnitude = std::max(std::abs(place), step);
  if (magnitude >= 1e5 || step < 1e-4) return place == 0 ? "0" : fmt::format("{:.2g}", place);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", place, decimals);
}

Ticks ticks(double from, double to, int wanted) {
  Ticks result;
  if (!(to > from) || !std::isfinite(to - from)) return result;
  const double rough = (to - from) / wanted, power = std::pow(10, std::floor(std::log10(rough)));
  const double lead = rough / power;
  result.step = power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
  const double slack = 1e-9 * result.step;
  for (double k = std::ceil((from - slack) / result.step); k * result.step <= to + slack; ++k)
    result.places.push_back(k == 0 ? 0.0 : k * result.step);
  return result;
}

}  // namespace livebed::report
