#pragma once
#include <vector>

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

/// A volume whose own face is closed has no velocity; what the flow carries into it belongs to the open volumes beside
/// it.  Without this the pipe would take momentum besides its pressure and friction.
struct HandedOn {
  int from_i = 0, from_j = 0;  ///< closed volume
  int to_i = 0, to_j = 0;      ///< open neighbour
  double share = 0;            ///< of the neighbour, by the open area between the two
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

/// Every closed volume of u or v with water in it and open neighbours.
std::vector<HandedOn> hand_on(const Mesh& mesh, bool west);

}  // namespace livebed::flow
