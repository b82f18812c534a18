#include "flow/pressure.hpp"

#include <cmath>

#include "base/fault.hpp"
#include "base/loops.hpp"

namespace livebed::flow {

using base::for_each_item;
using base::vector_loop;

namespace {

/// Field (x fastest) <-> columns split by colour.
void split(const base::Field& f, Split<double>& s) {
  for_each_item(0, f.ny(), [&](int j) {
    const double* from = f.row(j);
    double *even = s.F.row(j), *odd = s.C.row(j);
    for (int m = 0; m < s.F.nm; ++m) even[m] = from[2 * m];
    for (int m = 0; m < s.C.nm; ++m) odd[m] = from[2 * m + 1];
  });
}

void join(const Split<double>& s, base::Field& f) {
  for_each_item(0, f.ny(), [&](int j) {
    double* to = f.row(j);
    const double *even = s.F.row(j), *odd = s.C.row(j);
    for (int m = 0; m < s.F.nm; ++m) to[2 * m] = even[m];
    for (int m = 0; m < s.C.nm; ++m) to[2 * m + 1] = odd[m];
  });
}

/// update(a, b, ...) element by element over both colours.
template <class Update, class First, class... Rest>
void for_each_value(Update&& update, First& first, Rest&... rest) {
  for_each_item(0, first.F.ny, [&](int j) {
    const auto one = [&](int n, auto*... p) { vector_loop(0, n, [&](int m) { update(p[m]...); }); };
    one(first.F.nm, first.F.row(j), rest.F.row(j)...);
    one(first.C.nm, first.C.row(j), rest.C.row(j)...);
  });
}

}  // namespace

PressureSolver::PressureSolver(int nx, int ny) : nx_(nx), ny_(ny), a_(nx, ny), multigrid_(nx, ny) {
  diagonal_ = open_ = x_ = r_ = z_ = d_ = q_ = Split<double>(nx, ny);
}

void PressureSolver::set_coefficients(const base::Field& c_x, const base::Field& c_y, const base::Field& c_boundary) {
  floating_ = true;
  fluid_cells_ = 0;
  for (int j = 0; j < ny_; ++j) {
    for (int i = 0; i < nx_; ++i) {
      const int m = i / 2;
      const bool odd = i % 2;
      const double west = i > 0 ? c_x(i, j) : 0, east = i + 1 < nx_ ? c_x(i + 1, j) : 0;
      const double south = j > 0 ? c_y(i, j) : 0, north = j + 1 < ny_ ? c_y(i, j + 1) : 0;
      const double boundary = c_boundary(i, j);
      if (!odd) a_.west.row(j)[m] = west, a_.east.row(j)[m] = east;
      (odd ? a_.north.C : a_.north.F).row(j)[m] = north;
      (odd ? a_.extra.C : a_.extra.F).row(j)[m] = boundary;
      const double sum = west + east + south + north + boundary;
      (odd ? diagonal_.C : diagonal_.F).row(j)[m] = sum > 0 ? sum : 1.0;
      (odd ? open_.C : open_.F).row(j)[m] = sum > 0 ? 1.0 : 0.0;
      if (sum > 0) fluid_cells_ += 1;
      if (boundary > 0) floating_ = false;
    }
  }
  multigrid_.set(a_);
}

void PressureSolver::apply_operator(const Split<double>& p, Split<double>& q) const {
  for_each_item(0, ny_, [&](int j) {
    const auto colour = [&](const Columns<double>& diagonal, const Columns<double>& north, const double* w,
                            const double* e, const Columns<double>& own, const double* other, Columns<double>& out) {
      const double *d = diagonal.row(j), *n = north.row(j), *s = north.row(j > 0 ? j - 1 : 0);
      const double *pj = own.row(j), *below = own.row(j > 0 ? j - 1 : 0), *above = own.row(j + 1 < ny_ ? j + 1 : j);
      const double south = j > 0 ? 1 : 0;  // the top row's north coefficient is 0 already
      double* qj = out.row(j);
      vector_loop(0, own.nm, [&](int m) {
        qj[m] = d[m] * pj[m] - w[m] * other[m] - e[m] * other[m + 1] - south * s[m] * below[m] - n[m] * above[m];
      });
    };
    colour(diagonal_.F, a_.north.F, a_.west.row(j), a_.east.row(j), p.F, p.C.row(j) - 1, q.F);
    colour(diagonal_.C, a_.north.C, a_.east.row(j), a_.west.row(j) + 1, p.C, p.F.row(j), q.C);
  });
}

double PressureSolver::dot(const Split<double>& a, const Split<double>& b) {
  return base::ordered_sum(0, ny_, partial_, [&](int j) {
    const double *aF = a.F.row(j), *bF = b.F.row(j), *aC = a.C.row(j), *bC = b.C.row(j);
    return base::vector_sum(0, a.F.nm, [&](int m) { return aF[m] * bF[m]; }) +
           base::vector_sum(0, a.C.nm, [&](int m) { return aC[m] * bC[m]; });
  });
}

void PressureSolver::remove_mean(Split<double>& a) {
  if (!floating_) return;
  const double mean = dot(a, open_) / fluid_cells_;
  for_each_value([mean](double& value, double open) { value = (value - mean) * open; }, a, open_);
}

SolveReport PressureSolver::solve(base::Field& p, const base::Field& b, double tolerance, int most) {
  SolveReport report;
  split(b, r_);
  split(p, x_);
  for_each_value([](double& x, double& r, double open) { x *= open, r *= open; }, x_, r_, open_);
  remove_mean(r_);
  const double target = tolerance * std::sqrt(dot(r_, r_));
  apply_operator(x_, q_);
  for_each_value([](double& r, double q) { r -= q; }, r_, q_);
  report.before = report.after = std::sqrt(dot(r_, r_));
  double rz_old = 1;
  while (!(report.after <= target)) {  // also true for NaN
    if (report.iterations == most || !std::isfinite(report.after))
      base::fail(base::Exit::diverged,
                 "pressure: residual {:.3g} after {} iterations, {:.3g} was asked for (flow.pressure_tolerance, "
                 "flow.pressure_iterations)",
                 report.after, report.iterations, target);
    multigrid_.apply(r_, z_);
    remove_mean(z_);
    const double rz = dot(r_, z_);
    const double beta = report.iterations == 0 ? 0.0 : rz / rz_old;
    for_each_value([beta](double& d, double z) { d = z + beta * d; }, d_, z_);
    apply_operator(d_, q_);
    const double step = rz / dot(d_, q_);
    for_each_value([step](double& x, double& r, double d, double q) { x += step * d, r -= step * q; }, x_, r_, d_, q_);
    rz_old = rz;
    report.after = std::sqrt(dot(r_, r_));
    ++report.iterations;
  }
  remove_mean(x_);
  join(x_, p);
  return report;
}

}  // namespace livebed::flow
