#pragma once
#include <optional>
#include <span>
#include <vector>

#include "base/vec2.hpp"
#include "flow/mesh.hpp"
#include "flow/staggering.hpp"
#include "flow/state.hpp"

/// Where a laminar boundary layer leaves the pipe.  Up to Re_D = 2e5 the layer is laminar and leaves near 80 degrees
/// from the front (Achenbach 1968); a wall function's leaves beyond 110.  It is far thinner than a cell, so it is not
/// resolved: its separation follows from the pressure along the surface, and behind it the water next to the pipe goes
/// no further.
namespace livebed::flow {

/// Way along a surface from its stagnation point to where a laminar boundary layer leaves it [m], from the speed
/// outside the layer at equal spacing [m/s, m], the stagnation point first; nothing when it stays.  Thwaites (1949),
/// Aeronaut. Q. 1, 245: theta^2 = 0.45 nu/U^6 int U^5 ds, and it leaves where theta^2/nu dU/ds falls below -0.09.
std::optional<double> thwaites_separation(std::span<const double> speed, double spacing, double nu);

/// state.separation follows, within dt [s], where the layer under the present pressure leaves: the wake behind needs
/// half the time in which the water passes the pipe to answer.
void follow_separation(const Mesh& mesh, const std::vector<WallCell>& wall, const Params& params, double dt,
                       State& state);

/// Friction factor of the surface at the place `from_centre` of the pipe's centre [m] that holds water of velocity u
/// [m/s] back: 0 up to the separation and for water that flows back towards it, else large enough to stop it within a
/// cell.
double dead_water_friction(const Separation& separation, base::Vec2 from_centre, base::Vec2 u);

}  // namespace livebed::flow
