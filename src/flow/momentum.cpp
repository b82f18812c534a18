#include "flow/momentum.hpp"

#include <cmath>

#include "base/loops.hpp"

namespace livebed::flow {

using base::Field;
using base::for_each_item;
using base::vector_loop;

Workspace::Workspace(const Mesh& m)
    : handed_u(hand_on(m, true)),
      handed_v(hand_on(m, false)),
      wall_u(share_wall(m, true)),
      wall_v(share_wall(m, false)),
      rows(m) {
  const Field f(m.nx, m.ny);
  face = {f, f, f, f};
  gamma = wall_c = base_u = base_v = friction_u = friction_v = change = scratch = base = f;
  phi = outflow = c_x = c_y = c_boundary = f;
  response_u = response_v = Field(m.nx, m.ny, 2, 1.0);
  conductance = {f, f};
  floor_c.assign(m.nx, 0.0);
  top_c.assign(m.nx, 0.0);
}

void center_face_flow(const Mesh& m, const State& s, double dt, FaceFlow& face) {
  const double ahead = s.step > 0 ? 0.5 * dt / s.step : 0.0;
  for_each_item(-2, m.ny + 2, [&](int j) {
    const double *u = s.u.row(j), *v = s.v.row(j), *uo = s.u_old.row(j), *vo = s.v_old.row(j);
    const double *ax = m.aperture_x.row(j), *ay = m.aperture_y.row(j), *dx = m.dx_.data() + 2;
    const double dy = m.dy(j);
    double *fu = face.u.row(j), *fv = face.v.row(j), *qx = face.qx.row(j), *qy = face.qy.row(j);
    vector_loop(-2, m.nx + 2, [&](int i) {
      fu[i] = u[i] + ahead * (u[i] - uo[i]);
      fv[i] = v[i] + ahead * (v[i] - vo[i]);
      qx[i] = fu[i] * ax[i] * dy;
      qy[i] = fv[i] * ay[i] * dx[i];
    });
  });
}

void evaluate_walls(const Mesh& m, const Boundary& b, const Params& params, const State& s, Workspace& w) {
  const auto along = [&](int i, int j) { return std::abs(0.5 * (s.u(i, j) + s.u(i + 1, j))); };
  for (int i = 0; i < m.nx; ++i) {
    w.floor_c[i] =
        wall_friction(params.closure, b.floor, along(i, 0), 0.5 * m.dy(0), b.floor_roughness, params.viscosity);
    w.top_c[i] = wall_friction(params.closure, b.top, along(i, m.ny - 1), 0.5 * m.dy(m.ny - 1), b.floor_roughness,
                               params.viscosity);
  }
  if (!m.has_pipe()) return;
  for_each_item(0, m.ny, [&](int j) {
    for (int i = 0; i < m.nx; ++i) {
      if (m.wall_length(i, j) == 0) continue;
      const double speed = std::hypot(0.5 * (s.u(i, j) + s.u(i + 1, j)), 0.5 * (s.v(i, j) + s.v(i, j + 1)));
      w.wall_c(i, j) = m.wall_length(i, j) * wall_friction(params.closure, m.pipe.wall, speed, m.wall_distance(i, j),
                                                           m.pipe.roughness, params.viscosity);
    }
  });
}

namespace {

/// Conductances of a component: gamma of the cell on faces across its own direction, twice; mean of four cells on the
/// others.
void conduct(const Mesh& m, const MomentumEquation& c, const Field& gamma, Conductance& g) {
  const Staggering& at = c.at;
  for_each_item(0, m.ny + 1, [&](int j) {
    const double *here = gamma.row(j), *below = gamma.row(j - 1);
    const double *ax = at.area_x.row(j), *ay = at.area_y.row(j), *hx = at.hx.data() + 2;
    double *gx = g.x.row(j), *gy = g.y.row(j);
    const double hy = at.hy[j + 2];
    const bool inside = j > 0 && j < m.ny;
    if (c.is_u) {
      const double across = inside ? 0.25 / hy : 0.0;
      vector_loop(0, m.nx + 1, [&](int i) {
        gx[i] = 2.0 * here[i - 1] * ax[i] / hx[i];
        gy[i] = across * (here[i - 1] + here[i] + below[i - 1] + below[i]) * ay[i];
      });
    } else {
      vector_loop(0, m.nx + 1, [&](int i) {
        gx[i] = 0.25 * (here[i - 1] + here[i] + below[i - 1] + below[i]) * ax[i] / hx[i];
        gy[i] = 2.0 * below[i] * ay[i] / hy;
      });
      gx[0] = gx[m.nx] = 0;
    }
  });
}

}  // namespace

void assemble_momentum(const Mesh& m, const Boundary& b, const Params& params, double dt, double lead, const State& s,
                       Workspace& w, const MomentumEquation& c) {
  const Staggering& at = c.at;
  Conductance& g = w.conductance;
  const double rho = params.density;
  convect(m, at, params.convection, w.face, c.value, c.rate, w.gamma, lead, w.rows, w.change);
  for (const HandedOn& h : c.is_u ? w.handed_u : w.handed_v)
    w.change(h.to_i, h.to_j) += h.share * w.change(h.from_i, h.from_j);
  conduct(m, c, w.gamma, g);
  const Field& crossing = c.is_u ? w.face.v : w.face.u;  // the other component, centred in time
  const double* hx_u = at.hx.data() + 2;
  const double* hx_p = m.dx_face_.data() + 2;

  for_each_item(at.j0, at.j1, [&](int j) {
    const double *V = at.volume.row(j), *P = at.pressed.row(j), *M = at.inertia.row(j), *beta = c.beta.row(j),
                 *force = c.force.row(j);
    const double *fr = c.friction.row(j), *u = c.value.row(j), *below = c.value.row(j - 1), *above = c.value.row(j + 1);
    const double *gx = g.x.row(j), *gy = g.y.row(j), *gy_above = g.y.row(j + 1), *p = s.p.row(j),
                 *p_below = s.p.row(j - 1);
    double *rhs = w.change.row(j), *rate = c.rate.row(j), *factor = c.factor.row(j), *response = c.response.row(j);
    double* outer = w.scratch.row(j);  // forces from the other component and from the pressure
    // The other component's stress, d/dy (Gamma dv/dx) and d/dx (Gamma du/dy), fades with the openings of the two faces
    // it is a difference of: beside a sliver that difference is no gradient, and as an explicit force it would drive
    // the flow through the sliver instead of slowing it.
    const Field& opening = c.is_u ? m.aperture_y : m.aperture_x;
    const double *open = opening.row(j), *open_above = opening.row(j + 1), *open_below = opening.row(j - 1);
    if (c.is_u) {
      const double *v = crossing.row(j), *v_above = crossing.row(j + 1), h = at.hy[j + 2], h_above = at.hy[j + 3];
      vector_loop(at.i0, at.i1, [&](int i) {
        const double stress =
            open_above[i - 1] * open_above[i] * gy_above[i] * h_above * (v_above[i] - v_above[i - 1]) -
            open[i - 1] * open[i] * gy[i] * h * (v[i] - v[i - 1]);
        outer[i] = (stress - P[i] / rho * (p[i] - p[i - 1])) / hx_p[i];
      });
    } else {
      const double *v = crossing.row(j), *v_below = crossing.row(j - 1), scale = 1.0 / m.dy_face(j);
      vector_loop(at.i0, at.i1, [&](int i) {
        const double stress = open[i + 1] * open_below[i + 1] * gx[i + 1] * hx_u[i + 1] * (v[i + 1] - v_below[i + 1]) -
                              open[i] * open_below[i] * gx[i] * hx_u[i] * (v[i] - v_below[i]);
        outer[i] = (stress - P[i] / rho * (p[i] - p_below[i])) * scale;
      });
    }
    const double lid = c.is_u && j == m.ny - 1 ? b.top_speed : 0.0;
    vector_loop(at.i0, at.i1, [&](int i) {
      const double diffusion = gx[i + 1] * (u[i + 1] - u[i]) - gx[i] * (u[i] - u[i - 1]) +
                               gy_above[i] * (above[i] - u[i]) - gy[i] * (u[i] - below[i]);
      const double friction = fr[i] * (u[i] - lid);
      const double forces = diffusion + outer[i] - friction + V[i] / rho * (force[i] - beta[i] * u[i]);
      const double per_inertia = 1.0 / M[i];
      const double convection = rhs[i] * per_inertia;
      const double drag = dt / rho * beta[i] * V[i] * per_inertia;
      rhs[i] = dt * (convection + forces * per_inertia);
      rate[i] = -convection;
      factor[i] = 1.0 + drag + dt * fr[i] * per_inertia;
      // Not times P/M: the correction is that of a potential flow, whose order cut faces must not spoil.  A sliver's
      // predictor takes only P/M of the gradient; the pressure makes up for it within some steps.
      response[i] = 1.0 / (1.0 + drag);
    });
  });
}

namespace {

/// Share of the diffusive flux taken at the new time: one half (second order) while a step moves less than the cell's
/// own width, more beyond, so that no step oscillates.
double implicit_share(double number) { return number <= 1.0 ? 0.5 : 1.0 - 0.5 / number; }

void predict(const Mesh& m, const Boundary& b, const Params& params, double dt, State& s, Workspace& w,
             const MomentumEquation& c) {
  assemble_momentum(m, b, params, dt, dt, s, w, c);
  const Staggering& at = c.at;
  Conductance& g = w.conductance;
  // Only the implicit share of each flux stays in the line systems.
  for_each_item(0, m.ny + 1, [&](int j) {
    double *gx = g.x.row(j), *gy = g.y.row(j);
    const double *hx = at.hx.data() + 2, *ax = at.area_x.row(j), *ay = at.area_y.row(j);
    const double hy = at.hy[j + 2];
    vector_loop(0, m.nx + 1, [&](int i) {
      gx[i] *= ax[i] > 0 ? implicit_share(dt * gx[i] / (hx[i] * ax[i])) : 0.0;
      gy[i] *= ay[i] > 0 ? implicit_share(dt * gy[i] / (hy * ay[i])) : 0.0;
    });
  });
  solve_lines_x(at, c.factor, g.x, dt, w.change, w.scratch);
  for_each_item(at.j0, at.j1, [&](int j) {
    double* d = w.change.row(j);
    const double* factor = c.factor.row(j);
    vector_loop(at.i0, at.i1, [&](int i) { d[i] *= factor[i]; });
  });
  solve_lines_y(at, c.factor, g.y, dt, w.change, w.scratch);
  const Field& aperture = c.is_u ? m.aperture_x : m.aperture_y;
  for_each_item(at.j0, at.j1, [&](int j) {
    double* u = c.value.row(j);
    const double *d = w.change.row(j), *a = aperture.row(j);
    vector_loop(at.i0, at.i1, [&](int i) { u[i] = a[i] > 0 ? u[i] + d[i] : 0.0; });
  });
}

/// Wall friction of floor, lid, closed sides and pipe gathered on the volumes of u and v.
void gather_friction(const Mesh& m, const Boundary& b, const Params& params, const State& s, Workspace& w) {
  w.friction_u.fill(0.0);
  w.friction_v.fill(0.0);
  const auto at_pipe = [&](std::vector<WallPart>& wall, bool is_u, Field& friction) {
    for (WallPart& part : wall) {
      // Speed where the component lives: itself and the mean of the other one's four values around.
      const int i = part.i, j = part.j, i_b = is_u ? i - 1 : i + 1, j_b = is_u ? j + 1 : j - 1;
      const Field &own = is_u ? s.u : s.v, &other = is_u ? s.v : s.u;
      const double across = 0.25 * (other(i, j) + other(i_b, j) + other(i, j_b) + other(i_b, j_b));
      part.friction = part.length * wall_friction(params.closure, m.pipe.wall, std::hypot(own(i, j), across),
                                                  part.distance, m.pipe.roughness, params.viscosity);
      friction(i, j) = part.friction;
    }
  };
  at_pipe(w.wall_u, true, w.friction_u);
  at_pipe(w.wall_v, false, w.friction_v);
  for (int i = 1; i < m.nx; ++i) {
    w.friction_u(i, 0) += 0.5 * (w.floor_c[i - 1] * m.dx(i - 1) + w.floor_c[i] * m.dx(i));
    w.friction_u(i, m.ny - 1) += 0.5 * (w.top_c[i - 1] * m.dx(i - 1) + w.top_c[i] * m.dx(i));
  }
  const auto side = [&](Wall wall, int i) { return wall_friction(wall, 0, 0.5 * m.dx(i), 0, params.viscosity); };
  const double west = side(b.west, 0), east = b.outlet ? 0.0 : side(b.east, m.nx - 1);
  for (int j = 1; j < m.ny; ++j) {
    // Water comes in straight: v is 0 on the inlet.
    const double at_inlet = (w.gamma(0, j - 1) + w.gamma(0, j)) / m.dx(0);
    w.friction_v(0, j) += (b.inlet ? at_inlet : west) * m.dy_face(j);
    w.friction_v(m.nx - 1, j) += east * m.dy_face(j);
  }
}

/// Open outlet: u is carried out at its own speed; the faces feel the drag of the grains and the pressure drop to p =
/// 0.
void predict_outlet(const Mesh& m, const Params& params, double dt, State& s, Workspace& w) {
  const int n = m.nx;
  const double half = 0.5 * m.dx(n - 1);
  for (int j = 0; j < m.ny; ++j) {
    const double u = s.u(n, j), rho = params.density;
    const double drag = dt * s.load.beta_u(n, j) / rho;
    const double gradient = -s.p(n - 1, j) / half;
    const double convection = std::max(w.face.u(n, j), 0.0) * (u - s.u_old(n - 1, j)) / m.dx(n - 1);
    w.response_u(n, j) = 1.0 / (1.0 + drag);
    s.u(n, j) = (u - dt * convection + dt / rho * (s.load.force_u(n, j) - gradient)) / (1.0 + drag);
  }
}

}  // namespace

void prepare_momentum(const Mesh& m, const Boundary& b, const Params& params, const State& s, Workspace& w) {
  for_each_item(-2, m.ny + 2, [&](int j) {
    const double* nut = s.nut.row(j);
    double* gamma = w.gamma.row(j);
    const double nu = params.viscosity;
    vector_loop(-2, m.nx + 2, [&](int i) { gamma[i] = nu + nut[i]; });
  });
  gather_friction(m, b, params, s, w);
}

MomentumEquation u_equation(const Staggering& at_u, State& s, Workspace& w) {
  return {at_u, true, s.u, s.rate_u, s.load.beta_u, s.load.force_u, w.friction_u, w.base_u, w.response_u};
}
MomentumEquation v_equation(const Staggering& at_v, State& s, Workspace& w) {
  return {at_v, false, s.v, s.rate_v, s.load.beta_v, s.load.force_v, w.friction_v, w.base_v, w.response_v};
}

void predict_velocity(const Mesh& m, const Boundary& b, const Params& params, const Staggering& at_u,
                      const Staggering& at_v, double dt, State& s, Workspace& w) {
  prepare_momentum(m, b, params, s, w);
  std::copy(s.u.storage().begin(), s.u.storage().end(), s.u_old.storage().begin());
  std::copy(s.v.storage().begin(), s.v.storage().end(), s.v_old.storage().begin());
  predict(m, b, params, dt, s, w, u_equation(at_u, s, w));
  predict(m, b, params, dt, s, w, v_equation(at_v, s, w));
  if (b.outlet) predict_outlet(m, params, dt, s, w);
}

void complete_rates(const Staggering& at_u, const Staggering& at_v, double dt, State& s) {
  const auto one = [&](const Staggering& at, const Field& value, const Field& old, Field& rate) {
    for_each_item(at.j0, at.j1, [&](int j) {
      const double *a = value.row(j), *o = old.row(j);
      double* r = rate.row(j);
      vector_loop(at.i0, at.i1, [&](int i) { r[i] += (a[i] - o[i]) / dt; });
    });
  };
  one(at_u, s.u, s.u_old, s.rate_u);
  one(at_v, s.v, s.v_old, s.rate_v);
}

}  // namespace livebed::flow
