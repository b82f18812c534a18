#include "validate/contours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/vec2.hpp"

namespace livebed::validate {

namespace {

using base::Vec2;

/// An edge of the grid: from node (i, j) to the right (along = 0) or upwards (1).
using Edge = std::array<int, 3>;

/// Distance of p from the straight piece between a and b.
double distance(Vec2 p, Vec2 a, Vec2 b) {
  const double length2 = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
  const double s =
      length2 > 0 ? std::clamp(((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - s * (b.x - a.x), p.y - a.y - s * (b.y - a.y));
}

/// Douglas and Peucker: keeps the ends and, where the rest strays, the point furthest away.
void keep_needed(const std::vector<Vec2>& points, std::size_t from, std::size_t to, double tolerance,
                 std::vector<char>& keep) {
  double furthest = tolerance;
  std::size_t at = from;
  for (std::size_t k = from + 1; k < to; ++k)
    if (const double d = distance(points[k], points[from], points[to]); d > furthest) furthest = d, at = k;
  if (at == from) return;
  keep[at] = 1;
  keep_needed(points, from, at, tolerance, keep);
  keep_needed(points, at, to, tolerance, keep);
}

Line thinned(const std::vector<Vec2>& points, double tolerance) {
  std::vector<char> keep(points.size(), 0);
  keep.front() = keep.back() = 1;
  keep_needed(points, 0, points.size() - 1, tolerance, keep);
  Line line;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (keep[k]) line.x.push_back(points[k].x), line.y.push_back(points[k].y);
  return line;
}

}  // namespace

std::vector<Line> contour_lines(const std::vector<double>& x, const std::vector<double>& y,
                                const std::vector<double>& values, double level, double tolerance) {
  const int nx = static_cast<int>(x.size()), ny = static_cast<int>(y.size());
  const auto value = [&](int i, int j) { return values[static_cast<std::size_t>(j) * x.size() + i] - level; };
  const auto cut = [&](double a, double b) { return (a < 0) != (b < 0); };
  // Marching squares: pieces between the cut edges of each cell; each edge ends at most two pieces.
  std::map<Edge, std::vector<Edge>> joined;
  const auto join = [&](Edge a, Edge b) { joined[a].push_back(b), joined[b].push_back(a); };
  for (int j = 0; j + 1 < ny; ++j)
    for (int i = 0; i + 1 < nx; ++i) {
      const double a = value(i, j), b = value(i + 1, j), c = value(i + 1, j + 1), d = value(i, j + 1);
      const Edge south{i, j, 0}, east{i + 1, j, 1}, north{i, j + 1, 0}, west{i, j, 1};
      std::vector<Edge> edges;
      if (cut(a, b)) edges.push_back(south);
      if (cut(b, c)) edges.push_back(east);
      if (cut(c, d)) edges.push_back(north);
      if (cut(d, a)) edges.push_back(west);
      if (edges.size() == 2) join(edges[0], edges[1]);
      if (edges.size() == 4) {  // a saddle: the mean tells which corners belong together
        const bool with_a = (a + b + c + d < 0) == (a < 0);
        join(south, with_a ? east : west);
        join(north, with_a ? west : east);
      }
    }
  const auto place = [&](const Edge& e) -> Vec2 {
    const auto [i, j, along] = e;
    const double a = value(i, j), b = along == 0 ? value(i + 1, j) : value(i, j + 1), s = a / (a - b);
    return along == 0 ? Vec2{x[i] + s * (x[i + 1] - x[i]), y[j]} : Vec2{x[i], y[j] + s * (y[j + 1] - y[j])};
  };
  std::vector<Line> lines;
  const auto walk = [&](Edge at) {
    std::vector<Vec2> points{place(at)};
    while (!joined[at].empty()) {
      const Edge next = joined[at].back();
      joined[at].pop_back();
      std::vector<Edge>& back = joined[next];
      back.erase(std::find(back.begin(), back.end(), at));
      points.push_back(place(next));
      at = next;
    }
    lines.push_back(thinned(points, tolerance));
  };
  for (const auto& [edge, others] : joined)
    if (others.size() == 1) walk(edge);
  for (const auto& [edge, others] : joined)  // what is left are closed lines
    if (!others.empty()) walk(edge);
  return lines;
}

}  // namespace livebed::validate
