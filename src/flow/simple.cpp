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

Simple::Simple(const Mesh& m) : system_(m) { carrier_u_ = carrier_v_ = old_k_ = old_e_ = Field(m.nx, m.ny); }

void Simple::begin_step(State& s) {
  copy(s.u, s.u_old);
  copy(s.v, s.v_old);
  copy(s.k, old_k_);
  turbulence_kept_ = false;  // the second quantity is known when its equation is
}

void Simple::couple(const Staggering& at, const Workspace& w, const CarrierRows& carrier, int j, const double* kx,
                    const double* ky, const double* ky_above) {
  const int sx = at.shift_x, sy = at.shift_y;
  const double *ua = carrier.u(j - sy) - sx, *ub = carrier.u(j), *xa = w.face_x.row(j - sy) - sx, *xb = w.face_x.row(j);
  const double *va = carrier.v(j - sy) - sx, *vb = carrier.v(j), *ya = w.face_y.row(j - sy) - sx, *yb = w.face_y.row(j);
  const double *vc = carrier.v(j - sy + 1) - sx, *vd = carrier.v(j + 1), *yc = w.face_y.row(j - sy + 1) - sx,
               *yd = w.face_y.row(j + 1);
  const double y_a = at.share_y_before[j + 2], y_b = at.share_y[j + 2], height = at.height[j + 2];
  const double *x_a = at.share_x_before.data() + 2, *x_b = at.share_x.data() + 2, *width = at.width.data() + 2;
  double *west = system_.west.row(j), *east = system_.east.row(j), *south = system_.south.row(j),
         *north = system_.north.row(j), *centre = system_.centre.row(j);
  vector_loop(at.i0, at.i1, [&](int i) {
    const auto through_x = [&](int k) { return y_a * ua[k] * xa[k] + y_b * ub[k] * xb[k]; };
    west[i] = height * (kx[i] + std::max(through_x(i), 0.0));
    east[i] = height * (kx[i + 1] + std::max(-through_x(i + 1), 0.0));
    south[i] = width[i] * (ky[i] + std::max(x_a[i] * va[i] * ya[i] + x_b[i] * vb[i] * yb[i], 0.0));
    north[i] = width[i] * (ky_above[i] + std::max(-(x_a[i] * vc[i] * yc[i] + x_b[i] * vd[i] * yd[i]), 0.0));
    centre[i] = west[i] + east[i] + south[i] + north[i];
  });
}

template <class Scheme>
double Simple::solve_component(const Mesh& m, const Boundary& b, const Params& params, double inverse_dt, State& s,
                               Workspace& w, const Component& c) {
  const Staggering& at = c.at;
  w.rows.over_blocks(at.j0, at.j1, [&](int ja, int jb) {
    RowScratch::Rows scratch = w.rows.rows();
    MomentumRows<Scheme> rows(m, b, params, s, {carrier_u_, carrier_v_, carrier_u_, carrier_v_, 0.0}, 1.0, 0.0, w, c,
                              scratch);
    double *acceleration = scratch.take(), *kx = scratch.take();
    rows.start(ja, jb, nullptr);
    for (int j = ja; j < jb; ++j) {
      rows.next(acceleration, kx);
      couple(at, w, rows.carrier(), j, kx, rows.exchange_y(j), rows.exchange_y(j + 1));
      const double *inertia = at.inertia_.row(j), *width = at.width.data() + 2, *factor = c.factor.row(j);
      const double *u = c.value.row(j), *u_old = c.before.row(j), *open = at.open.row(j), height = at.height[j + 2];
      double *west = system_.west.row(j), *east = system_.east.row(j), *south = system_.south.row(j),
             *north = system_.north.row(j), *centre = system_.centre.row(j), *rhs = system_.rhs.row(j);
      vector_loop(at.i0, at.i1, [&](int i) {
        const double M = inertia[i] * width[i] * height;
        const bool moves = open[i] > 0;
        centre[i] = moves ? centre[i] + M * (factor[i] - 1.0 + inverse_dt) : 1.0;
        rhs[i] = moves ? M * (acceleration[i] - inverse_dt * (u[i] - u_old[i])) : 0.0;
        west[i] = moves ? west[i] : 0.0, east[i] = moves ? east[i] : 0.0;
        south[i] = moves ? south[i] : 0.0, north[i] = moves ? north[i] : 0.0;
      });
    }
  });
  const double residual = scaled_residual(at, system_, c.value, scratch_);
  const double per_relax = 1.0 / params.relax_velocity;
  for_each_item(at.j0, at.j1, [&](int j) {
    const double *open = at.open.row(j), *width = at.width.data() + 2, height = at.height[j + 2];
    double *centre = system_.centre.row(j), *response = c.response.own_row(j);
    vector_loop(at.i0, at.i1, [&](int i) {
      centre[i] *= per_relax;
      response[i] = open[i] * width[i] * height / centre[i];
    });
  });
  sweep_lines(at, sweeps, system_);
  return residual;
}

void Simple::solve_momentum(const Mesh& m, const Boundary& b, const Params& params, const Staggering& at_u,
                            const Staggering& at_v, double inverse_dt, State& s, Workspace& w, Residuals& residuals) {
  w.own_rows(m.ny);
  copy(s.u, carrier_u_);
  copy(s.v, carrier_v_);
  evaluate_walls(m, b, params, s, w);
  const auto correct = [&](const Staggering& at, Field& value) {
    for_each_item(at.j0, at.j1, [&](int j) {
      const double* change = system_.correction.row(j);
      double* to = value.row(j);
      vector_loop(at.i0, at.i1, [&](int i) { to[i] += change[i]; });
    });
  };
  with_scheme(params.convection, [&](auto scheme) {
    using Scheme = decltype(scheme);
    residuals.u = solve_component<Scheme>(m, b, params, inverse_dt, s, w, u_component(at_u, s, w));
    correct(at_u, s.u);
    residuals.v = solve_component<Scheme>(m, b, params, inverse_dt, s, w, v_component(at_v, s, w));
    correct(at_v, s.v);
  });
  if (!b.outlet) return;
  // Open outlet: u is carried out at its own speed, against the drag of the grains and the pressure drop to p = 0.
  const int n = m.nx;
  const double rho = params.density, half = 0.5 * m.dx(n - 1);
  for (int j = 0; j < m.ny; ++j) {
    const double carried = std::max(carrier_u_(n, j), 0.0) / m.dx(n - 1);
    const bool loaded = j < s.load.top;
    const double drag = loaded ? s.load.beta_u(n, j) / rho : 0.0;
    const double force = carried * (s.u(n - 1, j) - s.u(n, j)) + s.p(n - 1, j) / (rho * half) +
                         (loaded ? s.load.force_u(n, j) / rho : 0.0) - drag * s.u(n, j) -
                         inverse_dt * (s.u(n, j) - s.u_old(n, j));
    const double centre = (carried + drag + inverse_dt) / params.relax_velocity;
    const double least = params.viscosity / (half * half);  // an outlet at rest keeps a finite response
    const double response = 1.0 / std::max(centre, least);
    w.response_u.own_row(j)[n] = response;
    s.u(n, j) += force * response;
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

template <class Scheme>
double Simple::solve_scalar(const Mesh& m, const Params& params, const Staggering& at, double inverse_dt, bool of_k,
                            const Turbulence& turbulence, const State& s, Field& next, Workspace& w) {
  const Field &value = of_k ? s.k : turbulence.second(s), &old = of_k ? old_k_ : old_e_;
  w.rows.over_blocks(0, m.ny, [&](int ja, int jb) {
    RowScratch::Rows scratch = w.rows.rows();
    CarrierRows carrier(m, {s.u, s.v, s.u, s.v, 0.0}, scratch);
    ScalarRows<Scheme> rows(m, params, turbulence, at, of_k, s, carrier, 0.0, w, scratch);
    double *rate = scratch.take(), *convection = scratch.take(), *gain = scratch.take(), *decay = scratch.take(),
           *kx = scratch.take(), *other_gain = scratch.take(), *other_decay = scratch.take();
    carrier.start(ja - 2);
    rows.start(ja);
    for (int j = ja; j < jb; ++j) {
      turbulence.fill_rates(m, j, s,
                            of_k ? Turbulence::RowRates{gain, decay, other_gain, other_decay}
                                 : Turbulence::RowRates{other_gain, other_decay, gain, decay});
      rows.next(gain, decay, rate, convection, kx);
      const double *ky = rows.exchange_y(j), *ky_above = rows.exchange_y(j + 1);
      couple(at, w, carrier, j, kx, ky, ky_above);
      const double *inertia = at.inertia_.row(j), *width = at.width.data() + 2, height = at.height[j + 2];
      const double *c = value.row(j), *below = value.row(j - 1), *above = value.row(j + 1), *c_old = old.row(j);
      const double *west = system_.west.row(j), *east = system_.east.row(j), *south = system_.south.row(j),
                   *north = system_.north.row(j);
      double *centre = system_.centre.row(j), *rhs = system_.rhs.row(j);
      vector_loop(0, m.nx, [&](int i) {
        const double M = inertia[i] * width[i] * height;
        rhs[i] = M * (rate[i] - inverse_dt * (c[i] - c_old[i]));
        // What the right-hand side would hold for the new value itself; taken implicitly where it is negative, so that
        // the value stays positive (Patankar 1980).
        const double inflow =
            (west[i] - height * kx[i]) * (c[i] - c[i - 1]) + (east[i] - height * kx[i + 1]) * (c[i] - c[i + 1]) +
            (south[i] - width[i] * ky[i]) * (c[i] - below[i]) + (north[i] - width[i] * ky_above[i]) * (c[i] - above[i]);
        const double given = M * (convection[i] + gain[i]) + inflow;
        centre[i] += M * (decay[i] + inverse_dt) + (given < 0 ? -given / c[i] : 0.0);
      });
      turbulence.fixed_cells(of_k, j, [&](int i, double fixed) { system_.fix(i, j, fixed - c[i]); });
    }
  });
  const double residual = scaled_residual(at, system_, value, scratch_);
  const double per_relax = 1.0 / params.relax_turbulence, floor = of_k ? k_floor : turbulence.second_floor();
  for_each_item(0, m.ny, [&](int j) {
    double* centre = system_.centre.row(j);
    vector_loop(0, m.nx, [&](int i) { centre[i] *= per_relax; });
  });
  sweep_lines(at, sweeps, system_);
  for_each_item(0, m.ny, [&](int j) {
    const double *c = value.row(j), *change = system_.correction.row(j);
    double* to = next.row(j);
    vector_loop(0, m.nx, [&](int i) { to[i] = std::max(c[i] + change[i], floor); });
  });
  return residual;
}

void Simple::solve_turbulence(const Mesh& m, const Boundary& b, const Params& params, const Staggering& at,
                              double inverse_dt, Turbulence& turbulence, State& s, Workspace& w, Residuals& residuals) {
  turbulence.prepare(m, b, params, 0.0, s, w);
  if (!turbulence_kept_) copy(turbulence.second(s), old_e_);
  turbulence_kept_ = true;
  with_scheme(params.convection, [&](auto scheme) {
    using Scheme = decltype(scheme);
    residuals.k = solve_scalar<Scheme>(m, params, at, inverse_dt, true, turbulence, s, w.next_a, w);
    residuals.epsilon = solve_scalar<Scheme>(m, params, at, inverse_dt, false, turbulence, s, w.next_b, w);
  });
  for_each_item(0, m.ny, [&](int j) {
    turbulence.store(params, j, 0, m.nx, w.next_a.row(j), w.next_b.row(j), s.k.row(j), s.epsilon.row(j), s.nut.row(j));
  });
  fill_scalar_ghosts(m, nullptr, s.nut);
}

}  // namespace livebed::flow
