#pragma once
#include <algorithm>
#include <cmath>

/// Convection schemes: the value of a transported quantity on a face, from two nodes on either side.  Stateless
/// formulas.
namespace livebed::flow {

/// Harmonic limiter of van Leer (1974): 0 at an extremum, second order where the slopes agree.
inline double limited_slope(double a, double b) {
  const double product = a * b;
  return product > 0 ? 2.0 * product / (a + b) : 0.0;
}

/// What is believed of the change that the history of a positive quantity promises for half a step: all of it while it
/// is a small share of the value (second order in time), ever less beyond.  Where a quantity jumps from step to step,
/// as beside a wall function, running ahead would make it swing.
inline double believed_change(double change, double value) {
  constexpr double resolved = 0.05;  // of the value
  const double jump = change / (resolved * value);
  return change / (1.0 + jump * jump);
}

/// The four nodes about a face and their distances: mm, m | p, pp.
struct Stencil4 {
  double mm, m, p, pp;           ///< values
  double h;                      ///< distance m-p [m]
  double per_mm, per_h, per_pp;  ///< 1 / distances mm-m, m-p, p-pp [1/m]
  double to_face_m, to_face_p;   ///< distances of m and p from the face [m]
};

/// Bounded second order in space and time (a Hancock step): upwind node plus the limited slope over the part of the
/// cell that does not pass the face within dt.  half_m, half_p: what else changes nodes m and p within dt/2 (cross
/// flow, forces).
struct Bounded {
  static double face(const Stencil4& s, double velocity, double dt, double half_m, double half_p, double) {
    const bool forward = velocity > 0;
    const double middle = (s.p - s.m) * s.per_h;
    const double behind = forward ? (s.m - s.mm) * s.per_mm : (s.pp - s.p) * s.per_pp;
    const double slope = limited_slope(behind, middle);
    const double travel = 0.5 * velocity * dt;
    const double node = forward ? s.m + half_m : s.p + half_p;
    return node + slope * ((forward ? s.to_face_m : -s.to_face_p) - travel);
  }
};

/// Hybrid scheme of Spalding (1972), the paper's: central where the cell Peclet number |u| h / Gamma is below 2, upwind
/// without diffusion above.  The diffusive flux is added elsewhere, so the face value here takes away from upwind what
/// that flux brings: m + (p - m) / Pe, which meets the central value at Pe = 2 (where the face is not midway, at Pe = h
/// / distance of the upwind node).
struct Hybrid {
  static double face(const Stencil4& s, double velocity, double, double, double, double gamma) {
    const double speed_h = std::abs(velocity) * s.h;
    const bool forward = velocity > 0;
    const double central = (forward ? s.to_face_m : s.to_face_p) * s.per_h;
    const double downstream = speed_h * central <= gamma ? central : gamma / speed_h;
    return forward ? s.m + (s.p - s.m) * downstream : s.p + (s.m - s.p) * downstream;
  }
};

}  // namespace livebed::flow
