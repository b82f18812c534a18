#pragma once
#include "flow/constants.hpp"
#include "flow/momentum.hpp"

namespace livebed::flow {

/// Sources of the k-epsilon model (Eq. 4-6), one line each.  Constants: flow/constants.hpp.
/// Production p_r of Eq. 6 (its third term corrected to (dU/dy + dV/dx)^2) [m2/s3].
inline double production(double nut, double dudx, double dvdy, double shear) {
  return nut * (2.0 * dudx * dudx + 2.0 * dvdy * dvdy + shear * shear);
}
/// Eddy viscosity, Eq. 7 [m2/s].
inline double eddy_viscosity(double k, double epsilon) { return launder_spalding.c_mu * k * k / epsilon; }

/// k, epsilon <- one step of Eq. 4-5; nut <- Eq. 7.  Positive by construction: decay is implicit, convection that would
/// empty a cell is taken implicitly there (Patankar 1980), and the line systems are M-matrices.
/// Cells at walls with wall function get Eq. 10-12 from the shear velocity.
void advance_turbulence(const Mesh& mesh, const Boundary& boundary, const Params& params, const Staggering& at,
                        double dt, State& s, Workspace& w);

/// nut <- k, epsilon (Eq. 7); 0 in solid cells.
void update_eddy_viscosity(const Mesh& mesh, const Params& params, State& s);

}  // namespace livebed::flow
