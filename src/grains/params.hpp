#pragma once
#include <string>
#include <vector>

#include "base/vec2.hpp"

/// Plain parameters of the grains: what a case file says, in SI units.  Filled by `case`, read by `grains`.
/// Grains are spheres of diameter d whose centres stay in one vertical plane (a slab of thickness b = d).
namespace livebed::grains {

/// Moment of inertia: a solid sphere, m d^2/10, or the paper's disk, m d^2/8 (Eq. 17).
enum class Inertia { sphere, disk };
/// Dashpots of a contact: the paper's, one constant for all pairs (Eq. 27), or Hooke's, which follow the reduced mass
/// of the pair, so that the restitution is the same for any two sizes and for walls.
enum class Law { paper, hooke };
/// May the dashpot pull?  spring: force is cut when the spring is in tension (Eq. 23 to the letter); none: total
/// normal force >= 0.
enum class Tension { spring, none };
/// In what the grains are moved: all in double, or places and overlaps in double and the rest in single precision.
enum class Precision { all_double, mixed };
/// What bounds friction: the spring force e_n (Eq. 24 to the letter) or the total normal force.
enum class FrictionLimit { spring_force, total_force };
/// The bottom: a row of fixed grains (the paper) or a smooth plane.
enum class Floor { grains, plane };
/// Where the grains are before they are let go: in the rows of a square lattice (the paper), or scattered as densely as
/// they will lie.
enum class Placing { lattice, scattered };

/// A point of a sieve curve: grains finer than `diameter` [m] are the share `passing` [-] of the mass.
struct SievePoint {
  double diameter, passing;
};
/// A sieve curve, both numbers rising from point to point: log-linear in between, and beyond the ends along the line of
/// the nearest two points until nothing or everything passes.
using Grading = std::vector<SievePoint>;

/// A wall's springs, dashpots and friction over those between grains [-].  Negative: not given, wall_factor counts.
struct WallFactors {
  double stiffness = -1, damping = -1, friction = -1, rolling = -1;
};

/// A wall of straight pieces from point to point [m]; grains touch it from both sides.
using Polyline = std::vector<base::Vec2>;

struct Params {
  // the grain
  double diameter = 2e-3;   ///< d [m], mean; d50 of a grading, filled in by derive
  double density = 2650;    ///< rho_s [kg/m3]
  double spread = 0.05;     ///< half-width of the uniform distribution of diameters over d [-]; 0 = equal grains
  Grading grading;          ///< where it is given, sizes follow it instead of d and spread
  double added_mass = 0.5;  ///< C_M [-]
  Inertia inertia = Inertia::sphere;
  double fluid_density = 1000;  ///< rho [kg/m3], for added mass and submerged weight
  double gravity = 9.81;        ///< [m/s2]

  // the contact
  double stiffness = 0;           ///< k_n [N/m]; derived from step when the case gives the step
  double step = 0;                ///< Delta t_s [s]; derived from stiffness when the case gives that
  double steps_per_contact = 20;  ///< Delta t_c / Delta t_s of Eq. 25 [-]
  double poisson = 0.3;           ///< [-], k_s = k_n / (2 (1 + nu)), eta_s likewise (Eq. 26-27)
  double damping = 0;             ///< alpha_cn [-] of Eq. 27, on the full mass; derived when restitution is given
  double restitution = 0;         ///< normal restitution of a pair [-]; derived when damping is given
  double friction = 0.55;         ///< mu [-]
  Law law = Law::paper;
  double wall_factor = 2;        ///< k, eta, mu of walls over those of grains [-] (Eq. 28)
  WallFactors pipe, bottom;      ///< where one of them differs from that; side walls and polylines are like the bottom
  double rolling_friction = 0;   ///< mu_r of the rolling resistance [-]; 0 = none
  double rolling_damping = 0.3;  ///< of the rolling spring over its critical damping [-]
  double gamma = 1;              ///< contact distance over the sum of radii [-] (Eq. 19)
  Tension tension = Tension::none;
  FrictionLimit friction_limit = FrictionLimit::total_force;
  Precision precision = Precision::all_double;
  double skin = 0.5;  ///< extra reach of the neighbour lists over d [-]; 0.5 is fastest when grains fly at 1 m/s

  // sleep
  bool sleep = false;         ///< grains at rest may be passed over
  double sleep_speed = 0.02;  ///< slower than this over sqrt(g' d), g' of submerged_gravity, counts as at rest [-]
  double sleep_time = 0.5;    ///< that long over sqrt(d / g') before they fall asleep [-]
  double sleep_force = 0.5;   ///< change of the contact force over what presses a grain that wakes it [-]
  double sleep_drag = 0.1;    ///< change of the fluid's force over what presses the grain that wakes it [-]

  // the bed
  int count = 0;        ///< number of grains; derived from bed_thickness when the case gives that
  double length = 0.5;  ///< period in x [m]
  Floor floor = Floor::plane;
  bool side_walls = false;      ///< walls at x = 0 and x = length instead of the period
  std::vector<Polyline> walls;  ///< further walls
  int pieces = 1;               ///< equal pieces side by side that the bed is made of: one is packed, then copied
  Placing start = Placing::lattice;
  double lattice_gap = 0.001;      ///< gap between the grains of the starting lattice over d [-]
  double packing_fraction = 0.82;  ///< share of the plane inside the bed that the circles of the grains are to fill [-]
  double thickness = 0;         ///< level that the bed is cut to when it has come to rest [m]; 0: it stays as it comes
  unsigned seed = 1;            ///< of the diameters and of the lattice's small shifts
  double settled_speed = 1e-5;  ///< packing ends when the mean grain speed stays below this [m/s]
  double settle_time = 5;       ///< longest packing [s]
};

}  // namespace livebed::grains
