#pragma once
#include <optional>
#include <string_view>

/// What experiments say of sand, of its motion and of the hole under a pipe: the formulas that a run is planned with
/// and held against.  Pure numbers in, numbers out; s is the specific density of the grains [-], g gravity [m/s2], nu
/// the kinematic viscosity of the water [m2/s].  Where the text of a formula was not seen in its source,
/// docs/equations.md says so.
namespace livebed::base {

/// Diameter of the grains as gravity and viscosity see it, D* = d ((s-1) g/nu^2)^(1/3) [-].
double dimensionless_diameter(double d, double s, double g, double nu);

/// Shields parameter at which sand begins to move on a flat bed [-]: Soulsby (1997), Dynamics of Marine Sands,
/// 0.30/(1 + 1.2 D*) + 0.055 (1 - exp(-0.020 D*)).
double critical_shields(double D_star);

/// Fall speed of a grain of natural sand in still water [m/s]: Soulsby (1997), nu/d (sqrt(10.36^2 + 1.049 D*^3)
/// - 10.36).
double fall_speed(double d, double s, double g, double nu);

/// w_s/(kappa u*) [-].  Above 2.5 sand stays near the bed, below 0.8 the water carries it through its whole depth (the
/// usual limits, e.g. Fredsoe and Deigaard 1992).
double rouse_number(double fall_speed, double shear_velocity, double kappa);

/// Solids flux over sqrt((s-1) g d^3) [-]: Meyer-Peter and Mueller (1948), 8 (theta - 0.047)^1.5; 0 below.
double meyer_peter_mueller(double theta);
/// The same after Camenen and Larson (2005), Estuar. Coast. Shelf Sci. 63, 249: 12 theta^1.5 exp(-4.5 theta_c/theta).
double camenen_larson(double theta, double critical);

/// What a current does to the bed: nothing anywhere; digs under the pipe while the bed around rests; moves all of it.
enum class Regime { no_motion, clear_water, live_bed };
/// By the Shields parameter over the critical one.  A pipe raises the stress under it up to `pipe_amplification` times.
Regime regime(double theta, double critical, bool pipe);
/// Largest stress under a pipe over that far from it while the gap is small (Sumer and Fredsoe 2002: of order 4).
inline constexpr double pipe_amplification = 4;

/// Depth S of the hole at equilibrium over D, in a live bed.
struct EquilibriumDepth {
  double over_D = 0;
  double scatter = 0;  ///< one standard deviation of experiments [-]; 0: not known
  std::string_view formula, source;
};
/// After the gap ratio e/D of a pipe on a flat bed: 0.6 +- 0.2 where it touches (Sumer and Fredsoe 2002), 0.625
/// exp(-0.6 e/D) above (Hansen, Fredsoe and Mao 1986, up to e/D = 2).  Empty for a pipe embedded by a tenth of D or
/// more or further up.
std::optional<EquilibriumDepth> equilibrium_depth(double gap_ratio);

/// Time scale of S(t) = S_eq (1 - exp(-t/T)) [s]: Fredsoe, Sumer and Arnskov (1992), T = D^2/sqrt(g (s-1) d^3)
/// theta^(-5/3)/50.
double scour_time_scale(double D, double d, double s, double g, double theta);

/// Current at the pipe from which on seepage breaks through under it [m/s]: Sumer, Truelsen, Sichmann and Fredsoe
/// (2001), Coastal Eng. 42, 313: U^2 = 0.025 exp(9 sqrt(b)) g D (1 - n)(s - 1), n the porosity of the bed, b the burial
/// depth over D, 0 <= b <= deepest_burial.
double onset_speed(double D, double s, double g, double porosity, double burial_ratio);
inline constexpr double deepest_burial = 0.5;

}  // namespace livebed::base
