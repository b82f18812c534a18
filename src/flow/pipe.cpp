#include "flow/pipe.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"
#include "flow/constants.hpp"

namespace livebed::flow {

using base::square;

namespace {

/// Length of the part of [a, b] at distance `off` from the centre that lies outside the circle of radius r.
double open_length(double a, double b, double off, double r) {
  if (std::abs(off) >= r) return b - a;
  const double half = std::sqrt(square(r) - square(off));
  const double inside = std::min(b, half) - std::max(a, -half);
  return (b - a) - std::max(0.0, inside);
}

/// Integral of sqrt(r^2 - x^2) from 0 to x, |x| <= r.
double half_segment(double x, double r) {
  return 0.5 *
         (x * std::sqrt(std::max(0.0, square(r) - square(x))) + square(r) * std::asin(std::clamp(x / r, -1.0, 1.0)));
}

/// Integral over x in [x0,x1] of min(y, sqrt(r^2-x^2)) for y >= 0: area under both the chord y and the circle.
double under(double x0, double x1, double y, double r) {
  x0 = std::clamp(x0, -r, r);
  x1 = std::clamp(x1, -r, r);
  if (x1 <= x0) return 0;
  if (y >= r) return half_segment(x1, r) - half_segment(x0, r);
  const double corner = std::sqrt(square(r) - square(y));  // |x| < corner: the chord is lower than the circle
  const double a = std::clamp(-corner, x0, x1), b = std::clamp(corner, x0, x1);
  return half_segment(a, r) - half_segment(x0, r) + y * (b - a) + half_segment(x1, r) - half_segment(b, r);
}

}  // namespace

double circle_in_rectangle(double x0, double x1, double y0, double y1, double r) {
  const auto signed_under = [&](double y) { return y >= 0 ? under(x0, x1, y, r) : -under(x0, x1, -y, r); };
  return std::max(0.0, signed_under(y1) - signed_under(y0));
}

base::Vec2 wall_vector(const Mesh& m, int i, int j) {
  return {(m.aperture_x(i + 1, j) - m.aperture_x(i, j)) * m.dy(j),
          (m.aperture_y(i, j + 1) - m.aperture_y(i, j)) * m.dx(i)};
}

void cut_pipe(Mesh& m) {
  m.aperture_x = base::Field(m.nx, m.ny, 2, 1.0);
  m.aperture_y = base::Field(m.nx, m.ny, 2, 1.0);
  m.volume = base::Field(m.nx, m.ny, 2, 1.0);
  m.wall_length = base::Field(m.nx, m.ny, 2, 0.0);
  m.wall_distance = base::Field(m.nx, m.ny, 2, 0.0);
  if (!m.pipe.present) return;

  const double r = 0.5 * m.pipe.diameter, cx = m.pipe.x, cy = m.pipe.y;
  for (int j = 0; j < m.ny; ++j) {
    for (int i = 0; i < m.nx; ++i) {
      const double x0 = m.x[i] - cx, x1 = m.x[i + 1] - cx, y0 = m.y[j] - cy, y1 = m.y[j + 1] - cy;
      m.aperture_x(i, j) = open_length(y0, y1, x0, r) / m.dy(j);
      m.aperture_y(i, j) = open_length(x0, x1, y0, r) / m.dx(i);
      m.volume(i, j) = 1.0 - circle_in_rectangle(x0, x1, y0, y1, r) / (m.dx(i) * m.dy(j));
    }
  }
  // A face is as closed as the cells it joins: slivers would only cost the pressure solve its accuracy.
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i)
      if (m.volume(i, j) < m.pipe.least_open) {
        m.volume(i, j) = 0;
        m.aperture_x(i, j) = m.aperture_x(i + 1, j) = m.aperture_y(i, j) = m.aperture_y(i, j + 1) = 0;
      }
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      if (m.aperture_x(i, j) < aperture_least) m.aperture_x(i, j) = 0;
      if (m.aperture_y(i, j) < aperture_least) m.aperture_y(i, j) = 0;
    }
  for (int j = 0; j < m.ny; ++j) {
    for (int i = 0; i < m.nx; ++i) {
      m.wall_distance(i, j) = std::hypot(m.centre_x(i) - cx, m.centre_y(j) - cy) - r;
      if (m.volume(i, j) <= 0 || m.volume(i, j) >= 1) continue;
      m.wall_length(i, j) = base::norm(wall_vector(m, i, j));
      // Distance of the fluid's centroid, sampled; a quarter of the cell at least, so that a sliver's wall friction
      // stays that of its neighbours.
      const int n = 8;
      double sum = 0;
      int inside = 0;
      for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a) {
          const double away =
              std::hypot(m.x[i] + (a + 0.5) / n * m.dx(i) - cx, m.y[j] + (b + 0.5) / n * m.dy(j) - cy) - r;
          if (away > 0) sum += away, ++inside;
        }
      m.wall_distance(i, j) = std::max(inside ? sum / inside : 0.0, 0.25 * std::min(m.dx(i), m.dy(j)));
    }
  }
}

}  // namespace livebed::flow
