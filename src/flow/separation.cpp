#include "flow/separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.hpp"
#include "flow/constants.hpp"

namespace livebed::flow {

namespace {

constexpr double pi = Separation::never;
constexpr int sectors = 120;  ///< of 3 degrees
constexpr double sector = 2 * pi / sectors;

using Ring = std::array<double, sectors>;

/// Angle from the foremost point, upwards [rad], -pi to pi.
double angle_of(base::Vec2 from_centre) { return std::atan2(from_centre.y, -from_centre.x); }

double wrapped(double angle) { return angle > pi ? angle - 2 * pi : angle < -pi ? angle + 2 * pi : angle; }

int wrapped(int n) { return (n + sectors) % sectors; }

/// Mean pressure of the sectors, the lowest of the rear first; sectors without a cell take after their neighbours.
Ring surface_pressure(const Mesh& m, const std::vector<WallCell>& wall, const base::Field& p) {
  Ring sum{}, length{};
  for (const WallCell& cell : wall) {
    const double angle = angle_of({m.centre_x(cell.i) - m.pipe.x, m.centre_y(cell.j) - m.pipe.y});
    const int n = std::min(sectors - 1, static_cast<int>((angle + pi) / sector));
    sum[n] += m.wall_length(cell.i, cell.j) * p(cell.i, cell.j);
    length[n] += m.wall_length(cell.i, cell.j);
  }
  Ring mean{};
  for (int n = 0; n < sectors; ++n) {
    int before = n, behind = n;
    while (length[wrapped(before)] <= 0 && n - before < sectors / 2) --before;
    while (length[wrapped(behind)] <= 0 && behind - n < sectors / 2) ++behind;
    const auto value = [&](int k) { return length[wrapped(k)] > 0 ? sum[wrapped(k)] / length[wrapped(k)] : 0.0; };
    const double share = behind > before ? double(n - before) / (behind - before) : 0.0;
    mean[n] = (1 - share) * value(before) + share * value(behind);
  }
  return mean;
}

/// Cut cells scatter: three passes of 1, 2, 1.
Ring smoothed(Ring a) {
  for (int pass = 0; pass < separation_smoothing; ++pass) {
    const Ring b = a;
    for (int n = 0; n < sectors; ++n) a[n] = 0.25 * b[wrapped(n - 1)] + 0.5 * b[n] + 0.25 * b[wrapped(n + 1)];
  }
  return a;
}

}  // namespace

std::optional<double> thwaites_separation(std::span<const double> speed, double spacing, double nu) {
  double integral = 0;
  for (std::size_t n = 1; n < speed.size(); ++n) {
    const double before = speed[n - 1], here = speed[n], middle = 0.5 * (before + here);
    const double part = 0.25 * (std::pow(before, 5) + std::pow(here, 5)) * spacing;  // half of the interval's
    const double theta_squared = middle > 0 ? 0.45 * nu * (integral + part) / std::pow(middle, 6) : 0.0;
    if (theta_squared / nu * (here - before) / spacing < thwaites_leaves) return (n - 0.5) * spacing;
    integral += 2 * part;
  }
  return {};
}

void follow_separation(const Mesh& m, const std::vector<WallCell>& wall, const Params& params, double dt,
                       State& state) {
  const Ring p = smoothed(surface_pressure(m, wall, state.p));
  constexpr int quarter = sectors / 4;
  const int front = static_cast<int>(std::max_element(p.begin() + quarter, p.end() - quarter) - p.begin());
  Separation& s = state.separation;
  s.stagnation = (front + 0.5) * sector - pi;
  const double radius = 0.5 * m.pipe.diameter;
  for (const bool above : {false, true}) {
    std::array<double, sectors / 2> speed{};
    for (int n = 0; n < sectors / 2; ++n)
      speed[n] = std::sqrt(std::max(0.0, 2 * (p[front] - p[wrapped(above ? front + n : front - n)]) / params.density));
    const double fastest = *std::max_element(speed.begin(), speed.end());
    if (fastest <= 0) continue;
    const std::optional<double> leaves = thwaites_separation(speed, radius * sector, params.viscosity);
    double& angle = above ? s.above : s.below;
    const double time = separation_lag * m.pipe.diameter / fastest;
    angle += ((leaves ? *leaves / radius : Separation::never) - angle) * std::min(1.0, dt / time);
  }
}

double dead_water_friction(const Separation& s, base::Vec2 from_centre, base::Vec2 u) {
  const double angle = wrapped(angle_of(from_centre) - s.stagnation);
  const double turn = u.x * from_centre.y - u.y * from_centre.x;  // > 0: forward over the top
  if ((angle > 0 ? turn : -turn) <= 0) return 0;
  const double past = (std::abs(angle) - (angle > 0 ? s.above : s.below)) / sector;
  return std::clamp(past, 0.0, 1.0) * dead_water * std::hypot(u.x, u.y);
}

}  // namespace livebed::flow
