#include "grains/contact.hpp"

#include <algorithm>
#include <cmath>

#include "base/loops.hpp"

namespace livebed::grains {

Sweep make_sweep(const Params& p, const Circle& pipe, int count) {
  // An even number of fixed grains fills every piece of the bed, so that even and odd ones alternate across the seams.
  const double pairs = p.pieces * std::max(1.0, std::round(p.length / (2 * p.diameter * p.pieces)));
  return {.count = count,
          .law = p.law,
          .pair = pair_contact(p),
          .bottom = wall_contact(p, p.bottom),
          .pipe_wall = wall_contact(p, p.pipe),
          .reach = reach_of(p),
          .floor = p.floor,
          .floor_spacing = p.length / (2 * pairs),
          .gravity = submerged_gravity(p),
          .dt = p.step,
          .leash = 0.5 * p.skin * p.diameter,
          .kick_r3 = p.step / mass(p, 2),
          .spin = 1 / inertia_factor(p.inertia),
          .pipe = pipe,
          .walls = make_segments(p)};
}

namespace {

/// What a grain shows, into the form of the records; next: into the set that the next step writes.
void show(Records& r, int i, const Grain& g, bool next) {
  if (r.mixed) {
    const auto single = [](double a) { return static_cast<float>(a); };
    (next ? r.compact_next : r.compact)[i] = {g.x, g.y, single(g.r), single(g.w), single(g.u), single(g.v)};
  } else {
    (next ? r.place_next : r.place)[i] = {g.x, g.y, g.r, g.w};
    (next ? r.motion_next : r.motion)[i] = {g.u, g.v};
  }
}

void keep(Records& r, int i, const FluidPush& push) {
  const auto into = [&](auto& own) {
    using Number = std::remove_reference_t<decltype(own.beta[0])>;
    const int l = i % lanes;
    own.push_x[l] = static_cast<Number>(push.x), own.push_y[l] = static_cast<Number>(push.y);
    own.beta[l] = static_cast<Number>(push.beta);
  };
  if (r.mixed)
    into(r.compact_own[i / lanes]);
  else
    into(r.own[i / lanes]);
}

void give_memory(Records& r, std::size_t places, std::size_t slices, base::Arena& memory) {
  const std::size_t wide = r.mixed ? 0 : places, compact = r.mixed ? places : 0;
  memory.divide<Place, Place, Motion, Motion, Own, Compact, Compact, CompactOwn, std::int64_t>(
      {r.place, wide}, {r.place_next, wide}, {r.motion, wide}, {r.motion_next, wide}, {r.own, r.mixed ? 0 : slices},
      {r.compact, compact}, {r.compact_next, compact}, {r.compact_own, r.mixed ? slices : 0}, {r.filled_at, slices});
}

}  // namespace

void fill_slice(const State& s, int slice, std::int64_t steps, Records& r) {
  const int n = s.count();
  if ((slice + 1) * lanes > n) {
    if (r.mixed)
      r.compact_own[slice] = CompactOwn{};
    else
      r.own[slice] = Own{};
  }
  r.filled_at[slice] = steps;
  for (int i = slice * lanes; i < std::min(n, (slice + 1) * lanes); ++i) {
    const double radius = 0.5 * s.diameter[i];
    const Grain g{s.x[i], s.y[i], radius, s.omega[i] * radius, s.u[i], s.v[i]};
    show(r, i, g, false);
    if (r.asleep[slice] != 0) show(r, i, g, true);
    if (!r.mixed) r.own[slice].omega[i % lanes] = s.omega[i];
    keep(r, i,
         {s.fluid.fx[i] + s.fluid.beta[i] * s.fluid.u[i], s.fluid.fy[i] + s.fluid.beta[i] * s.fluid.v[i],
          s.fluid.beta[i]});
  }
}

void fill_records(const State& s, const Contacts& c, std::int64_t steps, Records& r, base::Arena& memory) {
  const int n = s.count(), slices = c.slices(), last = nobody(n);
  r.motion_known = false;
  if (!r.hold(c)) {
    r.mixed = c.spring.single();
    give_memory(r, last + 1, slices, memory);
    base::for_each_item(0, slices, [&](int slice) { fill_slice(s, slice, steps, r); });
    // Lanes without a grain have a radius all the same: a mass of nothing would spread.  They are not where nobody is,
    // or they would touch: what they feel is added up with the others' at the pipe.
    for (int i = n; i <= last; ++i) {
      for (const bool next : {false, true}) show(r, i, {0, i < last ? 2 * far_away : far_away, 1, 0, 0, 0}, next);
    }
    r.pipe_impulse_x.assign(slices, 0);
    r.pipe_impulse_y.assign(slices, 0);
    r.filled_for = c.rebuilds;
  } else {
    base::for_each_item(0, static_cast<int>(r.awake.size()), [&](int k) { fill_slice(s, r.awake[k], steps, r); });
  }
}

void read_slice(const Sweep& k, std::int64_t steps, const Records& r, int slice, State& s) {
  const double time = static_cast<double>(steps - r.filled_at[slice]) * k.dt;
  for (int i = slice * lanes; i < std::min(s.count(), (slice + 1) * lanes); ++i) {
    const double x_filled = s.x[i], y_filled = s.y[i];
    const Grain g = r.grain(i);
    s.x[i] = g.x, s.y[i] = g.y, s.u[i] = g.u, s.v[i] = g.v;
    s.omega[i] = r.mixed ? g.w / (0.5 * s.diameter[i]) : r.own[slice].omega[i % lanes];
    const double way = s.x[i] - x_filled;
    s.laps[i] += (way < -0.5 * k.reach.length) - (way > 0.5 * k.reach.length);
    // The sum of dt (push - beta u) over the steps.
    const FluidPush push = r.fluid_push(i);
    s.impulse_x[i] += time * push.x - push.beta * nearest_image(s.x[i] - x_filled, k.reach.length);
    s.impulse_y[i] += time * push.y - push.beta * (s.y[i] - y_filled);
  }
}

void read_records(const Sweep& k, std::int64_t steps, const Records& r, State& s) {
  base::for_each_item(0, static_cast<int>(r.awake.size()), [&](int n) { read_slice(k, steps, r, r.awake[n], s); });
}

base::Vec2 collect_pipe_impulse(Records& r) {
  base::Vec2 total;
  for (std::size_t slice = 0; slice < r.pipe_impulse_x.size(); ++slice) {
    total = total + base::Vec2{r.pipe_impulse_x[slice], r.pipe_impulse_y[slice]};
    r.pipe_impulse_x[slice] = r.pipe_impulse_y[slice] = 0;
  }
  return total;
}

}  // namespace livebed::grains
