#include "coupling/room.hpp"

#include <algorithm>
#include <cmath>

#include "base/loops.hpp"

namespace livebed::coupling {

void EddyRoom::average(const flow::Mesh& m, const base::Field& voids, int top) {
  const double reach = averaged_over * diameter_;
  base::for_each_item(0, top, [&](int j) {
    double* mean = packed.row(j);
    double volume = 0, length = 0;
    for (int i = 0, first = 0, next = 0; i < m.nx; ++i) {
      const double here = m.centre_x(i);
      for (; next <= i || (next < m.nx && m.centre_x(next) <= here + reach); ++next)
        volume += (1.0 - voids(next, j)) * m.dx(next), length += m.dx(next);
      for (; first < i && m.centre_x(first) < here - reach; ++first)
        volume -= (1.0 - voids(first, j)) * m.dx(first), length -= m.dx(first);
      mean[i] = volume / length / packed_solid;
    }
  });
}

void EddyRoom::fill(const flow::Mesh& m, int top, base::Field& room) {
  // Shortest way through the cells, each step counting as much as it is free of grains: down to the packed bed from
  // the west and from below, then from the east and from above.
  const auto counts = [&](double share) {
    if (share <= 0 || share >= 1) return share <= 0 ? 1.0 : 0.0;
    return std::pow(1.0 - share, power_);
  };
  const auto step = [&](double& here, int i, int j, int from_i, int from_j, double length) {
    const double mean = 0.5 * (packed(i, j) + packed(from_i, from_j));
    here = std::min(here, way_(from_i, from_j) + length * counts(mean));
  };
  const double far = m.height();
  for (int j = 0; j < top; ++j)
    for (int i = 0; i < m.nx; ++i) {
      double here = packed(i, j) > packed_share ? 0.0 : far;
      if (here > 0 && j > 0) step(here, i, j, i, j - 1, m.dy_face(j));
      if (here > 0 && i > 0) step(here, i, j, i - 1, j, m.dx_face(i));
      way_(i, j) = here;
    }
  const double least = room_least * diameter_;
  for (int j = top - 1; j >= 0; --j)
    for (int i = m.nx - 1; i >= 0; --i) {
      double& here = way_(i, j);
      if (here > 0 && j + 1 < top) step(here, i, j, i, j + 1, m.dy_face(j + 1));
      if (here > 0 && i + 1 < m.nx) step(here, i, j, i + 1, j, m.dx_face(i + 1));
      room(i, j) = std::max(here, least);
    }
}

}  // namespace livebed::coupling
