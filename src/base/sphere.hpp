#pragma once
#include <algorithm>

#include "base/math.hpp"

namespace livebed::base {

/// Volume of the part of a sphere of radius r [m] that lies below a plane at height h above its centre [m3].
inline double sphere_volume_below(double r, double h) {
  h = std::clamp(h, -r, r);
  return pi / 3.0 * square(r + h) * (2 * r - h);
}

}  // namespace livebed::base
