#pragma once
#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "coupling/params.hpp"

/// Drag laws: what the water does to one grain that moves through it.  Stateless formulas; a new law is one struct, one
/// entry in DragLaw (exchange.hpp), one word of the case schema and one test.
///
/// All return beta [N s/m] of the force beta (U - u_p), which stays finite at rest.  With a void fraction e < 1 the
/// velocity U is that of the water between the grains (e U is what a pump would deliver), and the force of the pressure
/// gradient on the grain comes on top (model A; Zhou, Kuang, Chu and Yu 2010, J. Fluid Mech. 661, 482).
namespace livebed::coupling {

/// A grain in the water, as a drag law sees it.
struct Immersed {
  double slip;     ///< |U - u_p| [m/s]
  double d;        ///< diameter [m]
  double rho, nu;  ///< of the water [kg/m3], [m2/s]
  double voidage;  ///< void fraction around the grain [-]
};

/// Drag coefficient of one grain alone, times the speed w [m/s]: C_D w with C_D = A/Re + B (sum; Eq. 18 of the paper,
/// A = 24, B = C_Dinf) or (sqrt(A/Re) + sqrt(B))^2 (Dallavalle 1948; spheres: A = 23.04, B = 0.397).
struct SingleGrain {
  DragCurve curve = DragCurve::sum;
  double viscous = 24;    ///< A [-]
  double infinity = 0.4;  ///< B [-]

  double operator()(double w, double d, double nu) const {
    const double of_viscosity = viscous * nu / d, of_inertia = infinity * w;
    const double mixed = curve == DragCurve::sum ? 0.0 : 2.0 * std::sqrt(of_viscosity * of_inertia);
    return of_viscosity + of_inertia + mixed;
  }
};

/// Drag of the paper (Eq. 15, 16, 18): f = rho/2 C_D A_2 d^2 |s| s on the slip s = U - u_p, whatever is around.
struct PaperDrag {
  SingleGrain single;

  double operator()(const Immersed& g) const {
    return 0.5 * g.rho * base::sphere_area(g.d) * single(g.slip, g.d, g.nu);
  }
};

/// The same on the superficial velocity e s, times e^-chi(Re): Di Felice (1994), Int. J. Multiphase Flow 20, 153, with
/// chi = 3.7 - 0.65 exp(-(1.5 - lg Re)^2/2), Re = e |s| d/nu.
struct DiFeliceDrag {
  SingleGrain single;

  static double exponent(double Re, double) { return 3.7 - 0.65 * std::exp(-0.5 * base::square(1.5 - std::log10(Re))); }
  double operator()(const Immersed& g) const { return crowded(*this, g); }

  /// What the laws with a power of the void fraction have in common.
  template <class Law>
  static double crowded(const Law& law, const Immersed& g) {
    const double w = g.voidage * g.slip, Re = std::max(w * g.d / g.nu, reynolds_least);
    return 0.5 * g.rho * base::sphere_area(g.d) * law.single(w, g.d, g.nu) * g.voidage *
           std::pow(g.voidage, -Law::exponent(Re, g.voidage));
  }
  static constexpr double reynolds_least = 1e-6;  ///< keeps the logarithm of water at rest finite
};

/// The same with the exponent of Rong, Dong and Yu (2013), Chem. Eng. Sci. 99, 44, from lattice-Boltzmann runs of
/// packed spheres: chi = 2.65 (e + 1) - (5.3 - 3.5 e) e^2 exp(-(1.5 - lg Re)^2/2).
struct RongDrag {
  SingleGrain single;

  static double exponent(double Re, double e) {
    return 2.65 * (e + 1.0) - (5.3 - 3.5 * e) * e * e * std::exp(-0.5 * base::square(1.5 - std::log10(Re)));
  }
  double operator()(const Immersed& g) const { return DiFeliceDrag::crowded(*this, g); }
};

/// Gidaspow (1994): the packed bed of Ergun (1952) below e = 0.8 and the single grain times e^-2.65 of Wen and Yu
/// (1966) above, joined by the smooth switch of Huilin and Gidaspow (2003), Chem. Eng. Sci. 58, 3777.
struct GidaspowDrag {
  SingleGrain single;

  double operator()(const Immersed& g) const {
    const double e = g.voidage, solid = 1.0 - e, volume = base::sphere_volume(g.d);
    const double ergun = volume * g.rho * (150.0 * solid * g.nu / (e * g.d * g.d) + 1.75 * g.slip / g.d);
    const double wen_yu = 0.5 * g.rho * base::sphere_area(g.d) * single(e * g.slip, g.d, g.nu) * std::pow(e, -2.65);
    const double dilute = 0.5 + std::atan(150.0 * 1.75 * (0.2 - solid)) / base::pi;
    return dilute * wen_yu + (1.0 - dilute) * ergun;
  }
};

}  // namespace livebed::coupling
