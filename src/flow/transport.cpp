#include "flow/transport.hpp"

#include <algorithm>

#include "base/loops.hpp"
#include "flow/constants.hpp"

namespace livebed::flow {

using base::Field;
using base::for_each_item;
using base::vector_loop;

void advance_scalar(const Mesh& m, const Boundary& b, const Params& params, const Staggering& at, double dt,
                    const ScalarEquation& q, Workspace& w) {
  fill_scalar_ghosts(m, b.inlet ? &q.inlet : nullptr, q.value);
  w.scratch.fill(0.0);
  convect(m, at, params.convection, w.face, q.value, w.scratch, w.gamma, dt, w.rows, q.next);
  for_each_item(0, m.ny, [&](int j) {
    const double *gain = q.gain.row(j), *decay = q.decay.row(j), *M = at.inertia.row(j), *old = q.value.row(j);
    double *rhs = q.next.row(j), *base = w.base.row(j);
    vector_loop(0, m.nx, [&](int i) {
      const double change = dt * (rhs[i] / M[i] + gain[i]);
      const bool empties = change < -0.5 * old[i];
      base[i] = 1.0 + dt * decay[i] + (empties ? -change / old[i] : 0.0);
      rhs[i] = old[i] + (empties ? 0.0 : change);
    });
  });
  // Fixed cells: their own rows say c = value; neighbours still feel them.
  for (const FixedCell& cell : q.fixed) {
    w.base(cell.i, cell.j) = fixed_row;
    q.next(cell.i, cell.j) = fixed_row * cell.value;
  }
  solve_lines_x(at, w.base, q.conductance.x, dt, q.next, w.scratch);
  for_each_item(0, m.ny, [&](int j) {
    double* r = q.next.row(j);
    const double* base = w.base.row(j);
    vector_loop(0, m.nx, [&](int i) { r[i] *= base[i]; });
  });
  solve_lines_y(at, w.base, q.conductance.y, dt, q.next, w.scratch);
  for_each_item(0, m.ny, [&](int j) {
    double* c = q.next.row(j);
    vector_loop(0, m.nx, [&](int i) { c[i] = std::max(c[i], q.floor); });
  });
}

void advance_turbulence(const Mesh& m, const Boundary& b, const Params& params, const Staggering& at, double dt,
                        Turbulence& turbulence, State& s, Workspace& w) {
  turbulence.prepare(m, b, params, s);
  advance_scalar(m, b, params, at, dt, turbulence.k_equation(m, params, at, s, w), w);
  advance_scalar(m, b, params, at, dt, turbulence.second_equation(m, params, at, s, w), w);
  turbulence.complete(m, params, s);
}

}  // namespace livebed::flow
