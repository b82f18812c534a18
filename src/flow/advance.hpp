#pragma once
#include <string>

#include "base/vec2.hpp"
#include "flow/boundary.hpp"
#include "flow/momentum.hpp"
#include "flow/params.hpp"
#include "flow/pressure.hpp"
#include "flow/simple.hpp"
#include "flow/state.hpp"
#include "flow/turbulence.hpp"

namespace livebed::flow {

/// What a step did.
struct StepReport {
  SolveReport pressure;
  double mass_residual =
      0;                  ///< net outflow of the cells after the step over that before the projection (Euclidean norms)
  double courant = 0;     ///< largest dt (|u|/dx + |v|/dy) of the step
  base::Vec2 pipe_force;  ///< pressure and friction on the pipe per metre of its length [N/m]
  int outer_iterations = 0;  ///< of the SIMPLE algorithm
  Residuals residuals;       ///< at the start of the last of them
};

/// The flow: grid, state, and the algorithm that advances them: the second-order projection or SIMPLE.
class Solver {
public:
  Solver(const Params& params, const Mesh& mesh, const Boundary& boundary);

  /// Inlet profiles everywhere (0 in the bed), made free of divergence.
  void start();

  /// The share of every cell that holds water [-], 0 < voidage <= 1 (1 at first), from now on; interval: time since the
  /// last one was given [s], over which the difference comes about in the step to come, 0 when it is to count as always
  /// so.  margin: this near to an inlet or outlet [m] grains may come and go at once; there the difference moves no
  /// water. Throws Fault (invalid case) for a value out of range.
  void set_voidage(const base::Field& voidage, double interval, double margin = 0);

  /// New profiles of velocity, k and epsilon at the inlet, one value a row, from the next step on.
  void set_inlet(const Column& profiles);

  /// Largest step that keeps the Courant number at params.courant [s], or the larger of those along x and y at
  /// params.courant and params.courant_y when the latter is given; never above params.max_step.  SIMPLE takes max_step
  /// at any Courant number.
  double step_limit() const;

  /// One step of dt [s]:
  ///   1  time-centred face flow <- u, u_old         2  wall friction <- u
  ///   3  u* <- convection, diffusion, drag, old p   4  phi <- div u*,  u <- u* - dt/rho grad phi,  p <- p + phi
  ///   5  k, epsilon, nut <- u
  /// Throws Fault (diverged) when the pressure solve fails.
  ///
  /// With SIMPLE an implicit Euler step: outer iterations until the residuals fall below params.tolerance, at most
  /// params.outer_iterations.  With params.steady the same without inertia: the flow moves towards the steady one past
  /// what the grains and the pipe are now.
  StepReport advance(double dt);

  /// Outer iterations without inertia until the residuals fall below params.tolerance, at most `most`: one entry an
  /// iteration.  The flow has converged when the last entry is below the tolerance.
  std::vector<Residuals> solve_steady(int most);

  /// First value that is not finite, as a sentence with place and time; empty when all is well.
  std::string find_fault() const;

  /// Kinematic friction velocity along the floor above cell i [m/s].
  double floor_shear_velocity(int i) const;

  /// Force on the pipe per metre of its length [N/m]: pressure on the cut surfaces and their friction.
  base::Vec2 pipe_force() const;

  const Params& params() const { return params_; }
  const Mesh& mesh() const { return mesh_; }
  const Boundary& boundary() const { return boundary_; }
  const Staggering& at_u() const { return at_u_; }
  const Staggering& at_v() const { return at_v_; }
  const Staggering& at_c() const { return at_c_; }
  State state;

private:
  void set_pressure_coefficients();
  /// Largest of both(|u|/dx, |v|/dy) [1/s].  by_what_cells_hold: what flows along x into a cell that the pipe cuts is
  /// taken over the part of the cell that is open, but for slivers.
  template <class Both>
  double passage_rate(Both&& both, bool by_what_cells_hold = false) const;
  StepReport advance_projection(double dt);
  StepReport advance_simple(double dt);
  StepReport outer_iteration(double inverse_dt);
  /// state.p_change <- what the last one promises for a step of dt.
  void guess_pressure_change(double dt);
  /// u, v <- free of divergence by the gradient of phi = state.p_change, solved from its present value to the tolerance
  /// given; p <- p + relax phi.
  /// set_pressure_coefficients comes first.
  SolveReport project(double dt, double tolerance, double relax, double& mass_residual);
  /// to <- scale x what flows out of each cell, when a field is given; returns the Euclidean norm of the outflow
  /// [m2/s].
  double sum_outflow(double scale, base::Field* to);

  Params params_;
  Mesh mesh_;   ///< with the pipe cut out
  Mesh water_;  ///< with the void fraction, too
  OpeningScratch openings_;
  base::Field volume_before_;  ///< of the water before the last change of the void fraction
  Boundary boundary_;
  Staggering at_u_, at_v_, at_c_;
  Workspace work_;
  Turbulence turbulence_;
  Simple simple_;
  PressureSolver pressure_;
  bool coefficients_set_ = false;
  mutable std::vector<double> partial_;
};

}  // namespace livebed::flow
