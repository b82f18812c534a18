#pragma once
#include "flow/turbulence.hpp"

namespace livebed::flow {

/// q.next <- one step of a scalar.  Positive by construction: decay is implicit, convection and gain that would empty a
/// cell are taken implicitly there (Patankar 1980), and the line systems are M-matrices.
void advance_scalar(const Mesh& mesh, const Boundary& boundary, const Params& params, const Staggering& at, double dt,
                    const ScalarEquation& q, Workspace& w);

/// k, epsilon, nut <- one step of Eq. 4-7 or of the closure asked for.
void advance_turbulence(const Mesh& mesh, const Boundary& boundary, const Params& params, const Staggering& at,
                        double dt, Turbulence& turbulence, State& s, Workspace& w);

}  // namespace livebed::flow
