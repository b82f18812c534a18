#pragma once
#include <cstdint>
#include <vector>

#include "grains/params.hpp"

/// The sizes of the grains: equal, spread evenly about d, or after a sieve curve.  Params need not be complete (derive)
/// but for static_overlap.
namespace livebed::grains {

/// Largest over smallest grain of a grading.  The cells of the neighbour search are as wide as the largest grain and a
/// list holds some thirty neighbours: with a wider range most of what a cell holds would be out of reach of its small
/// grains, and a large grain could have more small neighbours than its list holds.  The slab is as thick as d50, so a
/// grain much larger than that would not fit into it either.
inline constexpr double widest_grading = 4;

/// Throws Fault (invalid case) naming the point of the curve that is out of order or range, or a range wider than
/// widest_grading.
void check_grading(const Grading& grading);

/// Diameter [m] than which the share `passing` of the mass is finer, 0 <= passing <= 1.
double diameter_at(const Grading& grading, double passing);
/// Share of the mass that passes a sieve of this width [m]: the inverse.
double passing_at(const Grading& grading, double diameter);

/// Of the sizes that can occur [m].
double smallest_diameter(const Params& p);
double largest_diameter(const Params& p);

/// Mean over the number of grains of diameter^power [m^power]; power 2 or 3.
double mean_power(const Params& p, int power);

/// Diameters of p.count grains [m] in a random order that the seed decides; same seed, same bits.  Stratified: the
/// distribution is cut into as many parts of equal number as there are grains, and each grain has the mean mass (of an
/// even spread: the mean diameter) of its part.  So the mass is exact, and the sieve curve of the grains meets the
/// given one at every grain.
std::vector<double> sample_diameters(const Params& p);

/// Overlap over d of the lowest of the largest grains of a bed of `height` at rest, by its spring [-]: what stiffness
/// to expect before anything runs.  Grains are taken to stand on each other like a square lattice.
double static_overlap(const Params& p, double height);

}  // namespace livebed::grains
