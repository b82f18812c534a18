#pragma once
#include <cstdint>
#include <vector>

#include "grains/lanes.hpp"
#include "grains/params.hpp"

namespace livebed::grains {

/// A straight piece of a wall and the pieces it continues.  Where two pieces meet in a corner that points at the grain,
/// both are equally near; the corner then belongs to the later one.
struct Segment {
  double x, y;               ///< where it begins [m]
  double ex, ey;             ///< from there to its end [m]
  double per_length2;        ///< 1 / length^2 [1/m2]
  std::int32_t before = -1;  ///< index of the piece that ends where this one begins; -1: none
  std::int32_t after = -1;   ///< of the piece that begins where this one ends

  /// Where along the piece (0 to 1 between its ends) a point lies.
  double along(double px, double py) const { return ((px - x) * ex + (py - y) * ey) * per_length2; }
};

/// The pieces of all walls of a case but the floor and the pipe: side walls and polylines.  Throws Fault (invalid case)
/// for a polyline of fewer than two points or with two equal ones in a row.
std::vector<Segment> make_segments(const Params& p);

/// Period of the box in x [m].  With side walls it is longer than the box, so that no two grains meet through them.
double period(const Params& p);

}  // namespace livebed::grains
