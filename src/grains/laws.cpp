#include "grains/laws.hpp"

#include <cmath>

#include "base/fault.hpp"
#include "grains/sizes.hpp"

namespace livebed::grains {

using base::Exit;
using base::fail;
using base::pi;

namespace {

double restitution_of_oscillator(double zeta) {
  return zeta < 1 ? std::exp(-pi * zeta / std::sqrt(1 - zeta * zeta)) : 0.0;
}

/// Schwager and Poeschel (2007), Eq. 20-22, in units of the undamped frequency.
double restitution_without_tension(double zeta) {
  if (zeta < 1) {
    const double omega = std::sqrt(1 - zeta * zeta);
    // The angle at which spring and dashpot cancel: from pi (undamped) down to 0 (critical).
    const double angle = std::atan2(2 * zeta * omega, 2 * zeta * zeta - 1);
    return std::exp(-zeta / omega * angle);
  }
  if (zeta == 1) return std::exp(-2.0);
  const double omega = std::sqrt(zeta * zeta - 1);
  return std::exp(-zeta / omega * std::log((zeta + omega) / (zeta - omega)));
}

bool agree(double a, double b) { return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b)); }

void require(bool holds, const char* key, double value, const char* allowed) {
  if (!holds) fail(Exit::invalid_case, "{} = {} is not allowed: {}", key, value, allowed);
}

}  // namespace

double restitution_of(double damping, Tension tension) {
  const double zeta = std::sqrt(2.0) * damping;
  return tension == Tension::spring ? restitution_of_oscillator(zeta) : restitution_without_tension(zeta);
}

double damping_of(double restitution, Tension tension) {
  require(restitution > 0 && restitution <= 1, "contact.restitution", restitution, "it lies in (0, 1]");
  if (restitution == 1) return 0;
  double low = 0, high = 1;  // restitution falls as damping grows
  while (restitution_of(high, tension) > restitution) high *= 2;
  for (int halving = 0; halving < 200 && low < high; ++halving) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (restitution_of(middle, tension) > restitution ? low : high) = middle;
  }
  return high;
}

Params derive(Params p) {
  if (!p.grading.empty()) {
    check_grading(p.grading);
    p.diameter = diameter_at(p.grading, 0.5);
    p.spread = 0;
  }
  require(p.diameter > 0, "grains.diameter", p.diameter, "it is above 0 [m]");
  require(p.density > p.fluid_density, "grains.density", p.density, "grains are heavier than the fluid [kg/m3]");
  require(p.spread >= 0 && p.spread < 0.5, "grains.spread", p.spread, "it lies in [0, 0.5)");
  require(p.steps_per_contact > 4, "contact.steps", p.steps_per_contact, "more than 4");
  require(p.skin > 0, "contact.skin", p.skin, "it is above 0");
  require(p.gamma > 0, "contact.gamma", p.gamma, "it is above 0");
  const double m = mass(p, smallest_diameter(p));  // the smallest grains swing fastest

  if (p.stiffness <= 0 && p.step <= 0) {
    fail(Exit::invalid_case, "neither contact.stiffness nor time.grain_step is given; give one of them");
  }
  const double stiffness = p.step > 0 ? stiffness_of(m, p.step * p.steps_per_contact) : p.stiffness;
  if (p.stiffness > 0 && !agree(stiffness, p.stiffness)) {
    fail(Exit::invalid_case,
         "contact.stiffness = {} N/m contradicts time.grain_step = {} s, which needs {} N/m at {} steps a contact (Eq. "
         "25);"
         " give one of them",
         p.stiffness, p.step, stiffness, p.steps_per_contact);
  }
  if (p.stiffness <= 0) p.stiffness = stiffness;
  if (p.step <= 0) p.step = critical_time(m, p.stiffness) / p.steps_per_contact;

  if (p.restitution <= 0 && p.damping <= 0) {
    fail(Exit::invalid_case, "neither contact.restitution nor contact.damping is given; give one of them");
  }
  if (p.restitution <= 0) {
    p.restitution = restitution_of(p.damping, p.tension);
  } else {
    const double damping = damping_of(p.restitution, p.tension);
    if (p.damping > 0 && !agree(damping, p.damping)) {
      fail(Exit::invalid_case,
           "contact.restitution = {} contradicts contact.damping = {}: it needs a damping of {}; give one of them",
           p.restitution, p.damping, damping);
    }
    if (p.damping <= 0) p.damping = damping;
  }
  return p;
}

}  // namespace livebed::grains
