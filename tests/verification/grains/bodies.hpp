#pragma once
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "grains/advance.hpp"

/// Small beds that the tests of the grains share.
namespace livebed::grains::bodies {

/// Two millimetre quartz in water, undamped and smooth unless the test says otherwise; a box high and long enough to be
/// alone in.
inline Params quartz() {
  Params p;
  p.spread = 0;
  p.stiffness = 5500;
  p.steps_per_contact = 200;
  p.restitution = 1;
  p.friction = 0;
  p.length = 0.1;
  return p;
}

/// A grain of this density falling in vacuum: no added mass, no buoyancy.
inline Params dry(double diameter, double density, double stiffness) {
  Params p = quartz();
  p.diameter = diameter;
  p.density = density;
  p.fluid_density = 1e-9;
  p.added_mass = 0;
  p.stiffness = stiffness;
  p.wall_factor = 1;
  p.length = 20 * diameter;
  return p;
}

struct Body {
  double x = 0, y = 0, u = 0, v = 0, omega = 0;
};

inline Bed bed_of(Params p, const std::vector<Body>& bodies) {
  p.count = static_cast<int>(bodies.size());
  Bed bed = make_bed(derive(p));
  for (int i = 0; i < p.count; ++i) {
    bed.state.x[i] = bodies[i].x;
    bed.state.y[i] = bodies[i].y;
    bed.state.u[i] = bodies[i].u;
    bed.state.v[i] = bodies[i].v;
    bed.state.omega[i] = bodies[i].omega;
  }
  return bed;
}

/// Where grain `id` stands now: sorting moves it.
inline int place_of(const Bed& bed, int id) {
  for (int i = 0; i < bed.state.count(); ++i) {
    if (bed.state.id[i] == id) return i;
  }
  return -1;
}

inline Body body(const Bed& bed, int id) {
  const State& s = bed.state;
  const int i = place_of(bed, id);
  return {s.x[i], s.y[i], s.u[i], s.v[i], s.omega[i]};
}

/// Numbers of a csv file of tests/data; comment lines start with '#', one header line follows.
inline std::vector<std::vector<double>> read_csv(const std::string& name) {
  std::ifstream file(std::string(LIVEBED_SOURCE_DIR) + "/tests/data/" + name);
  if (!file) base::fail(base::Exit::input_output, "tests/data/{} cannot be read", name);
  std::vector<std::vector<double>> rows;
  std::string line, cell;
  bool header = true;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    if (header) {
      header = false;
      continue;
    }
    std::istringstream cells(line);
    rows.emplace_back();
    while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

}  // namespace livebed::grains::bodies
