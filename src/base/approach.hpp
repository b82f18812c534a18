#pragma once
#include <optional>
#include <span>

/// How a record approaches its end value: the depth of a hole in time.
namespace livebed::base {

/// S(t) = S_eq (1 - exp(-t/T)) by least squares, with standard errors from the linearised problem.  They take the
/// residuals as independent; those of a finely sampled S(t) are not, and `correlation` is the factor by which their
/// memory widens the errors: sqrt(1 + 2 sum of the residuals' autocorrelation up to its first zero).
struct Approach {
  double S_eq = 0, T = 0;              ///< units of S and t
  double error_S_eq = 0, error_T = 0;  ///< one standard error
  double correlation = 1;              ///< of the residuals: errors times this are those of a repeated experiment
  double rms = 0;                      ///< of the residuals
};
/// Empty when there are fewer than 4 points, when S never rises, or when the record is too short to tell T (T beyond
/// ten times its length).
std::optional<Approach> fit_approach(std::span<const double> t, std::span<const double> S);

/// First time S reaches `level`, linear between points; empty when it never does.
std::optional<double> time_to_reach(std::span<const double> t, std::span<const double> S, double level);

/// Mean of S over the last `window` when the means of its two halves differ by at most `change`: single grains make S
/// jump by d/D from line to line, so its range says nothing about a trend.  Empty before, or when the record is
/// shorter.
std::optional<double> equilibrium(std::span<const double> t, std::span<const double> S, double window, double change);

}  // namespace livebed::base
