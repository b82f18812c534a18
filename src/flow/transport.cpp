#include "flow/transport.hpp"

#include <algorithm>

#include "base/loops.hpp"
#include "flow/constants.hpp"

namespace livebed::flow {

using base::Field;
using base::vector_loop;

template <class Scheme>
ScalarRows<Scheme>::ScalarRows(const Mesh& mesh, const Params& params, const Turbulence& turbulence,
                               const Staggering& at, bool of_k, const State& s, CarrierRows& carrier, double lead,
                               const Workspace& w, RowScratch::Rows& scratch)
    : m_(mesh),
      params_(params),
      turbulence_(turbulence),
      at_(at),
      of_k_(of_k),
      s_(s),
      w_(w),
      convect_(w.face_x, w.face_y, carrier,
               {at, of_k ? s.k : turbulence.second(s), of_k ? s.k_old : turbulence.second_old(s),
                of_k ? s.convection_k : s.convection_e, s.step > 0 ? 1.0 / s.step : 0.0, lead, true, turbulence.nut(),
                params.viscosity, explicit_courant(params)},
               scratch) {
  for (double*& row : exchange_y_) row = scratch.take();
}

template <class Scheme>
void ScalarRows<Scheme>::fill_y(int j) {
  turbulence_.fill_exchange_y(m_, params_, at_, of_k_, j, 0, m_.nx, exchange_y_[j % 2]);
}

template <class Scheme>
void ScalarRows<Scheme>::start(int j) {
  convect_.start(j);
  fill_y(j);
  j_ = j;
}

template <class Scheme>
void ScalarRows<Scheme>::next(const double* gain, const double* decay, double* rate, double* convection, double* kx) {
  const int j = j_++;
  convect_.next(convection);
  turbulence_.fill_exchange_x(m_, params_, at_, of_k_, j, kx);
  fill_y(j + 1);
  const Field& field = of_k_ ? s_.k : turbulence_.second(s_);
  add_storage(at_, w_, j, field.row(j), convection);
  const double *c = field.row(j), *below = field.row(j - 1), *above = field.row(j + 1);
  const double *ky = exchange_y_[j % 2], *ky_above = exchange_y_[(j + 1) % 2], *per_inertia = at_.per_inertia.row(j);
  const double *per_width = at_.per_width.data() + 2, per_height = at_.per_height[j + 2];
  vector_loop(0, m_.nx, [&](int i) {
    const double diffusion = per_width[i] * (kx[i + 1] * (c[i + 1] - c[i]) - kx[i] * (c[i] - c[i - 1])) +
                             per_height * (ky_above[i] * (above[i] - c[i]) - ky[i] * (c[i] - below[i]));
    rate[i] = convection[i] + per_inertia[i] * diffusion + gain[i] - decay[i] * c[i];
  });
}

template class ScalarRows<Bounded>;
template class ScalarRows<Hybrid>;

namespace {

/// d <- dt x rate and factor <- 1 + what of it is implicit, for one row; given cells take their values.
void set_up_row(const Turbulence& turbulence, const Mesh& m, bool of_k, int j, double dt, const double* c,
                const double* rate, const double* decay, double* d, double* factor) {
  vector_loop(0, m.nx, [&](int i) {
    const double change = dt * rate[i], number = dt * decay[i];
    const double implicit = number <= 1.0 ? 0.5 * number : number - 0.5;
    factor[i] = 1.0 + implicit + (change < -0.5 * c[i] ? -change / c[i] : 0.0);
    d[i] = change;
  });
  turbulence.fixed_cells(of_k, j, [&](int i, double value) {
    factor[i] = fixed_row;
    d[i] = fixed_row * (value - c[i]);
  });
}

/// c + d, but never less than a positive part of c: below c/2 the sum gives way to a hyperbola that joins it smoothly.
double positive_sum(double c, double d) { return d < -0.5 * c ? -0.25 * c * c / d : c + d; }

template <class Scheme>
void advance_both(const Mesh& m, const Params& params, const Staggering& at, double dt, const Turbulence& turbulence,
                  State& s, Workspace& w) {
  Field &change_k = w.change, &change_e = w.change_e;
  const double* per_hx = at.per_hx.data() + 2;
  const bool little_everywhere = spreads_little(at, turbulence.nut(), params.viscosity, dt, 0, m.ny);
  w.rows.over_blocks(0, m.ny, [&](int ja, int jb) {
    constexpr int together = 8;
    RowScratch::Rows scratch = w.rows.rows();
    CarrierRows carrier(m, {s.u, s.v, s.u, s.v, 0.0}, scratch);
    ScalarRows<Scheme> rows_k(m, params, turbulence, at, true, s, carrier, dt, w, scratch);
    ScalarRows<Scheme> rows_e(m, params, turbulence, at, false, s, carrier, dt, w, scratch);
    double* rate = scratch.take();
    const Turbulence::RowRates rates{scratch.take(), scratch.take(), scratch.take(), scratch.take()};
    const bool half = little_everywhere;
    std::array<std::array<double*, together>, 2> kx, factor;
    std::array<double*, together> slope{};
    for (int r = 0; r < together; ++r) {
      slope[r] = scratch.take();
      for (int q : {0, 1}) kx[q][r] = scratch.take(), factor[q][r] = scratch.take();
    }
    carrier.start(ja - 2);
    rows_k.start(ja);
    rows_e.start(ja);
    for (int j = ja; j < jb;) {
      std::array<std::array<RowSystem, together>, 2> systems;
      int count = 0;
      for (; j < jb && count < together; ++j, ++count) {
        turbulence.fill_rates(m, j, s, rates);
        w.implicit_y.keep(at, j, dt, rows_k.implicit_y(j));
        for (int q : {0, 1}) {
          const bool of_k = q == 0;
          double* d = (of_k ? change_k : change_e).row(j);
          double* convection = (of_k ? w.convection : w.convection_e).row(j);
          const double *gain = of_k ? rates.gain_k : rates.gain_e, *decay = of_k ? rates.decay_k : rates.decay_e;
          (of_k ? rows_k : rows_e).next(gain, decay, rate, convection, kx[q][count]);
          set_up_row(turbulence, m, of_k, j, dt, (of_k ? s.k : turbulence.second(s)).row(j), rate, decay, d,
                     factor[q][count]);
          keep_implicit_part(
              0, m.nx + 1, dt, half, [&](int i) { return per_hx[i]; }, kx[q][count]);
          systems[q][count] = {factor[q][count], at.per_inertia.row(j), kx[q][count], d, slope[count]};
        }
      }
      for (int q : {0, 1}) solve_rows(at, systems[q].data(), count);
    }
  });
  w.implicit_y.keep(at, m.ny, dt, nullptr);  // nothing passes the lid
  over_columns(at, w.columns, [&](int ia, int ib) {
    constexpr int wide = ColumnScratch::columns;
    const bool half = little_everywhere;
    const auto solve = [&](bool of_k, double* d, double* slope) {
      // Exchange of the row in hand and of the one above it.
      double exchange[2][wide];
      int filled = -1;
      const auto exchange_of = [&](int j) {
        double* k = exchange[j % 2];
        if (j > filled) {
          if (j + rows_ahead < m.ny) base::fetch_ahead(turbulence.nut().row(j + rows_ahead), ia, ib);
          turbulence.fill_exchange_y(m, params, at, of_k, j, ia, ib, k);
          keep_implicit_part(
              0, ib - ia, dt, half, [per_h = at.per_hy[j + 2]](int) { return per_h; }, k);
          filled = j;
        }
        return k - ia;
      };
      with_implicit(w.implicit_y, at, ia, ib, [&](auto convection) {
        solve_columns(at, turbulence.factor(of_k), of_k ? change_k : change_e, ia, ib, exchange_of, convection, d,
                      slope);
      });
      const Field& now = of_k ? s.k : turbulence.second(s);
      const double floor = of_k ? k_floor : turbulence.second_floor();
      for (int j = 0; j < m.ny; ++j) {
        if (j + rows_ahead < m.ny) base::fetch_ahead(now.row(j + rows_ahead), ia, ib);
        const double* c = now.row(j) + ia;
        double* here = d + j * wide;
        vector_loop(0, ib - ia, [&](int i) { here[i] = std::max(positive_sum(c[i], here[i]), floor); });
        turbulence.fixed_cells(of_k, j, [&](int i, double value) {
          if (i >= ia && i < ib) here[i - ia] = value;
        });
      }
    };
    double *k = w.columns.piece(0), *e = w.columns.piece(1), *slope = w.columns.piece(2);
    solve(true, k, slope);
    solve(false, e, slope);
    for (int j = 0; j < m.ny; ++j) {
      if (j + rows_ahead < m.ny)
        for (Field* to : {&w.next_a, &w.next_b, &s.nut}) base::fetch_ahead<true>(to->row(j + rows_ahead), ia, ib);
      turbulence.store(params, j, ia, ib, k + j * wide, e + j * wide, w.next_a.row(j), w.next_b.row(j), s.nut.row(j));
    }
  });
  s.k_old.swap(s.k), s.k.swap(w.next_a);
  s.epsilon_old.swap(s.epsilon), s.epsilon.swap(w.next_b);
  s.convection_k.swap(w.convection);
  s.convection_e.swap(w.convection_e);
}

}  // namespace

void advance_turbulence(const Mesh& m, const Boundary& b, const Params& params, const Staggering& at, double dt,
                        Turbulence& turbulence, State& s, Workspace& w) {
  turbulence.prepare(m, b, params, s.step > 0 ? 0.5 * dt / s.step : 0.0, s, w);
  with_scheme(params.convection,
              [&](auto scheme) { advance_both<decltype(scheme)>(m, params, at, dt, turbulence, s, w); });
  fill_scalar_ghosts(m, nullptr, s.nut);
}

}  // namespace livebed::flow
