#include "flow/staggering.hpp"

#include <algorithm>
#include <cmath>

#include "flow/constants.hpp"

namespace livebed::flow {

namespace {

/// Spacing of nodes along one direction: at cell centres (shift 0) or at faces (shift 1).
struct Axis {
  std::vector<double> size, h, before, after;
};

Axis make_axis(const std::vector<double>& width, const std::vector<double>& between, int shift) {
  const int n = static_cast<int>(width.size());
  Axis a;
  a.size.resize(n), a.h.resize(n), a.before.resize(n), a.after.resize(n);
  for (int i = 0; i < n; ++i) {
    if (shift == 0) {
      a.size[i] = width[i];
      a.h[i] = between[i];
      a.before[i] = 0.5 * width[std::max(i - 1, 0)];
      a.after[i] = 0.5 * width[i];
    } else {
      a.size[i] = between[i];
      a.h[i] = width[std::max(i - 1, 0)];
      a.before[i] = a.after[i] = 0.5 * a.h[i];
    }
  }
  return a;
}

/// The open part of a west or south face that the pipe cuts, sampled.
struct OpenPart {
  double middle = 0;    ///< of its points along the face [m]
  double distance = 0;  ///< mean distance of its points from the pipe [m]
};

OpenPart open_part(const Mesh& m, bool west, int i, int j) {
  constexpr int n = 64;
  OpenPart part;
  int open = 0;
  for (int k = 0; k < n; ++k) {
    const double f = (k + 0.5) / n;
    const double x = west ? m.x[i] : m.x[i] + f * m.dx(i), y = west ? m.y[j] + f * m.dy(j) : m.y[j];
    const double away = std::hypot(x - m.pipe.x, y - m.pipe.y) - 0.5 * m.pipe.diameter;
    if (away > 0) part.middle += west ? y : x, part.distance += away, ++open;
  }
  if (open > 0) part.middle /= open, part.distance /= open;
  return part;
}

/// Friction between a cut face and the next one along it acts over the distance of their open parts, not over that of
/// the whole faces: without this the pipe would seem smaller by part of a cell.
void draw_closer(const Mesh& m, Staggering& s) {
  const bool west = s.shift_x > 0;
  const base::Field& aperture = west ? m.aperture_x : m.aperture_y;
  base::Field& area = west ? s.area_y : s.area_x;
  for (int j = 1; j < m.ny; ++j)
    for (int i = 1; i < m.nx; ++i) {
      const int a = west ? i : i - 1, b = west ? j - 1 : j;
      const double here = aperture(i, j), there = aperture(a, b);
      if (here <= 0 || there <= 0 || (here >= 1 && there >= 1)) continue;
      const double apart = open_part(m, west, i, j).middle - open_part(m, west, a, b).middle;
      const double whole = west ? m.dy_face(j) : m.dx_face(i);
      area(i, j) *= whole / std::max(apart, 0.5 * whole);
    }
}

Staggering make(const Mesh& m, int shift_x, int shift_y) {
  Staggering s;
  s.shift_x = shift_x, s.shift_y = shift_y;
  s.i0 = shift_x, s.i1 = m.nx, s.j0 = shift_y, s.j1 = m.ny;
  Axis x = make_axis(m.dx_, m.dx_face_, shift_x), y = make_axis(m.dy_, m.dy_face_, shift_y);
  s.width = x.size, s.hx = x.h, s.to_west = x.before, s.from_west = x.after;
  s.height = y.size, s.hy = y.h, s.to_south = y.before, s.from_south = y.after;
  s.volume = s.inertia = s.pressed = s.area_x = s.area_y = base::Field(m.nx, m.ny);
  const auto open = [&](int i, int j) {
    return shift_x ? m.aperture_x(i, j) : shift_y ? m.aperture_y(i, j) : m.volume(i, j);
  };
  for (int j = 0; j <= m.ny; ++j)
    for (int i = 0; i <= m.nx; ++i) {
      const int a = i - shift_x, b = j - shift_y;
      s.area_x(i, j) = 0.5 * (m.aperture_x(a, b) + m.aperture_x(i, j)) * s.height[j + 2];
      s.area_y(i, j) = 0.5 * (m.aperture_y(a, b) + m.aperture_y(i, j)) * s.width[i + 2];
      s.pressed(i, j) = open(i, j) * s.width[i + 2] * s.height[j + 2];
      s.volume(i, j) = 0.5 * (m.volume(a, b) * m.dx(a) * m.dy(b) + m.volume(i, j) * m.dx(i) * m.dy(j));
    }
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      const double open_x = std::max(s.area_x(i, j), s.area_x(i + 1, j)) / s.height[j + 2];
      const double open_y = std::max(s.area_y(i, j), s.area_y(i, j + 1)) / s.width[i + 2];
      const double whole = s.width[i + 2] * s.height[j + 2];
      s.inertia(i, j) = std::max({s.volume(i, j), s.pressed(i, j), 0.5 * std::max(open_x, open_y) * whole});
      if (s.inertia(i, j) <= 0) s.inertia(i, j) = whole;  // solid: nothing moves, nothing divides by zero
    }
  for (int j = 0; j <= m.ny; ++j)
    for (int i = 0; i <= m.nx; ++i) {
      if (open(i, j) <= 0 || open(i - 1, j) <= 0) s.area_x(i, j) = 0;
      if (open(i, j) <= 0 || open(i, j - 1) <= 0) s.area_y(i, j) = 0;
    }
  if (m.has_pipe() && shift_x + shift_y > 0) draw_closer(m, s);
  return s;
}

}  // namespace

Staggering Staggering::centres(const Mesh& m) { return make(m, 0, 0); }
Staggering Staggering::west_faces(const Mesh& m) { return make(m, 1, 0); }
Staggering Staggering::south_faces(const Mesh& m) { return make(m, 0, 1); }

std::vector<WallPart> share_wall(const Mesh& m, bool west) {
  std::vector<WallPart> parts;
  const int sx = west ? 1 : 0, sy = 1 - sx;
  const base::Field& aperture = west ? m.aperture_x : m.aperture_y;
  for (int j = sy; j < m.ny; ++j)
    for (int i = sx; i < m.nx; ++i) {
      const double open = aperture(i, j);
      const double length_before = m.wall_length(i - sx, j - sy), length_after = m.wall_length(i, j);
      if (open <= 0 || length_before + length_after <= 0) continue;
      WallPart part{i, j};
      part.length = open / (open + aperture(i - sx, j - sy)) * length_before +
                    open / (open + aperture(i + sx, j + sy)) * length_after;
      part.distance = std::max(open_part(m, west, i, j).distance, wall_distance_least * std::min(m.dx(i), m.dy(j)));
      parts.push_back(part);
    }
  return parts;
}

std::vector<HandedOn> hand_on(const Mesh& m, bool west) {
  std::vector<HandedOn> list;
  const int sx = west ? 1 : 0, sy = 1 - sx;
  const base::Field& aperture = west ? m.aperture_x : m.aperture_y;
  const auto moves = [&](int i, int j) { return i >= sx && i < m.nx && j >= sy && j < m.ny && aperture(i, j) > 0; };
  for (int j = sy; j < m.ny; ++j)
    for (int i = sx; i < m.nx; ++i) {
      if (aperture(i, j) > 0 || m.volume(i - sx, j - sy) + m.volume(i, j) <= 0) continue;
      const std::size_t first = list.size();
      double sum = 0;
      const auto offer = [&](int to_i, int to_j, double open) {
        if (open <= 0 || !moves(to_i, to_j)) return;
        list.push_back({i, j, to_i, to_j, open});
        sum += open;
      };
      const auto across_x = [&](int a, int b) { return m.aperture_x(a - sx, b - sy) + m.aperture_x(a, b); };
      const auto across_y = [&](int a, int b) { return m.aperture_y(a - sx, b - sy) + m.aperture_y(a, b); };
      offer(i - 1, j, across_x(i, j) * m.dy(j)), offer(i + 1, j, across_x(i + 1, j) * m.dy(j));
      offer(i, j - 1, across_y(i, j) * m.dx(i)), offer(i, j + 1, across_y(i, j + 1) * m.dx(i));
      for (std::size_t k = first; k < list.size(); ++k) list[k].share /= sum;
    }
  return list;
}

}  // namespace livebed::flow
