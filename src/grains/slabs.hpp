#pragma once
#include <cstdint>
#include <vector>

#include "grains/contact.hpp"

/// The bed in slabs along the current, and the order in which they are stepped.
///
/// A grain meets only grains of its own slab and of the two beside it.  So a slab may be ahead of the next one by a
/// step, and several steps can be made of a few slabs, while their records and lists are in the cache, before others
/// are fetched from memory: beds that are larger than the caches go as fast as small ones (skewed blocks in time: Wolf
/// and Lam 1991, ACM PLDI 26, 30).  The two sets of places and motions are enough for it: a slab's grains at a step are
/// overwritten two steps later, when both neighbours have read them.
namespace livebed::grains {

/// Most steps made at once.
inline constexpr int most_steps_at_once = 32;

/// Who is awake, slab by slab, by what is known of who sleeps.
void list_awake(Records& r, const State& s, const Contacts& c, const Reach& reach);

/// How many steps may be made, at most `most`, before grains must be looked at again: all of them when no grain awake
/// gets off its leash meanwhile, even when it meets the fastest and is pushed twice as hard as in the step before; else
/// 1, as in the first step after the records were filled.  Looked for when advance is called, `first`, and some steps
/// later again.
int plan_steps(const Sweep& k, const Contacts& c, Records& r, std::int64_t bed_steps, bool first, int most);

/// `steps` steps of every grain awake, forces and motion in one pass over the slices (symplectic: velocities, then
/// positions):
///   1  F <- contacts with neighbours, floor and pipe; histories forward
///   2  (m + dt beta) u <- m u + dt (F + weight + f + beta U); the drag is implicit;  impulse += dt (f + beta (U - u))
///   3  spin <- spin + dt r sum f_s / I;  x <- x + dt u, wrapped into [0, length)
/// Returns false when some grain is off its leash (or nowhere finite), so that it must be listed anew before the next
/// step.
bool sweep(const Sweep& k, Contacts& c, Records& r, int steps);

}  // namespace livebed::grains
