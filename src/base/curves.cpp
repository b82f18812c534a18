#include "base/curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.hpp"

namespace livebed::base {

double interpolate(std::span<const double> x, std::span<const double> y, double s) {
  const auto next = std::upper_bound(x.begin(), x.end(), s);
  if (next == x.end()) return y.back();
  if (next == x.begin()) return y.front();
  const auto b = static_cast<std::size_t>(next - x.begin()), a = b - 1;
  return y[a] + (y[b] - y[a]) * (s - x[a]) / (x[b] - x[a]);
}

std::optional<Comparison> compare(std::span<const double> x, std::span<const double> y,
                                  std::span<const double> x_reference, std::span<const double> y_reference,
                                  double baseline) {
  if (x.empty()) return {};
  Comparison result;
  double squares = 0, baseline_squares = 0;
  for (std::size_t i = 0; i < x_reference.size(); ++i) {
    if (x_reference[i] < x.front() || x_reference[i] > x.back()) continue;
    const double difference = interpolate(x, y, x_reference[i]) - y_reference[i];
    squares += square(difference);
    baseline_squares += square(baseline - y_reference[i]);
    result.bias += difference;
    result.largest = std::max(result.largest, std::abs(difference));
    ++result.points;
  }
  if (result.points == 0) return {};
  result.rms = std::sqrt(squares / result.points);
  result.bias /= result.points;
  result.skill = baseline_squares > 0 ? 1 - squares / baseline_squares : std::numeric_limits<double>::quiet_NaN();
  return result;
}

}  // namespace livebed::base
