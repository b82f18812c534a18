#pragma once
#include <vector>

#include "flow/mesh.hpp"
#include "flow/params.hpp"
#include "flow/state.hpp"

namespace livebed::flow {

/// What the four sides of the box do.
struct Boundary {
  bool inlet = true;       ///< west: prescribed profiles; otherwise the closed side `west`
  bool outlet = true;      ///< east: open, p = 0, vortices leave by convection; otherwise the closed side `east`
  Wall west = Wall::slip;  ///< of a closed side: slip or no_slip
  Wall east = Wall::slip;
  Wall floor = Wall::rough;
  double floor_roughness = 0;                           ///< ks [m]
  Wall top = Wall::slip;                                ///< slip is the symmetry lid
  double top_speed = 0;                                 ///< [m/s] of a no_slip lid
  std::vector<double> inlet_u, inlet_k, inlet_epsilon;  ///< one value a row
};

/// The boundary of a case: inlet profiles after params.current over the bed level (0 below it), symmetry lid.
/// Throws Fault (diverged) when the `developed` profile does not converge.
Boundary make_boundary(const Mesh& mesh, const Params& params);

/// Uniform-in-x open-channel flow of the k-epsilon model over a rough bed, driven so that the bed shear is rho u*^2:
/// values of u, k and epsilon at the heights y above the bed [m] in water of depth h.  Throws Fault (diverged) when the
/// iteration does not settle.
struct Column {
  std::vector<double> u, k, epsilon;
};
Column developed_column(const std::vector<double>& y, double h, double u_star, double ks, double nu);

/// Values outside the box from those inside: mirror images at the lid and floor, the profiles at the inlet, zero
/// gradient at the outlet.
void fill_velocity_ghosts(const Mesh& mesh, const Boundary& boundary, base::Field& u, base::Field& v);
void fill_scalar_ghosts(const Mesh& mesh, const std::vector<double>* inlet, base::Field& c);

/// Friction factor c of a wall [m/s]: the kinematic wall stress is c times the speed along it at distance y [m].
/// rough, smooth: log laws (Eq. 9; laminar below their meeting point); no_slip: nu/y; slip: 0.
double wall_friction(Wall wall, double speed, double y, double ks, double nu);

/// The friction factor of wall_friction; k-omega SST follows Spalding's law down to the wall where it is smooth.
double wall_friction(Closure closure, Wall wall, double speed, double y, double ks, double nu);

/// Friction factor of a smooth wall at any distance: the law of Spalding (1961), J. Appl. Mech. 28, 455, viscous below
/// y+ = 3 and the log law with E = 9 above y+ = 60 [m/s].
double spalding_friction(double speed, double y, double nu);

/// k, epsilon next to a wall with wall function (Eq. 10-12) from the shear velocity.  damped: with Van Driest's factor
/// of Eq. 10-11, which is 1 in the log layer; without it epsilon is u*^3/(kappa y) at any distance.
double wall_k(double u_star);
double wall_epsilon(double u_star, double y, double nu, bool damped);

}  // namespace livebed::flow
