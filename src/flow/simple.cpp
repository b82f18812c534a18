#include "flow/simple.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "base/loops.hpp"
#include "flow/constants.hpp"

namespace livebed::flow {

using base::Field;
using base::for_each_item;
using base::vector_loop;

namespace {

/// Rounds of line Gauss-Seidel for each equation in an outer iteration: more would polish coefficients that change
/// anyway.
constexpr int sweeps = 1;

void copy(const Field& from, Field& to) {
  std::copy(from.storage().begin(), from.storage().end(), to.storage().begin());
}

}  // namespace

double Residuals::largest() const { return std::max({u, v, p, k, epsilon}); }

std::string Residuals::text() const {
  return fmt::format("Ux {:.2e}, Uy {:.2e}, p {:.2e}, k {:.2e}, epsilon {:.2e}", u, v, p, k, epsilon);
}

Simple::Simple(const Mesh& m) : system_(m), old_k_(m.nx, m.ny), old_e_(m.nx, m.ny) {}

void Simple::begin_step(State& s) {
  copy(s.u, s.u_old);
  copy(s.v, s.v_old);
  copy(s.k, old_k_);
  turbulence_kept_ = false;  // the second quantity is known when its equation is
}

void Simple::couple(const Staggering& at, const FaceFlow& flow, const Conductance& g) {
  const int sx = at.shift_x, sy = at.shift_y;
  for_each_item(at.j0, at.j1, [&](int j) {
    const double *xa = flow.qx.row(j - sy) - sx, *xb = flow.qx.row(j);
    const double *ya = flow.qy.row(j - sy) - sx, *yb = flow.qy.row(j), *yc = flow.qy.row(j - sy + 1) - sx,
                 *yd = flow.qy.row(j + 1);
    const double *gx = g.x.row(j), *gy = g.y.row(j), *gy_above = g.y.row(j + 1);
    double *west = system_.west.row(j), *east = system_.east.row(j), *south = system_.south.row(j),
           *north = system_.north.row(j), *centre = system_.centre.row(j);
    vector_loop(at.i0, at.i1, [&](int i) {
      west[i] = gx[i] + std::max(0.5 * (xa[i] + xb[i]), 0.0);
      east[i] = gx[i + 1] + std::max(-0.5 * (xa[i + 1] + xb[i + 1]), 0.0);
      south[i] = gy[i] + std::max(0.5 * (ya[i] + yb[i]), 0.0);
      north[i] = gy_above[i] + std::max(-0.5 * (yc[i] + yd[i]), 0.0);
      centre[i] = west[i] + east[i] + south[i] + north[i];
    });
  });
}

double Simple::solve_component(const Mesh& m, const Boundary& b, const Params& params, double inverse_dt, State& s,
                               Workspace& w, const MomentumEquation& c, const Field& old) {
  const Staggering& at = c.at;
  assemble_momentum(m, b, params, 1.0, 0.0, s, w, c);
  couple(at, w.face, w.conductance);
  const Field& aperture = c.is_u ? m.aperture_x : m.aperture_y;
  for_each_item(at.j0, at.j1, [&](int j) {
    const double *M = at.inertia.row(j), *factor = c.factor.row(j), *acceleration = w.change.row(j),
                 *u = c.value.row(j), *u_old = old.row(j), *open = aperture.row(j);
    double *west = system_.west.row(j), *east = system_.east.row(j), *south = system_.south.row(j),
           *north = system_.north.row(j), *centre = system_.centre.row(j), *rhs = system_.rhs.row(j);
    vector_loop(at.i0, at.i1, [&](int i) {
      const bool moves = open[i] > 0;
      centre[i] = moves ? centre[i] + M[i] * (factor[i] - 1.0 + inverse_dt) : 1.0;
      rhs[i] = moves ? M[i] * (acceleration[i] - inverse_dt * (u[i] - u_old[i])) : 0.0;
      west[i] = moves ? west[i] : 0.0, east[i] = moves ? east[i] : 0.0;
      south[i] = moves ? south[i] : 0.0, north[i] = moves ? north[i] : 0.0;
    });
  });
  const double residual = scaled_residual(at, system_, c.value, scratch_);
  const double per_relax = 1.0 / params.relax_velocity;
  for_each_item(at.j0, at.j1, [&](int j) {
    const double* V = at.pressed.row(j);
    double *centre = system_.centre.row(j), *response = c.response.row(j);
    vector_loop(at.i0, at.i1, [&](int i) {
      centre[i] *= per_relax;
      response[i] = V[i] / centre[i];
    });
  });
  sweep_lines(at, sweeps, system_);
  return residual;
}

void Simple::solve_momentum(const Mesh& m, const Boundary& b, const Params& params, const Staggering& at_u,
                            const Staggering& at_v, double inverse_dt, State& s, Workspace& w, Residuals& residuals) {
  center_face_flow(m, s, 0.0, w.face);
  evaluate_walls(m, b, params, s, w);
  prepare_momentum(m, b, params, s, w);
  const auto correct = [&](const Staggering& at, Field& value) {
    for_each_item(at.j0, at.j1, [&](int j) {
      const double* change = system_.correction.row(j);
      double* to = value.row(j);
      vector_loop(at.i0, at.i1, [&](int i) { to[i] += change[i]; });
    });
  };
  residuals.u = solve_component(m, b, params, inverse_dt, s, w, u_equation(at_u, s, w), s.u_old);
  correct(at_u, s.u);
  residuals.v = solve_component(m, b, params, inverse_dt, s, w, v_equation(at_v, s, w), s.v_old);
  correct(at_v, s.v);
  if (!b.outlet) return;
  // Open outlet: u is carried out at its own speed, against the drag of the grains and the pressure drop to p = 0.
  const int n = m.nx;
  const double rho = params.density, half = 0.5 * m.dx(n - 1);
  for (int j = 0; j < m.ny; ++j) {
    const double carried = std::max(w.face.u(n, j), 0.0) / m.dx(n - 1), drag = s.load.beta_u(n, j) / rho;
    const double force = carried * (s.u(n - 1, j) - s.u(n, j)) + s.p(n - 1, j) / (rho * half) +
                         s.load.force_u(n, j) / rho - drag * s.u(n, j) - inverse_dt * (s.u(n, j) - s.u_old(n, j));
    const double centre = (carried + drag + inverse_dt) / params.relax_velocity;
    const double least = params.viscosity / (half * half);  // an outlet at rest keeps a finite response
    w.response_u(n, j) = 1.0 / std::max(centre, least);
    s.u(n, j) += force * w.response_u(n, j);
  }
}

double Simple::pressure_residual(const Mesh& m, double density, const Field& p, const Workspace& w) {
  const double cells = static_cast<double>(m.nx) * m.ny;
  const double mean = base::ordered_sum(0, m.ny, scratch_,
                                        [&](int j) {
                                          const double* row = p.row(j);
                                          return base::vector_sum(0, m.nx, [&](int i) { return row[i]; });
                                        }) /
                      cells;
  double residual = 0, scale = 0;
  for (const bool of_scale : {false, true})
    (of_scale ? scale : residual) = base::ordered_sum(0, m.ny, scratch_, [&](int j) {
      const double *here = p.row(j), *below = p.row(j - 1), *above = p.row(j + 1), *out = w.outflow.row(j);
      const double *x = w.c_x.row(j), *south = w.c_y.row(j), *north = w.c_y.row(j + 1), *open = w.c_boundary.row(j);
      const double has_below = j > 0 ? 1.0 : 0.0;
      return base::vector_sum(0, m.nx, [&](int i) {
        const double west = i > 0 ? x[i] : 0.0, east = i + 1 < m.nx ? x[i + 1] : 0.0;
        const double applied = west * (here[i] - here[i - 1]) + east * (here[i] - here[i + 1]) +
                               has_below * south[i] * (here[i] - below[i]) + north[i] * (here[i] - above[i]) +
                               open[i] * (here[i] - mean);
        const double b = density * out[i];
        return of_scale ? std::abs(applied) + std::abs(applied - b) : std::abs(b);
      });
    });
  return scale > 0 ? residual / scale : 0.0;
}

double Simple::solve_scalar(const Mesh& m, const Boundary& b, const Params& params, const Staggering& at,
                            double inverse_dt, const ScalarEquation& q, const Field& old, Workspace& w) {
  fill_scalar_ghosts(m, b.inlet ? &q.inlet : nullptr, q.value);
  convect(m, at, params.convection, w.face, q.value, w.scratch, w.gamma, 0.0, w.rows, w.change);
  couple(at, w.face, q.conductance);
  for_each_item(0, m.ny, [&](int j) {
    const double *M = at.inertia.row(j), *gain = q.gain.row(j), *decay = q.decay.row(j), *carried = w.change.row(j);
    const double *c = q.value.row(j), *below = q.value.row(j - 1), *above = q.value.row(j + 1), *c_old = old.row(j);
    const double *gx = q.conductance.x.row(j), *gy = q.conductance.y.row(j), *gy_above = q.conductance.y.row(j + 1);
    const double *west = system_.west.row(j), *east = system_.east.row(j), *south = system_.south.row(j),
                 *north = system_.north.row(j);
    double *centre = system_.centre.row(j), *rhs = system_.rhs.row(j);
    vector_loop(0, m.nx, [&](int i) {
      const double diffusion = gx[i + 1] * (c[i + 1] - c[i]) - gx[i] * (c[i] - c[i - 1]) +
                               gy_above[i] * (above[i] - c[i]) - gy[i] * (c[i] - below[i]);
      rhs[i] = carried[i] + diffusion + M[i] * (gain[i] - decay[i] * c[i] - inverse_dt * (c[i] - c_old[i]));
      // What the right-hand side would hold for the new value itself; taken implicitly where it is negative, so that
      // the value stays positive (Patankar 1980).
      const double inflow = (west[i] - gx[i]) * (c[i] - c[i - 1]) + (east[i] - gx[i + 1]) * (c[i] - c[i + 1]) +
                            (south[i] - gy[i]) * (c[i] - below[i]) + (north[i] - gy_above[i]) * (c[i] - above[i]);
      const double given = carried[i] + inflow + M[i] * gain[i];
      centre[i] += M[i] * (decay[i] + inverse_dt) + (given < 0 ? -given / c[i] : 0.0);
    });
  });
  for (const FixedCell& cell : q.fixed) system_.fix(cell.i, cell.j, cell.value - q.value(cell.i, cell.j));
  const double residual = scaled_residual(at, system_, q.value, scratch_);
  const double per_relax = 1.0 / params.relax_turbulence;
  for_each_item(0, m.ny, [&](int j) {
    double* centre = system_.centre.row(j);
    vector_loop(0, m.nx, [&](int i) { centre[i] *= per_relax; });
  });
  sweep_lines(at, sweeps, system_);
  for_each_item(0, m.ny, [&](int j) {
    const double *c = q.value.row(j), *change = system_.correction.row(j);
    double* next = q.next.row(j);
    vector_loop(0, m.nx, [&](int i) { next[i] = std::max(c[i] + change[i], q.floor); });
  });
  return residual;
}

void Simple::solve_turbulence(const Mesh& m, const Boundary& b, const Params& params, const Staggering& at,
                              double inverse_dt, Turbulence& turbulence, State& s, Workspace& w, Residuals& residuals) {
  center_face_flow(m, s, 0.0, w.face);  // carried by the corrected flow
  turbulence.prepare(m, b, params, s);
  residuals.k = solve_scalar(m, b, params, at, inverse_dt, turbulence.k_equation(m, params, at, s, w), old_k_, w);
  const ScalarEquation second = turbulence.second_equation(m, params, at, s, w);
  if (!turbulence_kept_) copy(second.value, old_e_);
  turbulence_kept_ = true;
  residuals.epsilon = solve_scalar(m, b, params, at, inverse_dt, second, old_e_, w);
  turbulence.complete(m, params, s);
}

}  // namespace livebed::flow
