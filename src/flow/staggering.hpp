#pragma once
#include <vector>

#include "flow/mesh.hpp"

namespace livebed::flow {

/// The pipe's surface as one control volume of a velocity component meets it.  A cell's surface is shared by its two
/// faces as their openings are, so that closed faces take none of it.
struct WallPart {
  int i = 0, j = 0;              ///< of the volume
  double before = 0, after = 0;  ///< shares of the surface in cells (i - shift_x, j - shift_y) and (i, j) [-]
  double length = 0;             ///< of all of it [m]
  double friction = 0;           ///< factor x length at present [m2/s]
  double distance = 0;           ///< mean distance of the open part of the volume's face from the pipe [m]
};

/// Where a quantity lives on the grid: at cell centres, on west faces (u) or on south faces (v), with the control
/// volumes around it.  Whatever belongs to a face of such a volume is the mean of two cell faces, (i - shift_x, j -
/// shift_y) and (i, j): so u, v and scalars share every kernel.
struct Staggering {
  int shift_x = 0, shift_y = 0;
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0;            ///< unknowns: i0 <= i < i1, j0 <= j < j1
  std::vector<double> width, height;             ///< of the volumes [m]; entry i+2 is volume i, likewise below
  std::vector<double> hx, to_west, from_west;    ///< nodes i-1 and i: distance, i-1 to their face, their face to i [m]
  std::vector<double> hy, to_south, from_south;  ///< the same in y
  base::Field volume;                            ///< open volume [m2 per unit of depth]
  base::Field inertia;  ///< the same, but never much less than the open faces: a sliver would need a tiny step
  base::Field pressed;  ///< open area of the face the quantity lives on x distance of the pressures on its sides [m2]:
                        ///< what a pressure gradient pushes, so that the volumes lose to the pipe exactly the pressure
                        ///< on its surface
  /// Open area of west and south faces of the volumes as friction sees it [m]: 0 towards a closed volume, whose wall
  /// already has its friction, and larger where the pipe leaves the open parts of two faces closer than the faces.
  base::Field area_x, area_y;

  static Staggering centres(const Mesh& mesh);
  static Staggering west_faces(const Mesh& mesh);
  static Staggering south_faces(const Mesh& mesh);
};

/// Every open volume of u (west faces) or v (south faces) that meets the pipe.
std::vector<WallPart> share_wall(const Mesh& mesh, bool west);

}  // namespace livebed::flow
