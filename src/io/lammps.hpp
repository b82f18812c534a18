#pragma once
#include <vector>

#include "grains/params.hpp"
#include "grains/state.hpp"
#include "io/file.hpp"

/// Beds as data files of LAMMPS (read_data, atom_style sphere), which OVITO and other grain codes read, too.
namespace livebed::io {

/// Grains of a data file, in the order of their ids.
struct LammpsBed {
  double length = 0;                      ///< of the box in x [m]; its lower end is moved to x = 0
  std::vector<double> diameter, density;  ///< [m], [kg/m3]
  std::vector<double> x, y, u, v, omega;  ///< [m], [m/s], [1/s]; at rest when the file has no velocities
};

/// Writes grain `id` as atom id + 1 of type 1: diameter, density of the sand, x, y, z = 0; velocities (spin about z).
/// Numbers are the shortest that read back to the same bits.  The box: 0 to the length, the floor at y = 0 a layer
/// above its lower end, up to `height` [m].
void write_lammps(const Path& path, const grains::Params& params, const grains::State& grains, double height);

/// Reads the sections Atoms (style sphere) and, when it is there, Velocities; others are passed over.  Fault
/// (input/output) with file and line when a number is missing or none, when grains lie outside the box, below y = 0 or
/// not in one plane z = 0, when ids are doubled, or when their number is not the one the header tells.
LammpsBed read_lammps(const Path& path);

}  // namespace livebed::io
