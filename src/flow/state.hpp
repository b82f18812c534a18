#pragma once
#include "base/field.hpp"
#include "flow/mesh.hpp"

namespace livebed::flow {

/// What the grains do to the flow, per unit volume of a cell face's control volume: the force is f - beta u.
struct Load {
  base::Field beta_u, beta_v;    ///< [kg m-3 s-1] on the faces of u and v
  base::Field force_u, force_v;  ///< [N m-3]
};

/// Everything that changes with time.  All fields have mesh.nx x mesh.ny cells and two ghosts; u(nx,j) and v(i,ny) are
/// the outlet and top faces.
struct State {
  base::Field u, v;            ///< velocity [m/s]; of the open part of cut faces, 0 on closed ones
  base::Field p;               ///< dynamic pressure [Pa]
  base::Field k;               ///< turbulent kinetic energy [m2/s2]
  base::Field epsilon;         ///< its dissipation [m2/s3]
  base::Field nut;             ///< eddy viscosity [m2/s]
  base::Field u_old, v_old;    ///< velocity one step ago (time-centred advection)
  base::Field rate_u, rate_v;  ///< acceleration of the last step but for convection [m/s2] (time-centred face values)
  double step = 0;             ///< last time step [s]
  double time = 0;             ///< [s] since the spin-up began
  Load load;
};

}  // namespace livebed::flow
