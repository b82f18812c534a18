#include "run/supply.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/math.hpp"
#include "base/sediment.hpp"
#include "base/sphere.hpp"

namespace livebed::run {

namespace {

/// The ends are looked at when the water has gone this far [d].
constexpr double way_between_looks = 16;
/// So far from an end grains come and go [d]: the fastest are half as fast again as the mean current.
constexpr double reach_of_ends = 1.5 * way_between_looks;
constexpr double lift = 0.25;  ///< a newcomer who would lie on others is set higher by this [d]

/// A grain by the mean one: disks.
double share_of(double diameter, double mean) { return base::square(diameter / mean); }

double unit(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1.0p-53; }

}  // namespace

Supply::Supply(const casefile::Case& c)
    : kind_(c.supply),
      length_(c.flow.mesh.length),
      diameter_(c.grains.diameter),
      speed_(c.flow.current.mean_speed),
      grains_per_flux_(std::sqrt((c.grains.density / c.flow.density - 1) * c.grains.gravity / c.grains.diameter) * 6 /
                       base::pi),
      seed_(c.grains.seed) {
  const double way = c.flow.pipe.present ? c.flow.pipe.x : length_;
  from_ = casefile::feed_from * way, to_ = casefile::feed_to * way;
}

double Supply::margin() const { return goes_round() ? 0.0 : reach_of_ends * diameter_; }

/// Sand between the inlet and the end of the approach without those that leave (in rising order), in mean grains.
double Supply::in_approach(const grains::State& s, const std::vector<int>& leaving) const {
  double sum = 0;
  std::size_t next = 0;
  for (int k = 0; k < s.count(); ++k) {
    if (next < leaving.size() && leaving[next] == k)
      ++next;
    else if (s.x[k] < to_)
      sum += share_of(s.diameter[k], diameter_);
  }
  return sum;
}

void Supply::begin(const grains::State& s) {
  if (kind_ == casefile::Supply::equilibrium) state_.stretch = in_approach(s, {});
}

void Supply::pass_ends(grains::Bed& bed, coupling::Coupler& coupler, double dt, double theta) {
  if (goes_round()) return;
  state_.time += dt;
  if (kind_ == casefile::Supply::equilibrium) state_.owed += dt * grains_per_flux_ * base::meyer_peter_mueller(theta);
  if (state_.time * speed_ < way_between_looks * diameter_) return;
  const double time = std::exchange(state_.time, 0.0);
  grains::State& s = bed.state;
  ++state_.looks;
  std::vector<int> leaving;
  for (int k = 0; k < s.count(); ++k) {
    if (s.laps[k] != 0) leaving.push_back(k);
    s.laps[k] = 0;
  }
  const std::vector<grains::Newcomer> entering = feed(s, leaving, time);
  for (const int k : leaving) state_.waiting.push_back(s.id[k]), state_.waiting_diameter.push_back(s.diameter[k]);
  state_.left += static_cast<std::int64_t>(leaving.size());
  state_.entered += static_cast<std::int64_t>(entering.size());
  if (leaving.empty() && entering.empty()) return;
  coupler.let_leave(s, leaving);
  grains::exchange_grains(bed, leaving, entering);
}

std::vector<grains::Newcomer> Supply::feed(const grains::State& s, const std::vector<int>& leaving, double time) {
  std::vector<grains::Newcomer> entering;
  if (kind_ != casefile::Supply::equilibrium) return entering;
  std::vector<int> moving;     // downstream, in the stretch whose grains newcomers are like
  std::vector<double> passed;  // speeds of these and all before
  double sum = 0;
  for (int k = 0; k < s.count(); ++k)
    if (s.x[k] >= from_ && s.x[k] < to_ && s.u[k] > 0) moving.push_back(k), passed.push_back(sum += s.u[k]);
  state_.owed = std::min(state_.owed, std::max(0.0, state_.stretch - in_approach(s, leaving)));

  std::vector<base::Vec2> at;  // of the grains near the inlet, and how large they are
  std::vector<double> wide;
  std::size_t next = 0;
  for (int k = 0; k < s.count(); ++k) {
    if (next < leaving.size() && leaving[next] == k) {
      ++next;
      continue;
    }
    const double x = s.x[k] > 0.5 * length_ ? s.x[k] - length_ : s.x[k];
    if (x > -2 * diameter_ && x < (reach_of_ends + 2) * diameter_)
      at.push_back({x, s.y[k]}), wide.push_back(s.diameter[k]);
  }
  std::mt19937_64 generator(seed_ * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(state_.looks));
  while (state_.owed > 0 && !state_.waiting.empty() && sum > 0) {
    const auto chosen = std::upper_bound(passed.begin(), passed.end(), unit(generator) * sum);
    const int like = moving[std::min<std::ptrdiff_t>(chosen - passed.begin(), std::ssize(moving) - 1)];
    // It has passed the inlet some time since the last look.
    grains::Newcomer g{.x = std::min(unit(generator) * time * s.u[like], reach_of_ends * diameter_),
                       .y = s.y[like],
                       .u = s.u[like],
                       .v = s.v[like],
                       .omega = s.omega[like],
                       .diameter = state_.waiting_diameter.front(),
                       .id = state_.waiting.front()};
    const auto lies_on_others = [&] {
      for (std::size_t n = 0; n < at.size(); ++n)
        if (base::square(at[n].x - g.x) + base::square(at[n].y - g.y) < base::square(0.5 * (wide[n] + g.diameter)))
          return true;
      return false;
    };
    while (lies_on_others()) g.y += lift * diameter_;
    at.push_back({g.x, g.y}), wide.push_back(g.diameter);
    state_.waiting.erase(state_.waiting.begin());
    state_.waiting_diameter.erase(state_.waiting_diameter.begin());
    state_.owed -= share_of(g.diameter, diameter_);
    entering.push_back(g);
  }
  return entering;
}

}  // namespace livebed::run
