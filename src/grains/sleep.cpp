#include "grains/sleep.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/loops.hpp"
#include "base/math.hpp"
#include "grains/kernels.hpp"
#include "grains/slabs.hpp"

namespace livebed::grains {

using base::square;

namespace {

constexpr int looks_a_rest = 2;  ///< a grain must be found calm as often as this, each time after half of sleep_time
/// A grain that carries little among others that carry much is no reason to wake: it is measured by what the grains of
/// its slice carry on average, but never by more than this over its own load.
constexpr double most_over_own = 5;
constexpr int looks_to_wake = 3;  ///< a change must last for as many looks: a knock that passes through does not wake

double weight(const Params& p, double d) { return mass(p, d) * submerged_gravity(p); }

/// Calls body(grain) for the grains of a slice.
template <class Body>
void each_grain(const State& s, int slice, Body&& body) {
  for (int i = slice * lanes; i < std::min(s.count(), (slice + 1) * lanes); ++i) body(i);
}

/// Force of the fluid on a grain that does not move [N].
base::Vec2 fluid_force(const FluidForce& f, int i) {
  return {f.fx[i] + f.beta[i] * f.u[i], f.fy[i] + f.beta[i] * f.v[i]};
}

/// Whether nothing about the fluid's force on the grains of a slice is new.
bool all_still(const State& s, int slice) {
  if (s.fluid.still.empty()) return false;
  bool all = true;
  each_grain(s, slice, [&](int i) { all &= s.fluid.still[i] != 0; });
  return all;
}

/// Calls body(slot, i, j) for every neighbour j of the grains i of a slice.
template <class Body>
void each_pair(const State& s, const Contacts& c, int slice, Body&& body) {
  for (int row = c.first[slice]; row < c.last[slice]; ++row) {
    for (int l = 0; l < lanes; ++l) {
      const std::ptrdiff_t slot = static_cast<std::ptrdiff_t>(row) * lanes + l;
      if (c.neighbour[slot] < s.count()) body(slot, slice * lanes + l, c.neighbour[slot]);
    }
  }
}

/// Both sides of a contact remember the same; a sleeper's memory is that of its neighbour awake.
void copy_history(Contacts& c, std::ptrdiff_t from, std::ptrdiff_t to) {
  c.spring.set(to, c.spring[from]);
  if (!c.rolling.empty()) c.rolling.set(to, -c.rolling[from]);
}

/// Takes over the histories of contacts with grains awake.
void take_histories(const State& s, Contacts& c, const Records& r, int slice) {
  each_pair(s, c, slice, [&](std::ptrdiff_t slot, int i, int j) {
    if (r.asleep[j / lanes] == 0) copy_history(c, slot_of(c, j, i), slot);
  });
}

/// Whether the contact forces on a sleeping slice have not been what they were for some looks.  While a grain sleeps,
/// calm counts those looks downwards from 0.
bool feels_change(Bed& bed, int slice, const SliceForce& now) {
  Sleep& z = bed.state.sleep;
  bool lasts = false;
  each_grain(bed.state, slice, [&](int i) {
    const int l = i % lanes;
    const double limit = bed.params.sleep_force * z.load[i];
    const bool changed = square(now.x[l] - z.contact_x[i]) + square(now.y[l] - z.contact_y[i]) > square(limit) ||
                         std::abs(now.twist[l] - z.twist[i]) > limit;
    z.calm[i] = changed ? z.calm[i] - 1 : 0;
    lasts |= z.calm[i] <= -looks_to_wake;
  });
  return lasts;
}

/// Whether no grain of the slice has moved much since the last look; begins the next interval.
bool looks_calm(Bed& bed, const Sweep& k, int slice, double interval) {
  Sleep& z = bed.state.sleep;
  const double far = square(bed.params.sleep_speed * std::sqrt(k.gravity * bed.params.diameter) * interval);
  int least = looks_a_rest;
  each_grain(bed.state, slice, [&](int i) {
    const Grain at = bed.records.grain(i);
    const double d2 = square(nearest_image(at.x - z.x_look[i], k.reach.length)) + square(at.y - z.y_look[i]);
    z.calm[i] = d2 <= far ? z.calm[i] + 1 : 0;
    z.x_look[i] = at.x, z.y_look[i] = at.y;
    least = std::min(least, z.calm[i]);
  });
  return least >= looks_a_rest;
}

/// What presses a grain: its weight and half the sum of the spring forces of its neighbours [N].
double load_of(const Bed& bed, const Sweep& k, int i) {
  const Contacts& c = bed.contacts;
  const Grain own = bed.records.grain(i);
  double pressed = 0;
  for (int row = c.first[i / lanes]; row < c.last[i / lanes]; ++row) {
    const Grain other = bed.records.grain(c.neighbour[static_cast<std::ptrdiff_t>(row) * lanes + i % lanes]);
    const double dx = nearest_image(other.x - own.x, k.reach.length), dy = other.y - own.y;
    pressed += k.pair.k_n * std::max(0.0, k.reach.gamma * (own.r + other.r) - std::hypot(dx, dy));
  }
  return weight(bed.params, bed.state.diameter[i]) + 0.5 * pressed;
}

/// Whether the forces on every grain of the slice are in balance; keeps them.
bool in_balance(Bed& bed, const Sweep& k, int slice) {
  SliceForce force;
  kernels().push_slice(k, bed.contacts, bed.records, slice, force);
  Sleep& z = bed.state.sleep;
  double own[lanes], sum = 0;
  each_grain(bed.state, slice, [&](int i) { sum += own[i % lanes] = load_of(bed, k, i); });
  const double mean = sum / std::min(lanes, bed.state.count() - slice * lanes);
  bool balance = true;
  each_grain(bed.state, slice, [&](int i) {
    const int l = i % lanes;
    const double w = weight(bed.params, bed.state.diameter[i]);
    z.load[i] = std::clamp(mean, own[l], most_over_own * own[l]);
    const double limit = bed.params.sleep_force * z.load[i];
    const base::Vec2 fluid = fluid_force(bed.state.fluid, i);
    z.contact_x[i] = force.x[l], z.contact_y[i] = force.y[l], z.twist[i] = force.twist[l];
    z.fluid_x[i] = fluid.x, z.fluid_y[i] = fluid.y;
    balance &= std::hypot(force.x[l] + fluid.x, force.y[l] + fluid.y - w) <= limit && std::abs(force.twist[l]) <= limit;
  });
  return balance;
}

void count_impulse(Bed& bed, int slice) {
  State& s = bed.state;
  std::int64_t& from = bed.records.slept_from[slice];
  const double time = static_cast<double>(bed.steps - std::max(from, bed.records.call_began)) * bed.params.step;
  each_grain(s, slice, [&](int i) {
    const base::Vec2 force = fluid_force(s.fluid, i);
    s.impulse_x[i] += time * force.x;
    s.impulse_y[i] += time * force.y;
  });
  from = bed.steps;
}

/// The histories of its contacts with grains awake must be there.
void wake(Bed& bed, int slice) {
  Sleep& z = bed.state.sleep;
  count_impulse(bed, slice);
  bed.records.asleep[slice] = 0;
  each_grain(bed.state, slice, [&](int i) {
    z.asleep[i] = z.calm[i] = 0;
    z.x_look[i] = bed.state.x[i], z.y_look[i] = bed.state.y[i];
  });
  fill_slice(bed.state, slice, bed.steps, bed.records);
}

void fall_asleep(Bed& bed, const Sweep& k, int slice) {
  State& s = bed.state;
  read_slice(k, bed.steps, bed.records, slice, s);
  each_grain(s, slice, [&](int i) {
    s.u[i] = s.v[i] = s.omega[i] = 0;
    s.sleep.asleep[i] = 1;
    s.sleep.calm[i] = 0;
  });
  bed.records.asleep[slice] = 1;
  bed.records.slept_from[slice] = bed.steps;
  fill_slice(s, slice, bed.steps, bed.records);
  each_pair(s, bed.contacts, slice, [&](std::ptrdiff_t slot, int i, int j) {
    if (bed.records.asleep[j / lanes] != 0) copy_history(bed.contacts, slot, slot_of(bed.contacts, j, i));
  });
}

}  // namespace

int steps_between_looks(const Params& p) { return std::max(1, static_cast<int>(std::lround(p.steps_per_contact))); }

void prepare_sleep(Bed& bed) {
  State& s = bed.state;
  Sleep& z = s.sleep;
  const std::size_t n = bed.params.sleep ? s.x.size() : 0;
  if (z.asleep.size() == n) return;
  bed.records.asleep.clear();
  for (auto* a : {&z.asleep, &z.calm}) a->assign(n, 0);
  for (Array* a : {&z.contact_x, &z.contact_y, &z.twist, &z.fluid_x, &z.fluid_y, &z.load}) a->assign(n, 0.0);
  z.x_look.assign(s.x.begin(), s.x.begin() + n);
  z.y_look.assign(s.y.begin(), s.y.begin() + n);
}

void spread_sleep(Bed& bed) {
  State& s = bed.state;
  Records& r = bed.records;
  const int slices = bed.contacts.slices();
  r.asleep.assign(slices, 0);
  if (s.sleep.asleep.empty()) return list_awake(r, s, bed.contacts, reach_of(bed.params));
  r.turn.assign(slices, 0);
  r.slept_from.assign(slices, bed.steps);
  base::for_each_item(0, slices, [&](int slice) {
    bool all = true, any = false;
    each_grain(s, slice, [&](int i) { all &= s.sleep.asleep[i] != 0, any |= s.sleep.asleep[i] != 0; });
    r.asleep[slice] = all && (bed.contacts.near[slice] & near_pipe) == 0;
    r.turn[slice] = any && r.asleep[slice] == 0;
  });
  for (int slice = 0; slice < slices; ++slice) {
    if (r.turn[slice] == 0) continue;
    // Grains that sleep in a slice that does not: their memory is that of whoever was awake.
    each_pair(s, bed.contacts, slice, [&](std::ptrdiff_t slot, int i, int j) {
      if (s.sleep.asleep[i] != 0 && s.sleep.asleep[j] == 0)
        copy_history(bed.contacts, slot_of(bed.contacts, j, i), slot);
    });
  }
  for (int slice = 0; slice < slices; ++slice) {
    if (r.turn[slice] == 0) continue;
    // Woken by their company alone, they may sleep again as soon as that is calm.
    each_grain(s, slice, [&](int i) {
      if (s.sleep.asleep[i] != 0) s.sleep.calm[i] = looks_a_rest;
      s.sleep.asleep[i] = 0;
    });
  }
  list_awake(r, bed.state, bed.contacts, reach_of(bed.params));
}

void wake_by_fluid(Bed& bed) {
  const State& s = bed.state;
  Records& r = bed.records;
  const int slices = bed.contacts.slices();
  base::for_each_item(0, slices, [&](int slice) {
    r.turn[slice] = 0;
    if (r.asleep[slice] == 0 || all_still(s, slice)) return;
    each_grain(s, slice, [&](int i) {
      const base::Vec2 now = fluid_force(s.fluid, i);
      const double limit = bed.params.sleep_drag * s.sleep.load[i];
      r.turn[slice] |= square(now.x - s.sleep.fluid_x[i]) + square(now.y - s.sleep.fluid_y[i]) > square(limit);
    });
    if (r.turn[slice] != 0) take_histories(s, bed.contacts, r, slice);
  });
  bool any = false;
  for (int slice = 0; slice < slices; ++slice) {
    if (r.turn[slice] == 0) continue;
    wake(bed, slice);
    any = true;
  }
  if (any) list_awake(r, bed.state, bed.contacts, reach_of(bed.params));
}

namespace {

/// Sleeping slices with a neighbour awake.
void find_border(const State& s, const Contacts& c, Records& r) {
  r.border.clear();
  for (const std::int32_t slice : r.awake)
    each_pair(s, c, slice, [&](std::ptrdiff_t, int, int j) {
      const int other = j / lanes;
      if (r.asleep[other] == 0 || r.turn[other] != 0) return;
      r.turn[other] = 1;
      r.border.push_back(other);
    });
  std::sort(r.border.begin(), r.border.end());
  r.border_known = true;
}

}  // namespace

void look(Bed& bed, const Sweep& k) {
  Records& r = bed.records;
  const int between = steps_between_looks(bed.params);
  const double rest = bed.params.sleep_time * std::sqrt(bed.params.diameter / k.gravity) / looks_a_rest;
  const int steps_a_rest = between * std::max(1, static_cast<int>(std::lround(rest / (between * k.dt))));
  const bool may_fall = bed.steps % steps_a_rest == 0;
  if (!r.border_known) find_border(bed.state, bed.contacts, r);
  base::for_each_item(0, static_cast<int>(r.border.size()), [&](int n) {
    const int slice = r.border[n];
    take_histories(bed.state, bed.contacts, r, slice);
    SliceForce now;
    kernels().push_slice(k, bed.contacts, r, slice, now);
    r.turn[slice] = feels_change(bed, slice, now);
  });
  if (may_fall) {
    base::for_each_item(0, static_cast<int>(r.awake.size()), [&](int n) {
      const int slice = r.awake[n];
      r.turn[slice] = looks_calm(bed, k, slice, steps_a_rest * k.dt) && (bed.contacts.near[slice] & near_pipe) == 0 &&
                      in_balance(bed, k, slice);
    });
  }
  bool any = false;
  const auto turn_over = [&](const std::vector<std::int32_t>& slices, auto&& turn) {
    for (const std::int32_t slice : slices) {
      if (r.turn[slice] == 0) continue;
      turn(slice);
      r.turn[slice] = 0;
      any = true;
    }
  };
  turn_over(r.border, [&](int slice) { wake(bed, slice); });
  if (may_fall) turn_over(r.awake, [&](int slice) { fall_asleep(bed, k, slice); });
  if (any) list_awake(r, bed.state, bed.contacts, reach_of(bed.params));
}

void count_impulses(Bed& bed, bool of_still) {
  base::for_each_item(0, static_cast<int>(bed.records.asleep.size()), [&](int slice) {
    if (bed.records.asleep[slice] != 0 && (of_still || !all_still(bed.state, slice))) count_impulse(bed, slice);
  });
}

double share_asleep(const State& s) {
  if (s.sleep.asleep.empty()) return 0;
  return std::accumulate(s.sleep.asleep.begin(), s.sleep.asleep.end(), 0.0) / static_cast<double>(s.count());
}

}  // namespace livebed::grains
