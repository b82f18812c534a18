#include "grains/contact.hpp"

#include <algorithm>
#include <cmath>

#include "base/loops.hpp"
#include "grains/kernels.hpp"

namespace livebed::grains {

namespace {

constexpr int slices_per_block = 8;  ///< what one thread takes at a time

}  // namespace

Sweep make_sweep(const Params& p, const Circle& pipe) {
  // An even number of fixed grains fills the period, so that even and odd ones alternate across the seam.
  const double pairs = std::max(1.0, std::round(p.length / (2 * p.diameter)));
  return {.count = p.count,
          .law = p.law,
          .pair = pair_contact(p),
          .bottom = wall_contact(p, p.bottom),
          .pipe_wall = wall_contact(p, p.pipe),
          .reach = reach_of(p),
          .floor = p.floor,
          .floor_spacing = p.length / (2 * pairs),
          .gravity = submerged_gravity(p),
          .dt = p.step,
          .pipe = pipe,
          .walls = make_segments(p)};
}

void fill_slice(const Params& p, const State& s, const Contacts& c, int slice, Records& r) {
  const int n = s.count();
  const double mass_factor = mass(p, 1);  // a grain's mass is that times d^3
  Own& own = r.own[slice];
  if ((slice + 1) * lanes > n) own = Own{};
  for (int i = slice * lanes; i < std::min(n, (slice + 1) * lanes); ++i) {
    const int l = i % lanes;
    const double radius = 0.5 * s.diameter[i], kick = p.step / (mass_factor * base::cube(s.diameter[i]));
    r.place[i] = {s.x[i], s.y[i], radius, s.omega[i] * radius};
    r.motion[i] = {s.u[i], s.v[i]};
    own.omega[l] = s.omega[i];
    own.impulse_x[l] = s.impulse_x[i];
    own.impulse_y[l] = s.impulse_y[i];
    own.kick[l] = kick;
    own.spin_kick[l] = kick / (inertia_factor(p.inertia) * radius);
    own.fluid_u[l] = s.fluid.u[i];
    own.fluid_v[l] = s.fluid.v[i];
    own.beta[l] = s.fluid.beta[i];
    own.fluid_fx[l] = s.fluid.fx[i];
    own.fluid_fy[l] = s.fluid.fy[i];
    own.x_built[l] = c.x_built[i];
    own.y_built[l] = c.y_built[i];
    if (r.asleep[slice] != 0) r.place_next[i] = r.place[i], r.motion_next[i] = r.motion[i];
  }
}

void fill_records(const Params& p, const State& s, const Contacts& c, Records& r) {
  const int n = s.count(), slices = c.slices(), last = nobody(n);
  r.place.resize(last + 1);
  r.place_next.resize(last + 1);
  r.motion.resize(last + 1);
  r.motion_next.resize(last + 1);
  r.own.resize(slices);
  const bool all = r.filled_for != c.rebuilds;
  base::for_each_item(0, slices, [&](int slice) {
    if (all || r.asleep[slice] == 0) fill_slice(p, s, c, slice, r);
  });
  r.filled_for = c.rebuilds;
  for (int i = n; i <= last; ++i) {
    r.place[i] = r.place_next[i] = {0, far_away, 0, 0};
    r.motion[i] = r.motion_next[i] = {0, 0};
  }
  r.moved.assign((slices + slices_per_block - 1) / slices_per_block, 0);
  r.pipe_impulse_x.assign(slices, 0);
  r.pipe_impulse_y.assign(slices, 0);
}

bool sweep(const Sweep& k, Contacts& c, Records& r) {
  const int slices = c.slices(), blocks = static_cast<int>(r.moved.size());
  const auto step_slices = kernels().step_slices;
  base::for_each_item(0, blocks, [&](int block) {
    const int begin = block * slices_per_block;
    r.moved[block] = step_slices(k, c, r, begin, std::min(slices, begin + slices_per_block));
  });
  r.place.swap(r.place_next);
  r.motion.swap(r.motion_next);
  return std::none_of(r.moved.begin(), r.moved.end(), [](std::uint8_t moved) { return moved != 0; });
}

void read_slice(const Records& r, int slice, State& s) {
  const Own& own = r.own[slice];
  for (int i = slice * lanes; i < std::min(s.count(), (slice + 1) * lanes); ++i) {
    s.x[i] = r.place[i].x;
    s.y[i] = r.place[i].y;
    s.u[i] = r.motion[i].u;
    s.v[i] = r.motion[i].v;
    s.omega[i] = own.omega[i % lanes];
    s.impulse_x[i] = own.impulse_x[i % lanes];
    s.impulse_y[i] = own.impulse_y[i % lanes];
  }
}

void read_records(const Records& r, State& s) {
  base::for_each_item(0, static_cast<int>(r.own.size()), [&](int slice) {
    if (r.asleep[slice] == 0) read_slice(r, slice, s);
  });
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
