#pragma once
#include <string>
#include <vector>

#include "flow/lines.hpp"
#include "flow/momentum.hpp"
#include "flow/transport.hpp"

/// The paper's algorithm: implicit SIMPLE of Patankar and Spalding (1972) with under-relaxation.
///
/// An outer iteration
///   1  u, v <- momentum with the present pressure, fluxes and viscosities    3  k, epsilon, nut <- their equations
///   2  p' <- div u,  u, v <- u - d grad p',  p <- p + relax p'               4  residuals of what 1-3 started from
/// is repeated until all residuals are small.  Equations are solved for corrections: upwind couplings inside the linear
/// systems, the scheme asked for in the imbalance they reduce (deferred correction).  What converges therefore obeys
/// the very balances of the projection algorithm, whatever the relaxation.
namespace livebed::flow {

/// Scaled imbalance of each equation at the start of an outer iteration, scaled as OpenFOAM's initial residuals.
struct Residuals {
  double u = 0, v = 0, p = 0, k = 0, epsilon = 0;
  double largest() const;
  /// "Ux 1.2e-03, Uy 3.4e-03, p 5.6e-02, k 7.8e-04, epsilon 9.1e-04"
  std::string text() const;
};

/// Systems and old values of the implicit algorithm; allocated once.
class Simple {
public:
  Simple() = default;
  explicit Simple(const Mesh& mesh);

  /// Keeps the present state as the old time level.
  void begin_step(State& s);

  /// u, v <- one relaxed solve of Eq. 2-3; response <- that of each face to a pressure gradient [s].  inverse_dt: 1/dt
  /// [1/s], 0 for a steady balance.
  void solve_momentum(const Mesh& mesh, const Boundary& boundary, const Params& params, const Staggering& at_u,
                      const Staggering& at_v, double inverse_dt, State& s, Workspace& w, Residuals& residuals);

  /// k, epsilon, nut <- one relaxed solve each.
  void solve_turbulence(const Mesh& mesh, const Boundary& boundary, const Params& params, const Staggering& at,
                        double inverse_dt, Turbulence& turbulence, State& s, Workspace& w, Residuals& residuals);

  /// Scaled continuity imbalance: residual of the equation for p.  c_x, c_y, c_boundary of w hold its coefficients,
  /// outflow its imbalance over -density.
  double pressure_residual(const Mesh& mesh, double density, const base::Field& p, const Workspace& w);

private:
  template <class Scheme>
  double solve_component(const Mesh& mesh, const Boundary& boundary, const Params& params, double inverse_dt, State& s,
                         Workspace& w, const Component& c);
  template <class Scheme>
  double solve_scalar(const Mesh& mesh, const Params& params, const Staggering& at, double inverse_dt, bool of_k,
                      const Turbulence& turbulence, const State& s, base::Field& next, Workspace& w);
  /// Couplings of row j: exchange plus what flows in; centre: their sum.
  void couple(const Staggering& at, const Workspace& w, const CarrierRows& carrier, int j, const double* kx,
              const double* ky, const double* ky_above);

  LineSystem system_;
  base::Field carrier_u_, carrier_v_;  ///< velocity at the start of an outer iteration
  base::Field old_k_, old_e_;
  bool turbulence_kept_ = false;
  std::vector<double> scratch_;
};

}  // namespace livebed::flow
