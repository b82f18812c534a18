#pragma once

/// Plain parameters of the coupling of flow and grains.
namespace livebed::coupling {

/// none: grains and flow ignore each other; one_way: the flow pushes the grains; two_way: and they push back.
enum class Mode { none, one_way, two_way };

/// How the fluid takes the drag.  implicit: beta (U - u_p) inside the momentum step, the difference to the true impulse
/// carried to the next step; lagged: the whole impulse of the last step as a source (the paper, Sec. 4.1).
enum class Exchange { implicit, lagged };

/// paper: one grain alone (Eq. 15-18); the others know the void fraction around the grain (drag.hpp).
enum class Drag { paper, di_felice, gidaspow, rong };

/// How the drag coefficient of one grain goes from viscous to inertial: C_D = A/Re + B (sum, the paper) or
/// (sqrt(A/Re) + sqrt(B))^2 (Dallavalle 1948).
enum class DragCurve { sum, dallavalle };

/// Does the void fraction enter the fluid equations?  off: no (the paper); on: volume-averaged continuity, momentum and
/// closure, and the grains feel the pressure gradient.
enum class Voidage { off, on };

/// Added mass.  grain: the grain is heavier to accelerate (the paper); relative: the force follows the acceleration of
/// the grain relative to the water around it, and the water takes the reaction.
enum class AddedMass { grain, relative };

/// saffman_mei: lift of a sheared grain, Saffman (1965) with the correction of Mei (1992).
enum class Lift { none, saffman_mei };

/// What the grains do to the turbulence.  bounded: no eddy among them is larger than its
/// distance from the packed bed, in which nothing mixes; damped: besides, they
/// take k from it as far as they do not follow its eddies.
enum class Turbulence { untouched, bounded, damped };

/// random_walk: each grain feels a fluctuation of the modelled k with the time scale of its eddies.  attached: along
/// the stream with energy and life of the strongest eddies that reach down to it (gusts.hpp).
enum class Dispersion { none, random_walk, attached };

struct Params {
  Mode mode = Mode::two_way;
  Exchange exchange = Exchange::implicit;
  Drag drag = Drag::paper;
  DragCurve drag_curve = DragCurve::sum;
  double drag_viscous = 24;    ///< A of the drag coefficient of one grain [-]
  double drag_infinity = 0.4;  ///< B, C_D infinity [-] (Table 2)
  Voidage voidage = Voidage::off;
  AddedMass added_mass = AddedMass::grain;
  Lift lift = Lift::none;
  Turbulence turbulence = Turbulence::untouched;
  double turbulence_inertia = 0.25;  ///< B of the share exp(-B St) of an eddy's motion that a grain follows [-]
  double room_power = 1;             ///< of the share free of grains by which a way counts in that distance [-]
  Dispersion dispersion = Dispersion::none;
  double dispersion_energy = 1;  ///< energy of the eddies that grains feel over the modelled k [-]
  double dispersion_time = 0.2;  ///< Lagrangian time scale over k/epsilon [-]
  double kernel = 2;             ///< half-width of the transfer kernel over the grain diameter [-]
};

}  // namespace livebed::coupling
