#pragma once
#include "base/field.hpp"
#include "flow/mesh.hpp"
#include "flow/state.hpp"

namespace livebed::coupling {

/// The eddies that stir the water along a bed.  A wall stops what goes across it and not what goes along it: right
/// above a wall the motion along it has the energy of the eddies that touch it, however far above their centres are
/// (Hunt and Graham 1978, J. Fluid Mech. 84, 209; the attached eddies of Townsend 1976).  k-epsilon knows one k for all
/// directions and lets it die towards the wall.  Here each cell has, for the motion along the bed, k and life time of
/// the strongest eddies between it and the lid that reach down to it, their size k^(3/2)/epsilon, or its own if they
/// are stronger.  Among grains they reach into the room that the grains leave, nothing goes on in a packed bed, and
/// nothing reaches through a pipe.
class Gusts {
public:
  Gusts() = default;
  Gusts(int nx, int ny) : k(nx, ny), time(nx, ny) {}

  base::Field k;     ///< [m2/s2]
  base::Field time;  ///< T_L of their eddies [s]

  /// The rows up to `top`.  packed: solid fraction of each of their cells over that of a packed bed [-]; C_T [-] and nu
  /// [m2/s] as Eddies::life_time has them.
  void fill(const flow::Mesh& mesh, const flow::State& state, const base::Field& packed, int top, double C_T,
            double nu);
};

}  // namespace livebed::coupling
