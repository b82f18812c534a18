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
  Lanes before;
  std::memcpy(&before, spring, sizeof before);
  const Lanes closing = -(u * n_x + v * n_y);
  const Lanes slip = (v * n_x - u * n_y) - spin;
  const ContactForce<Lanes> f = contact_force<Lanes>(law, overlap, closing, slip, before);
  const Lanes zero = Lanes{};
  const Lanes f_n = select(touching, f.normal, zero), f_s = select(touching, f.tangential, zero);
  const Lanes after = select(touching, f.spring, zero);
  g.force_x -= f_n * n_x + f_s * n_y;
  g.force_y += f_s * n_x - f_n * n_y;
  g.twist += f_s;
  std::memcpy(spring, &after, sizeof after);
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

/// Springs of a slice with a wall, in a full set of lanes whatever the number of grains in the slice.
struct WallSprings {
  double lane[lanes];
  double* home;
  int filled;
  WallSprings(Array& of_wall, int begin, int count) : home(of_wall.data() + begin), filled(count) {
    const Lanes a = load(home, filled);
    std::memcpy(lane, &a, sizeof a);
  }
  void keep() const {
    Lanes a;
    std::memcpy(&a, lane, sizeof a);
    store(home, a, filled);
  }
};

/// The nearest of a row of fixed grains `spacing` apart, the first of them at `start`: its distance in x.
inline Lanes to_nearest(const Lanes& x, double start, double spacing) {
  Lanes dx;
  for (int l = 0; l < lanes; ++l) dx[l] = start + spacing * std::nearbyint((x[l] - start) / spacing) - x[l];
  return dx;
}

[[gnu::always_inline]] inline void push_floor(const Sweep& k, Slice& g, Contacts& c, int begin, int filled) {
  const Lanes zero = Lanes{};
  if (k.floor == Floor::plane) {
    WallSprings springs(c.wall_spring[slot_floor], begin, filled);
    const Lanes overlap = k.reach.gamma * g.r - g.y;
    push(k.wall, g, overlap > zero, overlap, zero, zero - 1.0, -g.u, -g.v, g.w, springs.lane);
    springs.keep();
    return;
  }
  // A row of fixed grains with their tops at y = 0.  A grain touches at most one of even and one of odd number.
  const double radius = 0.5 * k.reach.floor_diameter;
  for (const int slot : {slot_floor, slot_floor_odd}) {
    WallSprings springs(c.wall_spring[slot], begin, filled);
    const double start = (slot == slot_floor ? 0.5 : 1.5) * k.floor_spacing;
    push_circle(k, g, to_nearest(g.x, start, 2 * k.floor_spacing), -radius - g.y, k.reach.gamma * (g.r + radius),
                springs.lane);
    springs.keep();
  }
}

/// Returns through `impulse` what the pipe receives.
[[gnu::always_inline]] inline void push_pipe(const Sweep& k, Slice& g, Contacts& c, int begin, int filled,
                                             double& impulse_x, double& impulse_y) {
  WallSprings springs(c.wall_spring[slot_pipe], begin, filled);
  Slice alone = g;
  alone.force_x = alone.force_y = alone.twist = Lanes{};
  push_circle(k, alone, nearest_image<Lanes>(k.pipe.x - g.x, k.reach.length), k.pipe.y - g.y,
              k.reach.gamma * g.r + 0.5 * k.pipe.diameter, springs.lane);
  springs.keep();
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

/// Moves the slice and writes its records.  Returns true when a grain has left its half skin.
[[gnu::always_inline]] inline bool move(const Sweep& k, const Slice& g, State& s, const Contacts& c, Records& records,
                                        int begin, int filled) {
  const auto get = [&](const Array& a) { return load(a.data() + begin, filled); };
  const auto put = [&](Array& a, const Lanes& value) { store(a.data() + begin, value, filled); };
  const Lanes kick = get(records.kick), beta = get(s.fluid.beta);
  const Lanes f_x = get(s.fluid.fx), f_y = get(s.fluid.fy), U = get(s.fluid.u), V = get(s.fluid.v);
  const Lanes damped = 1.0 / (1.0 + kick * beta);
  const Lanes u = (g.u + kick * (g.force_x + f_x + beta * U)) * damped;
  const Lanes v = (g.v - k.dt * k.gravity + kick * (g.force_y + f_y + beta * V)) * damped;
  put(s.impulse_x, get(s.impulse_x) + k.dt * (f_x + beta * (U - u)));
  put(s.impulse_y, get(s.impulse_y) + k.dt * (f_y + beta * (V - v)));
  const Lanes omega = get(s.omega) + get(records.spin_kick) * g.twist;
  put(s.omega, omega);

  const Lanes zero = Lanes{}, length = zero + k.reach.length;
  const Lanes x_free = g.x + k.dt * u;
  const Lanes x = select(x_free >= length, x_free - length, select(x_free < zero, x_free + length, x_free));
  const Lanes y = g.y + k.dt * v;
  store_fours(&records.place_next[static_cast<std::size_t>(begin)].x, x, y, g.r, omega * g.r);
  store_twos(&records.motion_next[static_cast<std::size_t>(begin)].u, u, v);

  const Lanes dx = nearest_image<Lanes>(x - get(c.x_built), k.reach.length), dy = y - get(c.y_built);
  const Lanes limit = zero + base::square(0.5 * k.reach.skin);
  const unsigned moved = bits(~(dx * dx + dy * dy <= limit));  // a NaN counts as moved
  return (moved & ((1u << filled) - 1)) != 0;
}

[[gnu::always_inline]] inline bool step_slice(const Sweep& k, State& s, Contacts& c, Records& records, int slice,
                                              int filled) {
  const int begin = slice * lanes;
  std::int32_t own[lanes];
  std::iota(own, own + lanes, begin);
  Lanes place[4], motion[2];
  load_fours(&records.place[0].x, own, place);
  load_twos(&records.motion[0].u, own, motion);
  Slice g{.x = place[0], .y = place[1], .u = motion[0], .v = motion[1], .r = place[2], .w = place[3]};
  const unsigned near = c.near[slice];
  if (near & near_seam) {
    push_pairs<true>(k, g, c, records, slice);
  } else {
    push_pairs<false>(k, g, c, records, slice);
  }
  if (near & near_floor) push_floor(k, g, c, begin, filled);
  if (near & near_pipe) {
    push_pipe(k, g, c, begin, filled, records.pipe_impulse_x[slice], records.pipe_impulse_y[slice]);
  }
  return move(k, g, s, c, records, begin, filled);
}

}  // namespace

Sweep make_sweep(const Params& p, const Circle& pipe) {
  // An even number of fixed grains fills the period, so that even and odd ones alternate across the seam.
  const double pairs = std::max(1.0, std::round(p.length / (2 * p.diameter)));
  return {.pair = contact(p, 1),
          .wall = contact(p, p.wall_factor),
          .reach = reach_of(p),
          .floor = p.floor,
          .floor_spacing = p.length / (2 * pairs),
          .gravity = submerged_gravity(p),
          .dt = p.step,
          .pipe = pipe};
}

void fill_records(const Params& p, const State& s, const Contacts& c, Records& r) {
  const int n = s.count(), last = nobody(n);
  r.place.assign(last + 1, {0, far_away, 0, 0});
  r.motion.assign(last + 1, {0, 0});
  r.kick.resize(n);
  r.spin_kick.resize(n);
  for (int i = 0; i < n; ++i) {
    const double radius = 0.5 * s.diameter[i], m = mass(p, s.diameter[i]);
    r.place[i] = {s.x[i], s.y[i], radius, s.omega[i] * radius};
    r.motion[i] = {s.u[i], s.v[i]};
    r.kick[i] = p.step / m;
    r.spin_kick[i] = p.step / (inertia_factor(p.inertia) * m * radius);
  }
  r.place_next.resize(last + 1);
  r.motion_next.resize(last + 1);
  r.place_next[last] = r.place[last];
  r.motion_next[last] = r.motion[last];
  r.moved.assign((c.slices() + slices_per_block - 1) / slices_per_block, 0);
  r.pipe_impulse_x.assign(c.slices(), 0);
  r.pipe_impulse_y.assign(c.slices(), 0);
}

bool sweep(const Sweep& k, State& s, Contacts& c, Records& r) {
  const int n = s.count(), slices = c.slices(), blocks = static_cast<int>(r.moved.size());
  base::for_each_item(0, blocks, [&](int block) {
    bool moved = false;
    for (int slice = block * slices_per_block; slice < std::min(slices, (block + 1) * slices_per_block); ++slice) {
      const int filled = std::min(lanes, n - slice * lanes);
      moved |= filled == lanes ? step_slice(k, s, c, r, slice, lanes) : step_slice(k, s, c, r, slice, filled);
    }
    r.moved[block] = moved;
  });
  r.place.swap(r.place_next);
  r.motion.swap(r.motion_next);
  return std::none_of(r.moved.begin(), r.moved.end(), [](std::uint8_t moved) { return moved != 0; });
}

void read_records(const Records& r, State& s) {
  for (int i = 0; i < s.count(); ++i) {
    s.x[i] = r.place[i].x;
    s.y[i] = r.place[i].y;
    s.u[i] = r.motion[i].u;
    s.v[i] = r.motion[i].v;
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
