#pragma once
#include "case/case.hpp"
#include "flow/advance.hpp"

/// How hard the current pulls at the bed, and how a flow without beginning is kept at it.
namespace livebed::run {

/// Shields parameter of the flow's total shear stress at the original bed level [m], upstream of the pipe: viscous and
/// turbulent stress on that plane, momentum carried through it (before a pipe: beside what the mean flow carries), and
/// drag on the grains above it.  Without grains that of the friction on the floor.
double measured_shields(const casefile::Case& c, const flow::Solver& flow, double level);

/// Makes the inlet of the next step from the flow itself (current.profile = "recycled"): the mean over the box of what
/// flows along it and of k and epsilon, as in a channel that has neither beginning nor end, a little faster or slower
/// so that the measured Shields parameter comes to the nominal one within some times the depth over u*.  dt: last step
/// [s].
void recycle_inlet(const casefile::Case& c, double level, double dt, flow::Solver& flow);

/// The part of its full speed that a current has which rises with time [-]: a tenth at first, then linearly all.
double risen_share(double time, double rise);
/// Lets the share of the full current through the inlet of the next step: velocity with it, k with its square, epsilon
/// with its cube, as in a developed flow.
void scale_inlet(const flow::Column& full, double share, flow::Solver& flow);

}  // namespace livebed::run
