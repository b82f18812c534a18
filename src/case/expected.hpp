#pragma once
#include <optional>

#include "base/sediment.hpp"
#include "case/case.hpp"

namespace livebed::casefile {

/// Pipe, current and sand as the formulas see them.  Without a pipe D = 0.
struct Scene {
  double D = 0;               ///< [m]
  double gap_ratio = 0;       ///< e/D [-]
  double d = 0;               ///< of the sand [m]
  double s = 2.65;            ///< specific density [-]
  double g = 9.81;            ///< [m/s2]
  double nu = 1e-6;           ///< [m2/s]
  double depth = 0;           ///< of the water above the bed [m]
  double shear_velocity = 0;  ///< u* [m/s]
  double mean_speed = 0;      ///< depth mean [m/s]
  double speed_at_pipe = 0;   ///< of the undisturbed current at the height of the pipe's centre [m/s]
  double porosity = 0.4;      ///< of the bed [-]
};
Scene scene_of(const Case& c);
/// The scene with sand of another diameter d [m] under a current with the Shields parameter theta, by the rough log
/// law.
Scene with_sand(Scene scene, double d, double theta);

/// What to expect before anything has run.
struct Expected {
  double theta = 0, theta_critical = 0, D_star = 0;
  double grain_reynolds = 0;  ///< Re* = u* d/nu
  double pipe_reynolds = 0;   ///< Re_D = U D/nu; 0 without a pipe
  double fall_speed = 0;      ///< w_s [m/s]
  double rouse = 0;           ///< w_s/(kappa u*)
  base::Regime regime = base::Regime::no_motion;
  // of a pipe; empty without one, or where no formula reaches
  std::optional<base::EquilibriumDepth> depth;  ///< in a live bed
  std::optional<double> time_scale;             ///< T [s], in a live bed
  std::optional<double> undermined;             ///< until S = tunnel_depth D by S_eq (1 - exp(-t/T)) [s]
  std::optional<double> onset_speed;            ///< at the pipe [m/s]; a pipe that does not touch the bed has none
};
/// A gap of a tenth of D counts as undermined, as in the report's stages.
inline constexpr double tunnel_depth = 0.1;

Expected expect(const Scene& scene);

}  // namespace livebed::casefile
