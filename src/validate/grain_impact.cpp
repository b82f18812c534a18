#include "validate/grain_impact.hpp"

#include <cmath>
#include <sstream>

#include "grains/advance.hpp"
#include "validate/references.hpp"

namespace livebed::validate {

Rebound run_oblique_impact(double angle, double shear_ratio) {
  constexpr double speed = 3.9, friction = 0.092, restitution = 0.98;
  grains::Params p;
  p.diameter = 5e-3;
  p.density = 4000;
  p.spread = 0;
  p.fluid_density = 1e-9;  // in vacuum
  p.added_mass = 0;
  p.gravity = 0;
  p.stiffness = 1e7;  // an overlap of a few thousandths of the diameter
  p.steps_per_contact = 2000;
  p.restitution = restitution;
  p.poisson = 0.5 / shear_ratio - 1;
  p.wall_factor = 2;  // twice the spring and the dashpot for twice the mass in play, so that the restitution holds
  p.friction = friction / p.wall_factor;
  p.count = 1;
  p.length = 0.1;
  grains::Bed bed = grains::make_bed(grains::derive(p));
  const double radians = angle * base::pi / 180, u = speed * std::sin(radians), v = speed * std::cos(radians);
  grains::State& s = bed.state;
  s.x[0] = 0.5 * p.length, s.y[0] = 0.51 * p.diameter;
  s.u[0] = u, s.v[0] = -v;
  while (s.v[0] < 0 || s.y[0] < 0.51 * p.diameter) grains::advance(bed, 1);
  const double slip = s.u[0] + 0.5 * p.diameter * s.omega[0];
  return {s.u[0] / u, s.omega[0], std::atan2(slip, s.v[0]) * 180 / base::pi};
}

ImpactData impact_data(const std::string& series, const std::string& quantity) {
  ImpactData data;
  std::istringstream lines{std::string(oblique_impact)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string of_series, of_quantity, angle, value;
    std::getline(cells, of_series, ',');
    std::getline(cells, of_quantity, ',');
    std::getline(cells, angle, ',');
    std::getline(cells, value, ',');
    if (of_series != series || of_quantity != quantity) continue;
    data.angle.push_back(std::stod(angle));
    data.value.push_back(std::stod(value));
  }
  return data;
}

}  // namespace livebed::validate
