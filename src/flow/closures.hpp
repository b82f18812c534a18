#pragma once
#include <algorithm>
#include <cmath>
#include <variant>

#include "base/math.hpp"
#include "flow/constants.hpp"
#include "flow/params.hpp"

/// Turbulence closures: what each says about one cell.  Stateless formulas; Turbulence holds the loops.
///
/// A closure transports k and a second quantity e: epsilon [m2/s3], or omega = epsilon/(Cmu k) [1/s].
namespace livebed::flow {

/// What a closure may know of a cell.
struct Local {
  double k;       ///< turbulent kinetic energy [m2/s2]
  double e;       ///< epsilon or omega
  double nut;     ///< eddy viscosity [m2/s]
  double strain;  ///< S^2 = 2 S_ij S_ij [1/s2]
  double cross;   ///< grad k . grad e, filled for omega closures alone
  double blend;   ///< of an omega closure: what its diffusion depends on (1 in the wall layer of SST, 0 outside)
};

/// dc/dt = gain - decay c.  decay is never negative; gain may be.
struct Rates {
  double gain, decay;
};

/// Production of Eq. 6 (its third term corrected to (dU/dy + dV/dx)^2) over nut: S^2 [1/s2].
inline double strain_squared(double dudx, double dvdy, double shear) {
  return 2.0 * dudx * dudx + 2.0 * dvdy * dvdy + shear * shear;
}

/// Standard k-epsilon, Eq. 4-7.
struct StandardKEpsilon {
  static constexpr bool transports_omega = false;
  static constexpr KEpsilon c = launder_spalding;

  Rates k(const Local& a) const { return {a.nut * a.strain, a.e / a.k}; }
  Rates e(const Local& a) const {
    const double turnover = a.e / a.k;
    return {c.c1 * turnover * a.nut * a.strain, c.c2 * turnover};
  }
  double diffusion_k(double) const { return 1.0 / c.sigma_k; }
  double diffusion_e(double) const { return 1.0 / c.sigma_epsilon; }
  double eddy_viscosity(double k, double e, double /*strain*/, double /*y*/, double /*nu*/) const {
    return c.c_mu * k * k / e;
  }
};

/// The standard model with the time scale T = k/epsilon held below alpha/(sqrt(3) Cmu S) wherever T enters: nut S stays
/// below alpha k/sqrt(3).  Durbin (1996), Int. J. Heat Fluid Flow 17, 89.  With alpha = 1 no normal stress turns
/// negative, and no false turbulence is made where the flow stagnates; with his later alpha = 0.6 (Behnia, Parneix and
/// Durbin 1998, Int. J. Heat Mass Transfer 41, 1845) the free shear layers of a pipe stay thin enough to roll up.  In a
/// log layer nut S = 0.3 k, below both: there it is the standard model.
struct RealizableKEpsilon {
  static constexpr bool transports_omega = false;
  static constexpr KEpsilon c = launder_spalding;
  double bound = Params{}.realizability * per_sqrt_3;  ///< nut S <= bound k

  double time_scale(double k, double e, double strain) const {
    const double slow = k / e, fast = bound / (c.c_mu * std::sqrt(strain));
    return slow < fast ? slow : fast;
  }
  Rates k(const Local& a) const { return {a.nut * a.strain, a.e / a.k}; }
  Rates e(const Local& a) const {
    const double turnover = 1.0 / time_scale(a.k, a.e, a.strain);
    return {c.c1 * turnover * a.nut * a.strain, c.c2 * turnover};
  }
  double diffusion_k(double) const { return 1.0 / c.sigma_k; }
  double diffusion_e(double) const { return 1.0 / c.sigma_epsilon; }
  double eddy_viscosity(double k, double e, double strain, double /*y*/, double /*nu*/) const {
    return c.c_mu * k * time_scale(k, e, strain);
  }
};

/// omega at distance y from a wall [1/s]: u*/(sqrt(Cmu) kappa y) in the log layer, 6 nu/(beta y^2) in the viscous layer
/// of a wall that is not rough, and the root of the sum of their squares between (Menter's automatic wall treatment).
inline double omega_at_wall(double beta, double u_star, double y, double nu, bool viscous_layer) {
  const double log_layer = u_star / (std::sqrt(launder_spalding.c_mu) * kappa * y);
  const double viscous = viscous_layer ? 6.0 * nu / (beta * y * y) : 0.0;
  return std::hypot(log_layer, viscous);
}

/// k-omega, Wilcox (2008), AIAA J. 46, 2823, in two dimensions: cross diffusion where k and omega rise together, and a
/// stress of at most sqrt(beta*)/C_lim of k.
struct KOmega {
  static constexpr bool transports_omega = true;
  static constexpr double beta_star = 0.09, beta = 0.0708, gamma = 13.0 / 25.0, sigma_k = 0.6, sigma_omega = 0.5,
                          sigma_d = 0.125, stress_limiter = 7.0 / 8.0;

  /// The omega that the eddy viscosity feels.
  static double felt(double omega, double strain) {
    return std::max(omega, stress_limiter * std::sqrt(strain * (1.0 / beta_star)));
  }
  Rates k(const Local& a) const { return {a.nut * a.strain, beta_star * a.e}; }
  Rates e(const Local& a) const {
    return {gamma * a.e / a.k * a.nut * a.strain + sigma_d * std::max(a.cross, 0.0) / a.e, beta * a.e};
  }
  /// k and omega spread by k/omega, not by the eddy viscosity that the limit holds down: the ratio of the two.
  double blend(const Local& a, double /*y*/, double /*nu*/) const { return felt(a.e, a.strain) / a.e; }
  double diffusion_k(double blend) const { return sigma_k * blend; }
  double diffusion_e(double blend) const { return sigma_omega * blend; }
  double eddy_viscosity(double k, double omega, double strain, double /*y*/, double /*nu*/) const {
    return k / felt(omega, strain);
  }
  static double wall_omega(double u_star, double y, double nu, bool viscous_layer) {
    return omega_at_wall(beta, u_star, y, nu, viscous_layer);
  }
};

/// tanh(a) for a >= 0 by its continued fraction (Lambert), 1 beyond 4.97; within 1e-4, and a vector instruction.
inline double blending_tanh(double a) {
  const double x = std::min(a, 4.97), x2 = x * x;
  const double ratio =
      x * (135135.0 + x2 * (17325.0 + x2 * (378.0 + x2))) / (135135.0 + x2 * (62370.0 + x2 * (3150.0 + x2 * 28.0)));
  return std::min(ratio, 1.0);
}

/// k-omega SST, Menter, Kuntz and Langtry (2003), Turbulence, Heat and Mass Transfer 4, 625.
struct KOmegaSst {
  static constexpr bool transports_omega = true;
  static constexpr double beta_star = 0.09, a1 = 0.31, production_limit = 10.0, cross_least = 1e-10;
  /// Constants of the wall layer (F1 = 1, k-omega) and of the rest (F1 = 0, k-epsilon).
  struct Set {
    double sigma_k, sigma_omega, beta, gamma;
  };
  static constexpr Set inner{0.85, 0.5, 3.0 / 40.0, 5.0 / 9.0}, outer{1.0, 0.856, 0.0828, 0.44};

  static double mix(double at_wall, double away, double blend) { return away + blend * (at_wall - away); }
  /// sqrt(k)/(beta* omega y) and 500 nu/(y^2 omega): sizes of eddies and of the viscous layer over the wall distance.
  static double eddy_size(double k, double omega, double y) { return std::sqrt(k) / (beta_star * omega * y); }
  static double viscous_size(double omega, double y, double nu) { return 500.0 * nu / (y * y * omega); }
  /// 2 sigma_omega2 (grad k . grad omega)/omega: the cross diffusion that turns k-epsilon into k-omega.
  static double cross_diffusion(const Local& a) { return 2.0 * outer.sigma_omega * a.cross / a.e; }

  /// F1.  Its argument is cut off where tanh(argument^4) is 1 anyhow.
  double blend(const Local& a, double y, double nu) const {
    const double wall = std::max(eddy_size(a.k, a.e, y), viscous_size(a.e, y, nu));
    const double away = 4.0 * outer.sigma_omega * a.k / (std::max(cross_diffusion(a), cross_least) * y * y);
    const double argument = std::min({wall, away, 2.0});
    return blending_tanh(base::square(base::square(argument)));
  }
  Rates k(const Local& a) const {
    const double decay = beta_star * a.e;
    return {std::min(a.nut * a.strain, production_limit * decay * a.k), decay};
  }
  Rates e(const Local& a) const {
    const double production_over_nut = std::min(a.strain, production_limit * beta_star * a.e * a.k / a.nut);
    return {mix(inner.gamma, outer.gamma, a.blend) * production_over_nut + (1.0 - a.blend) * cross_diffusion(a),
            mix(inner.beta, outer.beta, a.blend) * a.e};
  }
  double diffusion_k(double blend) const { return mix(inner.sigma_k, outer.sigma_k, blend); }
  double diffusion_e(double blend) const { return mix(inner.sigma_omega, outer.sigma_omega, blend); }
  double eddy_viscosity(double k, double omega, double strain, double y, double nu) const {
    const double argument = std::min(std::max(2.0 * eddy_size(k, omega, y), viscous_size(omega, y, nu)), 3.0);
    const double F2 = blending_tanh(argument * argument);
    return a1 * k / std::max(a1 * omega, std::sqrt(strain) * F2);
  }
  static double wall_omega(double u_star, double y, double nu, bool viscous_layer) {
    return omega_at_wall(inner.beta, u_star, y, nu, viscous_layer);
  }
};

/// A new closure: one struct, one entry, one word of Closure, one test.
using ClosureLaw = std::variant<StandardKEpsilon, RealizableKEpsilon, KOmega, KOmegaSst>;

/// The law of a turbulent closure; the standard one for laminar flow, which never asks it.
inline ClosureLaw closure_law(const Params& params) {
  switch (params.closure) {
    case Closure::k_epsilon_realizable:
      return RealizableKEpsilon{params.realizability * per_sqrt_3};
    case Closure::k_omega:
      return KOmega{};
    case Closure::k_omega_sst:
      return KOmegaSst{};
    case Closure::k_epsilon:
    case Closure::laminar:
      break;
  }
  return StandardKEpsilon{};
}

}  // namespace livebed::flow
