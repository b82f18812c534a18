#pragma once
#include "flow/boundary.hpp"
#include "flow/operators.hpp"
#include "flow/state.hpp"

namespace livebed::flow {

/// Fields that one step needs besides the state; allocated once.
struct Workspace {
  base::SharedRows face_x, face_y;          ///< openings of the cell faces, times void fraction [-]
  base::SharedRows cut_x, cut_y;            ///< what the pipe leaves open of them [-]
  base::Field storage;                      ///< volume x d(voidage)/dt of the cells [m2/s]; empty when it is 0
  std::vector<double> nothing;              ///< a row of zeros
  std::vector<double> per_dx, per_dx_face;  ///< 1 / widths and distances of cells [1/m], two ghosts in front
  std::vector<HandedOn> handed_u, handed_v;
  std::vector<WallPart> wall_u, wall_v;     ///< the pipe as u and v meet it
  std::vector<WallCell> wall_cells;         ///< the cells that hold a piece of its surface
  base::Field wall_c;                       ///< friction factor x length of the pipe's surface in a cell [m2/s]
  std::vector<double> floor_c, top_c;       ///< friction factor of floor and lid above cell i [m/s]
  base::SharedRows friction_u, friction_v;  ///< wall friction of the volumes of u and v [m2/s]
  base::SharedRows factor_u, factor_v;      ///< implicit factor of drag and friction [-]
  base::SharedRows response_u, response_v;  ///< share of a pressure gradient that accelerates the face, after drag [-]
  base::SharedRows ones;
  base::Field next_a, next_b;                ///< u, v, then k and epsilon at the new time, until they take their places
  base::Field convection, convection_e;      ///< likewise
  base::Field change, change_e, exchange_y;  ///< right-hand side and vertical exchange of the line systems
  base::Field outflow, c_x, c_y, c_boundary;
  ImplicitConvection implicit_y;  ///< of u, v, or k and epsilon
  RowScratch rows;
  ColumnScratch columns;
  explicit Workspace(const Mesh& mesh);

  /// Rows below `top` get factors and responses of their own: those with grains in them, or all for SIMPLE.
  void own_rows(int top);

private:
  std::vector<char> walls_u_, walls_v_;
  int nx_, owned_ = 0;
};

/// convection[i] += what the change of void fraction adds to the rate of a quantity c: with it, - (div(voidage u c) +
/// c d(voidage)/dt)/voidage, the quantity does not change where it is uniform.
void add_storage(const Staggering& at, const Workspace& w, int j, const double* c, double* convection);

/// The velocity that carries all quantities through the step to come: u + dt/(2 dt_old) (u - u_old), centred in time.
/// Both levels are free of divergence, so is their blend.  dt = 0: u as it is.
Carrier centred_carrier(const State& s, double dt);

/// Friction factors of floor, lid and pipe from the present flow, and their sums over the volumes of u and v.
void evaluate_walls(const Mesh& mesh, const Boundary& boundary, const Params& params, const State& s, Workspace& w);

/// One velocity component and what belongs to it.
struct Component {
  const Staggering& at;
  bool is_u;
  base::Field &value, &before, &convection;
  const base::Field &beta, &force;
  const base::SharedRows& friction;
  base::SharedRows &factor, &response;
  const std::vector<HandedOn>& handed;
};
Component u_component(const Staggering& at_u, State& s, Workspace& w);
Component v_component(const Staggering& at_v, State& s, Workspace& w);

/// Eq. 2-3 row after row upwards, without the new pressure: what accelerates a component now, the old pressure among
/// it.
template <class Scheme>
class MomentumRows {
public:
  /// dt: the rows come times dt [s]; lead: the convective face values run half of it ahead [s], 0 for a balance, which
  /// leaves nothing to an implicit sweep.
  MomentumRows(const Mesh& mesh, const Boundary& boundary, const Params& params, const State& s, const Carrier& carrier,
               double dt, double lead, Workspace& w, const Component& c, RowScratch::Rows& scratch);

  /// Begins with row ja of the block [ja, jb).  convection: a field that receives that of the block's rows, or null.
  void start(int ja, int jb, base::Field* convection);
  /// The next row j: d <- dt x acceleration, kx <- exchange across west faces (diffusivity x opening / distance) [m/s];
  /// factor <- 1 + dt x (drag + friction), response <- with drag alone where the row has its own; convection() and
  /// exchange_y(j), exchange_y(j + 1) are those of the row.
  void next(double* d, double* kx);
  const double* convection(int j) const { return convection_[j % 4]; }
  const double* exchange_y(int j) const { return exchange_y_[j % 2]; }
  const double* implicit_y(int j) const { return convect_.implicit_y(j); }
  const CarrierRows& carrier() const { return carrier_; }

private:
  void fill_exchange_x(int j, double* k) const;
  void fill_exchange_y(int j, double* k) const;
  void hand_on(int j);
  void add_load_and_friction(int j, double* d);

  const Mesh& m_;
  const Boundary& b_;
  const Params& params_;
  const State& s_;
  Workspace& w_;
  Component c_;
  CarrierRows carrier_;
  ConvectionRows<Scheme> convect_;
  double dt_;
  int j_ = 0, last_ = 0, converted_ = 0;
  bool hands_on_ = false;
  base::Field* kept_ = nullptr;
  int kept_from_ = 0, kept_to_ = 0;
  std::array<double*, 4> convection_{}, scratch_rows_{};
  std::array<double*, 2> exchange_y_{};
  double* outer_;
};

/// Eq. 2-3 without the new pressure: u, v <- predicted velocity, u_old, v_old <- the one before.  Convection explicit
/// and time-centred; diffusion by two line sweeps (centred in time where that cannot oscillate); drag and wall friction
/// implicit.
void predict_velocity(const Mesh& mesh, const Boundary& boundary, const Params& params, const Staggering& at_u,
                      const Staggering& at_v, double dt, State& s, Workspace& w);

}  // namespace livebed::flow
