#include "flow/momentum.hpp"

#include <algorithm>
#include <cmath>

#include "base/loops.hpp"
#include "flow/separation.hpp"

namespace livebed::flow {

using base::Field;
using base::SharedRows;
using base::vector_loop;

Workspace::Workspace(const Mesh& m)
    : face_x(m.aperture_x),
      face_y(m.aperture_y),
      cut_x(face_x),
      cut_y(face_y),
      handed_u(hand_on(m, true)),
      handed_v(hand_on(m, false)),
      wall_u(share_wall(m, true)),
      wall_v(share_wall(m, false)),
      wall_cells(find_wall_cells(m)),
      ones(m.nx, std::vector<char>(m.ny, 0), 1.0),
      implicit_y(m),
      rows(m),
      columns(m),
      walls_u_(m.ny, 0),
      walls_v_(m.ny, 0),
      nx_(m.nx) {
  const Field f(m.nx, m.ny);
  wall_c = next_a = next_b = convection = convection_e = change = change_e = exchange_y = outflow = c_x = c_y =
      c_boundary = f;
  for (double dx : m.dx_) per_dx.push_back(1.0 / dx);
  for (double h : m.dx_face_) per_dx_face.push_back(h > 0 ? 1.0 / h : 0.0);
  nothing.assign(m.nx, 0.0);
  floor_c.assign(m.nx, 0.0);
  top_c.assign(m.nx, 0.0);
  walls_u_.front() = walls_u_.back() = 1;
  for (const WallPart& part : wall_u) walls_u_[part.j] = 1;
  for (const WallPart& part : wall_v) walls_v_[part.j] = 1;
  friction_u = SharedRows(m.nx, walls_u_, 0.0);
  friction_v = SharedRows(m.nx, walls_v_, 0.0);
  owned_ = -1;
  own_rows(0);
}

void Workspace::own_rows(int top) {
  if (top <= owned_) return;
  owned_ = top;
  const auto with = [&](std::vector<char> own) {
    std::fill(own.begin(), own.begin() + top, 1);
    return SharedRows(nx_, own, 1.0);
  };
  factor_u = response_u = with(walls_u_);
  factor_v = response_v = with(walls_v_);
}

void add_storage(const Staggering& at, const Workspace& w, int j, const double* c, double* convection) {
  if (w.storage.nx() == 0) return;
  const double *before = w.storage.row(j - at.shift_y) - at.shift_x, *here = w.storage.row(j);
  const double *per_inertia = at.per_inertia.row(j), *per_width = at.per_width.data() + 2;
  const double per_height = at.per_height[j + 2];
  vector_loop(at.i0, at.i1, [&](int i) {
    convection[i] -= c[i] * 0.5 * (before[i] + here[i]) * per_width[i] * per_height * per_inertia[i];
  });
}

Carrier centred_carrier(const State& s, double dt) {
  return {s.u, s.v, s.u_old, s.v_old, s.step > 0 ? 0.5 * dt / s.step : 0.0};
}

Component u_component(const Staggering& at_u, State& s, Workspace& w) {
  return {at_u,           true,         s.u,        s.u_old,      s.convection_u, s.load.beta_u,
          s.load.force_u, w.friction_u, w.factor_u, w.response_u, w.handed_u};
}
Component v_component(const Staggering& at_v, State& s, Workspace& w) {
  return {at_v,           false,        s.v,        s.v_old,      s.convection_v, s.load.beta_v,
          s.load.force_v, w.friction_v, w.factor_v, w.response_v, w.handed_v};
}

void evaluate_walls(const Mesh& m, const Boundary& b, const Params& params, const State& s, Workspace& w) {
  const auto along = [&](int i, int j) { return std::abs(0.5 * (s.u(i, j) + s.u(i + 1, j))); };
  for (int i = 0; i < m.nx; ++i) {
    w.floor_c[i] =
        wall_friction(params.closure, b.floor, along(i, 0), 0.5 * m.dy(0), b.floor_roughness, params.viscosity);
    w.top_c[i] = wall_friction(params.closure, b.top, along(i, m.ny - 1), 0.5 * m.dy(m.ny - 1), b.floor_roughness,
                               params.viscosity);
  }
  for (const WallCell& cell : w.wall_cells) {
    const int i = cell.i, j = cell.j;
    const double speed = std::hypot(0.5 * (s.u(i, j) + s.u(i + 1, j)), 0.5 * (s.v(i, j) + s.v(i, j + 1)));
    w.wall_c(i, j) = m.wall_length(i, j) * wall_friction(params.closure, m.pipe.wall, speed, m.wall_distance(i, j),
                                                         m.pipe.roughness, params.viscosity);
  }
  for (int j = 0; j < m.ny; ++j) {
    if (w.friction_u.owns(j)) std::fill_n(w.friction_u.own_row(j), m.nx, 0.0);
    if (w.friction_v.owns(j)) std::fill_n(w.friction_v.own_row(j), m.nx, 0.0);
  }
  const auto at_pipe = [&](std::vector<WallPart>& wall, bool is_u, SharedRows& friction) {
    for (WallPart& part : wall) {
      // Speed where the component lives: itself and the mean of the other one's four values around.
      const int i = part.i, j = part.j, i_b = is_u ? i - 1 : i + 1, j_b = is_u ? j + 1 : j - 1;
      const Field &own = is_u ? s.u : s.v, &other = is_u ? s.v : s.u;
      const double across = 0.25 * (other(i, j) + other(i_b, j) + other(i, j_b) + other(i_b, j_b));
      double factor = wall_friction(params.closure, m.pipe.wall, std::hypot(own(i, j), across), part.distance,
                                    m.pipe.roughness, params.viscosity);
      if (params.pipe.layer == PipeLayer::laminar) {
        const base::Vec2 place = is_u ? base::Vec2{m.x[i], m.centre_y(j)} : base::Vec2{m.centre_x(i), m.y[j]};
        const base::Vec2 u = is_u ? base::Vec2{own(i, j), across} : base::Vec2{across, own(i, j)};
        factor = std::max(factor, dead_water_friction(s.separation, {place.x - m.pipe.x, place.y - m.pipe.y}, u));
      }
      part.friction = part.length * factor;
      friction.own_row(j)[i] = part.friction;
    }
  };
  at_pipe(w.wall_u, true, w.friction_u);
  at_pipe(w.wall_v, false, w.friction_v);
  double *floor = w.friction_u.own_row(0), *lid = w.friction_u.own_row(m.ny - 1);
  for (int i = 1; i < m.nx; ++i) {
    floor[i] += 0.5 * (w.floor_c[i - 1] * m.dx(i - 1) + w.floor_c[i] * m.dx(i));
    lid[i] += 0.5 * (w.top_c[i - 1] * m.dx(i - 1) + w.top_c[i] * m.dx(i));
  }
}

template <class Scheme>
MomentumRows<Scheme>::MomentumRows(const Mesh& mesh, const Boundary& boundary, const Params& params, const State& s,
                                   const Carrier& carrier, double dt, double lead, Workspace& w, const Component& c,
                                   RowScratch::Rows& scratch)
    : m_(mesh),
      b_(boundary),
      params_(params),
      s_(s),
      w_(w),
      c_(c),
      carrier_(mesh, carrier, scratch),
      convect_(w.face_x, w.face_y, carrier_,
               {c.at, c.value, c.before, c.convection, s.step > 0 ? 1.0 / s.step : 0.0, lead, false, s.nut,
                params.viscosity, explicit_courant(params)},
               scratch),
      dt_(dt) {
  for (double*& row : scratch_rows_) row = scratch.take();
  for (double*& row : exchange_y_) row = scratch.take();
  outer_ = scratch.take();
}

template <class Scheme>
void MomentumRows<Scheme>::start(int ja, int jb, Field* convection) {
  const Staggering& at = c_.at;
  hands_on_ =
      std::any_of(c_.handed.begin(), c_.handed.end(), [&](const HandedOn& h) { return h.to_j >= ja && h.to_j < jb; });
  // Rows beside the block hand on to it.
  const int first = hands_on_ ? std::max(ja - 1, at.j0) : ja;
  last_ = hands_on_ ? std::min(jb, at.j1 - 1) : jb - 1;
  carrier_.start(first - 2 < -2 ? -2 : first - 2);
  convect_.start(first);
  converted_ = first;
  j_ = ja;
  kept_ = convection, kept_from_ = ja, kept_to_ = jb;
  fill_exchange_y(ja, exchange_y_[ja % 2]);
}

template <class Scheme>
void MomentumRows<Scheme>::fill_exchange_x(int j, double* k) const {
  const Staggering& at = c_.at;
  const double *here = s_.nut.row(j), *below = s_.nut.row(j - 1);
  const double *open = at.open_x.row(j), *per_hx = at.per_hx.data() + 2, nu = params_.viscosity;
  const int nx = m_.nx;
  // Along its own direction the diffusivity counts twice (2 Gamma du/dx).
  if (c_.is_u) return vector_loop(0, nx + 1, [&](int i) { k[i] = 2.0 * (nu + here[i - 1]) * open[i] * per_hx[i]; });
  vector_loop(0, nx + 1, [&](int i) {
    k[i] = (nu + 0.25 * (here[i - 1] + here[i] + below[i - 1] + below[i])) * open[i] * per_hx[i];
  });
  // Water comes in straight: v is 0 on the inlet.  Ghosts mirror v at walls and at the inlet.
  const auto side = [&](Wall wall, int i) { return wall == Wall::no_slip ? nu / m_.dx(i) : 0.0; };
  k[0] = b_.inlet ? (nu + 0.5 * (below[0] + here[0])) / m_.dx(0) : side(b_.west, 0);
  k[nx] = b_.outlet ? 0.0 : side(b_.east, nx - 1);
}

template <class Scheme>
void MomentumRows<Scheme>::fill_exchange_y(int j, double* k) const {
  const Staggering& at = c_.at;
  const double *here = s_.nut.row(j), *below = s_.nut.row(j - 1), *open = at.open_y.row(j);
  const double nu = params_.viscosity;
  if (c_.is_u) {
    const double inside = j > 0 && j < m_.ny ? at.per_hy[j + 2] : 0.0;
    vector_loop(0, m_.nx + 1, [&](int i) {
      k[i] = inside * (nu + 0.25 * (here[i - 1] + here[i] + below[i - 1] + below[i])) * open[i];
    });
  } else {
    const double per_h = at.per_hy[j + 2];
    vector_loop(0, m_.nx + 1, [&](int i) { k[i] = 2.0 * (nu + below[i]) * open[i] * per_h; });
  }
}

template <class Scheme>
void MomentumRows<Scheme>::hand_on(int j) {
  const Staggering& at = c_.at;
  for (const HandedOn& h : c_.handed)
    if (h.to_j == j)
      convection_[j % 4][h.to_i] +=
          h.share * convection_[h.from_j % 4][h.from_i] * at.inertia(h.from_i, h.from_j) / at.inertia(h.to_i, h.to_j);
}

template <class Scheme>
void MomentumRows<Scheme>::next(double* d, double* kx) {
  const Staggering& at = c_.at;
  const int j = j_++;
  for (const int ready = hands_on_ ? std::min(j + 1, last_) : j; converted_ <= ready; ++converted_) {
    const bool keep = kept_ && converted_ >= kept_from_ && converted_ < kept_to_;
    convection_[converted_ % 4] = keep ? kept_->row(converted_) : scratch_rows_[converted_ % 4];
    convect_.next(convection_[converted_ % 4]);
  }
  if (hands_on_) hand_on(j);
  add_storage(at, w_, j, c_.value.row(j), convection_[j % 4]);
  fill_exchange_x(j, kx);
  fill_exchange_y(j + 1, exchange_y_[(j + 1) % 2]);

  const double *ky = exchange_y_[j % 2], *ky_above = exchange_y_[(j + 1) % 2], *convection = convection_[j % 4];
  const double *u = c_.value.row(j), *below = c_.value.row(j - 1), *above = c_.value.row(j + 1);
  const double *p = s_.p.row(j), *p_below = s_.p.row(j - 1), *open = at.open.row(j),
               *per_inertia = at.per_inertia.row(j);
  const double *per_width = at.per_width.data() + 2, per_height = at.per_height[j + 2];
  const double per_rho = 1.0 / params_.density, dt = dt_;
  double* outer = outer_;  // forces from the other component and from the pressure
  // The other component's stress, d/dy (Gamma dv/dx) and d/dx (Gamma du/dy), fades with the openings of the two faces
  // it is a difference of: beside a sliver that difference is no gradient, and as an explicit force it would drive the
  // flow through the sliver instead of slowing it.
  if (c_.is_u) {
    const double *v = carrier_.v(j), *v_above = carrier_.v(j + 1);
    const double *face = w_.cut_y.row(j), *face_above = w_.cut_y.row(j + 1);
    const double h = per_height * at.hy[j + 2], h_above = per_height * at.hy[j + 3];
    vector_loop(at.i0, at.i1, [&](int i) {
      const double stress = face_above[i - 1] * face_above[i] * ky_above[i] * h_above * (v_above[i] - v_above[i - 1]) -
                            face[i - 1] * face[i] * ky[i] * h * (v[i] - v[i - 1]);
      outer[i] = (stress - open[i] * per_rho * (p[i] - p[i - 1])) * per_width[i];
    });
  } else {
    const double *v = carrier_.u(j), *v_below = carrier_.u(j - 1), *hx = at.hx.data() + 2;
    const double *face = w_.cut_x.row(j), *face_below = w_.cut_x.row(j - 1);
    vector_loop(at.i0, at.i1, [&](int i) {
      const double stress = face[i + 1] * face_below[i + 1] * kx[i + 1] * hx[i + 1] * (v[i + 1] - v_below[i + 1]) -
                            face[i] * face_below[i] * kx[i] * hx[i] * (v[i] - v_below[i]);
      outer[i] = (stress * per_width[i] - open[i] * per_rho * (p[i] - p_below[i])) * per_height;
    });
  }
  vector_loop(at.i0, at.i1, [&](int i) {
    const double diffusion = per_width[i] * (kx[i + 1] * (u[i + 1] - u[i]) - kx[i] * (u[i] - u[i - 1])) +
                             per_height * (ky_above[i] * (above[i] - u[i]) - ky[i] * (u[i] - below[i]));
    d[i] = dt * (convection[i] + per_inertia[i] * (diffusion + outer[i]));
  });
  // A ghost mirrors its neighbour, so the exchange with it weighs twice in the neighbour's own coefficient.
  if (!c_.is_u) kx[0] *= 2.0, kx[m_.nx] *= 2.0;
  if (c_.factor.owns(j)) add_load_and_friction(j, d);
}

template <class Scheme>
void MomentumRows<Scheme>::add_load_and_friction(int j, double* d) {
  const Staggering& at = c_.at;
  const double *u = c_.value.row(j), *fr = c_.friction.row(j), *beta = c_.beta.row(j), *force = c_.force.row(j);
  const double *volume = at.open_volume.row(j), *per_inertia = at.per_inertia.row(j);
  const double *per_width = at.per_width.data() + 2, per_height = at.per_height[j + 2];
  const double per_rho = 1.0 / params_.density, dt = dt_, lid = c_.is_u && j == m_.ny - 1 ? b_.top_speed : 0.0;
  double *factor = c_.factor.own_row(j), *response = c_.response.own_row(j);
  vector_loop(at.i0, at.i1, [&](int i) {
    const double friction = dt * fr[i] * per_width[i] * per_height * per_inertia[i];
    const double share = dt * per_rho * volume[i] * per_inertia[i];
    const double drag = share * beta[i];
    d[i] += share * force[i] - drag * u[i] - friction * (u[i] - lid);
    factor[i] = 1.0 + drag + friction;
    // Not times opening/inertia: the correction is that of a potential flow, whose order cut faces must not spoil.  A
    // sliver's predictor takes only that share of the gradient; the pressure makes up for it within some steps.
    response[i] = 1.0 / (1.0 + drag);
  });
}

template class MomentumRows<Bounded>;
template class MomentumRows<Hybrid>;

namespace {

/// f <- 0 where `at` has no unknowns.  The field goes from one quantity to the next with every step; a run that goes on
/// from a checkpoint must not differ by what another quantity left there.
void clear_beside(const Staggering& at, Field& f) {
  for (int j = 0; j < f.ny(); ++j) {
    const bool inside = j >= at.j0 && j < at.j1;
    std::fill(f.row(j), f.row(j) + (inside ? at.i0 : f.nx()), 0.0);
    if (inside) std::fill(f.row(j) + at.i1, f.row(j) + f.nx(), 0.0);
  }
}

/// next <- predicted component; w.convection <- its convection.
template <class Scheme>
void predict(const Mesh& m, const Boundary& b, const Params& params, double dt, const State& s, Workspace& w,
             const Component& c, Field& next) {
  const Staggering& at = c.at;
  const double* per_hx = at.per_hx.data() + 2;
  clear_beside(at, w.convection);
  w.rows.over_blocks(at.j0, at.j1, [&](int ja, int jb) {
    constexpr int together = 8;
    RowScratch::Rows scratch = w.rows.rows();
    MomentumRows<Scheme> rows(m, b, params, s, centred_carrier(s, dt), dt, dt, w, c, scratch);
    std::array<double*, together> kx{}, slope{};
    for (int r = 0; r < together; ++r) kx[r] = scratch.take(), slope[r] = scratch.take();
    const bool half = spreads_little(at, s.nut, params.viscosity, dt, ja, jb);
    const auto keep_y = [&](int j) {
      w.implicit_y.keep(at, j, dt, rows.implicit_y(j));
      const double* exchange = rows.exchange_y(j);
      double* k = w.exchange_y.row(j);
      const double factor = half ? 0.5 * dt : 1.0;
      vector_loop(at.i0, at.i1, [&](int i) { k[i] = factor * exchange[i]; });
      if (!half)
        keep_implicit_part(
            at.i0, at.i1, dt, false, [per_h = at.per_hy[j + 2]](int) { return per_h; }, k);
    };
    rows.start(ja, jb, &w.convection);
    for (int j = ja; j < jb;) {
      std::array<RowSystem, together> systems;
      int count = 0;
      for (; j < jb && count < together; ++j, ++count) {
        double* d = w.change.row(j);
        rows.next(d, kx[count]);
        keep_y(j);
        keep_implicit_part(
            at.i0, at.i1 + 1, dt, half, [&](int i) { return per_hx[i]; }, kx[count]);
        systems[count] = {c.factor.row(j), at.per_inertia.row(j), kx[count], d, slope[count]};
      }
      solve_rows(at, systems.data(), count);
    }
    if (jb == at.j1) keep_y(jb);
  });
  over_columns(at, w.columns, [&](int ia, int ib) {
    double *d = w.columns.piece(0), *slope = w.columns.piece(1);
    const auto exchange = [&](int j) {
      if (j + rows_ahead < at.j1) base::fetch_ahead(w.exchange_y.row(j + rows_ahead), ia, ib);
      return w.exchange_y.row(j);
    };
    with_implicit(w.implicit_y, at, ia, ib, [&](auto convection) {
      solve_columns(at, c.factor, w.change, ia, ib, exchange, convection, d, slope);
    });
    for (int j = at.j0; j < at.j1; ++j) {
      if (j + rows_ahead < at.j1) {
        base::fetch_ahead(c.value.row(j + rows_ahead), ia, ib);
        base::fetch_ahead<true>(next.row(j + rows_ahead), ia, ib);
      }
      const double *u = c.value.row(j), *open = at.open.row(j), *change = d + j * ColumnScratch::columns - ia;
      double* to = next.row(j);
      vector_loop(ia, ib, [&](int i) { to[i] = open[i] > 0 ? u[i] + change[i] : 0.0; });
    }
  });
}

/// Open outlet: u is carried out at its own speed; the faces feel the drag of the grains and the pressure drop to p =
/// 0.
void predict_outlet(const Mesh& m, const Params& params, double dt, const State& s, Workspace& w) {
  const int n = m.nx;
  const double half = 0.5 * m.dx(n - 1), ahead = centred_carrier(s, dt).ahead, rho = params.density;
  for (int j = 0; j < m.ny; ++j) {
    const double u = s.u(n, j), carrier = u + ahead * (u - s.u_old(n, j));
    const double gradient = -s.p(n - 1, j) / half;
    const double convection = std::max(carrier, 0.0) * (u - s.u(n - 1, j)) / m.dx(n - 1);
    const double beta = j < s.load.top ? s.load.beta_u(n, j) : 0.0, force = j < s.load.top ? s.load.force_u(n, j) : 0.0;
    const double drag = dt * beta / rho;
    if (w.response_u.owns(j)) w.response_u.own_row(j)[n] = 1.0 / (1.0 + drag);
    w.next_a(n, j) = (u - dt * convection + dt / rho * (force - gradient)) / (1.0 + drag);
  }
}

}  // namespace

void predict_velocity(const Mesh& m, const Boundary& b, const Params& params, const Staggering& at_u,
                      const Staggering& at_v, double dt, State& s, Workspace& w) {
  w.own_rows(s.load.top);
  with_scheme(params.convection, [&](auto scheme) {
    using Scheme = decltype(scheme);
    predict<Scheme>(m, b, params, dt, s, w, u_component(at_u, s, w), w.next_a);
    s.convection_u.swap(w.convection);
    predict<Scheme>(m, b, params, dt, s, w, v_component(at_v, s, w), w.next_b);
    s.convection_v.swap(w.convection);
  });
  if (b.outlet) predict_outlet(m, params, dt, s, w);
  s.u_old.swap(s.u), s.u.swap(w.next_a);
  s.v_old.swap(s.v), s.v.swap(w.next_b);
  fill_velocity_ghosts(m, b, s.u, s.v);
}

}  // namespace livebed::flow
