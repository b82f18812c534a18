#include "flow/operators.hpp"

namespace livebed::flow {

namespace {

/// As many rows side by side as a vector has lanes.
template <int rows>
void solve_together(const Staggering& at, const RowSystem* systems) {
  double above[rows] = {}, slope[rows] = {};
  const double* per_width = at.per_width.data() + 2;
  for (int i = at.i0; i < at.i1; ++i)
    for (int r = 0; r < rows; ++r) {
      const RowSystem& a = systems[r];
      const double scale = per_width[i] * a.per_inertia[i];
      const double west = scale * a.k[i], east = scale * a.k[i + 1];
      const double pivot = 1.0 / (a.factor[i] + west + east - west * slope[r]);
      slope[r] = east * pivot;
      above[r] = (a.d[i] + west * above[r]) * pivot;
      a.slope[i] = slope[r];
      a.d[i] = above[r];
    }
  for (int r = 0; r < rows; ++r) above[r] = 0;
  for (int i = at.i1 - 1; i >= at.i0; --i)
    for (int r = 0; r < rows; ++r) systems[r].d[i] = above[r] = systems[r].d[i] + systems[r].slope[i] * above[r];
}

}  // namespace

void solve_rows(const Staggering& at, const RowSystem* rows, int count) {
  int first = 0;
  for (; first + 8 <= count; first += 8) solve_together<8>(at, rows + first);
  for (; first < count; ++first) solve_together<1>(at, rows + first);
}

}  // namespace livebed::flow
