#include "grains/contact.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/loops.hpp"

namespace livebed::grains {

namespace {

constexpr int slices_per_block = 8;  ///< what one thread takes at a time
constexpr double far_away = 1e9;     ///< [m], where nobody is

/// The eight grains of a slice and the forces on them so far.
struct Slice {
  Lanes x, y, u, v, r, w;
  Lanes force_x{}, force_y{}, twist{};  ///< twist: sum of f_s; the torque is r times that
};

/// Adds the force of one contact in each lane that touches.  (n_x, n_y): from the grain to the other; (u, v): velocity
/// of the other relative to the grain; spin: w_i + w_j.
[[gnu::always_inline]] inline void push(const Contact& law, Slice& g, const Mask& touching, const Lanes& overlap,
                                        const Lanes& n_x, const Lanes& n_y, const Lanes& u, const Lanes& v,
                                        const Lanes& spin, double* spring) {
  const Lanes before = load(spring);
  const Lanes closing = -(u * n_x + v * n_y);
  const Lanes slip = (v * n_x - u * n_y) - spin;
  const ContactForce<Lanes> f = contact_force<Lanes>(law, overlap, closing, slip, before);
  const Lanes zero = Lanes{};
  const Lanes f_n = select(touching, f.normal, zero), f_s = select(touching, f.tangential, zero);
  const Lanes after = select(touching, f.spring, zero);
  g.force_x -= f_n * n_x + f_s * n_y;
  g.force_y += f_s * n_x - f_n * n_y;
  g.twist += f_s;
  store(spring, after);
}

/// Contact with a circle that does not move: a grain of the floor, or the pipe.
[[gnu::always_inline]] inline void push_circle(const Sweep& k, Slice& g, const Lanes& dx, const Lanes& dy,
                                               const Lanes& contact_distance, double* spring) {
  const Lanes d2 = dx * dx + dy * dy;
  const Mask touching = d2 < contact_distance * contact_distance;
  const Lanes distance = root(d2);
  const Lanes inverse = 1.0 / distance;
  push(k.wall, g, touching, contact_distance - distance, dx * inverse, dy * inverse, -g.u, -g.v, g.w, spring);
}

/// The nearest of a row of fixed grains `spacing` apart, the first of them at `start`: its distance in x.
inline Lanes to_nearest(const Lanes& x, double start, double spacing) {
  double each[lanes];
  store(each, x);
  for (double& one : each) one = start + spacing * std::nearbyint((one - start) / spacing) - one;
  return load(each);
}

void push_floor(const Sweep& k, Slice& g, Contacts& c, int begin) {
  const Lanes zero = Lanes{};
  if (k.floor == Floor::plane) {
    const Lanes overlap = k.reach.gamma * g.r - g.y;
    push(k.wall, g, overlap > zero, overlap, zero, zero - 1.0, -g.u, -g.v, g.w, &c.wall_spring[slot_floor][begin]);
    return;
  }
  // A row of fixed grains with their tops at y = 0.  A grain touches at most one of even and one of odd number.
  const double radius = 0.5 * k.reach.floor_diameter;
  for (const int slot : {slot_floor, slot_floor_odd}) {
    const double start = (slot == slot_floor ? 0.5 : 1.5) * k.floor_spacing;
    push_circle(k, g, to_nearest(g.x, start, 2 * k.floor_spacing), -radius - g.y, k.reach.gamma * (g.r + radius),
                &c.wall_spring[slot][begin]);
  }
}

/// Adds to (impulse_x, impulse_y) what the pipe receives.
void push_pipe(const Sweep& k, Slice& g, Contacts& c, int begin, double& impulse_x, double& impulse_y) {
  Slice alone = g;
  alone.force_x = alone.force_y = alone.twist = Lanes{};
  push_circle(k, alone, nearest_image<Lanes>(k.pipe.x - g.x, k.reach.length), k.pipe.y - g.y,
              k.reach.gamma * g.r + 0.5 * k.pipe.diameter, &c.wall_spring[slot_pipe][begin]);
  g.force_x += alone.force_x;
  g.force_y += alone.force_y;
  g.twist += alone.twist;
  impulse_x -= k.dt * sum(alone.force_x);
  impulse_y -= k.dt * sum(alone.force_y);
}

/// A row of pairs: where the others are, and which of them touch.
struct Row {
  Lanes dx, dy, d2, contact_distance, w;
  Mask touching;
};

template <bool across_seam>
[[gnu::always_inline]] inline Row look(const Reach& reach, const Slice& g, const double* place,
                                       const std::int32_t* at) {
  Lanes other[4];  // x, y, r, w
  load_fours(place, at, other);
  Row row{.dx = other[0] - g.x, .dy = other[1] - g.y, .d2 = {}, .contact_distance = {}, .w = other[3], .touching = {}};
  if constexpr (across_seam) row.dx = nearest_image<Lanes>(row.dx, reach.length);
  row.d2 = row.dx * row.dx + row.dy * row.dy;
  row.contact_distance = reach.gamma * (g.r + other[2]);
  row.touching = row.d2 < row.contact_distance * row.contact_distance;
  return row;
}

template <bool across_seam>
[[gnu::always_inline]] inline void push_pairs(const Sweep& k, Slice& slice_grains, Contacts& c, const Records& records,
                                              int slice) {
  const double* const place = &records.place[0].x;
  const double* const motion = &records.motion[0].u;
  const std::int32_t* const neighbour = c.neighbour.data();
  double* const springs = c.spring.data();
  const Contact law = k.pair;  // copies stay in registers
  const Reach reach = k.reach;
  Slice g = slice_grains;
  const auto push_rows = [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      const std::int32_t* const at = neighbour + static_cast<std::ptrdiff_t>(row) * lanes;
      const Row pair = look<across_seam>(reach, g, place, at);
      Lanes speed[2];
      load_twos(motion, at, speed);
      const Lanes distance = root(pair.d2);
      const Lanes inverse = 1.0 / distance;
      push(law, g, pair.touching, pair.contact_distance - distance, pair.dx * inverse, pair.dy * inverse,
           speed[0] - g.u, speed[1] - g.v, g.w + pair.w, springs + static_cast<std::ptrdiff_t>(row) * lanes);
    }
  };
  const int apart = c.first_apart[slice], end = c.first[slice + 1];
  push_rows(c.first[slice], apart);

  // Pairs that were apart when the lists were built have no spring yet.  The first of them to touch moves them all to
  // the front part until the next lists.
  Mask met{};
  for (int row = apart; row < end; ++row) {
    met |= look<across_seam>(reach, g, place, neighbour + static_cast<std::ptrdiff_t>(row) * lanes).touching;
  }
  if (bits(met) != 0) {
    push_rows(apart, end);
    c.first_apart[slice] = end;
  }
  slice_grains = g;
}

/// Moves the slice and writes its records.  Returns a bit for every lane that has left its half skin.
[[gnu::always_inline]] inline unsigned move(const Sweep& k, const Slice& g, Own& own, Place* place, Motion* motion) {
  const Lanes kick = load(own.kick), beta = load(own.beta);
  const Lanes f_x = load(own.fluid_fx), f_y = load(own.fluid_fy), U = load(own.fluid_u), V = load(own.fluid_v);
  const Lanes damped = 1.0 / (1.0 + kick * beta);
  const Lanes u = (g.u + kick * (g.force_x + f_x + beta * U)) * damped;
  const Lanes v = (g.v - k.dt * k.gravity + kick * (g.force_y + f_y + beta * V)) * damped;
  store(own.impulse_x, load(own.impulse_x) + k.dt * (f_x + beta * (U - u)));
  store(own.impulse_y, load(own.impulse_y) + k.dt * (f_y + beta * (V - v)));
  const Lanes omega = load(own.omega) + load(own.spin_kick) * g.twist;
  store(own.omega, omega);

  const Lanes zero = Lanes{}, length = zero + k.reach.length;
  const Lanes x_free = g.x + k.dt * u;
  const Lanes x = select(x_free >= length, x_free - length, select(x_free < zero, x_free + length, x_free));
  const Lanes y = g.y + k.dt * v;
  store_fours(&place->x, x, y, g.r, omega * g.r);
  store_twos(&motion->u, u, v);

  const Lanes dx = nearest_image<Lanes>(x - load(own.x_built), k.reach.length), dy = y - load(own.y_built);
  const Lanes limit = zero + base::square(0.5 * k.reach.skin);
  return bits(~(dx * dx + dy * dy <= limit));  // a NaN counts as moved
}

/// One step of a slice.  Returns true when a grain of it has left its half skin.
inline bool step_slice(const Sweep& k, Contacts& c, Records& records, int slice) {
  const int begin = slice * lanes;
  std::int32_t at[lanes];
  std::iota(at, at + lanes, begin);
  Lanes place[4], motion[2];
  load_fours(&records.place[0].x, at, place);
  load_twos(&records.motion[0].u, at, motion);
  Slice g{.x = place[0], .y = place[1], .u = motion[0], .v = motion[1], .r = place[2], .w = place[3]};
  const unsigned near = c.near[slice];
  if (near & near_seam) {
    push_pairs<true>(k, g, c, records, slice);
  } else {
    push_pairs<false>(k, g, c, records, slice);
  }
  if (near & near_floor) push_floor(k, g, c, begin);
  if (near & near_pipe) push_pipe(k, g, c, begin, records.pipe_impulse_x[slice], records.pipe_impulse_y[slice]);
  const unsigned grains = (1u << std::min(lanes, k.count - begin)) - 1;  // the last slice may have idle lanes
  return (move(k, g, records.own[slice], &records.place_next[begin], &records.motion_next[begin]) & grains) != 0;
}

}  // namespace

Sweep make_sweep(const Params& p, const Circle& pipe) {
  // An even number of fixed grains fills the period, so that even and odd ones alternate across the seam.
  const double pairs = std::max(1.0, std::round(p.length / (2 * p.diameter)));
  return {.count = p.count,
          .pair = contact(p, 1),
          .wall = contact(p, p.wall_factor),
          .reach = reach_of(p),
          .floor = p.floor,
          .floor_spacing = p.length / (2 * pairs),
          .gravity = submerged_gravity(p),
          .dt = p.step,
          .pipe = pipe};
}

void fill_records(const Params& p, const State& s, const Contacts& c, Records& r) {
  const int n = s.count(), slices = c.slices(), last = nobody(n);
  r.place.resize(last + 1);
  r.place_next.resize(last + 1);
  r.motion.resize(last + 1);
  r.motion_next.resize(last + 1);
  r.own.resize(slices);
  const double mass_factor = mass(p, 1);  // a grain's mass is that times d^3
  base::for_each_item(0, slices, [&](int slice) {
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
    }
  });
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
  base::for_each_item(0, blocks, [&](int block) {
    bool moved = false;
    for (int slice = block * slices_per_block; slice < std::min(slices, (block + 1) * slices_per_block); ++slice) {
      moved |= step_slice(k, c, r, slice);
    }
    r.moved[block] = moved;
  });
  r.place.swap(r.place_next);
  r.motion.swap(r.motion_next);
  return std::none_of(r.moved.begin(), r.moved.end(), [](std::uint8_t moved) { return moved != 0; });
}

void read_records(const Records& r, State& s) {
  for (int i = 0; i < s.count(); ++i) {
    const Own& own = r.own[i / lanes];
    s.x[i] = r.place[i].x;
    s.y[i] = r.place[i].y;
    s.u[i] = r.motion[i].u;
    s.v[i] = r.motion[i].v;
    s.omega[i] = own.omega[i % lanes];
    s.impulse_x[i] = own.impulse_x[i % lanes];
    s.impulse_y[i] = own.impulse_y[i % lanes];
  }
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
