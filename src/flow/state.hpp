#pragma once
#include "base/field.hpp"
#include "flow/mesh.hpp"

namespace livebed::flow {

/// What the grains do to the flow, per unit volume of the water in a cell face's control volume: the force is f - beta
/// u.
struct Load {
  int top = 0;                   ///< rows from it on hold no grains: there all is 0 and not read
  base::Field beta_u, beta_v;    ///< [kg m-3 s-1] on the faces of u and v
  base::Field force_u, force_v;  ///< [N m-3]
  base::Field damping;           ///< rate at which the grains take k from the eddies [1/s], in cells
  base::Field room;              ///< largest mixing length between them over kappa [m], in cells; 0: no bound
};

/// Where the laminar boundary layer of the pipe begins and leaves it [rad].
struct Separation {
  static constexpr double never = 3.141592653589793;
  double stagnation = 0;                ///< from the foremost point, upwards
  double above = never, below = never;  ///< from the stagnation point, over the top and under the bottom
};

/// Everything that changes with time.  k, epsilon and nut live half a step ahead of the velocity: each is then centred
/// in the step of the other.  All fields have mesh.nx x mesh.ny cells and two ghosts; u(nx,j) and v(i,ny) are
/// the outlet and top faces.
struct State {
  base::Field u, v;          ///< velocity [m/s]; of the open part of cut faces, 0 on closed ones
  base::Field p;             ///< dynamic pressure [Pa]
  base::Field p_change;      ///< of p in the last step [Pa]: where the solve for the next change starts
  base::Field nut;           ///< eddy viscosity [m2/s]
  base::Field k;             ///< turbulent kinetic energy [m2/s2]
  base::Field epsilon;       ///< its dissipation [m2/s3]
  base::Field u_old, v_old;  ///< one step ago, likewise below: face values are centred in time with their help
  base::Field k_old, epsilon_old;
  base::Field convection_u, convection_v;  ///< rates of change by convection in the last step [m/s2]
  base::Field convection_k, convection_e;  ///< of k and the second quantity of the closure [m2/s3], [its unit/s]
  base::Field voidage;                     ///< share of the cells that holds water [-]; empty: all of it
  Separation separation;                   ///< of the pipe, where its layer is laminar
  double step = 0;                         ///< last time step [s]
  double time = 0;                         ///< [s] since the spin-up began
  Load load;
};

}  // namespace livebed::flow
