#pragma once
#include <variant>

#include "base/vec2.hpp"
#include "coupling/drag.hpp"
#include "coupling/params.hpp"
#include "coupling/transfer.hpp"
#include "flow/mesh.hpp"
#include "flow/state.hpp"
#include "grains/state.hpp"

namespace livebed::coupling {

using DragLaw = std::variant<PaperDrag>;

/// Sums of all impulses since the release [N s]; in the slab of thickness b.
struct ImpulseLedger {
  base::Vec2 to_grains;  ///< what the water gave the grains
  base::Vec2 to_flow;    ///< what the flow has taken up
  base::Vec2 carried;    ///< still to be handed over: to_grains + to_flow + carried = 0 to round-off
  base::Vec2 error() const { return to_grains + to_flow + carried; }
};

/// The drag between flow and grains, both ways.  A coupled step of dt is
///   1  load_flow:    beta <- slip of each grain; load <- beta, beta u_p and what is still owed
///   2  the flow advances with beta implicit
///   3  push_grains:  each grain sees the new velocity around it; the grains advance their sub-steps
///   4  collect:      what the grains truly took is set against what the flow gave; the difference is owed
/// Forces per volume in a cell are sums of forces over dx dy b with b the grain diameter (spheres in a slab).
class Coupler {
public:
  Coupler(const Params& params, const flow::Mesh& mesh, const flow::Staggering& at_u, const flow::Staggering& at_v,
          double grain_diameter, double density, double viscosity);

  /// Step 1.  held: the grains stand still whatever happens (spin-up of the flow on the fixed bed).
  void load_flow(grains::State& g, flow::State& s, double dt, bool held);
  /// Step 3.
  void push_grains(const flow::State& s, grains::State& g);
  /// Step 4.
  void collect(const grains::State& g, const flow::State& s, double dt);

  /// Solid volume fraction in cells [-] (spheres in the slab), smoothed by the kernel.
  void solid_fraction(const grains::State& g, base::Field& fraction);

  const ImpulseLedger& ledger() const { return ledger_; }

  /// What a checkpoint must hold besides the states: visit(name, field) and the ledger.
  template <class Visit>
  void each_field(Visit&& visit) {
    visit("owed_u", owed_u_), visit("owed_v", owed_v_);
  }
  void restore_ledger(const ImpulseLedger& ledger) { ledger_ = ledger; }

private:
  void locate(const grains::State& g);
  /// Rows of the grid, from the floor, that the kernel of any grain touches.
  int rows_with_grains(const grains::State& g) const;

  Params params_;
  DragLaw drag_;
  int nx_ = 0, ny_ = 0;
  std::vector<double> y_;  ///< of the rows' upper edges [m]
  double reach_ = 0;       ///< half-width of the kernel [m]
  double slab_ = 0, density_ = 0, viscosity_ = 0;
  base::Field volume_u_, volume_v_, volume_c_;  ///< of the control volumes [m3], slab included
  Transfer at_u_, at_v_, at_c_;
  bool located_ = false;         ///< weights of u and v belong to the present places of the grains
  base::Field owed_u_, owed_v_;  ///< impulse owed to the flow [N s]
  ImpulseLedger ledger_;
};

}  // namespace livebed::coupling
