#pragma once
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

/// Constants of one kind of contact, in double or single precision.
template <class Number>
struct ContactOf {
  Number k_n, k_s;       ///< springs [N/m]
  Number eta_n;          ///< dashpot [N s/m], or over the root of the reduced mass [N s/m/kg^(1/2)] (Law::hooke)
  Number shear;          ///< k_s/k_n and eta_s/eta_n [-] (Eq. 26)
  Number mu;             ///< friction [-]
  Number dt;             ///< step over which springs grow [s]
  Number pull;           ///< lowest total normal force allowed [N]: 0, or minus infinity when the dashpot may pull
  bool limit_on_spring;  ///< friction bounded by mu e_n instead of mu f_n
  Number mu_r;           ///< rolling friction [-]
  Number k_r;            ///< rolling spring over the square of the rolling radius [N/m]
  Number eta_r;          ///< rolling dashpot over the root of inertia times rolling spring [-]
  Number mass_r3;        ///< mass of a grain over the cube of its radius [kg/m3]
  Number inertia_r5;     ///< its moment of inertia about a point of its surface over radius^5 [kg/m3]
};
using Contact = ContactOf<double>;

/// Contact between two grains.  p is complete (derive).
Contact pair_contact(const Params& p);
/// Contact of a grain with a wall; factors are complete.
Contact wall_contact(const Params& p, const WallFactors& factors);

// The laws are written once for `double` and for `Lanes`; see lanes.hpp for the namespace.
inline namespace LIVEBED_SET {

/// The same constants rounded to the precision of Number.
template <class Number>
inline ContactOf<Number> in_precision(const Contact& c) {
  const auto in = [](double a) { return static_cast<Number>(a); };
  return {.k_n = in(c.k_n),
          .k_s = in(c.k_s),
          .eta_n = in(c.eta_n),
          .shear = in(c.shear),
          .mu = in(c.mu),
          .dt = in(c.dt),
          .pull = in(c.pull),
          .limit_on_spring = c.limit_on_spring,
          .mu_r = in(c.mu_r),
          .k_r = in(c.k_r),
          .eta_r = in(c.eta_r),
          .mass_r3 = in(c.mass_r3),
          .inertia_r5 = in(c.inertia_r5)};
}

/// Forces of one contact [N].
template <class Real>
struct ContactForce {
  Real normal;      ///< f_n, positive: pushes the two apart
  Real tangential;  ///< f_s, on the first of the two, along the tangent t = (-n_y, n_x)
  Real spring;      ///< e_s to be kept for the next step
};

/// Eq. 20-24 for a pair that overlaps.  overlap [m] > 0; closing: its rate [m/s]; slip: tangential velocity of the
/// other surface relative to ours [m/s]; spring: e_s of the last step [N]; eta_n: normal dashpot of the pair [N s/m].
/// The incremental e_n of Eq. 21 is k_n overlap.  Sliding bounds the total f_s and the stored e_s alike: a spring that
/// went on growing would push for long after the slip has turned.
template <class Real, class Number, class Dashpot>
inline ContactForce<Real> contact_force(const ContactOf<Number>& c, const Dashpot& eta_n, const Real& overlap,
                                        const Real& closing, const Real& slip, const Real& spring) {
  const Real zero = Real{};
  const Real e_n = c.k_n * overlap;
  const Real f_n = larger<Real>(e_n + eta_n * closing, zero + c.pull);
  const Real limit = c.mu * (c.limit_on_spring ? e_n : larger<Real>(f_n, zero));
  const Real e_s = larger<Real>(smaller<Real>(spring + c.k_s * c.dt * slip, limit), -limit);
  const Real f_s = larger<Real>(smaller<Real>(e_s + c.shear * eta_n * slip, limit), -limit);
  return {f_n, f_s, e_s};
}

/// What the mass and the size of the two in contact decide.  A wall has neither: then it is the grain's own.
template <class Real>
struct Reduced {
  Real mass;     ///< [kg]
  Real radius;   ///< [m]
  Real inertia;  ///< about the point of contact [kg m2]
};
/// Of two grains.  Made of the sum and the product of the radii alone, so that both see the same bits; by way of their
/// shares of the sum, or the fifth power of the product would be below the smallest single.
template <class Real, class Number>
inline Reduced<Real> reduced_of_pair(const ContactOf<Number>& c, const Real& r, const Real& other) {
  const Real s = r + other, per_s = Number(1) / s;
  const Real q = (r * other) * (per_s * per_s);  // r_i r_j / (r_i + r_j)^2
  const Real radius = q * s, cube = radius * radius * radius;
  return {c.mass_r3 * cube / (Number(1) - Number(3) * q), radius,
          c.inertia_r5 * (cube * radius * radius) / (Number(1) - Number(5) * (q - q * q))};
}
template <class Real, class Number>
inline Reduced<Real> reduced_at_wall(const ContactOf<Number>& c, const Real& r) {
  const Real cube = r * r * r;
  return {c.mass_r3 * cube, r, c.inertia_r5 * (cube * r * r)};
}

/// Rolling resistance of one contact [N m].
template <class Real>
struct RollingMoment {
  Real moment;  ///< on the first of the two, counter-clockwise
  Real spring;  ///< to be kept for the next step
};

/// Elastic-plastic spring and dashpot against rolling, type C of Ai, Chen, Rotter and Ooi (2011), Powder Technology
/// 206, 269: spring k_r = 2.25 k_n mu_r^2 R^2, bounded by mu_r R f_n, and a dashpot while it is not at that bound.
/// rate: spin of the first minus spin of the other [1/s]; normal: f_n [N].
template <class Real, class Number>
inline RollingMoment<Real> rolling_moment(const ContactOf<Number>& c, const Reduced<Real>& reduced, const Real& normal,
                                          const Real& rate, const Real& spring) {
  const Real zero = Real{};
  const Real k = c.k_r * (reduced.radius * reduced.radius);
  const Real limit = c.mu_r * (reduced.radius * larger<Real>(normal, zero));
  const Real free = spring - k * (c.dt * rate);
  const Real kept = larger<Real>(smaller<Real>(free, limit), -limit);
  const Real damped = c.eta_r * root(reduced.inertia * k) * rate;
  return {select(free > limit, kept, select(free < -limit, kept, kept - damped)), kept};
}

}  // namespace LIVEBED_SET

}  // namespace livebed::grains
