#pragma once
#include "base/vec2.hpp"
#include "flow/mesh.hpp"
#include "flow/params.hpp"
#include "flow/state.hpp"

/// Forces from the momentum of a box of water: independent of what happens at the pipe's surface.
namespace livebed::flow {

/// Cells i0 <= i < i1, j0 <= j < j1.
struct Box {
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0;
};

/// The smallest box of whole cells that reaches `half` [m] to every side of the pipe's centre.  Throws Fault (internal)
/// when it would leave the grid's inside.
Box box_around_pipe(const Mesh& mesh, double half);

/// What comes in through the box's sides per metre of pipe and second: momentum, pressure and friction [N/m].  In
/// steady flow without grains this is the force on the pipe; otherwise it is that and the rate of `momentum_inside`. No
/// side may cut the pipe.
base::Vec2 momentum_inflow(const Params& params, const Mesh& mesh, const State& state, const Box& box);

/// Momentum of the water in the box [N s/m].
base::Vec2 momentum_inside(const Params& params, const Mesh& mesh, const State& state, const Box& box);

}  // namespace livebed::flow
