#include "base/sediment.hpp"

#include <cmath>

#include "base/math.hpp"

namespace livebed::base {

double dimensionless_diameter(double d, double s, double g, double nu) {
  return d * std::cbrt((s - 1) * g / (nu * nu));
}

double critical_shields(double D_star) { return 0.30 / (1 + 1.2 * D_star) + 0.055 * (1 - std::exp(-0.020 * D_star)); }

double fall_speed(double d, double s, double g, double nu) {
  const double D_star = dimensionless_diameter(d, s, g, nu);
  return nu / d * (std::sqrt(square(10.36) + 1.049 * cube(D_star)) - 10.36);
}

double rouse_number(double fall_speed, double shear_velocity, double kappa) {
  return fall_speed / (kappa * shear_velocity);
}

double meyer_peter_mueller(double theta) { return theta > 0.047 ? 8 * std::pow(theta - 0.047, 1.5) : 0.0; }

double camenen_larson(double theta, double critical) {
  return 12 * std::pow(theta, 1.5) * std::exp(-4.5 * critical / theta);
}

Regime regime(double theta, double critical, bool pipe) {
  if (theta > critical) return Regime::live_bed;
  return pipe && pipe_amplification * theta > critical ? Regime::clear_water : Regime::no_motion;
}

std::optional<EquilibriumDepth> equilibrium_depth(double gap_ratio) {
  constexpr double touching = 0.1, highest = 2;
  if (std::abs(gap_ratio) < touching)
    return EquilibriumDepth{0.6, 0.2, "S_eq/D = 0.6 ± 0.2 (e/D = 0)", "Sumer and Fredsøe 2002"};
  if (gap_ratio > 0 && gap_ratio <= highest)
    return EquilibriumDepth{0.625 * std::exp(-0.6 * gap_ratio), 0, "S_eq/D = 0.625 exp(-0.6 e/D)",
                            "Hansen, Fredsøe and Mao 1986"};
  return std::nullopt;
}

double scour_time_scale(double D, double d, double s, double g, double theta) {
  return square(D) / std::sqrt(g * (s - 1) * cube(d)) * std::pow(theta, -5.0 / 3.0) / 50;
}

double onset_speed(double D, double s, double g, double porosity, double burial_ratio) {
  return std::sqrt(0.025 * std::exp(9 * std::sqrt(burial_ratio)) * g * D * (1 - porosity) * (s - 1));
}

}  // namespace livebed::base
