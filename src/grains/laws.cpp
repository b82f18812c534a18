#include "grains/laws.hpp"

#include <cmath>
#include <limits>

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

Contact pair_contact(const Params& p) {
  const double shear = 1 / (2 * (1 + p.poisson));  // Eq. 26
  // Eq. 27 is the dashpot of two equal grains, whose reduced mass is half of one: Hooke's takes it over for any mass.
  const double alpha = p.damping * 2 * std::sqrt(p.stiffness);
  const double mass_r3 = mass(p, 2);
  return {.k_n = p.stiffness,
          .k_s = shear * p.stiffness,
          .eta_n = p.law == Law::hooke ? alpha * std::sqrt(2.0) : alpha * std::sqrt(mass(p, p.diameter)),
          .shear = shear,
          .mu = p.friction,
          .dt = p.step,
          .pull = p.tension == Tension::none ? 0.0 : -std::numeric_limits<double>::infinity(),
          .limit_on_spring = p.friction_limit == FrictionLimit::spring_force,
          .mu_r = p.rolling_friction,
          .k_r = 2.25 * p.stiffness * base::square(p.rolling_friction),
          .eta_r = 2 * p.rolling_damping,
          .mass_r3 = mass_r3,
          .inertia_r5 = (inertia_factor(p.inertia) + 1) * mass_r3};
}

Contact wall_contact(const Params& p, const WallFactors& factors) {
  Contact c = pair_contact(p);
  c.k_n *= factors.stiffness;
  c.k_s *= factors.stiffness;
  // The paper multiplies the dashpot itself.  Hooke's keeps the restitution of a wall apart from its stiffness.
  c.eta_n *= factors.damping * (p.law == Law::hooke ? std::sqrt(factors.stiffness) : 1.0);
  c.mu *= factors.friction;
  c.mu_r *= factors.rolling;
  c.k_r *= factors.stiffness * base::square(factors.rolling);
  return c;
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
  require(p.rolling_friction >= 0, "contact.rolling_friction", p.rolling_friction, "it is not negative");
  for (WallFactors* wall : {&p.pipe, &p.bottom})
    for (double* factor : {&wall->stiffness, &wall->damping, &wall->friction, &wall->rolling})
      if (*factor < 0) *factor = p.law == Law::hooke && factor == &wall->damping ? 1.0 : p.wall_factor;
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
