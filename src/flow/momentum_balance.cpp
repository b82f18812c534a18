#include "flow/momentum_balance.hpp"

#include "base/fault.hpp"

namespace livebed::flow {

using base::Vec2;

Box box_around_pipe(const Mesh& m, double half) {
  const auto around = [](const std::vector<double>& faces, double centre, double reach, int& from, int& to) {
    const int n = static_cast<int>(faces.size()) - 1;
    from = n, to = 0;
    while (from > 0 && faces[from] > centre - reach) --from;
    while (to < n && faces[to] < centre + reach) ++to;
    return from > 0 && to < n;
  };
  Box box;
  const bool in_x = around(m.x, m.pipe.x, half, box.i0, box.i1), in_y = around(m.y, m.pipe.y, half, box.j0, box.j1);
  if (!in_x || !in_y) base::fail(base::Exit::internal, "a box of {} m round the pipe does not fit into the grid", half);
  return box;
}

Vec2 momentum_inflow(const Params& params, const Mesh& m, const State& s, const Box& box) {
  const double nu = params.viscosity, per_density = 1 / params.density;
  // At the middle of west face (i,j): velocity u, v and the stresses of Eq. 2-3 over the density.
  const auto through_x = [&](int i, int j) {
    const double f = 0.5 * m.dx(i - 1) / m.dx_face(i);
    const auto between = [f](double west, double east) { return (1 - f) * west + f * east; };
    const double u = s.u(i, j), p = between(s.p(i - 1, j), s.p(i, j));
    const double v_west = 0.5 * (s.v(i - 1, j) + s.v(i - 1, j + 1)), v_east = 0.5 * (s.v(i, j) + s.v(i, j + 1));
    const double gamma = nu + between(s.nut(i - 1, j), s.nut(i, j));
    const double dudx = (s.u(i + 1, j) - s.u(i - 1, j)) / (m.dx(i) + m.dx(i - 1));
    const double dudy = (s.u(i, j + 1) - s.u(i, j - 1)) / (m.dy_face(j) + m.dy_face(j + 1));
    const double dvdx = (v_east - v_west) / m.dx_face(i);
    return Vec2{(u * u + p * per_density - 2 * gamma * dudx) * m.dy(j),
                (u * between(v_west, v_east) - gamma * (dudy + dvdx)) * m.dy(j)};
  };
  const auto through_y = [&](int i, int j) {
    const double f = 0.5 * m.dy(j - 1) / m.dy_face(j);
    const auto between = [f](double south, double north) { return (1 - f) * south + f * north; };
    const double v = s.v(i, j), p = between(s.p(i, j - 1), s.p(i, j));
    const double u_south = 0.5 * (s.u(i, j - 1) + s.u(i + 1, j - 1)), u_north = 0.5 * (s.u(i, j) + s.u(i + 1, j));
    const double gamma = nu + between(s.nut(i, j - 1), s.nut(i, j));
    const double dvdy = (s.v(i, j + 1) - s.v(i, j - 1)) / (m.dy(j) + m.dy(j - 1));
    const double dvdx = (s.v(i + 1, j) - s.v(i - 1, j)) / (m.dx_face(i) + m.dx_face(i + 1));
    const double dudy = (u_north - u_south) / m.dy_face(j);
    return Vec2{(v * between(u_south, u_north) - gamma * (dudy + dvdx)) * m.dx(i),
                (v * v + p * per_density - 2 * gamma * dvdy) * m.dx(i)};
  };
  Vec2 sum;
  const auto add = [&sum](const Vec2& in, const Vec2& out) { sum.x += in.x - out.x, sum.y += in.y - out.y; };
  for (int j = box.j0; j < box.j1; ++j) add(through_x(box.i0, j), through_x(box.i1, j));
  for (int i = box.i0; i < box.i1; ++i) add(through_y(i, box.j0), through_y(i, box.j1));
  return {params.density * sum.x, params.density * sum.y};
}

Vec2 momentum_inside(const Params& params, const Mesh& m, const State& s, const Box& box) {
  Vec2 sum;
  for (int j = box.j0; j < box.j1; ++j)
    for (int i = box.i0; i < box.i1; ++i) {
      const double half = 0.5 * m.dx(i) * m.dy(j);
      sum.x += half * (m.aperture_x(i, j) * s.u(i, j) + m.aperture_x(i + 1, j) * s.u(i + 1, j));
      sum.y += half * (m.aperture_y(i, j) * s.v(i, j) + m.aperture_y(i, j + 1) * s.v(i, j + 1));
    }
  return {params.density * sum.x, params.density * sum.y};
}

}  // namespace livebed::flow
