#include "flow/turbulence.hpp"

#include <algorithm>
#include <cmath>

#include "base/loops.hpp"
#include "flow/constants.hpp"

namespace livebed::flow {

using base::Field;
using base::for_each_item;
using base::vector_loop;

namespace {

bool has_wall_function(Wall wall) { return wall == Wall::rough || wall == Wall::smooth; }

/// Is cell (i,j) not solved but set: solid, or at a wall with wall function?
bool is_set(const Mesh& m, const Boundary& b, int i, int j) {
  if (m.volume(i, j) <= 0) return true;
  return (j == 0 && has_wall_function(b.floor)) || (m.wall_length(i, j) > 0 && has_wall_function(m.pipe.wall));
}

/// k and epsilon of a set cell.
struct WallValues {
  double k, epsilon;
};
WallValues set_values(const Mesh& m, const Params& params, const State& s, const Workspace& w, int i, int j) {
  if (m.volume(i, j) <= 0) return {k_floor, epsilon_floor};
  const double u = 0.5 * (s.u(i, j) + s.u(i + 1, j)), v = 0.5 * (s.v(i, j) + s.v(i, j + 1));
  const bool at_pipe = m.wall_length(i, j) > 0;
  const double friction = at_pipe ? w.wall_c(i, j) / m.wall_length(i, j) : w.floor_c[i];
  const double y = at_pipe ? m.wall_distance(i, j) : 0.5 * m.dy(0);
  const double u_star = std::sqrt(friction * (at_pipe ? std::hypot(u, v) : std::abs(u)));
  return {wall_k(u_star), wall_epsilon(u_star, y, params.viscosity)};
}

/// What tells the equations of k and epsilon apart (Eq. 4 and 5).
struct Equation {
  double sigma;        ///< turbulent Prandtl number
  double gain, decay;  ///< factors of production and decay
  bool is_k;           ///< epsilon's production is multiplied by epsilon/k
  const std::vector<double>& inlet;
};

/// One equation: c (1 + dt decay) = c + dt (convection + diffusion + gain).
void transport(const Mesh& m, const Boundary& b, const Params& params, const Staggering& at, double dt,
               const Equation& q, State& s, Workspace& w, Field& c) {
  Conductance& g = w.conductance;
  const double nu = params.viscosity;
  for_each_item(0, m.ny + 1, [&](int j) {
    const double *here = s.nut.row(j), *below = s.nut.row(j - 1), *ax = at.area_x.row(j), *ay = at.area_y.row(j);
    const double* hx = at.hx.data() + 2;
    double *gx = g.x.row(j), *gy = g.y.row(j);
    const double inverse_hy = j > 0 && j < m.ny ? 1.0 / at.hy[j + 2] : 0.0;
    vector_loop(0, m.nx + 1, [&](int i) {
      gx[i] = (nu + 0.5 * (here[i - 1] + here[i]) / q.sigma) * ax[i] / hx[i];
      gy[i] = (nu + 0.5 * (here[i] + below[i]) / q.sigma) * ay[i] * inverse_hy;
    });
    gx[0] = gx[m.nx] = 0;
  });
  fill_scalar_ghosts(m, b.inlet ? &q.inlet : nullptr, c);
  w.scratch.fill(0.0);
  convect(m, at, params.convection, w.face, c, w.scratch, w.gamma, dt, w.rows, w.change);
  for_each_item(0, m.ny, [&](int j) {
    const double *produced = w.production.row(j), *turnover = w.turnover.row(j), *M = at.inertia.row(j),
                 *old = c.row(j);
    double *rhs = w.change.row(j), *base = w.base.row(j);
    vector_loop(0, m.nx, [&](int i) {
      const double carried = dt * rhs[i] / M[i];
      const bool empties = carried < -0.5 * old[i];
      base[i] = 1.0 + dt * q.decay * turnover[i] + (empties ? -carried / old[i] : 0.0);
      rhs[i] = old[i] + (empties ? 0.0 : carried) + dt * q.gain * produced[i] * (q.is_k ? 1.0 : turnover[i]);
    });
  });
  // Set cells: their own rows say c = value; neighbours still feel them.
  const int nx = m.nx;
  for_each_item(0, m.ny, [&](int j) {
    if (j > 0 && !m.has_pipe()) return;
    for (int i = 0; i < nx; ++i) {
      if (!is_set(m, b, i, j)) continue;
      const WallValues value = set_values(m, params, s, w, i, j);
      w.base(i, j) = fixed_row;
      w.change(i, j) = fixed_row * (q.is_k ? value.k : value.epsilon);
    }
  });
  solve_lines_x(at, w.base, g.x, dt, w.change, w.scratch);
  for_each_item(0, m.ny, [&](int j) {
    double* r = w.change.row(j);
    const double* base = w.base.row(j);
    vector_loop(0, m.nx, [&](int i) { r[i] *= base[i]; });
  });
  solve_lines_y(at, w.base, g.y, dt, w.change, w.scratch);
  const double floor = q.is_k ? k_floor : epsilon_floor;
  for_each_item(0, m.ny, [&](int j) {
    const double* r = w.change.row(j);
    double* to = c.row(j);
    vector_loop(0, m.nx, [&](int i) { to[i] = std::max(r[i], floor); });
  });
}

}  // namespace

void update_eddy_viscosity(const Mesh& m, const Params& params, State& s) {
  const double most = nut_over_nu_most * params.viscosity;
  for_each_item(0, m.ny, [&](int j) {
    const double *k = s.k.row(j), *e = s.epsilon.row(j), *volume = m.volume.row(j);
    double* nut = s.nut.row(j);
    vector_loop(0, m.nx, [&](int i) { nut[i] = volume[i] > 0 ? std::min(eddy_viscosity(k[i], e[i]), most) : 0.0; });
  });
  fill_scalar_ghosts(m, nullptr, s.nut);
}

void advance_turbulence(const Mesh& m, const Boundary& b, const Params& params, const Staggering& at, double dt,
                        State& s, Workspace& w) {
  for_each_item(0, m.ny, [&](int j) {
    const double *u = s.u.row(j), *ub = s.u.row(j - 1), *ua = s.u.row(j + 1), *v = s.v.row(j), *va = s.v.row(j + 1);
    const double *k = s.k.row(j), *e = s.epsilon.row(j), *nut = s.nut.row(j), *dx = m.dx_.data() + 2,
                 *hx = m.dx_face_.data() + 2;
    const double dy = m.dy(j), h_below = m.dy_face(j), h_above = m.dy_face(j + 1);
    double *produced = w.production.row(j), *turnover = w.turnover.row(j);
    vector_loop(0, m.nx, [&](int i) {
      const double dudx = (u[i + 1] - u[i]) / dx[i], dvdy = (va[i] - v[i]) / dy;
      const double uc = u[i] + u[i + 1], vc = v[i] + va[i];
      const double dudy = 0.25 * ((ua[i] + ua[i + 1] - uc) / h_above + (uc - ub[i] - ub[i + 1]) / h_below);
      const double dvdx = 0.25 * ((v[i + 1] + va[i + 1] - vc) / hx[i + 1] + (vc - v[i - 1] - va[i - 1]) / hx[i]);
      produced[i] = production(nut[i], dudx, dvdy, dudy + dvdx);
      turnover[i] = e[i] / k[i];
    });
  });
  transport(m, b, params, at, dt, {launder_spalding.sigma_k, 1.0, 1.0, true, b.inlet_k}, s, w, s.k);
  transport(m, b, params, at, dt,
            {launder_spalding.sigma_epsilon, launder_spalding.c1, launder_spalding.c2, false, b.inlet_epsilon}, s, w,
            s.epsilon);
  update_eddy_viscosity(m, params, s);
}

}  // namespace livebed::flow
