#include "flow/mapping.hpp"

#include <algorithm>

#include "flow/constants.hpp"

namespace livebed::flow {

namespace {

/// Index a and weight so that x lies between nodes a and a + 1; clamped to the ends.
struct Place {
  int a;
  double weight;
};
Place find(const std::vector<double>& nodes, double x) {
  const int last = static_cast<int>(nodes.size()) - 2;
  const int a =
      std::clamp(static_cast<int>(std::upper_bound(nodes.begin(), nodes.end(), x) - nodes.begin()) - 1, 0, last);
  return {a, std::clamp((x - nodes[a]) / (nodes[a + 1] - nodes[a]), 0.0, 1.0)};
}

std::vector<double> centres(const std::vector<double>& faces) {
  std::vector<double> c;
  for (std::size_t i = 0; i + 1 < faces.size(); ++i) c.push_back(0.5 * (faces[i] + faces[i + 1]));
  return c;
}

void map_field(const base::Field& from, const std::vector<double>& x, const std::vector<double>& y, base::Field& to,
               const std::vector<double>& to_x, const std::vector<double>& to_y) {
  for (std::size_t j = 0; j < to_y.size(); ++j) {
    const Place py = find(y, to_y[j]);
    for (std::size_t i = 0; i < to_x.size(); ++i) {
      const Place px = find(x, to_x[i]);
      const auto along = [&](int row) { return (1 - px.weight) * from(px.a, row) + px.weight * from(px.a + 1, row); };
      to(static_cast<int>(i), static_cast<int>(j)) = (1 - py.weight) * along(py.a) + py.weight * along(py.a + 1);
    }
  }
}

}  // namespace

void map_flow(const Solver& from, Solver& to) {
  const Mesh &a = from.mesh(), &b = to.mesh();
  const std::vector<double> ax = centres(a.x), ay = centres(a.y), bx = centres(b.x), by = centres(b.y);
  State& s = to.state;
  map_field(from.state.u, a.x, ay, s.u, b.x, by);
  map_field(from.state.v, ax, a.y, s.v, bx, b.y);
  map_field(from.state.p, ax, ay, s.p, bx, by);
  map_field(from.state.k, ax, ay, s.k, bx, by);
  map_field(from.state.epsilon, ax, ay, s.epsilon, bx, by);
  map_field(from.state.nut, ax, ay, s.nut, bx, by);
  for (int j = 0; j < b.ny; ++j)
    for (int i = 0; i < b.nx; ++i) {
      if (b.aperture_x(i, j) <= 0) s.u(i, j) = 0;
      if (b.aperture_y(i, j) <= 0) s.v(i, j) = 0;
      if (b.volume(i, j) <= 0) s.k(i, j) = k_floor, s.epsilon(i, j) = epsilon_floor, s.nut(i, j) = 0;
    }
  fill_velocity_ghosts(b, to.boundary(), s.u, s.v);
  fill_scalar_ghosts(b, nullptr, s.nut);
  s.u_old = s.u, s.v_old = s.v, s.k_old = s.k, s.epsilon_old = s.epsilon;
  for (base::Field* f : {&s.p_change, &s.convection_u, &s.convection_v, &s.convection_k, &s.convection_e}) f->fill(0.0);
  s.step = 0;
}

}  // namespace livebed::flow
