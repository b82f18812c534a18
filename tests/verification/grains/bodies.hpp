#pragma once
#include <algorithm>
#include <cmath>
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

/// The same grain above a plane of this spring [N/m], restitution and friction, all three those of the grain with the
/// plane.
inline Params above_plane(Params p, double stiffness, double restitution, double friction, Tension tension) {
  p.wall_factor = 2;  // spring, dashpot and friction of the plane are twice those of two grains
  p.stiffness = 0.5 * stiffness;
  p.friction = 0.5 * friction;
  p.restitution = restitution;
  p.tension = tension;
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

/// A grain thrown at the floor without gravity, u along it, v > 0 towards it, spinning; returns it after the rebound.
inline Body thrown_at_floor(Params p, double u, double v, double omega = 0) {
  p.gravity = 0;
  Bed bed = bed_of(p, {{0.5 * p.length, 0.6 * p.diameter, u, -v, omega}});
  while (body(bed, 0).y < 0.6 * p.diameter || body(bed, 0).v < 0) advance(bed, 1);
  return body(bed, 0);
}

/// Two grains that meet along x without gravity, a tenth of a diameter apart at first; returns both once they have
/// parted again.  Only speeds and spins of left and right count.
struct Meeting {
  Body left, right;
  double overlap = 0;  ///< the largest [m]
};
inline Meeting meet(Params p, Body left, Body right) {
  p.gravity = 0;
  const double middle = 0.5 * p.length, apart = 0.55 * p.diameter;
  left.x = middle - apart, right.x = middle + apart;
  left.y = right.y = 10 * p.diameter;
  Bed bed = bed_of(p, {left, right});
  Meeting result;
  do {
    advance(bed, 1);
    result.left = body(bed, 0), result.right = body(bed, 1);
    const double distance = std::hypot(result.right.x - result.left.x, result.right.y - result.left.y);
    result.overlap = std::max(result.overlap, p.diameter - distance);
  } while (result.right.u <= result.left.u || result.right.x - result.left.x < 2 * apart);
  return result;
}

/// Rows of a csv file of data/, cell by cell; comment lines start with '#', one header line follows.
inline std::vector<std::vector<std::string>> read_cells(const std::string& name) {
  std::ifstream file(std::string(LIVEBED_SOURCE_DIR) + "/data/" + name);
  if (!file) base::fail(base::Exit::input_output, "data/{} cannot be read", name);
  std::vector<std::vector<std::string>> rows;
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
    while (std::getline(cells, cell, ',')) rows.back().push_back(cell);
  }
  return rows;
}

/// The same where every cell is a number.
inline std::vector<std::vector<double>> read_csv(const std::string& name) {
  std::vector<std::vector<double>> rows;
  for (const auto& cells : read_cells(name)) {
    rows.emplace_back();
    for (const std::string& cell : cells) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

}  // namespace livebed::grains::bodies
