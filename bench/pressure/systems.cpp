#include "systems.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "flow/advance.hpp"
#include "flow/mapping.hpp"
#include "flow/profiles.hpp"

namespace livebed::bench {

using base::Field;

namespace {

constexpr double D = 0.05, mean_speed = 0.197;

/// Rows of height h in [0, fine], growing above by `growth`, make n rows of which the largest is `stretch` times the
/// smallest: dn/dy = 1/(h + (growth - 1)(y - fine)) integrated.
void stretch_rows(flow::MeshParams& mesh, int n, double stretch) {
  if (stretch <= 1) {
    mesh.cell_y = mesh.height / n;
    return;
  }
  const double fine = 0.3 * D, above = mesh.height - fine;
  mesh.fine_y_to = fine;
  mesh.cell_y = (fine + above * std::log(stretch) / (stretch - 1)) / n;
  mesh.growth = 1 + (stretch - 1) * mesh.cell_y / above;
}

/// Column width that makes n columns with the growth that the rows have, fine round the pipe.
void stretch_columns(flow::MeshParams& mesh, int n, double pipe_x) {
  if (mesh.growth == 1) {
    mesh.cell_x = mesh.length / n;
    return;
  }
  mesh.fine_x_from = pipe_x - D, mesh.fine_x_to = pipe_x + 2 * D;
  const double slope = mesh.growth - 1;
  const auto count = [&](double h) {
    const auto graded = [&](double away) { return std::log(1 + slope * away / h) / slope; };
    return (mesh.fine_x_to - mesh.fine_x_from) / h + graded(mesh.fine_x_from) + graded(mesh.length - mesh.fine_x_to);
  };
  double low = 1e-6, high = mesh.length;
  for (int k = 0; k < 100; ++k) {
    const double middle = std::sqrt(low * high);
    (count(middle) > n ? low : high) = middle;
  }
  mesh.cell_x = low;
}

flow::Params pipe_flow() {
  flow::Params p;
  p.viscosity = mean_speed * D / 9500;
  p.mesh.length = 30 * D;
  p.mesh.height = 3.5 * D;
  p.pipe.diameter = D;
  p.pipe.x = 10 * D;
  p.pipe.y = 0.8 * D;
  p.pipe.gap_ratio = 0.3;
  p.floor = flow::Wall::smooth;
  p.current.profile = flow::Profile::smooth;
  p.current.mean_speed = mean_speed;
  p.current.shear_velocity =
      flow::shear_velocity_from_mean(flow::Profile::smooth, mean_speed, p.mesh.height, 0.0, p.viscosity);
  p.courant = 0.85;
  p.max_step = 0.1;
  return p;
}

flow::Solver make_solver(const flow::Params& p) {
  const flow::Mesh mesh = flow::make_mesh(p.mesh, p.pipe);
  return {p, mesh, flow::make_boundary(mesh, p)};
}

/// Water fraction of a packed bed at a place: 0.4-0.6, another value every 2 mm; 1 above the bed.
double water_fraction(double x, double y, double bed) {
  constexpr double grain = 2e-3;
  if (y > bed) return 1;
  auto hash = static_cast<std::uint32_t>(std::lround(std::floor(x / grain)) * 73856093) ^
              static_cast<std::uint32_t>(std::lround(std::floor(y / grain)) * 19349663);
  hash = (hash ^ (hash >> 15)) * 0x2c1b3c6dU;
  hash = (hash ^ (hash >> 12)) * 0x297a2d39U;
  return 0.4 + 0.2 * static_cast<double>(hash >> 8) / (1 << 24);
}

/// The system of a grid, b and guess still 0.
System without_source(const std::string& name, const flow::Mesh& m, bool grains) {
  const int nx = m.nx, ny = m.ny;
  System s;
  s.name = name, s.nx = nx, s.ny = ny;
  s.x = m.x, s.y = m.y;
  s.c_x = s.c_y = s.c_boundary = s.b = s.guess = Field(nx, ny);
  Field alpha(nx, ny, 2, 1.0);
  if (grains)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) alpha(i, j) = water_fraction(m.centre_x(i), m.centre_y(j), 0.5 * m.height());
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      if (i > 0) s.c_x(i, j) = m.aperture_x(i, j) * 0.5 * (alpha(i - 1, j) + alpha(i, j)) * m.dy(j) / m.dx_face(i);
      if (j > 0) s.c_y(i, j) = m.aperture_y(i, j) * 0.5 * (alpha(i, j - 1) + alpha(i, j)) * m.dx(i) / m.dy_face(j);
      s.aspect = std::max({s.aspect, m.dx(i) / m.dy(j), m.dy(j) / m.dx(i)});
    }
    s.c_boundary(nx - 1, j) = alpha(nx - 1, j) * m.dy(j) / (0.5 * m.dx(nx - 1));
  }
  for (int j = 0; j < ny; ++j) {
    double here = 0, across = 0;
    for (int i = 0; i < nx; ++i)
      here += alpha(i, j) / nx, across += 0.5 * (alpha(i, std::max(j - 1, 0)) + alpha(i, j)) / nx;
    s.openness.push_back(here), s.openness_across.push_back(across);
  }
  return s;
}

}  // namespace

double System::diagonal(int i, int j) const {
  return c_x(i, j) + c_x(i + 1, j) + c_y(i, j) + c_y(i, j + 1) + c_boundary(i, j);
}

double System::relative_residual(const Field& p) const {
  double left = 0, right = 0;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      right += base::square(b(i, j));
      if (diagonal(i, j) == 0) continue;
      const double flux = diagonal(i, j) * p(i, j) - c_x(i, j) * p(i - 1, j) - c_x(i + 1, j) * p(i + 1, j) -
                          c_y(i, j) * p(i, j - 1) - c_y(i, j + 1) * p(i, j + 1);
      left += base::square(b(i, j) - flux);
    }
  return std::sqrt(left / right);
}

System make_system(const Choice& choice) {
  flow::Params coarse_params = pipe_flow();
  coarse_params.mesh.cell_x = coarse_params.mesh.length / 186;
  coarse_params.mesh.cell_y = coarse_params.mesh.height / 32;
  flow::Solver coarse = make_solver(coarse_params);
  coarse.start();
  while (coarse.state.time < 6) coarse.advance(coarse.step_limit());

  flow::Params p = pipe_flow();
  stretch_rows(p.mesh, choice.ny, choice.stretch);
  stretch_columns(p.mesh, choice.nx, p.pipe.x);
  flow::Solver fine = make_solver(p);
  flow::map_flow(coarse, fine);
  // The first steps take the divergence away that the mapping leaves.
  for (int k = 0; k < 6; ++k) fine.advance(fine.step_limit());
  const Field last = fine.state.p_change;
  const double last_step = fine.state.step, step = fine.step_limit();
  fine.advance(step);

  System s = without_source(choice.name, fine.mesh(), choice.grains);
  const Field& change = fine.state.p_change;
  for (int j = 0; j < s.ny; ++j)
    for (int i = 0; i < s.nx; ++i) {
      if (s.diagonal(i, j) == 0) continue;
      const auto flux = [&](double c, int a, int b) { return c > 0 ? c * (change(i, j) - change(a, b)) : 0.0; };
      s.b(i, j) = flux(s.c_x(i, j), i - 1, j) + flux(s.c_x(i + 1, j), i + 1, j) + flux(s.c_y(i, j), i, j - 1) +
                  flux(s.c_y(i, j + 1), i, j + 1) + s.c_boundary(i, j) * change(i, j);
      s.guess(i, j) = last(i, j) * step / last_step;
    }
  return s;
}

System make_thin_system() {
  flow::MeshParams grid;
  grid.cell_x = 0.05, grid.cell_y = 0.0005;
  grid.length = 80 * grid.cell_x, grid.height = 100 * grid.cell_y;
  flow::PipeParams no_pipe;
  no_pipe.present = false;
  const flow::Mesh m = flow::make_mesh(grid, no_pipe);
  System s = without_source("no pipe", m, false);
  // What a current that meanders leaves of its mass: u = 0.2 (1 + 0.1 sin(x/h) cos(y/h)), nothing upwards.
  const auto flow_through = [&](int face, int j) {
    return 0.2 * (1 + 0.1 * std::sin(m.x[face] / grid.height) * std::cos(m.centre_y(j) / grid.height)) * m.dy(j);
  };
  for (int j = 0; j < s.ny; ++j)
    for (int i = 0; i < s.nx; ++i) s.b(i, j) = flow_through(i, j) - flow_through(i + 1, j);
  return s;
}

}  // namespace livebed::bench
