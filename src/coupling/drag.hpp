#pragma once
#include "base/math.hpp"

/// Drag laws: what the water does to one grain that moves through it.  Stateless formulas; a new law is one struct, one
/// entry in DragLaw (exchange.hpp), one word of the case schema and one test.
namespace livebed::coupling {

/// Drag of the paper (Eq. 15, 16, 18): f = rho/2 C_D A_2 d^2 |s| s with C_D = C_Dinf + 24/Re_p on the slip s = U - u_p.
/// Written as f = beta s, which stays finite at rest.
struct PaperDrag {
  double drag_infinity = 0.4;  ///< C_D infinity [-]

  /// beta [N s/m] of a grain of diameter d [m] at the slip speed |s| [m/s].
  double operator()(double slip, double d, double rho, double nu) const {
    return 0.5 * rho * base::sphere_area(d) * (drag_infinity * slip + 24.0 * nu / d);
  }
};

}  // namespace livebed::coupling
