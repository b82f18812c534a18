#pragma once
#include "base/vec2.hpp"
#include "flow/mesh.hpp"

/// The pipe as cut cells: a true circle anywhere on the grid, seen as open fractions of faces and cells.
namespace livebed::flow {

/// Fills the apertures, volumes, wall lengths and wall distances of the mesh from mesh.pipe (all open without a pipe).
/// The outer boundary is closed only by boundary conditions, never by apertures.
void cut_pipe(Mesh& mesh);

/// Area of the part of the rectangle [x0,x1] x [y0,y1] that lies inside the circle of radius r about the origin [m2].
double circle_in_rectangle(double x0, double x1, double y0, double y1, double r);

/// The pipe's surface inside cell (i,j) as a vector [m]: its length times the normal that points into the fluid.  By
/// the divergence theorem it is the sum of the cell's open faces, so a uniform pressure gives no force on the closed
/// circle.
base::Vec2 wall_vector(const Mesh& mesh, int i, int j);

}  // namespace livebed::flow
