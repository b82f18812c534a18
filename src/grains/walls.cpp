#include "grains/walls.hpp"

#include "base/fault.hpp"
#include "base/math.hpp"
#include "grains/sizes.hpp"

namespace livebed::grains {

namespace {

void add(const Polyline& line, std::vector<Segment>& segments) {
  if (line.size() < 2) {
    base::fail(base::Exit::invalid_case, "a wall of {} points is none: give two or more", line.size());
  }
  const auto first = static_cast<std::int32_t>(segments.size());
  const bool closed = line.size() > 2 && line.front().x == line.back().x && line.front().y == line.back().y;
  const auto last = first + static_cast<std::int32_t>(line.size()) - 2;
  for (std::int32_t k = first; k <= last; ++k) {
    const base::Vec2 a = line[k - first], b = line[k - first + 1];
    const double length2 = base::square(b.x - a.x) + base::square(b.y - a.y);
    if (!(length2 > 0)) {
      base::fail(base::Exit::invalid_case, "a wall has the point ({}, {}) twice in a row: leave one out", a.x, a.y);
    }
    segments.push_back({.x = a.x,
                        .y = a.y,
                        .ex = b.x - a.x,
                        .ey = b.y - a.y,
                        .per_length2 = 1 / length2,
                        .before = k > first ? k - 1 : (closed ? last : -1),
                        .after = k < last ? k + 1 : (closed ? first : -1)});
  }
}

}  // namespace

std::vector<Segment> make_segments(const Params& p) {
  constexpr double high = 1e3;  // [m]: no grain of a bed flies over its side walls
  std::vector<Segment> segments;
  if (p.side_walls) {
    const double low = -largest_diameter(p);  // below the floor, so that no corner of it is met
    add({{0, low}, {0, high}}, segments);
    add({{p.length, low}, {p.length, high}}, segments);
  }
  for (const Polyline& line : p.walls) add(line, segments);
  return segments;
}

double period(const Params& p) { return p.side_walls ? p.length + 2 * p.gamma * largest_diameter(p) : p.length; }

}  // namespace livebed::grains
