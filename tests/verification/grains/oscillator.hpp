#pragma once
#include <cmath>
#include <limits>

#include "base/math.hpp"

/// Closed forms of a mass on a spring and a dashpot: what a contact of a linear law does.
namespace livebed::grains::bodies {

struct Oscillator {
  double mass;         ///< [kg]; half that of a grain for two equal grains
  double stiffness;    ///< [N/m]
  double zeta;         ///< damping ratio [-], below 1
  double gravity = 0;  ///< presses the mass on the spring [m/s2]

  double omega_0() const { return std::sqrt(stiffness / mass); }
  double omega() const { return omega_0() * std::sqrt(1 - zeta * zeta); }
  double sunk() const { return gravity / base::square(omega_0()); }

  /// Overlap [m] and its rate [m/s], `t` after the first touch at speed v.
  double overlap(double t, double v) const {
    const double a = -sunk(), b = (v + zeta * omega_0() * a) / omega();
    return sunk() + std::exp(-zeta * omega_0() * t) * (a * std::cos(omega() * t) + b * std::sin(omega() * t));
  }
  double rate(double t, double v) const {
    const double a = -sunk(), b = (v + zeta * omega_0() * a) / omega();
    const double c = omega() * b - zeta * omega_0() * a, s = -omega() * a - zeta * omega_0() * b;
    return std::exp(-zeta * omega_0() * t) * (c * std::cos(omega() * t) + s * std::sin(omega() * t));
  }

  /// Duration of the contact that ends with the overlap [s]; infinite when the mass stays on the spring.
  double contact_time(double v) const {
    const double step = base::pi / omega() / 64;
    double low = step;
    while (low < 4 * base::pi / omega() && overlap(low + step, v) > 0) low += step;
    if (low >= 4 * base::pi / omega()) return std::numeric_limits<double>::infinity();
    double high = low + step;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (overlap(middle, v) > 0 ? low : high) = middle;
    }
    return low;
  }
  /// Speed with which it leaves after that time [m/s].
  double rebound(double v) const { return -rate(contact_time(v), v); }

  /// Without gravity, contact that ends when spring and dashpot cancel (Schwager and Poeschel 2007): -k x = eta x'.
  double contact_time_without_tension() const {
    return std::atan2(2 * zeta * std::sqrt(1 - zeta * zeta), 2 * zeta * zeta - 1) / omega();
  }
};

/// Damping ratio of the oscillator that leaves with e times its speed when the contact ends with the overlap.
inline double damping_ratio(double e) {
  const double L = std::log(e);
  return -L / std::sqrt(base::pi * base::pi + L * L);
}

}  // namespace livebed::grains::bodies
