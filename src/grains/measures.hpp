#pragma once
#include "grains/advance.hpp"

/// Numbers that say how the bed is doing.  All of them are plain loops in the order of the storage.
namespace livebed::grains {

double mean_speed(const State& s);  ///< of the centres [m/s]
double max_speed(const State& s);   ///< [m/s]
/// Of translation (inertial mass) and spin [J].
double kinetic_energy(const Params& p, const State& s);
/// Sum of m u [kg m/s].
base::Vec2 momentum(const Params& p, const State& s);
/// Sum of the impulses the fluid gave since the last reset [N s].
base::Vec2 fluid_impulse(const State& s);
/// Solids moving along per width: sum (pi d^3/6) u / (L b) with b the mean diameter [m2/s], without pores.
double solids_flux(const Params& p, const State& s);
/// Thickness of a bed whose solids lie evenly: twice the height of their centre of mass [m].
double bed_height(const State& s);
/// Area of all grains as circles over the length [m]: the bed's thickness without pores.
double solid_thickness(const Params& p, const State& s);
/// What the grains fill between two heights.
struct Fractions {
  double area;    ///< their circles, of the plane [-]
  double volume;  ///< their spheres, of the slab as thick as the mean diameter [-]
};
Fractions packing_fractions(const Params& p, const State& s, double low, double high);
/// Upper edge of the highest grain whose centre is within `half_width` of x [m]; 0 where there is none.
double highest_grain(const State& s, double length, double x, double half_width);

struct ContactMeasures {
  double per_grain = 0;        ///< touching grains per grain (two for each pair) [-]
  double largest_overlap = 0;  ///< of two grains, over the mean diameter [-]
  double mean_overlap = 0;     ///< the same, averaged over touching pairs [-]
  double largest_force = 0;    ///< spring part of the normal force [N]
};
/// From the present positions and lists; the bed must have been advanced at least once.
ContactMeasures measure_contacts(const Bed& bed);

}  // namespace livebed::grains
