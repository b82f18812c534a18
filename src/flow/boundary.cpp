#include "flow/boundary.hpp"

#include <algorithm>
#include <cmath>

#include "base/fault.hpp"
#include "base/math.hpp"
#include "flow/constants.hpp"
#include "flow/profiles.hpp"

namespace livebed::flow {

using base::square;

double wall_friction(Wall wall, double speed, double y, double ks, double nu) {
  switch (wall) {
    case Wall::slip:
      return 0;
    case Wall::no_slip:
      return nu / y;
    case Wall::rough: {
      const double log_y = std::log(std::max(rough_scale * y / ks, log_argument_least));
      return std::max(square(kappa / log_y) * speed, nu / y);
    }
    case Wall::smooth: {
      // u*: fixed point of u* = kappa U / ln(E u* y / nu), from the laminar value upwards; contracts by 1/ln(E y+).
      double u_star = std::sqrt(nu * speed / y);
      if (u_star * y / nu < 11.0) return nu / y;
      for (int n = 0; n < 8; ++n)
        u_star = kappa * speed / std::log(std::max(smooth_E * u_star * y / nu, log_argument_least));
      return std::max(square(u_star) / speed, nu / y);
    }
  }
  return 0;
}

double spalding_friction(double speed, double y, double nu) {
  const double reynolds = speed * y / nu;  // u+ y+
  if (reynolds < 1e-6) return nu / y;
  // y+ = u+ + (exp(a) - 1 - a - a^2/2 - a^3/6)/E, a = kappa u+.  Newton from above: the function is convex.
  double u = std::min(std::sqrt(reynolds), std::log(1.0 + smooth_E * reynolds) / kappa);
  for (int n = 0; n < 20; ++n) {
    const double a = kappa * u, growth = std::exp(a);
    const double y_plus = u + (growth - 1.0 - a * (1.0 + a * (0.5 + a / 6.0))) / smooth_E;
    const double slope = 1.0 + kappa * (growth - 1.0 - a * (1.0 + 0.5 * a)) / smooth_E;
    const double change = (u * y_plus - reynolds) / (y_plus + u * slope);
    u -= change;
    if (std::abs(change) < 1e-12 * u) break;
  }
  return speed / square(u);
}

double wall_friction(Closure closure, Wall wall, double speed, double y, double ks, double nu) {
  if (transports_omega(closure) && wall == Wall::smooth) return spalding_friction(speed, y, nu);
  return wall_friction(wall, speed, y, ks, nu);
}

double wall_k(double u_star) { return std::max(k_floor, square(u_star) / std::sqrt(launder_spalding.c_mu)); }

double wall_epsilon(double u_star, double y, double nu, bool damped) {
  const double damping = damped ? 1.0 - std::exp(-u_star * y / (van_driest * nu)) : 1.0;
  return std::max(epsilon_floor, damping > 0 ? base::cube(u_star) / (kappa * y * damping) : 0.0);
}

Column developed_column(const std::vector<double>& y, double h, double u_star, double ks, double nu) {
  // Own fine grid, logarithmic towards the bed, from a wall-function point at z = ks up; the stress is known exactly,
  // u*^2 (1 - y/h), so only k and epsilon are iterated (implicitly in time) and u is integrated at the end.
  const int n = 400;
  const double first = std::min(std::max(ks, 1e-3 * h), 0.1 * h);
  std::vector<double> z(n), k(n), e(n), nut(n);
  for (int i = 0; i < n; ++i) z[i] = first * std::pow(h / first, (i + 0.5) / n);
  for (int i = 0; i < n; ++i) {
    k[i] = equilibrium_k(z[i], h, u_star);
    e[i] = equilibrium_epsilon(z[i], h, u_star);
  }
  const auto eddy = [&] {
    for (int i = 0; i < n; ++i) nut[i] = launder_spalding.c_mu * square(k[i]) / e[i];
  };
  const double step = 0.05 * h / u_star;
  std::vector<double> lower(n), upper(n), middle(n), right(n);
  const auto sweep = [&](std::vector<double>& c, double sigma, double wall_value, auto&& production, auto&& decay) {
    double change = 0;
    for (int i = 0; i < n; ++i) {
      const auto conduct = [&](int a, int b) { return (nu + 0.5 * (nut[a] + nut[b]) / sigma) / (z[b] - z[a]); };
      const double size = (i + 1 < n ? 0.5 * (z[i] + z[i + 1]) : h) - (i > 0 ? 0.5 * (z[i - 1] + z[i]) : first);
      lower[i] = i > 0 ? conduct(i - 1, i) / size : 0;
      upper[i] = i + 1 < n ? conduct(i, i + 1) / size : 0;
      middle[i] = 1 / step + lower[i] + upper[i] + decay(i);
      right[i] = c[i] / step + production(i);
    }
    lower[0] = upper[0] = 0, middle[0] = 1, right[0] = wall_value;
    for (int i = 1; i < n; ++i) {
      const double f = lower[i] / middle[i - 1];
      middle[i] -= f * upper[i - 1];
      right[i] += f * right[i - 1];
    }
    for (int i = n - 1; i >= 0; --i) {
      const double value = (right[i] + (i + 1 < n ? upper[i] * right[i + 1] : 0.0)) / middle[i];
      change = std::max(change, std::abs(value - c[i]) / c[i]);
      c[i] = right[i] = value;
    }
    return change;
  };
  double change = 1;
  for (int it = 0; it < 20000 && change > 1e-9; ++it) {
    eddy();
    const auto produced = [&](int i) { return square(square(u_star) * (1 - z[i] / h)) * nut[i] / square(nu + nut[i]); };
    const double dk = sweep(k, launder_spalding.sigma_k, wall_k(u_star), produced, [&](int i) { return e[i] / k[i]; });
    const double de = sweep(
        e, launder_spalding.sigma_epsilon, base::cube(u_star) / (kappa * z[0]),
        [&](int i) { return launder_spalding.c1 * produced(i) * e[i] / k[i]; },
        [&](int i) { return launder_spalding.c2 * e[i] / k[i]; });
    change = std::max(dk, de);
  }
  if (!(change <= 1e-9))
    base::fail(base::Exit::diverged, "developed inlet profile: relative change still {:.2g} after 20000 iterations",
               change);
  eddy();
  std::vector<double> u(n);
  u[0] = log_law(z[0], u_star, ks / rough_scale);
  for (int i = 1; i < n; ++i) {
    const auto slope = [&](int a) { return square(u_star) * (1 - z[a] / h) / (nu + nut[a]); };
    // Trapezoid in ln z, in which the profile is nearly straight.
    u[i] = u[i - 1] + 0.5 * (z[i] * slope(i) + z[i - 1] * slope(i - 1)) * std::log(z[i] / z[i - 1]);
  }
  Column result;
  for (double yi : y) {
    if (yi <= z[0]) {
      result.u.push_back(log_law(yi, u_star, ks / rough_scale));
      result.k.push_back(wall_k(u_star));
      result.epsilon.push_back(base::cube(u_star) / (kappa * std::max(yi, ks / rough_scale)));
      continue;
    }
    const int b =
        static_cast<int>(std::min<std::ptrdiff_t>(n - 1, std::lower_bound(z.begin(), z.end(), yi) - z.begin()));
    const double f = std::min(1.0, (yi - z[b - 1]) / (z[b] - z[b - 1]));
    const auto between = [&](const std::vector<double>& c) { return c[b - 1] + f * (c[b] - c[b - 1]); };
    result.u.push_back(between(u)), result.k.push_back(between(k)), result.epsilon.push_back(between(e));
  }
  return result;
}

Boundary make_boundary(const Mesh& mesh, const Params& params) {
  Boundary b;
  b.floor = params.floor;
  b.floor_roughness = params.floor_roughness;
  const CurrentParams& c = params.current;
  const double h = mesh.height() - c.bed_level;
  b.inlet_u.assign(mesh.ny, 0.0);
  b.inlet_k.assign(mesh.ny, k_floor);
  b.inlet_epsilon.assign(mesh.ny, epsilon_floor);
  std::vector<double> heights;
  for (int j = 0; j < mesh.ny; ++j) heights.push_back(std::max(1e-9, mesh.centre_y(j) - c.bed_level));
  Column column;
  if (c.profile == Profile::developed)
    column = developed_column(heights, h, c.shear_velocity, c.roughness, params.viscosity);
  const double z0 = zero_level(c.profile, c.roughness, c.shear_velocity, params.viscosity);
  for (int j = 0; j < mesh.ny; ++j) {
    // The share of the face above the bed carries water; the rest is sand.
    const double wet = std::clamp((mesh.y[j + 1] - c.bed_level) / mesh.dy(j), 0.0, 1.0);
    if (wet <= 0) continue;
    const double y = wet < 1 ? 0.5 * (mesh.y[j + 1] - c.bed_level) : heights[j];
    switch (c.profile) {
      case Profile::uniform:
        b.inlet_u[j] = wet * c.mean_speed;
        break;
      case Profile::developed:
        b.inlet_u[j] = wet * column.u[j];
        break;
      default:
        b.inlet_u[j] = wet * log_law(y, c.shear_velocity, z0);
    }
    if (params.closure == Closure::laminar) continue;
    b.inlet_k[j] = c.profile == Profile::developed ? column.k[j] : equilibrium_k(y, h, c.shear_velocity);
    b.inlet_epsilon[j] =
        c.profile == Profile::developed ? column.epsilon[j] : equilibrium_epsilon(std::max(y, z0), h, c.shear_velocity);
  }
  return b;
}

void fill_velocity_ghosts(const Mesh& mesh, const Boundary& b, base::Field& u, base::Field& v) {
  const int nx = mesh.nx, ny = mesh.ny;
  const auto tangential = [](Wall wall) { return wall == Wall::no_slip ? -1.0 : 1.0; };
  const double at_west = tangential(b.west), at_east = tangential(b.east);
  for (int j = 0; j < ny; ++j) {
    if (b.inlet) {
      u(0, j) = b.inlet_u[j];
      u(-1, j) = u(-2, j) = u(0, j);
      v(-1, j) = -v(0, j), v(-2, j) = -v(1, j);
    } else {
      u(0, j) = 0;
      u(-1, j) = -u(1, j), u(-2, j) = -u(2, j);
      v(-1, j) = at_west * v(0, j), v(-2, j) = at_west * v(1, j);
    }
    if (b.outlet) {
      u(nx + 1, j) = u(nx, j);
      v(nx, j) = v(nx + 1, j) = v(nx - 1, j);
    } else {
      u(nx, j) = 0;
      u(nx + 1, j) = -u(nx - 1, j);
      v(nx, j) = at_east * v(nx - 1, j), v(nx + 1, j) = at_east * v(nx - 2, j);
    }
  }
  const double below = tangential(b.floor), above = tangential(b.top),
               lid = b.top == Wall::no_slip ? 2 * b.top_speed : 0;
  for (int i = -2; i < nx + 2; ++i) {
    u(i, -1) = below * u(i, 0), u(i, -2) = below * u(i, 1);
    u(i, ny) = lid + above * u(i, ny - 1), u(i, ny + 1) = lid + above * u(i, ny - 2);
    v(i, 0) = v(i, ny) = 0;
    v(i, -1) = -v(i, 1), v(i, -2) = -v(i, 2);
    v(i, ny + 1) = -v(i, ny - 1);
  }
}

void fill_scalar_ghosts(const Mesh& mesh, const std::vector<double>* inlet, base::Field& c) {
  const int nx = mesh.nx, ny = mesh.ny;
  for (int j = 0; j < ny; ++j) {
    c(-1, j) = inlet ? (*inlet)[j] : c(0, j);
    c(-2, j) = inlet ? (*inlet)[j] : c(1, j);
    c(nx, j) = c(nx + 1, j) = c(nx - 1, j);
  }
  for (int i = -2; i < nx + 2; ++i) {
    c(i, -1) = c(i, 0), c(i, -2) = c(i, 1);
    c(i, ny) = c(i, ny - 1), c(i, ny + 1) = c(i, ny - 2);
  }
}

}  // namespace livebed::flow
