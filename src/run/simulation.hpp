#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "case/case.hpp"
#include "coupling/exchange.hpp"
#include "flow/advance.hpp"
#include "grains/advance.hpp"
#include "grains/packing.hpp"
#include "run/bed_cache.hpp"
#include "run/supply.hpp"

namespace livebed::run {

/// Where a run stands.  The time since the release of the grains is a whole number of grain steps, so it carries no
/// round-off.
struct Clock {
  std::int64_t flow_steps = 0;   ///< spin-up included
  std::int64_t grain_steps = 0;  ///< since the release
  bool released = false;
};

/// Wall time by part [s].
struct WallTimes {
  double flow = 0, grains = 0, exchange = 0, output = 0;
  double total() const { return flow + grains + exchange + output; }
};

/// Flow, grains and their exchange: owns the state, knows the order of a step and the clock, and nothing of files.
class Simulation {
public:
  /// A bed at rest with the pipe in place: packing, measured level, pipe, and the case completed at that level.
  struct Start {
    casefile::Case resolved;
    grains::Bed bed;
    std::vector<grains::SettleRow> convergence;
  };
  /// Throws Fault: invalid case when bed.count is not what bed.cut leaves, and what pack and place_pipe throw.
  static Start prepare(const casefile::Case& given, const BedCache& cache = BedCache(),
                       const grains::OnLook& on_look = {});

  /// resolved: the case of `prepare`, or of a checkpoint with its bed.
  Simulation(const casefile::Case& resolved, grains::Bed bed);

  /// One step of the flow on the fixed bed (spin-up).
  void spin_up_step();
  /// Lets the grains go: t = 0.
  void release();
  /// One coupled step: the flow moves by a whole number of grain steps, then the grains catch up.  Throws Fault
  /// (diverged) with place and time when a number is not finite.
  void step();

  /// A new last time [s] for a run that goes on; from here on the case counts as given by time.end.
  void set_end(double end);

  /// Time [s]: since the release, negative before.
  double time() const;

  const casefile::Case& resolved() const { return case_; }
  const flow::Solver& flow() const { return flow_; }
  const grains::Bed& bed() const { return bed_; }
  const coupling::Coupler& coupler() const { return coupler_; }
  const flow::StepReport& last_report() const { return report_; }
  double last_step() const { return last_step_; }
  const Supply& supply() const { return supply_; }
  const Clock& clock() const { return clock_; }
  const WallTimes& wall() const { return wall_; }
  WallTimes& wall() { return wall_; }

  /// Force of the grains on the pipe per metre of it over the last step [N/m].
  base::Vec2 grain_force_on_pipe() const { return grain_force_; }
  /// Momentum of the water along x [N s], in the slab.
  double flow_momentum() const;
  /// Solid volume fraction in the cells of the flow [-].
  const base::Field& solid_fraction();

  /// What a checkpoint saves and restores, each part under its own name; see run/checkpoint.
  template <class Self, class Visit>
  static void each_part(Self& self, Visit&& visit) {
    visit(self.flow_, self.bed_, self.coupler_, self.supply_, self.clock_, self.wall_);
  }

private:
  void advance_flow(double dt);
  void advance_grains(int substeps);
  void check_finite() const;
  [[noreturn]] void fail_here(const base::Fault& fault) const;
  bool has_grains() const { return case_.grains.count > 0; }

  casefile::Case case_;
  grains::Bed bed_;
  flow::Solver flow_;
  flow::Column full_inlet_;  ///< of the current that has risen
  Supply supply_;
  coupling::Coupler coupler_;
  Clock clock_;
  WallTimes wall_;
  flow::StepReport report_;
  base::Vec2 grain_force_;
  double last_step_ = 0;
  base::Field solid_;
};

}  // namespace livebed::run
