#include "case/expected.hpp"

#include <algorithm>
#include <cmath>

#include "case/check.hpp"
#include "flow/constants.hpp"
#include "flow/profiles.hpp"

namespace livebed::casefile {

namespace {

double speed_at_pipe(const Scene& w, double z0) {
  return flow::log_law((std::max(w.gap_ratio, 0.0) + 0.5) * w.D, w.shear_velocity, z0);
}

}  // namespace

Scene scene_of(const Case& c) {
  const flow::CurrentParams& current = c.flow.current;
  Scene scene;
  if (c.flow.pipe.present) scene.D = c.flow.pipe.diameter, scene.gap_ratio = c.flow.pipe.gap_ratio;
  scene.d = c.grains.diameter, scene.s = c.grains.density / c.flow.density, scene.g = c.grains.gravity;
  scene.nu = c.flow.viscosity;
  scene.shear_velocity = current.shear_velocity, scene.mean_speed = current.mean_speed;
  scene.depth = c.flow.mesh.height - c.bed_thickness;
  const auto law = current.profile == flow::Profile::smooth ? flow::Profile::smooth : flow::Profile::rough;
  scene.speed_at_pipe = speed_at_pipe(scene, flow::zero_level(law, current.roughness, scene.shear_velocity, scene.nu));
  return scene;
}

Scene with_sand(Scene w, double d, double theta) {
  w.d = d;
  w.shear_velocity = flow::shear_velocity_from_shields(theta, w.s, w.g, d);
  const double z0 = flow::zero_level(flow::Profile::rough, roughness_over_diameter * d, w.shear_velocity, w.nu);
  w.mean_speed = flow::depth_mean(w.depth, w.shear_velocity, z0);
  w.speed_at_pipe = speed_at_pipe(w, z0);
  return w;
}

Expected expect(const Scene& w) {
  Expected e;
  e.theta = flow::shields(w.shear_velocity, w.s, w.g, w.d);
  e.D_star = base::dimensionless_diameter(w.d, w.s, w.g, w.nu);
  e.theta_critical = base::critical_shields(e.D_star);
  e.grain_reynolds = w.shear_velocity * w.d / w.nu;
  e.pipe_reynolds = w.mean_speed * w.D / w.nu;
  e.fall_speed = base::fall_speed(w.d, w.s, w.g, w.nu);
  e.rouse = base::rouse_number(e.fall_speed, w.shear_velocity, flow::kappa);
  e.regime = base::regime(e.theta, e.theta_critical, w.D > 0);
  if (w.D == 0) return e;
  if (w.gap_ratio <= 0 && -w.gap_ratio <= base::deepest_burial)
    e.onset_speed = base::onset_speed(w.D, w.s, w.g, w.porosity, -w.gap_ratio);
  if (e.regime != base::Regime::live_bed) return e;
  e.depth = base::equilibrium_depth(w.gap_ratio);
  e.time_scale = base::scour_time_scale(w.D, w.d, w.s, w.g, e.theta);
  if (e.depth && e.depth->over_D > tunnel_depth && w.gap_ratio < tunnel_depth)
    e.undermined = -*e.time_scale * std::log(1 - tunnel_depth / e.depth->over_D);
  return e;
}

}  // namespace livebed::casefile
