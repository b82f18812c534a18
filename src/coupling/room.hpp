#pragma once
#include "base/field.hpp"
#include "flow/mesh.hpp"

namespace livebed::coupling {

/// The bed counts as packed, and its water as unmixed, from this share of the packed solid fraction on [-].
inline constexpr double packed_solid = 0.55, packed_share = 0.9;
/// Half the length along the current over which the solid fraction that bounds the eddies is averaged, over d [-].  A
/// grain that flies alone fills its cell and would count as a bed.
inline constexpr double averaged_over = 3;
inline constexpr double room_least = 0.02;  ///< of the packed bed over d; keeps its dissipation finite

/// The room that the packed bed leaves to the eddies above it.
class EddyRoom {
public:
  EddyRoom() = default;
  /// power: how a way through grains counts less by what they fill; grain_diameter [m].
  EddyRoom(int nx, int ny, double power, double grain_diameter)
      : packed(nx, ny), way_(nx, ny), power_(power), diameter_(grain_diameter) {}

  /// Solid fraction, averaged along the current, over that of a packed bed [-].
  base::Field packed;

  /// packed <- of the lowest `top` rows.  voids: void fraction of the cells [-].
  void average(const flow::Mesh& mesh, const base::Field& voids, int top);

  /// room <- distance of each cell of the lowest `top` rows from the packed bed [m], ways through grains counting less
  /// by what they fill (Li and Sawamoto 1995, Coastal Eng. Japan 38, 1: dl/dy = kappa (1 - solid/packed), here to a
  /// power).
  void fill(const flow::Mesh& mesh, int top, base::Field& room);

private:
  base::Field way_;
  double power_ = 0, diameter_ = 0;
};

}  // namespace livebed::coupling
