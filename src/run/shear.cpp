#include "run/shear.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "flow/profiles.hpp"

namespace livebed::run {

double measured_shields(const casefile::Case& c, const flow::Solver& flow, double level) {
  const flow::Mesh& m = flow.mesh();
  const flow::State& s = flow.state;
  const double rho = c.flow.density;
  // Upstream of the pipe, out of reach of the inlet; without a pipe the middle of the box.
  const bool pipe = c.flow.pipe.present;
  const double from = pipe ? 0.25 * c.flow.pipe.x : 0.3 * m.length();
  const double to = pipe ? c.flow.pipe.x - 1.5 * c.flow.pipe.diameter : 0.9 * m.length();
  const int plane =
      static_cast<int>(std::lower_bound(m.y.begin(), m.y.end() - 1, level - 1e-9 * m.height()) - m.y.begin());
  // Where the bed sinks and the hole draws water down, the mean flow carries momentum through the plane, too: that is
  // no friction, and no part of the stress.
  double mean_u = 0, mean_v = 0;
  const auto speeds_at_bed = [&](int i) {
    return base::Vec2{0.5 * (s.u(i, plane) + s.u(i, plane - 1)), 0.5 * (s.v(i, plane) + s.v(i - 1, plane))};
  };
  const auto stress_at_bed = [&](int i) {
    const double nut = 0.25 * (s.nut(i - 1, plane - 1) + s.nut(i, plane - 1) + s.nut(i - 1, plane) + s.nut(i, plane));
    const double shear =
        (s.u(i, plane) - s.u(i, plane - 1)) / m.dy_face(plane) + (s.v(i, plane) - s.v(i - 1, plane)) / m.dx_face(i);
    const base::Vec2 speed = speeds_at_bed(i);
    const double water = flow.at_u().open_y(i, plane);
    double drag = 0;
    for (int j = plane; j < std::min(m.ny, s.load.top); ++j)
      drag += (s.load.beta_u(i, j) * s.u(i, j) - s.load.force_u(i, j)) * flow.at_u().open_volume(i, j) * m.dy(j);
    return water * rho * ((c.flow.viscosity + nut) * shear - (speed.x - mean_u) * (speed.y - mean_v)) + drag;
  };
  double length = 0;
  for (int i = 1; i < m.nx; ++i) {
    if (m.x[i] < from || m.x[i] > to) continue;
    const double width = m.dx_face(i);
    length += width;
    if (!pipe || plane == 0) continue;
    mean_u += width * speeds_at_bed(i).x, mean_v += width * speeds_at_bed(i).y;
  }
  if (length == 0) return 0;
  mean_u /= length, mean_v /= length;
  double stress = 0;
  for (int i = 1; i < m.nx; ++i) {
    if (m.x[i] < from || m.x[i] > to) continue;
    const double width = m.dx_face(i);
    stress += width * (plane > 0 ? stress_at_bed(i) : rho * base::square(flow.floor_shear_velocity(i)));
  }
  const double u_star = std::sqrt(std::max(0.0, stress / length) / rho);
  return flow::shields(u_star, c.grains.density / rho, c.grains.gravity, c.grains.diameter);
}

void recycle_inlet(const casefile::Case& c, double level, double dt, flow::Solver& flow) {
  const flow::Mesh& m = flow.mesh();
  const flow::State& s = flow.state;
  flow::Column mean{std::vector<double>(m.ny), std::vector<double>(m.ny), std::vector<double>(m.ny)};
  for (int j = 0; j < m.ny; ++j) {
    for (int i = 0; i < m.nx; ++i) {
      const double share = m.dx(i) / m.length();
      mean.u[j] += share * s.u(i + 1, j) * flow.at_c().open_volume(i, j);
      mean.k[j] += share * s.k(i, j);
      mean.epsilon[j] += share * s.epsilon(i, j);
    }
  }
  const double lag = (m.height() - level) / c.flow.current.shear_velocity;
  const double missing = 1.0 - measured_shields(c, flow, level) / c.theta;
  for (double& u : mean.u) u *= 1.0 + 0.5 * std::clamp(missing, -1.0, 1.0) * dt / lag;
  flow.set_inlet(mean);
}

double risen_share(double time, double rise) {
  constexpr double at_first = 0.1;  // a hundredth of the shear stress
  return std::clamp(time / rise, at_first, 1.0);
}

void scale_inlet(const flow::Column& full, double share, flow::Solver& flow) {
  flow::Column now = full;
  for (double& u : now.u) u *= share;
  for (double& k : now.k) k = std::max(flow::k_floor, k * base::square(share));
  for (double& e : now.epsilon) e = std::max(flow::epsilon_floor, e * base::cube(share));
  flow.set_inlet(now);
}

}  // namespace livebed::run
