#pragma once
#include "grains/advance.hpp"

/// Grains of the deep bed that have been at rest for a while are passed over until something near them changes.
///
/// Whole slices fall asleep: when none of their grains has moved faster than sleep_speed for sleep_time, and the forces
/// on each of them are in balance within sleep_force.  They keep their places, without speed, and their neighbours push
/// against them as if they were awake.  Every contact time all sleepers with a neighbour awake are looked at: their
/// contact forces are computed anew, and where one differs for some looks by more than sleep_force from what it was
/// when the grain fell asleep, the slice wakes.  A sleeper whose neighbours all sleep has the contact forces it had.
/// The fluid's force is compared at every call of advance, with sleep_drag.  So nothing that acts on a sleeper can
/// change by more than the thresholds for longer than that unnoticed. Nobody sleeps at the pipe.
namespace livebed::grains {

/// Grain steps between two looks: as many as a contact lasts, the time in which news travels from grain to grain.
int steps_between_looks(const Params& p);

/// Makes room for the sleep of all grains, awake at first; nothing when it is there or nobody may sleep.
void prepare_sleep(Bed& bed);

/// Who is asleep slice by slice, after new lists or at the start of a run; slices of which only a part is asleep wake.
void spread_sleep(Bed& bed);

/// Wakes the slices whose grains feel another fluid than when they fell asleep.  The records must be filled.
void wake_by_fluid(Bed& bed);

/// Looks at the neighbours of those awake and lets fall asleep who has been at rest for long; after a step.
void look(Bed& bed, const Sweep& k);

/// Gives the sleepers the impulse of the fluid since it was last counted, but none from before the present call of
/// advance.  of_still: those, too, whose impulse nobody asks for (FluidForce::still); some of them may be about to
/// wake.
void count_impulses(Bed& bed, bool of_still);

/// Share of the grains that are asleep [-].
double share_asleep(const State& s);

}  // namespace livebed::grains
