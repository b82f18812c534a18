#pragma once
#include <vector>

#include "base/field.hpp"
#include "flow/params.hpp"

namespace livebed::flow {

/// Staggered tensor-product grid with the pipe cut out of it.
///
/// Cell (i,j), 0 <= i < nx, 0 <= j < ny, spans [x(i), x(i+1)] x [y(j), y(j+1)].  Scalars sit at the centre; u(i,j) on
/// the cell's west face, v(i,j) on its south face.  Apertures are the open fractions of faces, volume that of the cell.
struct Mesh {
  int nx = 0, ny = 0;
  std::vector<double> x, y;                ///< faces [m], nx+1 and ny+1
  std::vector<double> xc, yc;              ///< centres [m], with two ghosts: centre_x(i) = xc[i+2]
  std::vector<double> dx_, dy_;            ///< widths [m], with two ghosts
  std::vector<double> dx_face_, dy_face_;  ///< distances of neighbouring centres [m], with two ghosts

  base::Field aperture_x;     ///< open fraction of the west face [-]
  base::Field aperture_y;     ///< open fraction of the south face [-]
  base::Field volume;         ///< open fraction of the cell [-]
  base::Field wall_length;    ///< length of the pipe's surface inside the cell [m]
  base::Field wall_distance;  ///< of the cell's fluid centroid from the pipe [m]; negative inside, 0 without a pipe

  double dx(int i) const { return dx_[i + 2]; }
  double dy(int j) const { return dy_[j + 2]; }
  double centre_x(int i) const { return xc[i + 2]; }
  double centre_y(int j) const { return yc[j + 2]; }
  /// Distance between the centres of cells i-1 and i: the width of the control volume of u(i,j).
  double dx_face(int i) const { return dx_face_[i + 2]; }
  double dy_face(int j) const { return dy_face_[j + 2]; }
  double length() const { return x[nx]; }
  double height() const { return y[ny]; }
  bool has_pipe() const { return pipe.present; }

  PipeParams pipe;  ///< where it is; pipe.present is false without one
};

/// Face positions of one direction: cells of width h in [fine_from, fine_to], growing by the ratio growth outside,
/// scaled so that the whole [0, length] is filled exactly.  Throws Fault (invalid case) when length or h are not
/// positive.
std::vector<double> stretched_faces(double length, double h, double growth, double fine_from, double fine_to);

/// The grid of the case with its pipe cut out.
Mesh make_mesh(const MeshParams& grid, const PipeParams& pipe);
/// The same from the positions of its faces [m], which begin at 0 and rise; an even number of columns.
Mesh make_mesh(const std::vector<double>& x, const std::vector<double>& y, const PipeParams& pipe);

/// The mesh with every opening and volume times the share of it that holds water: voidage at cell centres [-], 0 <
/// voidage <= 1, mean of both cells on faces.  All operators on this mesh are those of the volume-averaged equations,
/// inlet: what comes in through the west must not change with every grain that passes it: its faces stay as they are.
///   d(voidage)/dt + div(voidage u) = 0,   voidage du/dt + ... = - voidage grad p/rho + div(voidage stress) + ...
/// filled: a copy of the mesh, of which the openings are replaced.  Throws Fault (invalid case) for a value out of
/// range.
void fill_with_voids(const Mesh& mesh, const base::Field& voidage, bool inlet, Mesh& filled);
Mesh fill_with_voids(const Mesh& mesh, const base::Field& voidage, bool inlet = false);

}  // namespace livebed::flow
