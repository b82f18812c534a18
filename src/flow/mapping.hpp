#pragma once
#include "flow/advance.hpp"

namespace livebed::flow {

/// Fills the state of `to` from that of `from` by bilinear interpolation at the same places, whatever the two grids: a
/// developed flow on a fine grid for the price of a coarse run.  What divergence the interpolation leaves goes with the
/// first step.
void map_flow(const Solver& from, Solver& to);

}  // namespace livebed::flow
