#pragma once
#include <limits>

#include "base/math.hpp"
#include "grains/lanes.hpp"
#include "grains/params.hpp"

/// The pure formulas of the grains: masses, springs, dashpots and the force of one contact.  No grain is stored here.
/// Equation numbers are those of Yeganeh-Bakhtiary et al. (2013).
namespace livebed::grains {

/// Inertial mass of a grain of diameter d [m], added mass included [kg] (left side of Eq. 15).
inline double mass(const Params& p, double d) {
  return p.fluid_density * (p.density / p.fluid_density + p.added_mass) * base::sphere_volume(d);
}

/// Moment of inertia over m r^2 [-]: 1/2 for the paper's disk (Eq. 17), 2/5 for a solid sphere.
inline double inertia_factor(Inertia inertia) { return inertia == Inertia::disk ? 0.5 : 0.4; }

/// Downward acceleration of a free grain [m/s2]: submerged weight over inertial mass, the same for every diameter.
inline double submerged_gravity(const Params& p) {
  const double s = p.density / p.fluid_density;
  return (s - 1) / (s + p.added_mass) * p.gravity;
}

/// Critical time of Eq. 25 [s]: the period of two equal grains of mass m on the spring k_n.
inline double critical_time(double m, double k_n) { return 2 * base::pi * std::sqrt(m / (2 * k_n)); }
/// The spring that has this critical time [N/m].
inline double stiffness_of(double m, double time) { return 0.5 * m * base::square(2 * base::pi / time); }

/// Normal restitution of two equal grains [-] for alpha_cn of Eq. 27.  The pair's damping ratio is zeta = sqrt(2)
/// alpha. Tension::spring: the contact ends with the overlap, the closed formula of the damped oscillator.
/// Tension::none: it ends when the total force vanishes, Schwager and Poeschel (2007), Granular Matter 9, 465.
double restitution_of(double damping, Tension tension);
/// The inverse, by bisection.  0 < restitution <= 1; for Tension::spring alpha < 1/sqrt(2).
double damping_of(double restitution, Tension tension);

/// Params with everything derived filled in: d50 of a grading; stiffness from step or step from stiffness (Eq. 25, with
/// the mass of the smallest grains); damping from restitution or restitution from damping.  Deriving twice changes
/// nothing.  Throws Fault (invalid case) when neither or contradicting values are given, or a value is out of range.
Params derive(Params given);

/// Constants of one kind of contact.
struct Contact {
  double k_n, k_s;       ///< springs [N/m]
  double eta_n, eta_s;   ///< dashpots [N s/m]
  double mu;             ///< friction [-]
  double dt;             ///< step over which the tangential spring grows [s]
  double pull;           ///< lowest total normal force allowed [N]: 0, or minus infinity when the dashpot may pull
  bool limit_on_spring;  ///< friction bounded by mu e_n instead of mu f_n
};

/// Contact between two grains (factor 1) or of a grain with a wall (factor = wall_factor, Eq. 28).  p is complete.
inline Contact contact(const Params& p, double factor) {
  const double shear = 1 / (2 * (1 + p.poisson));                                     // Eq. 26
  const double eta_n = p.damping * 2 * std::sqrt(mass(p, p.diameter) * p.stiffness);  // Eq. 27
  return {.k_n = factor * p.stiffness,
          .k_s = factor * shear * p.stiffness,
          .eta_n = factor * eta_n,
          .eta_s = factor * shear * eta_n,
          .mu = factor * p.friction,
          .dt = p.step,
          .pull = p.tension == Tension::none ? 0.0 : -std::numeric_limits<double>::infinity(),
          .limit_on_spring = p.friction_limit == FrictionLimit::spring_force};
}

/// Forces of one contact [N].
template <class Real>
struct ContactForce {
  Real normal;      ///< f_n, positive: pushes the two apart
  Real tangential;  ///< f_s, on the first of the two, along the tangent t = (-n_y, n_x)
  Real spring;      ///< e_s to be kept for the next step
};

/// Eq. 20-24 for a pair that overlaps.  overlap [m] > 0; closing: its rate [m/s]; slip: tangential velocity of the
/// other surface relative to ours [m/s]; spring: e_s of the last step [N].  The incremental e_n of Eq. 21 is k_n
/// overlap. Sliding bounds the total f_s and the stored e_s alike: a spring that went on growing would push for long
/// after the slip has turned.
template <class Real>
inline ContactForce<Real> contact_force(const Contact& c, const Real& overlap, const Real& closing, const Real& slip,
                                        const Real& spring) {
  const Real zero = Real{};
  const Real e_n = c.k_n * overlap;
  const Real f_n = larger<Real>(e_n + c.eta_n * closing, zero + c.pull);
  const Real limit = c.mu * (c.limit_on_spring ? e_n : larger<Real>(f_n, zero));
  const Real e_s = larger<Real>(smaller<Real>(spring + c.k_s * c.dt * slip, limit), -limit);
  const Real f_s = larger<Real>(smaller<Real>(e_s + c.eta_s * slip, limit), -limit);
  return {f_n, f_s, e_s};
}

}  // namespace livebed::grains
