#include "case/question.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "case/check.hpp"
#include "flow/profiles.hpp"

namespace livebed::casefile {
namespace {

// The box over D, as in the shipped case `mao`.
constexpr double box_length = 12, bed_thickness = 2, pipe_from_inlet = 4;
constexpr double fine_upstream = 2, fine_downstream = 6, fine_below_bed = 1, fine_above_pipe = 0.3;
// Cells over d: about the size of a grain, or the bed is too rough for the water.
constexpr double cell_x_over_d = 2.5, cell_y_over_d = 1.25, most_cell_over_D = 0.05;
constexpr double box_passages = 3;  ///< of the current during the spin-up
constexpr double end_over_T = 5;    ///< 0.99 of the way to equilibrium

double depth_of(const Question& q) { return q.depth > 0 ? q.depth : default_depth * q.pipe; }

/// A length in the unit people would choose.
std::string length(double m) {
  if (m < 0.01) return fmt::format("{:.4g} mm", 1e3 * m);
  return m < 0.995 ? fmt::format("{:.4g} cm", 1e2 * m) : fmt::format("{:.4g} m", m);
}

std::string duration(double s) {
  if (s < 120) return fmt::format("{:.3g} s", s);
  return s < 7200 ? fmt::format("{:.3g} min", s / 60) : fmt::format("{:.3g} h", s / 3600);
}

/// The current as it was asked.
std::string asked(const Question& q) {
  return q.current > 0 ? fmt::format("current {:.4g} m/s", q.current) : fmt::format("theta {:.4g}", q.theta);
}

std::string head(const Question& q, double d) {
  const Scene real = scene_of(q), model = scene_of(q, d);
  const Expected of_real = expect(real), of_model = expect(model);
  std::string text = fmt::format("# The question: a pipe of {}, {} over water {} deep, sand of {}, gap e/D = {:.4g}.\n",
                                 length(q.pipe), asked(q), length(depth_of(q)), length(q.sand), q.gap_ratio);
  if (d > q.sand) {
    text += fmt::format(
        "# ENLARGED GRAINS: {} stand for the sand of {}, {:.3g} times as large, because the real sand is out of "
        "reach.\n"
        "# Kept: the Shields parameter theta = {:.4g}, pipe, gap, depth.  Lost:\n"
        "#   the current: a depth mean of {:.3g} m/s pulls at these grains as {:.3g} m/s does at the sand;\n"
        "#   fall speed over u*: {:.3g} instead of {:.3g}, so what the water carries off is not that of the sand;\n"
        "#   the time scale T: {} instead of {}.  Compare in t/T, never in seconds;\n"
        "#   the threshold of motion: theta/theta_c = {:.3g} instead of {:.3g}.\n",
        length(d), length(q.sand), d / q.sand, of_real.theta, model.mean_speed, real.mean_speed,
        of_model.fall_speed / model.shear_velocity, of_real.fall_speed / real.shear_velocity,
        duration(base::scour_time_scale(q.pipe, d, model.s, model.g, of_model.theta)),
        duration(base::scour_time_scale(q.pipe, q.sand, real.s, real.g, of_real.theta)),
        of_model.theta / of_model.theta_critical, of_real.theta / of_real.theta_critical);
  }
  return text +
         "# livebed plan tells what to expect; free spans and the spread along the pipe are three-dimensional: not "
         "here.\n";
}

}  // namespace

double grain_step_of(double d) { return 1e-5 * std::sqrt(d / 2e-3); }

Scene scene_of(const Question& q) { return scene_of(q, q.sand); }

Scene scene_of(const Question& q, double d) {
  Scene w;
  w.D = q.pipe, w.gap_ratio = q.gap_ratio, w.depth = depth_of(q);
  double theta = q.theta;
  if (q.current > 0) {
    const double ks = roughness_over_diameter * q.sand;
    theta = flow::shields(flow::shear_velocity_from_mean(flow::Profile::rough, q.current, w.depth, ks, w.nu), w.s, w.g,
                          q.sand);
  }
  return with_sand(w, d, theta);
}

std::string title_of(const Question& q, double d) {
  return fmt::format("Pipe of {}, {}, sand of {}{}, e/D = {:.4g}", length(q.pipe), asked(q), length(q.sand),
                     d == q.sand ? "" : fmt::format(" as grains of {}", length(d)), q.gap_ratio);
}

std::string case_text(const Question& q, double d) {
  const double D = q.pipe, bed = bed_thickness * D, x = pipe_from_inlet * D;
  const Scene scene = scene_of(q, d);
  const double theta = flow::shields(scene.shear_velocity, scene.s, scene.g, d);
  const double T = base::scour_time_scale(D, d, scene.s, scene.g, theta);
  const bool real = d == q.sand;
  const std::string current =
      real && q.current > 0
          ? fmt::format("mean_speed = \"{:.6g} m/s\"  # over the depth", q.current)
          : fmt::format("theta = {:.6g}  # u*^2/((s-1) g d){}", theta, real ? "" : ", that of the real sand");
  const std::string supply = feed_from * x < feed_behind_inlet * d
                                 ? "\"periodic\"  # what leaves comes in again; the grains are too large for a feed"
                                 : "\"equilibrium\"  # what moves well before the pipe comes in; what leaves is gone";
  const double least_cell = most_cell_over_D * D;
  return head(q, d) +
         fmt::format(R"(preset = "livebed"

[case]
title = "{title}"

[mesh]
length = "{length:.6g} m"  # 12 D
height = "{height:.6g} m"  # bed and water
cell_x = "{cell_x:.4g} m"
cell_y = "{cell_y:.4g} m"  # near the size of a grain
growth = 1.06
fine_x_from = "{fine_x_from:.6g} m"
fine_x_to = "{fine_x_to:.6g} m"
fine_y_from = "{fine_y_from:.6g} m"  # 1 D below the bed
fine_y_to = "{fine_y_to:.6g} m"  # above the pipe

[pipe]
diameter = "{D:.6g} m"
x = "{x:.6g} m"
gap_ratio = {gap:.4g}  # e/D; 0: it touches the bed, below 0: it lies in it

[flow]
density = "1000 kg/m3"
viscosity = "1e-6 m2/s"

[current]
{current}

[bed]
thickness = "{bed:.6g} m"  # 2 D, so that the hole does not meet the floor
supply = {supply}

[grains]
diameter = "{d:.4g} mm"
density = "2650 kg/m3"
sleep = true  # grains at rest cost nothing

[contact]
steps = 20

[time]
grain_step = "{grain_step:.3g} s"
spin_up = "{spin_up:.3g} s"  # the current over the bed at rest
end_over_T = {end:.4g}  # T = {T:.3g} s

[output]
series_every = "{series:.2g} s"
bed_every = "{bed_every:.2g} s"
fields_every = "{fields:.2g} s"
checkpoint_every = "{checkpoint:.2g} s"
)",
                     fmt::arg("title", title_of(q, d)), fmt::arg("gap", q.gap_ratio),
                     fmt::arg("length", box_length * D), fmt::arg("height", bed + depth_of(q)),
                     fmt::arg("cell_x", std::min(cell_x_over_d * d, least_cell)),
                     fmt::arg("cell_y", std::min(cell_y_over_d * d, least_cell)),
                     fmt::arg("fine_x_from", x - fine_upstream * D), fmt::arg("fine_x_to", x + fine_downstream * D),
                     fmt::arg("fine_y_from", bed - fine_below_bed * D),
                     fmt::arg("fine_y_to", bed + (std::max(q.gap_ratio, 0.0) + 1 + fine_above_pipe) * D),
                     fmt::arg("D", D), fmt::arg("x", x), fmt::arg("current", current), fmt::arg("bed", bed),
                     fmt::arg("supply", supply), fmt::arg("d", 1e3 * d), fmt::arg("grain_step", grain_step_of(d)),
                     fmt::arg("spin_up", box_passages * box_length * D / scene.mean_speed), fmt::arg("end", end_over_T),
                     fmt::arg("T", T), fmt::arg("series", T / 500), fmt::arg("bed_every", T / 100),
                     fmt::arg("fields", T / 10), fmt::arg("checkpoint", T / 4));
}

}  // namespace livebed::casefile
