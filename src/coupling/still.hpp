#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/field.hpp"
#include "coupling/transfer.hpp"
#include "grains/state.hpp"

namespace livebed::coupling {

/// The water around grains that are still is looked at every so many steps of the flow; deeper below the bed's surface
/// than this [d], where nothing but the pressure changes, every so many rounds.
inline constexpr int steps_a_round = 64, rounds_of_the_deep = 8;
inline constexpr double surface_depth = 10;
/// Grains less deep than this below the bed's surface [d] feel gusts, which are gone before a round is over: asleep or
/// not, they are looked at in every step, or weak currents would move next to nothing.
inline constexpr double gust_depth = 5;

/// Whether the grain at place k of the storage is one of those.
inline bool is_still(const grains::State& g, int k) { return !g.fluid.still.empty() && g.fluid.still[k] != 0; }

/// Grains that neither move nor see other water (FluidForce::still), as those asleep and those held: what they do to
/// the cells is summed once.  In the first step of a round they are treated like all others (those deep in the bed in
/// the first step of some rounds); from then on the sums are kept, and each grain is taken out of them when it wakes.
class StillGrains {
public:
  StillGrains() = default;
  /// grains: number of ids; grain_diameter [m].
  StillGrains(int nx, int ny, int grains, double grain_diameter);

  base::Field solid;           ///< what they fill of each cell [m3]
  base::Field beta_u, beta_v;  ///< their drag on the volumes of u and v [N s/m]
  base::Field damping;         ///< what takes k in each cell [N s/m]
  /// By id: what a grain adds to damping when it comes to rest.
  grains::Array damps;

  /// Goes on by a step of the flow with grains free to move.  Grains may have moved or begun to rest: in the last step
  /// of a round nobody near the surface is still any more, in that of some rounds nobody at all; in the first one those
  /// are for which rests(k) holds and that lie deeper than `exposed` below the highest of them nearby [d].  Returns the
  /// places in the storage of those that have become so.
  template <class Rests>
  const std::vector<int>& step(grains::State& g, Kernels& at, double exposed, Rests&& rests) {
    begun_.clear();
    const std::int64_t place = ++steps_ % steps_a_round;
    if (place == 0 && steps_ / steps_a_round % rounds_of_the_deep == 0)
      forget(g);
    else if (place == 0)
      unsettle_surface(g, at);
    else if (place == 1) {
      find_surface(g, [&](int k) { return is_still(g, k) || rests(k); });
      for (int k = 0; k < g.count(); ++k)
        if (!is_still(g, k) && rests(k) && depth(g, k) >= exposed) begun_.push_back(k);
      add(g, at, begun_);
    }
    return begun_;
  }
  /// Whether the last step may have changed who is still.
  bool changed() const { return steps_ % steps_a_round <= 1; }

  /// Takes grains that have woken out of the sums; returns their places in the storage.
  const std::vector<int>& wake(grains::State& g, Kernels& at);
  /// Takes grains at these places of the storage, if they are still, out of the sums: they leave the bed.
  void let_leave(const grains::State& g, Kernels& at, const std::vector<int>& leaving);
  /// Nobody is still.
  void forget(grains::State& g);
  /// Nor has been since the grains were free.
  void begin(grains::State& g) { forget(g), steps_ = 0; }

  /// What a checkpoint must hold: visit(name, field or array or number).
  template <class Self, class Visit>
  static void each_part(Self& self, Visit&& visit) {
    visit("still_steps", self.steps_);
    visit("still_x", self.x_), visit("still_y", self.y_);
    visit("still_beta", self.beta_), visit("still_volume", self.volume_);
    visit("still_damps", self.damps);
    visit("still_solid", self.solid), visit("still_damping", self.damping);
    visit("still_beta_u", self.beta_u), visit("still_beta_v", self.beta_v);
  }

private:
  /// Grains at these places of the storage are still from now on.
  void add(grains::State& g, Kernels& at, const std::vector<int>& which);
  void unsettle_surface(grains::State& g, Kernels& at);
  /// surface_ <- height of the highest grain for which counts(k) holds, column by column.
  template <class Counts>
  void find_surface(const grains::State& g, Counts&& counts) {
    std::fill(surface_.begin(), surface_.end(), 0.0);
    for (int k = 0; k < g.count(); ++k) {
      if (!counts(k)) continue;
      const std::size_t column = column_of(g, k);
      if (column >= surface_.size()) surface_.resize(column + 1, 0.0);
      surface_[column] = std::max(surface_[column], g.y[k]);
    }
  }
  std::size_t column_of(const grains::State& g, int k) const {
    constexpr double wide = 3;  // [d]: each column holds some grains of the topmost layer
    return static_cast<std::size_t>(std::max(0.0, g.x[k] / (wide * diameter_)));
  }
  /// Below that surface, of a grain that counts [d].
  double depth(const grains::State& g, int k) const { return (surface_[column_of(g, k)] - g.y[k]) / diameter_; }
  /// Adds what grains do to the cells to the sums, or takes it away.
  void sum(Kernels& at, const std::vector<int>& ids, double sign);

  double diameter_ = 0;
  std::int64_t steps_ = 0;               ///< with grains free to move
  grains::Array x_, y_, beta_, volume_;  ///< by id, of those that are still: [m], [N s/m], [m3]
  std::vector<int> begun_, woken_, ids_;
  std::vector<double> surface_;  ///< of the bed, in columns along the box [m]
};

}  // namespace livebed::coupling
