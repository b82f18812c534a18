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

void fill_slice(const State& s, int slice, std::int64_t steps, Records& r) {
  const int n = s.count();
  Own& own = r.own[slice];
  if ((slice + 1) * lanes > n) own = Own{};
  r.filled_at[slice] = steps;
  for (int i = slice * lanes; i < std::min(n, (slice + 1) * lanes); ++i) {
    const int l = i % lanes;
    const double radius = 0.5 * s.diameter[i];
    r.place[i] = {s.x[i], s.y[i], radius, s.omega[i] * radius};
    r.motion[i] = {s.u[i], s.v[i]};
    own.omega[l] = s.omega[i];
    own.push_x[l] = s.fluid.fx[i] + s.fluid.beta[i] * s.fluid.u[i];
    own.push_y[l] = s.fluid.fy[i] + s.fluid.beta[i] * s.fluid.v[i];
    own.beta[l] = s.fluid.beta[i];
    if (r.asleep[slice] != 0) r.place_next[i] = r.place[i], r.motion_next[i] = r.motion[i];
  }
}

void fill_records(const State& s, const Contacts& c, std::int64_t steps, Records& r, base::Arena& memory) {
  const int n = s.count(), slices = c.slices(), last = nobody(n);
  r.motion_known = false;
  if (!r.hold(c)) {
    const std::size_t places = last + 1, owners = slices;
    memory.divide<Place, Place, Motion, Motion, Own, std::int64_t>({r.place, places}, {r.place_next, places},
                                                                   {r.motion, places}, {r.motion_next, places},
                                                                   {r.own, owners}, {r.filled_at, owners});
    base::for_each_item(0, slices, [&](int slice) { fill_slice(s, slice, steps, r); });
    // Lanes without a grain have a radius all the same: a mass of nothing would spread.  They are not where nobody is,
    // or they would touch: what they feel is added up with the others' at the pipe.
    for (int i = n; i <= last; ++i) {
      r.place[i] = r.place_next[i] = {0, i < last ? 2 * far_away : far_away, 1, 0};
      r.motion[i] = r.motion_next[i] = {0, 0};
    }
    r.pipe_impulse_x.assign(slices, 0);
    r.pipe_impulse_y.assign(slices, 0);
    r.filled_for = c.rebuilds;
  } else {
    base::for_each_item(0, static_cast<int>(r.awake.size()), [&](int k) { fill_slice(s, r.awake[k], steps, r); });
  }
}

void read_slice(const Sweep& k, std::int64_t steps, const Records& r, int slice, State& s) {
  const Own& own = r.own[slice];
  const double time = static_cast<double>(steps - r.filled_at[slice]) * k.dt;
  for (int i = slice * lanes; i < std::min(s.count(), (slice + 1) * lanes); ++i) {
    const int l = i % lanes;
    const double x_filled = s.x[i], y_filled = s.y[i];
    s.x[i] = r.place[i].x;
    s.y[i] = r.place[i].y;
    s.u[i] = r.motion[i].u;
    s.v[i] = r.motion[i].v;
    s.omega[i] = own.omega[l];
    const double way = s.x[i] - x_filled;
    s.laps[i] += (way < -0.5 * k.reach.length) - (way > 0.5 * k.reach.length);
    // The sum of dt (push - beta u) over the steps.
    s.impulse_x[i] += time * own.push_x[l] - own.beta[l] * nearest_image(s.x[i] - x_filled, k.reach.length);
    s.impulse_y[i] += time * own.push_y[l] - own.beta[l] * (s.y[i] - y_filled);
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
