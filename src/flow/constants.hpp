#pragma once

/// Constants, floors and tolerances of the flow: each has one name and this one home.
namespace livebed::flow {

inline constexpr double kappa = 0.41;        ///< von Karman (paper, below Eq. 8)
inline constexpr double smooth_E = 9.0;      ///< smooth log law (Eq. 8)
inline constexpr double rough_scale = 30.0;  ///< rough log law: U = u*/kappa ln(30 y/ks)
inline constexpr double van_driest = 26.0;   ///< Eq. 10-11

/// Standard k-epsilon, Launder and Spalding (1974); the paper's Table 1.
struct KEpsilon {
  double c_mu = 0.09, sigma_k = 1.0, sigma_epsilon = 1.3, c1 = 1.44, c2 = 1.92;
};
inline constexpr KEpsilon launder_spalding{};

/// Grains that take k from the eddies at the rate r take epsilon at this times r (Chauchat et al. 2017, C_3epsilon).
inline constexpr double grain_damping_epsilon = 1.2;
/// Eddies larger than the room between the grains break up this many times faster than they turn over.
inline constexpr double breakup = 100;
inline constexpr double k_floor = 1e-10;         ///< [m2/s2], water at rest; keeps k^2/epsilon defined
inline constexpr double epsilon_floor = 1e-12;   ///< [m2/s3]; with k_floor: nut = 1e-9 m2/s, far below nu
inline constexpr double nut_over_nu_most = 1e5;  ///< only hit by a start from rest, where epsilon is tiny and k not yet
inline constexpr double per_sqrt_3 = 0.5773502691896258;
inline constexpr double log_argument_least = 2.718281828459045;  ///< y/z0 is held above e: the log law ends there
inline constexpr double fixed_row = 1e14;     ///< factor that makes a row of a line system say c = given value
inline constexpr double volume_least = 1e-6;  ///< cells with less open volume count as solid [-]
/// The same beside moving grains: their room changes with every step, and the pressure in slivers, which moves little
/// water, answers with hundreds of kPa until the flow breaks down.  Costs the force on the pipe its second order.
inline constexpr double volume_least_among_grains = 0.05;
/// A volume holds at least so much over its widest opening [-]: a sliver would need a tiny step.
inline constexpr double inertia_least = 0.5;
inline constexpr double wall_distance_least =
    0.01;  ///< of a velocity from the pipe, in cells: friction of slivers stays finite [-]
inline constexpr double thwaites_leaves = -0.09;  ///< theta^2/nu dU/ds where a laminar layer leaves (Thwaites 1949)
inline constexpr int separation_smoothing = 3;    ///< passes over the pressure along the pipe before that
inline constexpr double separation_lag = 0.5;     ///< of the wake behind it, over D and the fastest water at the pipe
/// From the pipe to where the layers that left it laminar have turned turbulent, over D: a few tenths at Re_D of some
/// 1e4 (Bloor 1964, J. Fluid Mech. 19, 290), shorter beyond.
inline constexpr double transition_distance = 0.1;
/// Stress on water that would go on beyond the separation, over rho u^2; 0.3 and 3 give the same drag within 1 %.
inline constexpr double dead_water = 1.0;
inline constexpr double aperture_least = 1e-6;  ///< faces with less opening count as closed [-]

}  // namespace livebed::flow
