#pragma once
#include <variant>

#include "base/vec2.hpp"
#include "coupling/drag.hpp"
#include "coupling/eddies.hpp"
#include "coupling/gusts.hpp"
#include "coupling/params.hpp"
#include "coupling/room.hpp"
#include "coupling/still.hpp"
#include "coupling/transfer.hpp"
#include "flow/advance.hpp"
#include "grains/state.hpp"

namespace livebed::coupling {

using DragLaw = std::variant<PaperDrag, DiFeliceDrag, GidaspowDrag, RongDrag>;

/// The void fraction of a cell is never taken smaller [-]: equal spheres in the densest plane packing leave 0.395, and
/// below that the kernel has put a share of a grain where a sliver of water is.
inline constexpr double voidage_least = 0.3;

/// The water learns a step late what the grains do, through drag and through the room that they leave.  Of each change
/// of the void fraction, and of the impulse that it is still owed, it is told this share in a step, the rest later [-]:
/// a loose bed that moves as one swings with the water from step to step otherwise, the more the denser it is and the
/// longer the step (docs/equations.md).
inline constexpr double share_passed = 0.5;
/// Largest step of the flow over the response time of any grain [-].
inline constexpr double step_over_response = 1;

/// A face with less opening than this passes no pressure gradient on to grains [-]: the pressure in a sliver of a cell
/// is whatever stops the little that flows there.
inline constexpr double sliver = 0.05;

/// Sums of all impulses since the release [N s]; in the slab of thickness b.  The force of the pressure gradient is not
/// among them: the water's own equation holds its counterpart.
struct ImpulseLedger {
  base::Vec2 to_grains;  ///< what the water gave the grains; those asleep: what the flow gave on their behalf
  base::Vec2 to_flow;    ///< what the flow has taken up
  base::Vec2 carried;    ///< still to be handed over: to_grains + to_flow + carried = 0 to round-off
  base::Vec2 error() const { return to_grains + to_flow + carried; }
};

/// What the exchange must know of sand and water.
struct Materials {
  double grain_diameter = 0;  ///< mean, also the thickness of the slab [m]
  double grain_density = 0;   ///< [kg/m3]
  double added_mass = 0;      ///< C_M [-]
  double viscosity = 0;       ///< nu of the water, as drag and lift see it [m2/s]
  int grains = 0;             ///< number of them
  std::uint64_t seed = 1;     ///< of the dispersion
  double ends = 0;            ///< grains come and go so near to the ends of the box [m]
};

/// The forces between flow and grains, both ways.  A coupled step of dt is
///   1  load_flow:    void fraction <- grains; beta <- slip of each grain; load <- beta, beta u_p, what is still owed
///   2  the flow advances with beta implicit
///   3  push_grains:  each grain sees the new water around it; the grains advance their sub-steps
///   4  collect:      what the grains truly took is set against what the flow gave; the difference is owed
/// Forces per volume in a cell are sums of forces over dx dy b with b the grain diameter (spheres in a slab).
///
/// Grains that sleep (grains::Sleep), and all while they are held, are still (StillGrains).
///
/// Where the inlet is recycled the water has no beginning and no end and is the same all along the box: what the grains
/// do to it is averaged along x, as in the one-dimensional flows that bed-load experiments are compared with (Revil-
/// Baudard and Chauchat 2013, J. Fluid Mech. 730, 368; Maurin et al. 2015, Phys. Fluids 27, 113302).
class Coupler {
public:
  Coupler(const Params& params, const flow::Solver& flow, const Materials& materials);

  /// Step 1.  held: the grains stand still whatever happens (spin-up of the flow on the fixed bed).
  void load_flow(grains::State& g, flow::Solver& flow, double dt, bool held);
  /// After each step with the grains held: all of them are still.
  void hold(grains::State& g);
  /// Ends that.
  void let_go(grains::State& g);
  /// Step 3.  dt: the step of the flow [s].
  void push_grains(const flow::Solver& flow, grains::State& g, double dt);
  /// Step 4.
  void collect(grains::State& g, const flow::Solver& flow, double dt);

  /// Before grains at these places of the storage leave the bed and others enter: forgets where all were.
  void let_leave(grains::State& g, const std::vector<int>& leaving);

  /// Longest step that the exchange bears [s], from the drag of the last one on grains that may move.
  double step_limit(const grains::State& g) const;

  /// Solid volume fraction in cells [-] (spheres in the slab), smoothed by the kernel.
  void solid_fraction(const grains::State& g, base::Field& fraction);

  const ImpulseLedger& ledger() const { return ledger_; }

  /// What a checkpoint must hold besides the states: visit(name, field or array or number) and the ledger.
  template <class Self, class Visit>
  static void each_part(Self& self, Visit&& visit) {
    visit("owed_u", self.owed_u_), visit("owed_v", self.owed_v_);
    visit("still_given_x", self.given_x_), visit("still_given_y", self.given_y_);
    StillGrains::each_part(self.still_, visit);
    if (self.params_.dispersion != Dispersion::none) Eddies::each_part(self.eddies_, visit);
  }
  void restore_ledger(const ImpulseLedger& ledger) { ledger_ = ledger; }

private:
  /// Weights of the grains that are not still.
  void locate(const grains::State& g);
  /// After a step: who is still in the next one, of those for which rests(k) holds and that lie deeper than `exposed`
  /// below the surface [d].
  template <class Rests>
  void settle(grains::State& g, double exposed, Rests&& rests);
  /// Rows of the grid, from the floor, that the kernel of any grain touches.
  int rows_with_grains(const grains::State& g) const;
  void fill_voids(const grains::State& g, flow::Solver& flow, double interval);
  /// The flow's void fraction moves by share_passed towards that of the cells; at once where it had none or, interval =
  /// 0, nothing moves.
  void pass_room(flow::Solver& flow, double interval);
  /// volumes += what the located grains fill of each cell [m3].
  void add_volumes(const grains::State& g, base::Field& volumes) const;
  void to_fractions(base::Field& volumes) const;
  /// Impulse that the flow has given to the grains that are still [N s].
  double given_to_still(const base::Field& beta, const base::Field& velocity, double dt) const;
  /// Velocity of the water and fluctuation at each grain.
  void feel_eddies(grains::State& g, const flow::Solver& flow, double dt);
  void load_eddies(const grains::State& g, flow::Load& load);
  /// Velocity of the water at each grain, and its forces besides drag.
  void feel_water(const flow::Solver& flow, grains::State& g, double dt);
  double response_time(const grains::State& g, int k) const;

  Params params_;
  Materials materials_;
  DragLaw drag_;
  bool uniform_ = false;  ///< the water is the same all along the box
  int nx_ = 0, ny_ = 0, top_ = 0;
  std::vector<double> y_;  ///< of the rows' upper edges [m]
  double reach_ = 0;       ///< half-width of the kernel [m]
  double slab_ = 0, density_ = 0, viscosity_ = 0;
  Kernels at_;
  StillGrains still_;
  std::vector<int> moving_;      ///< all others, in the order of the storage
  bool located_ = false;         ///< the weights belong to the present places of the grains
  bool voids_filled_ = false;    ///< so does the void fraction
  base::Field owed_u_, owed_v_;  ///< impulse owed to the flow [N s]
  ImpulseLedger ledger_;
  Eddies eddies_;
  Gusts gusts_;
  EddyRoom room_;

  // Of each grain, in the order of the storage while the flow steps:
  grains::Array voidage_;                                           ///< around it [-]
  grains::Array eddy_k_, eddy_epsilon_;                             ///< of the water around it [m2/s2], [m2/s3]
  grains::Array gust_k_, gust_time_, gust_slope_x_, gust_slope_y_;  ///< of the eddies that reach it from above
  grains::Array eddy_u_, eddy_v_;                                   ///< fluctuation it feels [m/s]
  grains::Array slope_x_, slope_y_, rate_x_, rate_y_, vorticity_;

  // By id, what the reaction on the water must know of a grain when the step is over: force whose counterpart is in the
  // water's own equation [N], velocity when the step began [m/s].
  grains::Array given_x_, given_y_, before_u_, before_v_;

  base::Field volume_c_;  ///< of the cells, water and grains, slab included [m3]
  base::Field voids_, slope_u_, slope_v_, gust_slope_u_, gust_slope_v_, rate_u_, rate_v_, curl_;
};

}  // namespace livebed::coupling
