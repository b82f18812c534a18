#pragma once
#include "base/field.hpp"
#include "flow/mesh.hpp"
#include "flow/params.hpp"
#include "flow/staggering.hpp"

/// The finite-volume operators that u, v, k and epsilon share.
namespace livebed::flow {

/// Flow through the cell faces, centred in the time step: it carries everything.
struct FaceFlow {
  base::Field u, v;    ///< velocity [m/s]
  base::Field qx, qy;  ///< volume flux per unit of depth through west and south faces [m2/s]
};

/// Row scratch of `convect`: allocated once, a few rows for each block of rows.
struct RowScratch {
  static constexpr int rows_a_block = 16;
  static constexpr int buffers = 6;
  base::Field rows;
  RowScratch() = default;
  explicit RowScratch(const Mesh& mesh) : rows(mesh.nx, buffers * ((mesh.ny + rows_a_block - 1) / rows_a_block)) {}
};

/// out = - sum over faces of flux x face value of phi, integrated over each volume [phi m2/s].
/// rate: what else changes phi [phi/s], for time-centred face values; gamma: diffusivity at cell centres (hybrid
/// scheme).
void convect(const Mesh& mesh, const Staggering& at, Convection scheme, const FaceFlow& flow, const base::Field& phi,
             const base::Field& rate, const base::Field& gamma, double dt, RowScratch& scratch, base::Field& out);

/// Diffusive conductances of the faces of the volumes [m2/s]: area x diffusivity / distance.
struct Conductance {
  base::Field x, y;
};

/// Tridiagonal systems along grid lines, all of one direction in place:
///   (base + g_before + g_after) phi - g_before phi_before - g_after phi_after = phi_given,   g = dt x conductance /
///   inertia.
/// base is the factor of the unknown alone (1 + dt x drag ...).  What lies outside the unknowns counts as 0.
void solve_lines_x(const Staggering& at, const base::Field& base, const base::Field& conductance, double dt,
                   base::Field& phi, base::Field& scratch);
void solve_lines_y(const Staggering& at, const base::Field& base, const base::Field& conductance, double dt,
                   base::Field& phi, base::Field& scratch);

}  // namespace livebed::flow
