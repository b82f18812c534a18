#include <cmath>

#include "base/fault.hpp"
#include "flow/advance.hpp"

namespace livebed::flow {

namespace {

/// Residual that the solve for p' leaves: what is left goes into the next outer iteration.
constexpr double correction_tolerance = 1e-2;

}  // namespace

StepReport Solver::outer_iteration(double inverse_dt) {
  StepReport report;
  simple_.solve_momentum(mesh_, boundary_, params_, at_u_, at_v_, inverse_dt, state, work_, report.residuals);
  set_pressure_coefficients();
  sum_outflow(1.0, &work_.outflow);
  report.residuals.p = simple_.pressure_residual(mesh_, params_.density, state.p, work_);
  state.p_change.fill(0.0);
  report.pressure = project(1.0, std::max(params_.pressure_tolerance, correction_tolerance), params_.relax_pressure,
                            report.mass_residual);
  if (params_.closure != Closure::laminar)
    simple_.solve_turbulence(mesh_, boundary_, params_, at_c_, inverse_dt, turbulence_, state, work_, report.residuals);
  const Residuals& r = report.residuals;
  if (!std::isfinite(r.u + r.v + r.p + r.k + r.epsilon))
    base::fail(base::Exit::diverged,
               "simple: residuals {}; smaller flow.relax_velocity and flow.relax_pressure may hold it", r.text());
  return report;
}

StepReport Solver::advance_simple(double dt) {
  simple_.begin_step(state);
  StepReport report;
  int n = 0;
  double outflow_at_start = 0;  // of the first outer iteration, before its correction
  do {
    report = outer_iteration(params_.steady ? 0.0 : 1.0 / dt);
    if (n++ == 0) outflow_at_start = report.pressure.before;
  } while (n < params_.outer_iterations && report.residuals.largest() > params_.tolerance);
  report.outer_iterations = n;
  if (outflow_at_start > 0) report.mass_residual *= report.pressure.before / outflow_at_start;
  return report;
}

std::vector<Residuals> Solver::solve_steady(int most) {
  if (params_.algorithm != Algorithm::simple)
    base::fail(base::Exit::invalid_case, "a steady flow needs flow.algorithm = \"simple\"");
  std::vector<Residuals> history;
  simple_.begin_step(state);
  do history.push_back(outer_iteration(0.0).residuals);
  while (static_cast<int>(history.size()) < most && history.back().largest() > params_.tolerance);
  return history;
}

}  // namespace livebed::flow
