#include "flow/mesh.hpp"

#include <cmath>

#include "base/fault.hpp"
#include "base/loops.hpp"
#include "flow/pipe.hpp"

namespace livebed::flow {

using base::Exit;

namespace {

/// Width that grading asks for at position x: h inside the window, growing by (growth-1) per unit distance outside.
double wanted_width(double x, double h, double growth, double from, double to) {
  const double away = std::max({from - x, x - to, 0.0});
  return h + (growth - 1.0) * away;
}

void fill_axis(const std::vector<double>& faces, std::vector<double>& centre, std::vector<double>& width,
               std::vector<double>& between) {
  const int n = static_cast<int>(faces.size()) - 1;
  centre.assign(n + 4, 0.0);
  width.assign(n + 4, 0.0);
  between.assign(n + 5, 0.0);
  for (int i = 0; i < n; ++i) width[i + 2] = faces[i + 1] - faces[i];
  width[1] = width[0] = width[2];
  width[n + 2] = width[n + 3] = width[n + 1];
  for (int i = 0; i < n; ++i) centre[i + 2] = 0.5 * (faces[i] + faces[i + 1]);
  centre[1] = faces[0] - 0.5 * width[1];
  centre[0] = centre[1] - width[0];
  centre[n + 2] = faces[n] + 0.5 * width[n + 2];
  centre[n + 3] = centre[n + 2] + width[n + 3];
  for (int i = 1; i < n + 4; ++i) between[i] = centre[i] - centre[i - 1];
  between[0] = between[1];
  between[n + 4] = between[n + 3];
}

}  // namespace

std::vector<double> stretched_faces(double length, double h, double growth, double fine_from, double fine_to) {
  if (!(length > 0) || !(h > 0) || !(growth >= 1))
    base::fail(Exit::invalid_case,
               "grid: length {} m, cell {} m, growth {}: length and cell must be positive, growth 1 or more", length, h,
               growth);
  if (fine_from == 0 && fine_to == 0) fine_to = length;
  // Integrate dn/dx = 1/width: cells of the wanted grading, then bend the count to a whole even number (the pressure
  // solver halves it).
  const int samples = 20000;
  std::vector<double> count(samples + 1, 0.0);
  for (int s = 0; s < samples; ++s) {
    const double xm = (s + 0.5) * length / samples;
    count[s + 1] = count[s] + length / samples / wanted_width(xm, h, growth, fine_from, fine_to);
  }
  const int n = std::max(4, 2 * static_cast<int>(std::lround(0.5 * count[samples])));
  std::vector<double> faces(n + 1);
  int s = 0;
  for (int i = 1; i < n; ++i) {
    const double target = count[samples] * i / n;
    while (count[s + 1] < target) ++s;
    faces[i] = length / samples * (s + (target - count[s]) / (count[s + 1] - count[s]));
  }
  faces[0] = 0;
  faces[n] = length;
  if (growth == 1.0)
    for (int i = 0; i <= n; ++i) faces[i] = length * i / n;
  return faces;
}

Mesh make_mesh(const MeshParams& grid, const PipeParams& pipe) {
  return make_mesh(stretched_faces(grid.length, grid.cell_x, grid.growth, grid.fine_x_from, grid.fine_x_to),
                   stretched_faces(grid.height, grid.cell_y, grid.growth, grid.fine_y_from, grid.fine_y_to), pipe);
}

Mesh make_mesh(const std::vector<double>& x, const std::vector<double>& y, const PipeParams& pipe) {
  Mesh m;
  m.x = x;
  m.y = y;
  m.nx = static_cast<int>(m.x.size()) - 1;
  m.ny = static_cast<int>(m.y.size()) - 1;
  fill_axis(m.x, m.xc, m.dx_, m.dx_face_);
  fill_axis(m.y, m.yc, m.dy_, m.dy_face_);
  m.pipe = pipe;
  cut_pipe(m);
  return m;
}

namespace {

[[noreturn]] void refuse_voidage(const base::Field& voidage, int j) {
  int i = 0;
  while (voidage(i, j) > 0 && voidage(i, j) <= 1) ++i;
  base::fail(base::Exit::invalid_case,
             "void fraction {} in cell ({},{}): above 0 and at most 1 is allowed; fewer or smaller grains there",
             voidage(i, j), i, j);
}

}  // namespace

void fill_with_voids(const Mesh& mesh, const base::Field& voidage, bool inlet, Mesh& filled) {
  for (int j = 0; j < mesh.ny; ++j)
    if (!std::all_of(voidage.row(j), voidage.row(j) + mesh.nx, [](double e) { return e > 0 && e <= 1; }))
      refuse_voidage(voidage, j);
  base::for_each_item(0, mesh.ny + 1, [&](int j) {
    for (int i = 0; i <= mesh.nx; ++i) {
      // Outer faces are as open as the cells inside them.
      const int east = std::min(i, mesh.nx - 1), north = std::min(j, mesh.ny - 1);
      const int west = std::max(i - 1, 0), south = std::max(j - 1, 0);
      const double here = voidage(east, north);
      filled.aperture_x(i, j) = mesh.aperture_x(i, j) * (i == 0 && inlet ? 1.0 : 0.5 * (voidage(west, north) + here));
      filled.aperture_y(i, j) = mesh.aperture_y(i, j) * (0.5 * (voidage(east, south) + here));
      filled.volume(i, j) = mesh.volume(i, j) * here;
    }
  });
}

Mesh fill_with_voids(const Mesh& mesh, const base::Field& voidage, bool inlet) {
  Mesh filled = mesh;
  fill_with_voids(mesh, voidage, inlet, filled);
  return filled;
}

}  // namespace livebed::flow
