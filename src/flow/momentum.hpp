#pragma once
#include "flow/boundary.hpp"
#include "flow/operators.hpp"
#include "flow/state.hpp"

namespace livebed::flow {

/// Fields that one step needs besides the state; allocated once.
struct Workspace {
  FaceFlow face;      ///< time-centred flow through the faces
  base::Field gamma;  ///< nu + nut at cell centres [m2/s]
  std::vector<HandedOn> handed_u, handed_v;
  std::vector<WallPart> wall_u, wall_v;  ///< the pipe as u and v meet it
  base::Field wall_c;                    ///< friction factor x length of the pipe's surface in a cell [m2/s]
  std::vector<double> floor_c, top_c;    ///< friction factor of floor and lid above cell i [m/s]
  base::Field base_u, base_v;            ///< implicit factor of drag and friction in the momentum lines [-]
  base::Field response_u, response_v;    ///< share of a pressure gradient that accelerates the face, after drag [-]
  base::Field friction_u, friction_v;    ///< wall friction of the volumes of u and v [m2/s]
  Conductance conductance;
  base::Field change, scratch, base;
  base::Field phi, outflow, c_x, c_y, c_boundary;
  RowScratch rows;
  explicit Workspace(const Mesh& mesh);
};

/// Time-centred advecting flow: u + dt/(2 dt_old) (u - u_old).  Both levels are free of divergence, so is their blend.
void center_face_flow(const Mesh& mesh, const State& s, double dt, FaceFlow& face);

/// Friction factors of floor, lid and pipe from the present flow.
void evaluate_walls(const Mesh& mesh, const Boundary& boundary, const Params& params, const State& s, Workspace& w);

/// One velocity component.  gamma enters twice along the direction it points to (2 Gamma du/dx).
struct MomentumEquation {
  const Staggering& at;
  bool is_u;
  base::Field& value;
  base::Field& rate;
  const base::Field& beta;
  const base::Field& force;
  const base::Field& friction;
  base::Field& factor;    ///< base of the line systems
  base::Field& response;  ///< share of a pressure gradient that accelerates the face
};
MomentumEquation u_equation(const Staggering& at_u, State& s, Workspace& w);
MomentumEquation v_equation(const Staggering& at_v, State& s, Workspace& w);

/// gamma and the wall friction of the volumes, from the present flow.
void prepare_momentum(const Mesh& mesh, const Boundary& boundary, const Params& params, const State& s, Workspace& w);

/// w.change <- dt x acceleration by all forces of Eq. 2-3 on the present flow, the old pressure among them;
/// w.conductance
/// <- of the faces; factor <- 1 + dt x (drag + friction); response <- with drag alone; rate <- - convection.
/// lead: how far the face values run ahead in time [s]; 0 for a steady or fully implicit balance.
void assemble_momentum(const Mesh& mesh, const Boundary& boundary, const Params& params, double dt, double lead,
                       const State& s, Workspace& w, const MomentumEquation& c);

/// Eq. 2-3 without the new pressure: u, v <- predicted velocity.  Convection explicit and time-centred; diffusion by
/// two line sweeps (centred in time where that cannot oscillate); drag and wall friction implicit.  On return
/// state.rate_u, rate_v hold minus the convective acceleration: complete_rates turns them into the acceleration without
/// convection.
void predict_velocity(const Mesh& mesh, const Boundary& boundary, const Params& params, const Staggering& at_u,
                      const Staggering& at_v, double dt, State& s, Workspace& w);

/// rate = (u - u_old)/dt - convection, for the face values of the next step.
void complete_rates(const Staggering& at_u, const Staggering& at_v, double dt, State& s);

}  // namespace livebed::flow
