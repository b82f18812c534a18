#include "flow/operators.hpp"

#include <algorithm>

#include "base/loops.hpp"
#include "flow/schemes.hpp"

namespace livebed::flow {

using base::Field;
using base::vector_loop;

namespace {

/// One block of rows of `convect`.  Names: xh, yh hold half-step changes of the nodes of a row for faces across x and
/// y; south, north the fluxes through the lower and upper faces of a row.
template <class Scheme>
void convect_rows(const Staggering& at, Scheme face, const FaceFlow& flow, const Field& phi, const Field& rate,
                  const Field& gamma, double dt, Field& scratch, int first_buffer, int ja, int jb, Field& out) {
  const int sx = at.shift_x, sy = at.shift_y, i0 = at.i0, i1 = at.i1;
  const double* hx = at.hx.data() + 2;
  const double* hy = at.hy.data() + 2;
  const double* to_west = at.to_west.data() + 2;
  const double* from_west = at.from_west.data() + 2;
  double* west = scratch.row(first_buffer);
  double* south = scratch.row(first_buffer + 1);
  double* north = scratch.row(first_buffer + 2);
  double* xh = scratch.row(first_buffer + 3);
  double* yh_below = scratch.row(first_buffer + 4);
  double* yh = scratch.row(first_buffer + 5);

  const auto half_changes = [&](int j, double* across_x, double* across_y) {
    const double *p = phi.row(j), *below = phi.row(j - 1), *above = phi.row(j + 1), *r = rate.row(j);
    const double *ua = flow.u.row(j - sy) - sx, *ub = flow.u.row(j), *va = flow.v.row(j - sy) - sx, *vb = flow.v.row(j);
    const double *vc = flow.v.row(j - sy + 1) - sx, *vd = flow.v.row(j + 1);
    const double h_below = hy[j], h_above = hy[j + 1];
    vector_loop(i0 - 1, i1 + 1, [&](int i) {
      const double u = 0.25 * (ua[i] + ub[i] + ua[i + 1] + ub[i + 1]);
      const double v = 0.25 * (va[i] + vb[i] + vc[i] + vd[i]);
      const double slope_x = u > 0 ? (p[i] - p[i - 1]) / hx[i] : (p[i + 1] - p[i]) / hx[i + 1];
      const double slope_y = v > 0 ? (p[i] - below[i]) / h_below : (above[i] - p[i]) / h_above;
      across_x[i] = 0.5 * dt * (r[i] - v * slope_y);
      across_y[i] = 0.5 * dt * (r[i] - u * slope_x);
    });
  };
  const auto south_fluxes = [&](int j, const double* change_below, const double* change, double* flux) {
    const double *mm = phi.row(j - 2), *m = phi.row(j - 1), *p = phi.row(j), *pp = phi.row(j + 1);
    const double *qa = flow.qy.row(j - sy) - sx, *qb = flow.qy.row(j), *va = flow.v.row(j - sy) - sx,
                 *vb = flow.v.row(j);
    const double *ga = gamma.row(j - 1), *gb = gamma.row(j);
    const double h_mm = hy[j - 1], h = hy[j], h_pp = hy[j + 1];
    const double before = at.to_south[j + 2], after = at.from_south[j + 2];
    vector_loop(i0, i1, [&](int i) {
      const Stencil4 s{mm[i], m[i], p[i], pp[i], h_mm, h, h_pp, before, after};
      flux[i] =
          0.5 * (qa[i] + qb[i]) * face(s, 0.5 * (va[i] + vb[i]), dt, change_below[i], change[i], 0.5 * (ga[i] + gb[i]));
    });
  };

  half_changes(ja - 1, xh, yh_below);
  half_changes(ja, xh, yh);
  south_fluxes(ja, yh_below, yh, south);
  for (int j = ja; j < jb; ++j) {
    const double *p = phi.row(j), *g = gamma.row(j);
    const double *qa = flow.qx.row(j - sy) - sx, *qb = flow.qx.row(j), *ua = flow.u.row(j - sy) - sx,
                 *ub = flow.u.row(j);
    vector_loop(i0, i1 + 1, [&](int i) {
      const Stencil4 s{p[i - 2], p[i - 1], p[i], p[i + 1], hx[i - 1], hx[i], hx[i + 1], to_west[i], from_west[i]};
      west[i] = 0.5 * (qa[i] + qb[i]) * face(s, 0.5 * (ua[i] + ub[i]), dt, xh[i - 1], xh[i], 0.5 * (g[i - 1] + g[i]));
    });
    std::swap(yh_below, yh);
    half_changes(j + 1, xh, yh);
    south_fluxes(j + 1, yh_below, yh, north);
    double* o = out.row(j);
    vector_loop(i0, i1, [&](int i) { o[i] = west[i] - west[i + 1] + south[i] - north[i]; });
    std::swap(south, north);
  }
}

}  // namespace

void convect(const Mesh& mesh, const Staggering& at, Convection scheme, const FaceFlow& flow, const Field& phi,
             const Field& rate, const Field& gamma, double dt, RowScratch& scratch, Field& out) {
  const int rows = RowScratch::rows_a_block;
  base::for_each_item(0, (mesh.ny + rows - 1) / rows, [&](int block) {
    const int ja = std::max(at.j0, block * rows), jb = std::min(at.j1, (block + 1) * rows);
    if (ja >= jb) return;
    const auto run = [&](auto face) {
      convect_rows(at, face, flow, phi, rate, gamma, dt, scratch.rows, block * RowScratch::buffers, ja, jb, out);
    };
    if (scheme == Convection::hybrid)
      run(Hybrid{});
    else
      run(Bounded{});
  });
}

void solve_lines_x(const Staggering& at, const Field& base, const Field& conductance, double dt, Field& phi,
                   Field& scratch) {
  // The recurrence runs along a row, so eight rows go side by side to keep the vector units busy.
  constexpr int together = 8;
  base::for_each_item(0, (at.j1 - at.j0 + together - 1) / together, [&](int group) {
    const int j0 = at.j0 + group * together, n = std::min(together, at.j1 - j0);
    double above[together] = {}, slope[together] = {};
    for (int i = at.i0; i < at.i1; ++i)
      for (int r = 0; r < n; ++r) {
        const int j = j0 + r;
        const double scale = dt / at.inertia(i, j);
        const double west = scale * conductance(i, j), east = scale * conductance(i + 1, j);
        const double pivot = 1.0 / (base(i, j) + west + east - west * slope[r]);
        slope[r] = east * pivot;
        above[r] = (phi(i, j) + west * above[r]) * pivot;
        scratch(i, j) = slope[r];
        phi(i, j) = above[r];
      }
    for (int i = at.i1 - 2; i >= at.i0; --i)
      for (int r = 0; r < n; ++r) phi(i, j0 + r) += scratch(i, j0 + r) * phi(i + 1, j0 + r);
  });
}

void solve_lines_y(const Staggering& at, const Field& base, const Field& conductance, double dt, Field& phi,
                   Field& scratch) {
  constexpr int columns = 64;
  base::for_each_item(0, (at.i1 - at.i0 + columns - 1) / columns, [&](int block) {
    const int ia = at.i0 + block * columns, ib = std::min(at.i1, ia + columns);
    for (int j = at.j0; j < at.j1; ++j) {
      const double *c = conductance.row(j), *cn = conductance.row(j + 1), *b = base.row(j),
                   *inertia = at.inertia.row(j);
      double *p = phi.row(j), *s = scratch.row(j);
      const double *below = phi.row(j - 1), *s_below = scratch.row(j - 1);
      const double has_below = j > at.j0 ? 1.0 : 0.0;
      vector_loop(ia, ib, [&](int i) {
        const double scale = dt / inertia[i];
        const double south = scale * c[i], north = scale * cn[i];
        const double pivot = 1.0 / (b[i] + south + north - has_below * south * s_below[i]);
        s[i] = north * pivot;
        p[i] = (p[i] + has_below * south * below[i]) * pivot;
      });
    }
    for (int j = at.j1 - 2; j >= at.j0; --j) {
      double* p = phi.row(j);
      const double *above = phi.row(j + 1), *s = scratch.row(j);
      vector_loop(ia, ib, [&](int i) { p[i] += s[i] * above[i]; });
    }
  });
}

}  // namespace livebed::flow
