#include "base/approach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/math.hpp"

namespace livebed::base {

namespace {

/// For a given T the best S_eq is linear; returns it with the sum of squared residuals.
struct Trial {
  double S_eq, residual;
};
Trial try_time_scale(std::span<const double> t, std::span<const double> S, double T) {
  double gg = 0, gs = 0, ss = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double g = -std::expm1(-t[i] / T);
    gg += g * g;
    gs += g * S[i];
    ss += S[i] * S[i];
  }
  const double S_eq = gg > 0 ? gs / gg : 0;
  return {S_eq, ss - S_eq * gs};
}

/// sqrt(1 + 2 sum rho_k), rho the autocorrelation of the residuals, k up to its first zero.
double memory_of(const std::vector<double>& residuals, double squares) {
  double sum = 1;
  for (std::size_t lag = 1; lag < residuals.size() / 2 && squares > 0; ++lag) {
    double product = 0;
    for (std::size_t i = lag; i < residuals.size(); ++i) product += residuals[i] * residuals[i - lag];
    if (product <= 0) break;
    sum += 2 * product / squares;
  }
  return std::sqrt(sum);
}

}  // namespace

std::optional<Approach> fit_approach(std::span<const double> t, std::span<const double> S) {
  const std::size_t n = t.size();
  if (n < 4) return {};
  const double span = *std::max_element(t.begin(), t.end());
  if (!(span > 0) || !(*std::max_element(S.begin(), S.end()) > 0)) return {};
  // Coarse scan of log T for the basin, then golden section inside it.
  const double low = std::log(span * 1e-4), high = std::log(span * 10);
  constexpr int scans = 120;
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= scans; ++k) {
    const double r = try_time_scale(t, S, std::exp(low + (high - low) * k / scans)).residual;
    if (r < least) {
      least = r;
      best = k;
    }
  }
  if (best == 0 || best == scans) return {};
  double a = low + (high - low) * (best - 1) / scans, b = low + (high - low) * (best + 1) / scans;
  const double golden = (std::sqrt(5.0) - 1) / 2;
  for (int k = 0; k < 60; ++k) {
    const double c = b - golden * (b - a), d = a + golden * (b - a);
    if (try_time_scale(t, S, std::exp(c)).residual < try_time_scale(t, S, std::exp(d)).residual)
      b = d;
    else
      a = c;
  }
  Approach fit;
  fit.T = std::exp((a + b) / 2);
  fit.S_eq = try_time_scale(t, S, fit.T).S_eq;
  if (!(fit.S_eq > 0)) return {};

  // Covariance s^2 (J^T J)^-1 with J = (dS/dS_eq, dS/dT).
  double jj11 = 0, jj12 = 0, jj22 = 0, squares = 0;
  std::vector<double> residuals(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double decay = std::exp(-t[i] / fit.T);
    const double d_S = 1 - decay, d_T = -fit.S_eq * decay * t[i] / square(fit.T);
    jj11 += d_S * d_S;
    jj12 += d_S * d_T;
    jj22 += d_T * d_T;
    residuals[i] = S[i] - fit.S_eq * d_S;
    squares += square(residuals[i]);
  }
  const double determinant = jj11 * jj22 - square(jj12), variance = squares / static_cast<double>(n - 2);
  if (!(determinant > 0)) return {};
  fit.error_S_eq = std::sqrt(variance * jj22 / determinant);
  fit.error_T = std::sqrt(variance * jj11 / determinant);
  fit.correlation = memory_of(residuals, squares);
  fit.rms = std::sqrt(squares / static_cast<double>(n));
  return fit;
}

std::optional<double> time_to_reach(std::span<const double> t, std::span<const double> S, double level) {
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (S[i] < level) continue;
    if (i == 0) return t[0];
    return t[i - 1] + (t[i] - t[i - 1]) * (level - S[i - 1]) / (S[i] - S[i - 1]);
  }
  return {};
}

std::optional<double> equilibrium(std::span<const double> t, std::span<const double> S, double window, double change) {
  if (t.size() < 4 || t.back() - t.front() < window) return {};
  double sum[2] = {0, 0};  // later and earlier half of the window
  int count[2] = {0, 0};
  for (std::size_t i = t.size(); i-- > 0 && t.back() - t[i] <= window;) {
    const int half = t.back() - t[i] <= 0.5 * window ? 0 : 1;
    sum[half] += S[i];
    ++count[half];
  }
  if (count[0] == 0 || count[1] == 0) return {};
  if (std::abs(sum[0] / count[0] - sum[1] / count[1]) > change) return {};
  return (sum[0] + sum[1]) / (count[0] + count[1]);
}

}  // namespace livebed::base
