#pragma once
#include <cmath>

#include "base/math.hpp"
#include "flow/advance.hpp"

/// What the tests of laminar flow share.
namespace livebed::flow {

/// A laminar case without pipe on nx x ny equal cells.
inline Params laminar(double length, double height, int nx, int ny, double nu) {
  Params p;
  p.viscosity = nu;
  p.density = 1000;
  p.closure = Closure::laminar;
  p.pressure_tolerance = 1e-9;
  p.mesh.length = length, p.mesh.height = height;
  p.mesh.cell_x = length / nx, p.mesh.cell_y = height / ny;
  p.pipe.present = false;
  p.max_step = 1e9;
  return p;
}

/// Root-mean-square difference of two velocity fields, weighted with the volumes.
inline double distance(const Mesh& m, const base::Field& u, const base::Field& v, const base::Field& u2,
                       const base::Field& v2) {
  double sum = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      const double along = u(i, j) - u2(i, j), across = v(i, j) - v2(i, j);
      sum += base::square(along) * m.dx_face(i) * m.dy(j) + base::square(across) * m.dx(i) * m.dy_face(j);
    }
  return std::sqrt(sum / (m.length() * m.height()));
}

}  // namespace livebed::flow
