#include "run/sampling.hpp"

#include <algorithm>
#include <cmath>

#include "grains/measures.hpp"
#include "run/shear.hpp"

namespace livebed::run {

namespace {

PipeCircle circle_of(const flow::PipeParams& pipe) { return {pipe.x, pipe.y, pipe.present ? pipe.diameter : 0.0}; }

SamplingGrid grid_of(const casefile::Case& c) {
  return sampling_grid(c.flow.mesh.length, c.flow.mesh.height, sampling_cell_over_d * c.grains.diameter);
}

}  // namespace

double measured_level(const casefile::Case& c, const grains::Bed& bed) {
  SolidFraction solid(grid_of(c), {}, c.grains.diameter);
  const grains::State& g = bed.state;
  solid.sample(g.x, g.y, g.diameter);
  const double height = grains::bed_height(g);
  const std::vector<double> line = bed_line(solid, solid.packed(packed_from * height, packed_to * height));
  double sum = 0;
  for (double y : line) sum += y;
  return sum / static_cast<double>(line.size());
}

const std::vector<std::string>& series_columns() {
  static const std::vector<std::string> columns = {"time_s",
                                                   "t_over_T",
                                                   "S_over_D",
                                                   "depth_under_pipe_over_D",
                                                   "hole_width_over_D",
                                                   "mound_height_over_D",
                                                   "mound_x_over_D",
                                                   "grain_flux_m2_s",
                                                   "drag_N_m",
                                                   "lift_N_m",
                                                   "theta_measured",
                                                   "mass_residual",
                                                   "fluid_momentum_x_N_s",
                                                   "grain_momentum_x_N_s",
                                                   "impulse_error_N_s",
                                                   "flow_step_s",
                                                   "courant",
                                                   "pressure_iterations",
                                                   "grain_mean_speed_m_s",
                                                   "grain_max_speed_m_s",
                                                   "contacts_per_grain",
                                                   "overlap_max_over_d"};
  return columns;
}

Sampler::Sampler(const Simulation& sim)
    : solid_(grid_of(sim.resolved()), circle_of(sim.resolved().flow.pipe), sim.resolved().grains.diameter) {
  const SamplingGrid& grid = solid_.grid();
  for (int i = 0; i < grid.nx; ++i) x_.push_back(grid.x(i));
  const grains::State& g = sim.bed().state;
  if (g.count() == 0) return;
  const double height = sim.resolved().bed_thickness;
  solid_.sample(g.x, g.y, g.diameter);
  original_.packed = solid_.packed(packed_from * height, packed_to * height);
  original_.level = mean_level(x_, bed_line(solid_, original_.packed), solid_.pipe());
}

Sample Sampler::sample(const Simulation& sim) {
  const casefile::Case& c = sim.resolved();
  const grains::State& g = sim.bed().state;
  const bool grains = g.count() > 0;
  Sample result;
  Hole hole;
  if (grains) {
    solid_.sample(g.x, g.y, g.diameter);
    result.line = bed_line(solid_, original_.packed);
    if (c.flow.pipe.present) hole = measure_hole(x_, result.line, original_.level, solid_.pipe());
  }
  const bool pipe = c.flow.pipe.present;
  const double D = pipe ? c.flow.pipe.diameter : 1.0;
  const flow::StepReport& report = sim.last_report();
  const grains::ContactMeasures contacts = grains ? grains::measure_contacts(sim.bed()) : grains::ContactMeasures{};
  const base::Vec2 force = report.pipe_force + sim.grain_force_on_pipe();
  const base::Vec2 error = sim.coupler().ledger().error();
  result.time = sim.time();
  result.depth_over_D = hole.depth / D;
  result.theta = measured_shields(c, sim.flow(), original_.level);
  result.largest_overlap = contacts.largest_overlap;
  result.row = {result.time,
                c.time_scale > 0 ? result.time / c.time_scale : 0.0,
                result.depth_over_D,
                hole.depth_under_pipe / D,
                hole.width / D,
                hole.mound_height / D,
                pipe && grains ? (hole.mound_x - c.flow.pipe.x) / D : 0.0,
                grains ? grains::solids_flux(c.grains, g) : 0.0,
                force.x,
                force.y,
                result.theta,
                report.mass_residual,
                sim.flow_momentum(),
                grains ? grains::momentum(c.grains, g).x : 0.0,
                std::max(std::abs(error.x), std::abs(error.y)),
                sim.last_step(),
                report.courant,
                static_cast<double>(report.pressure.iterations),
                grains ? grains::mean_speed(g) : 0.0,
                grains ? grains::max_speed(g) : 0.0,
                contacts.per_grain,
                result.largest_overlap};
  return result;
}

}  // namespace livebed::run
