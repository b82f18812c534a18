#include "run/sampling.hpp"

#include <algorithm>
#include <cmath>

#include "flow/profiles.hpp"
#include "grains/measures.hpp"

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

double Sampler::measured_theta(const Simulation& sim) const {
  const casefile::Case& c = sim.resolved();
  const flow::Mesh& m = sim.flow().mesh();
  const flow::State& s = sim.flow().state;
  const double rho = c.flow.density;
  // Upstream of the pipe, out of reach of the inlet; without a pipe the middle of the box.
  const bool pipe = c.flow.pipe.present;
  const double from = pipe ? 0.25 * c.flow.pipe.x : 0.3 * m.length();
  const double to = pipe ? c.flow.pipe.x - 1.5 * c.flow.pipe.diameter : 0.9 * m.length();
  const int plane =
      static_cast<int>(std::lower_bound(m.y.begin(), m.y.end() - 1, original_.level - 1e-9 * m.height()) - m.y.begin());
  const auto stress_at_bed = [&](int i) {
    const double nut = 0.25 * (s.nut(i - 1, plane - 1) + s.nut(i, plane - 1) + s.nut(i - 1, plane) + s.nut(i, plane));
    const double shear =
        (s.u(i, plane) - s.u(i, plane - 1)) / m.dy_face(plane) + (s.v(i, plane) - s.v(i - 1, plane)) / m.dx_face(i);
    const double u = 0.5 * (s.u(i, plane) + s.u(i, plane - 1)), v = 0.5 * (s.v(i, plane) + s.v(i - 1, plane));
    double drag = 0;
    for (int j = plane; j < m.ny; ++j) drag += (s.load.beta_u(i, j) * s.u(i, j) - s.load.force_u(i, j)) * m.dy(j);
    return rho * (c.flow.viscosity + nut) * shear - rho * u * v + drag;
  };
  double stress = 0, length = 0;
  for (int i = 1; i < m.nx; ++i) {
    if (m.x[i] < from || m.x[i] > to) continue;
    const double width = m.dx_face(i);
    stress += width * (plane > 0 ? stress_at_bed(i) : rho * base::square(sim.flow().floor_shear_velocity(i)));
    length += width;
  }
  if (length == 0) return 0;
  const double u_star = std::sqrt(std::max(0.0, stress / length) / rho);
  return flow::shields(u_star, c.grains.density / rho, c.grains.gravity, c.grains.diameter);
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
  result.theta = measured_theta(sim);
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
