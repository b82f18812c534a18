#pragma once
#include "flow/constants.hpp"

/// Plain parameters of the flow: what a case file says, in SI units.  Filled by `case`, read by `flow`.
namespace livebed::flow {

/// k_epsilon: the standard model (paper, Table 1).  k_epsilon_realizable: with Durbin's bound on its time scale.
/// k_omega: Wilcox's model of 2006; k_omega_sst: Menter's; both down to the wall where the grid resolves it.
enum class Closure { laminar, k_epsilon, k_epsilon_realizable, k_omega, k_omega_sst };
inline constexpr bool transports_omega(Closure c) { return c == Closure::k_omega || c == Closure::k_omega_sst; }

/// hybrid: central below a cell Peclet number of 2, upwind above (the paper).  bounded: second order with a limiter.
enum class Convection { hybrid, bounded };

/// How pressure and velocity are brought together.  projection: incremental pressure correction, one solve a step.
/// simple: the paper's, implicit, with under-relaxed outer iterations; any step, or none (steady).
enum class Algorithm { projection, simple };

/// What a solid surface does to the flow.  rough and smooth are wall functions (Eq. 9-12 of the paper with a rough or a
/// smooth log law); no_slip resolves the viscous stress; slip has none.
enum class Wall { rough, smooth, no_slip, slip };

/// The boundary layer on the pipe.  turbulent: leaves it where the wall function's does.  laminar: where a laminar one
/// does (flow/separation.hpp), as on pipes below Re_D = 2e5, and stays without eddies close to the pipe.
enum class PipeLayer { turbulent, laminar };

/// Velocity profile at the inlet: rough and smooth log law, the 1D solution of the same closure, one speed, or what
/// flows in the box itself, as in a channel without beginning or end.
enum class Profile { rough, smooth, developed, uniform, recycled };

/// Tensor-product grid over [0, length] x [0, height]: cells of size cell_x, cell_y inside the fine window, growing
/// outside it by the ratio growth from cell to cell (1 = uniform everywhere).
struct MeshParams {
  double length = 0.5;                    ///< [m]
  double height = 0.2;                    ///< [m], water and bed
  double cell_x = 0.0025;                 ///< [m]
  double cell_y = 0.0025;                 ///< [m]
  double growth = 1.0;                    ///< [-]
  double fine_x_from = 0, fine_x_to = 0;  ///< [m], window of fine cells; the whole length when both are 0
  double fine_y_from = 0, fine_y_to = 0;  ///< [m], the whole height when both are 0
};

struct PipeParams {
  bool present = true;
  double diameter = 0.05;  ///< D [m]
  double x = 0.2;          ///< centre, distance from the inlet [m]
  double y = 0;            ///< centre above the floor [m]; derived from the bed level and gap_ratio
  double gap_ratio = 0;    ///< e/D [-], from the level of the bed to the pipe's lowest point; negative = embedded
  Wall wall = Wall::smooth;
  double roughness = 0;  ///< ks [m] of the rough law
  PipeLayer layer = PipeLayer::turbulent;
  double least_open = volume_least;  ///< cells with less open volume count as solid [-]
};

/// The approaching current.
struct CurrentParams {
  Profile profile = Profile::rough;
  double shear_velocity = 0;  ///< u* [m/s]; derived from whichever of theta, mean speed, u* the case gives
  double mean_speed = 0;      ///< depth-mean over the water [m/s]; derived
  double roughness = 0;       ///< ks [m], 2.5 d unless given
  double bed_level = 0;       ///< height where the profile starts [m]
  double rise = 0;            ///< time in which the current comes up once the grains are free [s]; 0: it is there
};

struct Params {
  double density = 1000;    ///< rho [kg/m3]
  double viscosity = 1e-6;  ///< nu [m2/s]
  Closure closure = Closure::k_epsilon;
  double realizability = 0.6;  ///< alpha of Durbin's bound, of k_epsilon_realizable [-]
  Convection convection = Convection::bounded;
  Algorithm algorithm = Algorithm::projection;
  Wall floor = Wall::rough;
  double floor_roughness = 0;        ///< ks [m]
  bool wall_damping = true;          ///< Van Driest's factor in epsilon at walls (Eq. 10-11) of the k-epsilon closures
  double courant = 0.8;              ///< target of the adaptive step [-]
  double courant_y = 0;              ///< the same along y, what is beyond `courant` being implicit; 0: all explicit [-]
  double max_step = 0.01;            ///< [s]; the step of simple
  double pressure_tolerance = 1e-6;  ///< residual after the solve over residual before it [-]
  int pressure_iterations = 100;     ///< most iterations before the solve counts as failed
  bool steady = false;               ///< simple without inertia
  double relax_velocity = 0.7;       ///< under-relaxation of simple [-]
  double relax_pressure = 0.3;
  double relax_turbulence = 0.7;
  double tolerance = 1e-3;    ///< of simple: outer iterations end when all scaled residuals are below it [-]
  int outer_iterations = 50;  ///< most of them in a step
  MeshParams mesh;
  PipeParams pipe;
  CurrentParams current;
};

}  // namespace livebed::flow
