#include "flow/staggering.hpp"

#include <algorithm>
#include <cmath>

#include "base/loops.hpp"
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
void draw_closer(const Mesh& m, bool west, base::Field& open) {
  const base::Field& aperture = west ? m.aperture_x : m.aperture_y;
  for (int j = 1; j < m.ny; ++j)
    for (int i = 1; i < m.nx; ++i) {
      const int a = west ? i : i - 1, b = west ? j - 1 : j;
      const double here = aperture(i, j), there = aperture(a, b);
      const int sx = west ? 1 : 0, sy = 1 - sx;  // to the cell on the other side of the face
      const bool cut = m.wall_length(i, j) > 0 || m.wall_length(i - sx, j - sy) > 0 || m.wall_length(a, b) > 0 ||
                       m.wall_length(a - sx, b - sy) > 0;
      if (here <= 0 || there <= 0 || !cut) continue;
      const double apart = open_part(m, west, i, j).middle - open_part(m, west, a, b).middle;
      const double whole = west ? m.dy_face(j) : m.dx_face(i);
      open(i, j) *= whole / std::max(apart, 0.5 * whole);
    }
}

std::vector<double> inverse(const std::vector<double>& a) {
  std::vector<double> b(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) b[k] = a[k] > 0 ? 1.0 / a[k] : 0.0;
  return b;
}

/// Shares of cell faces k - shift and k in the flux through the face of volume k that both are halves of.
void share_faces(const std::vector<double>& cell, const std::vector<double>& volume, int shift,
                 std::vector<double>& before, std::vector<double>& here) {
  before.assign(cell.size(), 0.5), here.assign(cell.size(), 0.5);
  for (std::size_t k = shift; shift > 0 && k < cell.size(); ++k) {
    if (volume[k] <= 0) continue;
    before[k] = 0.5 * cell[k - 1] / volume[k];
    here[k] = 0.5 * cell[k] / volume[k];
  }
}

Staggering make(const Mesh& m, int shift_x, int shift_y) {
  Staggering s;
  s.shift_x = shift_x, s.shift_y = shift_y;
  s.i0 = shift_x, s.i1 = m.nx, s.j0 = shift_y, s.j1 = m.ny;
  Axis x = make_axis(m.dx_, m.dx_face_, shift_x), y = make_axis(m.dy_, m.dy_face_, shift_y);
  s.width = x.size, s.hx = x.h, s.to_west = x.before, s.from_west = x.after;
  s.height = y.size, s.hy = y.h, s.to_south = y.before, s.from_south = y.after;
  s.per_width = inverse(s.width), s.per_hx = inverse(s.hx);
  s.per_height = inverse(s.height), s.per_hy = inverse(s.hy);
  share_faces(m.dx_, s.width, shift_x, s.share_x_before, s.share_x);
  share_faces(m.dy_, s.height, shift_y, s.share_y_before, s.share_y);
  OpeningScratch scratch;
  s.open_to(m, scratch);
  return s;
}

}  // namespace

void Staggering::open_to(const Mesh& m, OpeningScratch& w) {
  if (w.volume.nx() != m.nx || w.volume.ny() != m.ny)
    w.volume = w.open = w.open_x = w.open_y = w.inertia = w.per_inertia = base::Field(m.nx, m.ny, 2, 1.0);
  base::for_each_item(0, m.ny + 1, [&](int j) {
    for (int i = 0; i <= m.nx; ++i) {
      const int a = i - shift_x, b = j - shift_y;
      w.open_x(i, j) = 0.5 * (m.aperture_x(a, b) + m.aperture_x(i, j));
      w.open_y(i, j) = 0.5 * (m.aperture_y(a, b) + m.aperture_y(i, j));
      w.open(i, j) = shift_x ? m.aperture_x(i, j) : shift_y ? m.aperture_y(i, j) : m.volume(i, j);
      const double before = m.volume(a, b), here = m.volume(i, j);
      // Equal openings give their own value to the last bit, so that rows without pipe are all alike.
      w.volume(i, j) =
          before == here ? here : 0.5 * (before * m.dx(a) * m.dy(b) + here * m.dx(i) * m.dy(j)) / whole(i, j);
    }
  });
  base::for_each_item(0, m.ny, [&](int j) {
    for (int i = 0; i < m.nx; ++i) {
      const double widest =
          std::max(std::max(w.open_x(i, j), w.open_x(i + 1, j)), std::max(w.open_y(i, j), w.open_y(i, j + 1)));
      w.inertia(i, j) = std::max({w.volume(i, j), w.open(i, j), inertia_least * widest});
      if (w.inertia(i, j) <= 0) w.inertia(i, j) = 1;  // solid: nothing moves, nothing divides by zero
      w.per_inertia(i, j) = 1.0 / w.inertia(i, j);
    }
  });
  base::for_each_item(0, m.ny + 1, [&](int j) {
    for (int i = 0; i <= m.nx; ++i) {
      if (w.open(i, j) <= 0 || w.open(i - 1, j) <= 0) w.open_x(i, j) = 0;
      if (w.open(i, j) <= 0 || w.open(i, j - 1) <= 0) w.open_y(i, j) = 0;
    }
  });
  if (m.has_pipe() && shift_x) draw_closer(m, true, w.open_y);
  if (m.has_pipe() && shift_y) draw_closer(m, false, w.open_x);
  open_volume.keep(w.volume), open.keep(w.open);
  open_x.keep(w.open_x), open_y.keep(w.open_y);
  inertia_.keep(w.inertia), per_inertia.keep(w.per_inertia);
}

Staggering Staggering::centres(const Mesh& m) { return make(m, 0, 0); }
Staggering Staggering::west_faces(const Mesh& m) { return make(m, 1, 0); }
Staggering Staggering::south_faces(const Mesh& m) { return make(m, 0, 1); }

std::vector<WallCell> find_wall_cells(const Mesh& m) {
  std::vector<WallCell> cells;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i)
      if (m.wall_length(i, j) > 0) cells.push_back({i, j});
  return cells;
}

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
