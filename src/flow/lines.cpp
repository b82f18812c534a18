#include "flow/lines.hpp"

#include <algorithm>
#include <cmath>

#include "base/loops.hpp"

namespace livebed::flow {

using base::Field;
using base::for_each_item;

LineSystem::LineSystem(const Mesh& m) {
  west = east = south = north = centre = rhs = correction = slope = Field(m.nx, m.ny);
}

void LineSystem::fix(int i, int j, double value) {
  west(i, j) = east(i, j) = south(i, j) = north(i, j) = 0.0;
  centre(i, j) = 1.0;
  rhs(i, j) = value;
}

namespace {

/// Rows j0 + colour, j0 + colour + 2, ...: a recurrence runs along a row, so eight rows go side by side.
void sweep_rows(const Staggering& at, int colour, LineSystem& a) {
  constexpr int together = 8;
  const int rows = (at.j1 - at.j0 - colour + 1) / 2;
  for_each_item(0, (rows + together - 1) / together, [&](int group) {
    const int first = at.j0 + colour + 2 * together * group;
    const int n = std::min(together, rows - group * together);
    double value[together] = {}, slope[together] = {};
    for (int i = at.i0; i < at.i1; ++i)
      for (int r = 0; r < n; ++r) {
        const int j = first + 2 * r;
        const double west = i > at.i0 ? a.west(i, j) : 0.0;
        const double known =
            a.rhs(i, j) + a.south(i, j) * a.correction(i, j - 1) + a.north(i, j) * a.correction(i, j + 1);
        const double pivot = 1.0 / (a.centre(i, j) - west * slope[r]);
        slope[r] = a.east(i, j) * pivot;
        value[r] = (known + west * value[r]) * pivot;
        a.slope(i, j) = slope[r];
        a.correction(i, j) = value[r];
      }
    for (int i = at.i1 - 2; i >= at.i0; --i)
      for (int r = 0; r < n; ++r)
        a.correction(i, first + 2 * r) += a.slope(i, first + 2 * r) * a.correction(i + 1, first + 2 * r);
  });
}

/// Columns i0 + colour, i0 + colour + 2, ...: vectors run across columns.
void sweep_columns(const Staggering& at, int colour, LineSystem& a) {
  constexpr int together = 32;
  const int columns = (at.i1 - at.i0 - colour + 1) / 2;
  for_each_item(0, (columns + together - 1) / together, [&](int group) {
    const int first = at.i0 + colour + 2 * together * group;
    const int n = std::min(together, columns - group * together);
    for (int j = at.j0; j < at.j1; ++j) {
      const double *west = a.west.row(j) + first, *east = a.east.row(j) + first, *south = a.south.row(j) + first,
                   *north = a.north.row(j) + first, *centre = a.centre.row(j) + first, *rhs = a.rhs.row(j) + first;
      const double *below = a.correction.row(j - 1) + first, *slope_below = a.slope.row(j - 1) + first;
      double *c = a.correction.row(j) + first, *slope = a.slope.row(j) + first;
      const double has_below = j > at.j0 ? 1.0 : 0.0;
      base::vector_loop(0, n, [&](int m) {
        const int i = 2 * m;
        const double known = rhs[i] + west[i] * c[i - 1] + east[i] * c[i + 1];
        const double pivot = 1.0 / (centre[i] - has_below * south[i] * slope_below[i]);
        slope[i] = north[i] * pivot;
        c[i] = (known + has_below * south[i] * below[i]) * pivot;
      });
    }
    for (int j = at.j1 - 2; j >= at.j0; --j) {
      const double *above = a.correction.row(j + 1) + first, *slope = a.slope.row(j) + first;
      double* c = a.correction.row(j) + first;
      base::vector_loop(0, n, [&](int m) { c[2 * m] += slope[2 * m] * above[2 * m]; });
    }
  });
}

}  // namespace

void sweep_lines(const Staggering& at, int sweeps, LineSystem& a) {
  a.correction.fill(0.0);
  for (int n = 0; n < sweeps; ++n) {
    for (const int colour : {0, 1}) sweep_rows(at, colour, a);
    for (const int colour : {0, 1}) sweep_columns(at, colour, a);
  }
}

double scaled_residual(const Staggering& at, const LineSystem& a, const Field& x, std::vector<double>& scratch) {
  const double mean = base::ordered_sum(at.j0, at.j1, scratch,
                                        [&](int j) {
                                          const double* row = x.row(j);
                                          return base::vector_sum(at.i0, at.i1, [&](int i) { return row[i]; });
                                        }) /
                      (static_cast<double>(at.i1 - at.i0) * (at.j1 - at.j0));
  double residual = 0, scale = 0;
  for (const bool of_scale : {false, true})
    (of_scale ? scale : residual) = base::ordered_sum(at.j0, at.j1, scratch, [&](int j) {
      const double *west = a.west.row(j), *east = a.east.row(j), *south = a.south.row(j), *north = a.north.row(j),
                   *centre = a.centre.row(j), *rhs = a.rhs.row(j), *here = x.row(j), *below = x.row(j - 1),
                   *above = x.row(j + 1);
      return base::vector_sum(at.i0, at.i1, [&](int i) {
        const double couplings = west[i] + east[i] + south[i] + north[i];
        const double applied = centre[i] * here[i] - west[i] * here[i - 1] - east[i] * here[i + 1] -
                               south[i] * below[i] - north[i] * above[i] - (centre[i] - couplings) * mean;
        const double term = of_scale ? std::abs(applied) + std::abs(rhs[i] + applied) : std::abs(rhs[i]);
        return couplings > 0 ? term : 0.0;
      });
    });
  return scale > 0 ? residual / scale : 0.0;
}

}  // namespace livebed::flow
