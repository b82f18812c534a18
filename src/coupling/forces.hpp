#pragma once
#include <algorithm>
#include <cmath>

#include "base/math.hpp"

/// Forces of the water on a grain besides drag, and what grains do to the eddies around them.  Stateless formulas.
namespace livebed::coupling {

/// Lift of a grain in shear over the cross product of slip and vorticity [N s2/m]: Saffman (1965), J. Fluid Mech. 22,
/// 385, f = 1.615 rho d^2 sqrt(nu/|omega|) s x omega, times the factor that Mei (1992), Int. J. Multiphase Flow 18,
/// 145, fitted to larger Reynolds numbers.  slip [m/s], vorticity |omega| [1/s], d [m], rho [kg/m3], nu [m2/s].
inline double saffman_mei_lift(double slip, double vorticity, double d, double rho, double nu) {
  if (slip <= 0 || vorticity <= 0) return 0;
  const double Re = slip * d / nu, root = std::sqrt(0.5 * vorticity * d / slip);  // alpha^(1/2)
  const double bound = 0.3314 * root;
  const double mei = Re <= 40 ? (1.0 - bound) * std::exp(-0.1 * Re) + bound : 0.0524 * root * std::sqrt(Re);
  return 1.615 * rho * base::square(d) * std::sqrt(nu / vorticity) * mei;
}

/// Share of an eddy's motion that a grain follows [-]: exp(-B St), St the grain's response time over the eddy's, k/(6
/// epsilon) (Chauchat et al. 2017, Geosci. Model Dev. 10, 4367, Eq. 25-26).  B [-], response and k/epsilon [s].
inline double share_followed(double B, double response, double k_over_epsilon) {
  return std::exp(-B * 6.0 * response / k_over_epsilon);
}

}  // namespace livebed::coupling
