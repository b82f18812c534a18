#pragma once
#include <optional>
#include <span>

/// Curves given by points, and how far one is from another.
namespace livebed::base {

/// y at s on the broken line through (x, y), x ascending; outside the end values go on.
double interpolate(std::span<const double> x, std::span<const double> y, double s);

/// How far a computed curve is from a reference, over the reference points inside the curve's range.
struct Comparison {
  int points = 0;
  double rms = 0;   ///< of the difference
  double bias = 0;  ///< mean of computed - reference
  double largest = 0;
  double skill = 0;  ///< Brier skill score 1 - MSE / MSE(baseline): 1 perfect, 0 no better than the baseline
};
/// x ascending; baseline is the value that no model would give (flat bed: 0).  Empty when no point is inside, skill is
/// NaN when the reference equals the baseline everywhere.
std::optional<Comparison> compare(std::span<const double> x, std::span<const double> y,
                                  std::span<const double> x_reference, std::span<const double> y_reference,
                                  double baseline);

}  // namespace livebed::base
