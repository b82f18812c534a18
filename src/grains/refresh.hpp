#pragma once
#include "grains/contact.hpp"

/// Lists kept complete around the few grains that have moved far, instead of making all of them anew.
///
/// Every grain is listed by where it was when it was listed last (x_built, y_built): all pairs are in the lists that
/// are within a reach and a skin of each other there.  A grain that leaves its half skin is looked up alone among the
/// others at those places, and both sides of its pairs are put right.  Where the others have been listed at other times
/// does not matter: two grains within half a skin of places farther apart than that do not touch.
namespace livebed::grains {

/// Lists anew every grain awake that has moved more than half a skin (Records::moved tells where), serially and in
/// order.  Returns false when all lists have to be made anew: beside further walls, in a box of less than three cells,
/// for a grain that is lost or lies on others (rebuild tells which), and when so many have been listed alone since the
/// last time that the order of the storage is out of date.
bool refresh(const Sweep& k, const State& s, Contacts& c, const Records& r, ListScratch& w);

}  // namespace livebed::grains
