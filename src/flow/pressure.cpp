#include "flow/pressure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/fault.hpp"
#include "base/loops.hpp"

namespace livebed::flow {

using base::for_each_item;
using base::vector_loop;

namespace {

/// Most that single precision is asked to reduce a residual before it is taken anew in double precision.
constexpr double single_factor = 1e-4;
/// Most iterations before the residual is taken anew: single precision may believe that it goes on converging.
constexpr int a_refinement = 6;

}  // namespace

PressureSolver::PressureSolver(int nx, int ny)
    : nx_(nx),
      ny_(ny),
      c_x_(nx, ny),
      c_y_(nx, ny),
      c_boundary_(nx, ny),
      r_(nx, ny),
      first_(ny + 1),
      multigrid_(nx, ny) {}

void PressureSolver::set_coefficients(const base::Field& c_x, const base::Field& c_y, const base::Field& c_boundary) {
  Stencil& a = multigrid_.finest();
  // Closed outer faces are zeros in the copies, so that no loop below asks where it is.
  for_each_item(0, ny_, [&](int j) {
    double *x = c_x_.row(j), *y = c_y_.row(j), *b = c_boundary_.row(j);
    const double *from_x = c_x.row(j), *from_y = c_y.row(j), *from_b = c_boundary.row(j);
    const double inside = j > 0 ? 1.0 : 0.0;
    vector_loop(0, nx_, [&](int i) { x[i] = from_x[i], y[i] = inside * from_y[i], b[i] = from_b[i]; });
    x[0] = x[nx_] = 0;
  });
  for (int j = 0; j <= ny_; ++j) {
    const auto same = [&](const base::Field& c) { return std::equal(c.row(j), c.row(j) + nx_, c.row(first_[j - 1])); };
    first_[j] = j > 0 && same(c_x_) && same(c_y_) && same(c_boundary_) ? first_[j - 1] : j;
  }
  for_each_item(0, ny_, [&](int j) {
    const double *x = c_x_.row(j), *north = c_y_.row(j + 1), *b = c_boundary_.row(j);
    float *w = a.west.own_row(j), *e = a.east.own_row(j);
    float *nF = a.north.F.row(j), *nC = a.north.C.row(j), *xF = a.extra.F.row(j), *xC = a.extra.C.row(j);
    vector_loop(0, a.west.nm(), [&](int m) {
      w[m] = static_cast<float>(x[2 * m]), e[m] = static_cast<float>(x[2 * m + 1]);
      nF[m] = static_cast<float>(north[2 * m]), xF[m] = static_cast<float>(b[2 * m]);
    });
    vector_loop(0, nx_ / 2,
                [&](int m) { nC[m] = static_cast<float>(north[2 * m + 1]), xC[m] = static_cast<float>(b[2 * m + 1]); });
  });
  multigrid_.build();

  floating_ = base::largest(0, ny_, partial_, 0.0, [&](int j) {
                const double* b = c_boundary_.row(j);
                return base::vector_largest(0, nx_, 0.0, [&](int i) { return b[i]; });
              }) == 0.0;
  if (!floating_) return;
  fluid_cells_ = base::ordered_sum(0, ny_, partial_, [&](int j) {
    const double *x = c_x_.row(j), *y = c_y_.row(j), *north = c_y_.row(j + 1);
    return base::vector_sum(0, nx_, [&](int i) { return x[i] + x[i + 1] + y[i] + north[i] > 0 ? 1.0 : 0.0; });
  });
}

double PressureSolver::residual(const base::Field& p, const base::Field& b) {
  const double squares = base::ordered_sum(0, ny_, partial_, [&](int j) {
    const int shared = first_[j];
    const double *x = c_x_.row(shared), *y = c_y_.row(shared), *north = c_y_.row(first_[j + 1]),
                 *boundary = c_boundary_.row(shared);
    const double *pj = p.row(j), *below = p.row(j - 1), *above = p.row(j + 1), *bj = b.row(j);
    double* r = r_.row(j);
    vector_loop(0, nx_, [&](int i) {
      const double sum = x[i] + x[i + 1] + y[i] + north[i] + boundary[i];
      const double flux = x[i] * (pj[i] - pj[i - 1]) + x[i + 1] * (pj[i] - pj[i + 1]) + y[i] * (pj[i] - below[i]) +
                          north[i] * (pj[i] - above[i]) + boundary[i] * pj[i];
      r[i] = sum > 0 ? bj[i] - flux : 0.0;
    });
    return base::vector_sum(0, nx_, [&](int i) { return r[i] * r[i]; });
  });
  return std::sqrt(squares);
}

void PressureSolver::remove_mean(base::Field& a) {
  const double mean = base::ordered_sum(0, ny_, partial_,
                                        [&](int j) {
                                          const double* v = a.row(j);
                                          return base::vector_sum(0, nx_, [&](int i) { return v[i]; });
                                        }) /
                      fluid_cells_;
  for_each_item(0, ny_, [&](int j) {
    const double *x = c_x_.row(j), *y = c_y_.row(j), *north = c_y_.row(j + 1);
    double* v = a.row(j);
    vector_loop(0, nx_, [&](int i) { v[i] = x[i] + x[i + 1] + y[i] + north[i] > 0 ? v[i] - mean : 0.0; });
  });
}

void PressureSolver::correct_columns(base::Field& p) {
  for (std::vector<double>* sums : {&column_, &column_x_, &column_boundary_, &slope_}) sums->assign(nx_ + 1, 0.0);
  for (int j = 0; j < ny_; ++j) {
    const double *r = r_.row(j), *x = c_x_.row(j), *b = c_boundary_.row(j);
    for (int i = 0; i < nx_; ++i) column_[i] += r[i], column_x_[i] += x[i], column_boundary_[i] += b[i];
  }
  // Pivots as in Multigrid::factor: sums of positive numbers.
  double excess = 0, d = 0;
  for (int i = 0; i < nx_; ++i) {
    const double west = i > 0 ? column_x_[i] : 0.0, east = i + 1 < nx_ ? column_x_[i + 1] : 0.0;
    excess = column_boundary_[i] + (west > 0 ? west * excess / d : 0.0);
    d = excess + east;
    const double pivot = d > 0 ? 1.0 / d : 0.0;  // a floating pressure keeps 0 in its last column
    slope_[i] = east * pivot;
    column_[i] = (column_[i] + (i > 0 ? west * column_[i - 1] : 0.0)) * pivot;
  }
  for (int i = nx_ - 2; i >= 0; --i) column_[i] += slope_[i] * column_[i + 1];
  for_each_item(0, ny_, [&](int j) {
    const double *x = c_x_.row(j), *y = c_y_.row(j), *north = c_y_.row(j + 1);
    double* pj = p.row(j);
    vector_loop(0, nx_, [&](int i) { pj[i] += x[i] + x[i + 1] + y[i] + north[i] > 0 ? column_[i] : 0.0; });
  });
}

SolveReport PressureSolver::solve(base::Field& p, const base::Field& b, double tolerance, int most) {
  SolveReport report;
  const auto norm_of_b = [&] {
    return std::sqrt(base::ordered_sum(0, ny_, partial_, [&](int j) {
      const double* bj = b.row(j);
      return base::vector_sum(0, nx_, [&](int i) { return bj[i] * bj[i]; });
    }));
  };
  const double target = tolerance * norm_of_b();
  report.before = report.after = residual(p, b);
  // A long wave leaves rounding errors that may be no smaller than what was there before; but they are rough, and gone
  // after the next refinement.
  constexpr int setbacks_allowed = 3;
  constexpr double slow = 0.1;  // a refinement that leaves more than this calls for the columns
  double best = std::numeric_limits<double>::infinity(), last = best;
  int setbacks = 0;
  while (!(report.after <= target)) {  // also true for NaN
    if (!(report.after < best)) ++setbacks;
    if (report.iterations >= most || setbacks > setbacks_allowed)
      base::fail(base::Exit::diverged,
                 "pressure: residual {:.3g} after {} iterations, {:.3g} was asked for (flow.pressure_tolerance, "
                 "flow.pressure_iterations)",
                 report.after, report.iterations, target);
    if (report.after > slow * last) {
      correct_columns(p);
      report.after = residual(p, b);
      if (report.after <= target) break;
    }
    last = report.after;
    best = std::min(best, report.after);
    if (floating_) remove_mean(r_);
    const double scale = report.after;  // keeps single precision in the middle of its range
    const double inverse = 1.0 / scale;
    Split& right = multigrid_.right();
    for_each_item(0, ny_, [&](int j) {
      const double* r = r_.row(j);
      float *F = right.F.row(j), *C = right.C.row(j);
      vector_loop(0, right.F.nm, [&](int m) { F[m] = static_cast<float>(inverse * r[2 * m]); });
      vector_loop(0, right.C.nm, [&](int m) { C[m] = static_cast<float>(inverse * r[2 * m + 1]); });
    });
    // A little further than asked, so that the residual taken anew is not a hair above the target.
    const double factor = std::max(0.9 * target / report.after, single_factor);
    report.iterations += multigrid_.solve(factor, std::min(a_refinement, most - report.iterations));
    const Split& x = multigrid_.solution();
    for_each_item(0, ny_, [&](int j) {
      double* pj = p.row(j);
      const float *F = x.F.row(j), *C = x.C.row(j);
      vector_loop(0, x.F.nm, [&](int m) { pj[2 * m] += scale * static_cast<double>(F[m]); });
      vector_loop(0, x.C.nm, [&](int m) { pj[2 * m + 1] += scale * static_cast<double>(C[m]); });
    });
    report.after = residual(p, b);
  }
  if (floating_) remove_mean(p);
  return report;
}

}  // namespace livebed::flow
