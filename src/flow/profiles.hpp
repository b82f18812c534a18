#pragma once
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "flow/constants.hpp"
#include "flow/params.hpp"

/// Closed forms of the turbulent open-channel flow that reaches the pipe.
namespace livebed::flow {

/// Height z0 [m] where the log law is zero: ks/30 over a rough bed, nu/(E u*) over a smooth one (Eq. 8).
inline double zero_level(Profile profile, double ks, double u_star, double nu) {
  return profile == Profile::smooth ? nu / (smooth_E * u_star) : ks / rough_scale;
}

/// Log law U(y) = u*/kappa ln(y/z0) [m/s]; 0 at and below z0.
inline double log_law(double y, double u_star, double z0) { return y > z0 ? u_star / kappa * std::log(y / z0) : 0.0; }

/// Mean of the log law over the depth h [m/s]: u*/kappa (ln(h/z0) - 1 + z0/h).
inline double depth_mean(double h, double u_star, double z0) {
  return h > z0 ? u_star / kappa * (std::log(h / z0) - 1.0 + z0 / h) : 0.0;
}

/// Shear velocity u* [m/s] whose log law has the given depth mean; fixed-point iteration (z0 of a smooth bed knows u*).
inline double shear_velocity_from_mean(Profile profile, double mean, double h, double ks, double nu) {
  double u_star = 0.05 * mean;
  for (int n = 0; n < 60; ++n) u_star = mean * u_star / depth_mean(h, u_star, zero_level(profile, ks, u_star, nu));
  return u_star;
}

/// Shields parameter [-] of a shear velocity (Eq. 29), s the specific density of the grains, and back.
inline double shields(double u_star, double s, double g, double d) { return u_star * u_star / ((s - 1.0) * g * d); }
inline double shear_velocity_from_shields(double theta, double s, double g, double d) {
  return std::sqrt(theta * (s - 1.0) * g * d);
}

/// Open-channel equilibrium at height y above the bed in water of depth h: k = u*^2/sqrt(Cmu) (1 - y/h) and
/// epsilon = u*^3/(kappa y) (1 - y/h), so that nu_t = kappa u* y (1 - y/h).
inline double equilibrium_k(double y, double h, double u_star) {
  return std::max(k_floor, base::square(u_star) / std::sqrt(launder_spalding.c_mu) * (1.0 - y / h));
}
inline double equilibrium_epsilon(double y, double h, double u_star) {
  return std::max(epsilon_floor, base::cube(u_star) / (kappa * y) * (1.0 - y / h));
}

}  // namespace livebed::flow
