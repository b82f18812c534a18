#pragma once
#include <vector>

#include "base/shared_rows.hpp"
#include "flow/mesh.hpp"

namespace livebed::flow {

/// The pipe's surface as one control volume of a velocity component meets it.  A cell's surface is shared by its two
/// faces as their openings are, so that closed faces take none of it.
struct WallPart {
  int i = 0, j = 0;     ///< of the volume
  double length = 0;    ///< of the surface [m]
  double distance = 0;  ///< mean distance of the open part of the volume's face from the pipe [m]
  double friction = 0;  ///< friction factor x length at present [m2/s]
};

/// A cell that holds a piece of the pipe's surface.
struct WallCell {
  int i, j;
};

/// A volume whose own face is closed has no velocity; what the flow carries into it belongs to the open volumes beside
/// it.  Without this the pipe would take momentum besides its pressure and friction.
struct HandedOn {
  int from_i = 0, from_j = 0;  ///< closed volume
  int to_i = 0, to_j = 0;      ///< open neighbour
  double share = 0;            ///< of the neighbour, by the open area between the two
};

/// Room for the openings of a grid's volumes while they are worked out.
struct OpeningScratch {
  base::Field volume, open, open_x, open_y, inertia, per_inertia;
};

/// Where a quantity lives on the grid: at cell centres, on west faces (u) or on south faces (v), with the control
/// volumes around it.  Whatever belongs to a face of such a volume is the mean of two cell faces, (i - shift_x, j -
/// shift_y) and (i, j): so u, v and scalars share every kernel.  Vectors have two ghosts in front: entry i+2 belongs to
/// volume i.  Openings are fractions, so that rows without pipe are all alike, whatever the grid.
struct Staggering {
  int shift_x = 0, shift_y = 0;
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0;            ///< unknowns: i0 <= i < i1, j0 <= j < j1
  std::vector<double> width, height;             ///< of the volumes [m]
  std::vector<double> hx, to_west, from_west;    ///< nodes i-1 and i: distance, i-1 to their face, their face to i [m]
  std::vector<double> hy, to_south, from_south;  ///< the same in y
  std::vector<double> per_width, per_hx;         ///< 1/width, 1/hx [1/m]
  std::vector<double> per_height, per_hy;
  /// Flux through a south face of the volume over its width: shares of the faces of cells i - shift_x and i [-]; and
  /// through a west face over its height, of cells j - shift_y and j.
  std::vector<double> share_x_before, share_x, share_y_before, share_y;
  base::SharedRows open_volume;  ///< of the volume [-]
  base::SharedRows inertia_;     ///< the same, but never much less than the open faces: a sliver would need a tiny step
  base::SharedRows per_inertia;  ///< 1/inertia_
  base::SharedRows open;  ///< of the face (of the cell) the quantity lives on: what a pressure gradient pushes, so
                          ///< that the volumes lose to the pipe exactly the pressure on its surface
  /// West and south faces of the volumes as friction sees them [-]: 0 towards a closed volume, whose wall already has
  /// its friction, and larger where the pipe leaves the open parts of two faces closer than the faces.
  base::SharedRows open_x, open_y;

  double whole(int i, int j) const { return width[i + 2] * height[j + 2]; }
  double volume(int i, int j) const { return open_volume(i, j) * whole(i, j); }  ///< [m2 per unit of depth]
  double inertia(int i, int j) const { return inertia_(i, j) * whole(i, j); }    ///< [m2]
  double area_x(int i, int j) const { return open_x(i, j) * height[j + 2]; }     ///< [m]
  double area_y(int i, int j) const { return open_y(i, j) * width[i + 2]; }      ///< [m]

  /// Takes over the openings of a mesh with the same faces.
  void open_to(const Mesh& mesh, OpeningScratch& scratch);

  static Staggering centres(const Mesh& mesh);
  static Staggering west_faces(const Mesh& mesh);
  static Staggering south_faces(const Mesh& mesh);
};

std::vector<WallCell> find_wall_cells(const Mesh& mesh);

/// Every open volume of u (west faces) or v (south faces) that meets the pipe.
std::vector<WallPart> share_wall(const Mesh& mesh, bool west);

/// Every closed volume of u or v with water in it and open neighbours.
std::vector<HandedOn> hand_on(const Mesh& mesh, bool west);

}  // namespace livebed::flow
