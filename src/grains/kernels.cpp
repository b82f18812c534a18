// Compiled once for each instruction set, see kernels.hpp.
#include "grains/kernels.hpp"

#include "base/math.hpp"

namespace livebed::grains {

namespace {

/// Pairs within this factor of touching come first in a list: what touches, or will soon.
constexpr double close_by = 1.005;

/// The grains of a part of a slice, as many as a vector holds, and the forces on them so far.
struct Part {
  Lanes x, y, u, v, r, w;
  Lanes force_x{}, force_y{}, twist{};  ///< twist: sum of f_s and of rolling moments over r; the torque is r times that
};

/// What a contact computes: a kernel for each of the laws, with and without rolling resistance, and whether it keeps
/// its histories.
template <Law dashpots, bool rolls, bool keeps>
struct Form {
  static constexpr bool remembers = keeps;
  static constexpr Law law = dashpots;
  static constexpr bool rolling = rolls;
  static constexpr bool sized = rolls || dashpots == Law::hooke;  ///< needs what mass and size decide
};

/// One contact in each lane.
struct Touch {
  Mask touching;
  Lanes overlap, n_x, n_y;  ///< n: from the grain to the other
  Lanes u, v;               ///< velocity of the other relative to the grain
  Lanes spin;               ///< w_i + w_j
};

/// Adds the force of one contact in each lane that touches.  reduced() and rate() (spin of the grain minus spin of the
/// other) are asked for only by the laws that need them.
template <class Form, class ReducedOf, class Rate>
[[gnu::always_inline]] inline void push(const Contact& law, Part& g, const Touch& t, const ReducedOf& reduced_of,
                                        const Rate& rate, double* spring, double* rolling) {
  const Lanes before = load(spring);
  const Lanes closing = -(t.u * t.n_x + t.v * t.n_y);
  const Lanes slip = (t.v * t.n_x - t.u * t.n_y) - t.spin;
  Reduced<Lanes> reduced;
  if constexpr (Form::sized) reduced = reduced_of();
  const ContactForce<Lanes> f = [&] {
    if constexpr (Form::law == Law::hooke) {
      return contact_force<Lanes>(law, law.eta_n * root(reduced.mass), t.overlap, closing, slip, before);
    } else {
      return contact_force<Lanes>(law, law.eta_n, t.overlap, closing, slip, before);
    }
  }();
  const Lanes zero = Lanes{};
  const Lanes f_n = select(t.touching, f.normal, zero), f_s = select(t.touching, f.tangential, zero);
  const Lanes after = select(t.touching, f.spring, zero);
  g.force_x -= f_n * t.n_x + f_s * t.n_y;
  g.force_y += f_s * t.n_x - f_n * t.n_y;
  g.twist += f_s;
  if constexpr (Form::remembers) store(spring, after);
  if constexpr (Form::rolling) {
    const RollingMoment<Lanes> m = rolling_moment<Lanes>(law, reduced, f_n, rate(), load(rolling));
    g.twist += select(t.touching, m.moment, zero) / g.r;
    if constexpr (Form::remembers) store(rolling, select(t.touching, m.spring, zero));
  }
}

/// Contact with something that does not move.
template <class Form>
[[gnu::always_inline]] inline void push_wall(const Contact& law, Part& g, const Mask& touching, const Lanes& overlap,
                                             const Lanes& n_x, const Lanes& n_y, double* spring, double* rolling) {
  push<Form>(
      law, g, {touching, overlap, n_x, n_y, -g.u, -g.v, g.w}, [&] { return reduced_at_wall<Lanes>(law, g.r); },
      [&] { return g.w / g.r; }, spring, rolling);
}

/// Contact with a circle that does not move: a grain of the floor, or the pipe.
template <class Form>
[[gnu::always_inline]] inline void push_circle(const Contact& law, Part& g, const Lanes& dx, const Lanes& dy,
                                               const Lanes& contact_distance, double* spring, double* rolling) {
  const Lanes d2 = dx * dx + dy * dy;
  const Lanes distance = root(d2);
  const Lanes inverse = 1.0 / distance;
  push_wall<Form>(law, g, d2 < contact_distance * contact_distance, contact_distance - distance, dx * inverse,
                  dy * inverse, spring, rolling);
}

/// The nearest of a row of fixed grains `spacing` apart, the first of them at `start`: its distance in x.
inline Lanes to_nearest(const Lanes& x, double start, double spacing) {
  constexpr double whole = 6755399441055744.0;  // 1.5 * 2^52: a sum with it has no digits behind the point
  const Lanes number = ((x - start) / spacing + whole) - whole;
  return start + spacing * number - x;
}

/// Rolling springs of a slice with a wall; null without rolling resistance.
template <class Form>
double* rolling_of(Array& springs, std::ptrdiff_t begin) {
  if constexpr (Form::rolling) return springs.data() + begin;
  return nullptr;
}

template <class Form>
void push_floor(const Sweep& k, Part& g, Contacts& c, int begin) {
  const Lanes zero = Lanes{};
  if (k.floor == Floor::plane) {
    const Lanes overlap = k.reach.gamma * g.r - g.y;
    push_wall<Form>(k.bottom, g, overlap > zero, overlap, zero, zero - 1.0, c.wall_spring[slot_floor].data() + begin,
                    rolling_of<Form>(c.wall_rolling[slot_floor], begin));
    return;
  }
  // A row of fixed grains with their tops at y = 0.  A grain touches at most one of even and one of odd number.
  const double radius = 0.5 * k.reach.floor_diameter;
  for (const int slot : {slot_floor, slot_floor_odd}) {
    const double start = (slot == slot_floor ? 0.5 : 1.5) * k.floor_spacing;
    push_circle<Form>(k.bottom, g, to_nearest(g.x, start, 2 * k.floor_spacing), -radius - g.y,
                      k.reach.gamma * (g.r + radius), c.wall_spring[slot].data() + begin,
                      rolling_of<Form>(c.wall_rolling[slot], begin));
  }
}

/// Adds to (impulse_x, impulse_y) what the pipe receives.
template <class Form>
void push_pipe(const Sweep& k, Part& g, Contacts& c, int begin, double& impulse_x, double& impulse_y) {
  Part alone = g;
  alone.force_x = alone.force_y = alone.twist = Lanes{};
  push_circle<Form>(k.pipe_wall, alone, nearest_image<Lanes>(k.pipe.x - g.x, k.reach.length), k.pipe.y - g.y,
                    k.reach.gamma * g.r + 0.5 * k.pipe.diameter, c.wall_spring[slot_pipe].data() + begin,
                    rolling_of<Form>(c.wall_rolling[slot_pipe], begin));
  g.force_x += alone.force_x;
  g.force_y += alone.force_y;
  g.twist += alone.twist;
  impulse_x -= k.dt * sum(alone.force_x);
  impulse_y -= k.dt * sum(alone.force_y);
}

/// A lane and a piece of wall: the way from the grain to the nearest point of the piece, and whether that point is this
/// piece's and not a neighbour's.
struct NearestPoint {
  double dx, dy;
  bool own;
};
inline NearestPoint nearest_point(const Segment* walls, const Segment& piece, double x, double y) {
  const double t = piece.along(x, y), at = t < 0 ? 0.0 : (t > 1 ? 1.0 : t);
  bool own = true;
  if (t <= 0 && piece.before >= 0) own = walls[piece.before].along(x, y) >= 1;
  if (t >= 1 && piece.after >= 0) own = false;
  return {piece.x + at * piece.ex - x, piece.y + at * piece.ey - y, own};
}

template <class Form>
void push_pieces(const Sweep& k, Part& g, Contacts& c, int slice, int lane) {
  const Segment* const walls = k.walls.data();
  double x[width], y[width], dx[width], dy[width];
  store(x, g.x);
  store(y, g.y);
  for (int row = c.wall_first[slice]; row < c.wall_first[slice + 1]; ++row) {
    const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(row) * lanes + lane;
    const std::int32_t* const piece = c.wall.data() + begin;
    for (int l = 0; l < width; ++l) {
      dx[l] = 0, dy[l] = far_away;
      if (piece[l] < 0) continue;
      const NearestPoint p = nearest_point(walls, walls[piece[l]], x[l], y[l]);
      if (!p.own) continue;
      dx[l] = p.dx, dy[l] = p.dy;
    }
    push_circle<Form>(k.bottom, g, load(dx), load(dy), k.reach.gamma * g.r, c.piece_spring.data() + begin,
                      rolling_of<Form>(c.piece_rolling, begin));
  }
}

/// Places and motions of all grains when a step begins, or when it ends.
struct Level {
  Place* place;
  Motion* motion;
};
Level now_of(Records& r) { return {r.place.data(), r.motion.data()}; }
Level next_of(Records& r) { return {r.place_next.data(), r.motion_next.data()}; }

/// A row of pairs: where the others are, and which of them touch.
struct Row {
  Lanes dx, dy, d2, contact_distance, r, w;
  Mask touching;
};

template <bool across_seam>
[[gnu::always_inline]] inline Row look(const Reach& reach, const Part& g, const double* place, const std::int32_t* at) {
  Lanes other[4];  // x, y, r, w
  load_fours(place, at, other);
  Row row{.dx = other[0] - g.x,
          .dy = other[1] - g.y,
          .d2 = {},
          .contact_distance = {},
          .r = other[2],
          .w = other[3],
          .touching = {}};
  if constexpr (across_seam) row.dx = nearest_image<Lanes>(row.dx, reach.length);
  row.d2 = row.dx * row.dx + row.dy * row.dy;
  row.contact_distance = reach.gamma * (g.r + other[2]);
  row.touching = row.d2 < row.contact_distance * row.contact_distance;
  return row;
}

template <class Form, bool across_seam>
[[gnu::always_inline]] inline void push_pairs(const Sweep& k, Part& part, Contacts& c, const Level& now, int slice,
                                              int lane) {
  const double* const place = &now.place->x;
  const double* const motion = &now.motion->u;
  const std::int32_t* const neighbour = c.neighbour.data() + lane;
  double* const springs = c.spring.data() + lane;
  double* const rolling = c.rolling.data() + (Form::rolling ? lane : 0);
  const Contact law = k.pair;  // copies stay in registers
  const Reach reach = k.reach;
  Part g = part;
  int row = c.first[slice], end = c.first_apart[slice];
  const int last = c.last[slice];
  while (true) {
    for (; row < end; ++row) {
      const std::ptrdiff_t slot = static_cast<std::ptrdiff_t>(row) * lanes;
      const std::int32_t* const at = neighbour + slot;
      const Row pair = look<across_seam>(reach, g, place, at);
      Lanes speed[2];
      load_twos(motion, at, speed);
      const Lanes distance = root(pair.d2);
      const Lanes inverse = 1.0 / distance;
      push<Form>(
          law, g,
          {pair.touching, pair.contact_distance - distance, pair.dx * inverse, pair.dy * inverse, speed[0] - g.u,
           speed[1] - g.v, g.w + pair.w},
          [&] { return reduced_of_pair<Lanes>(law, g.r, pair.r); }, [&] { return g.w / g.r - pair.w / pair.r; },
          springs + slot, rolling + (Form::rolling ? slot : 0));
    }
    // Pairs that were apart when the lists were built have no spring yet.  The first of them to touch moves them all to
    // the front part until the next lists.
    Mask met{};
    for (int apart = row; apart < last; ++apart) {
      met |= look<across_seam>(reach, g, place, neighbour + static_cast<std::ptrdiff_t>(apart) * lanes).touching;
    }
    if (bits(met) == 0) break;
    c.first_apart[slice] = end = last;
  }
  part = g;
}

/// Moves the part of a slice from `lane` on and writes its records.  x_built, y_built: of its grains.  Returns a bit
/// for every lane that is off the leash.
[[gnu::always_inline]] inline unsigned move(const Sweep& k, const Part& g, Own& own, int lane, const double* x_built,
                                            const double* y_built, Place* place, Motion* motion) {
  const auto get = [&](const Own::Eight& of) { return load(of + lane); };
  // Masses and inertias are made of the radius anew: large beds wait for memory, not for a division.
  const Lanes per_r = 1.0 / g.r, kick = k.kick_r3 * (per_r * per_r * per_r);
  const Lanes damped = 1.0 / (1.0 + kick * get(own.beta));
  const Lanes u = (g.u + kick * (g.force_x + get(own.push_x))) * damped;
  const Lanes v = (g.v - k.dt * k.gravity + kick * (g.force_y + get(own.push_y))) * damped;
  const Lanes omega = get(own.omega) + k.spin * (kick * per_r) * g.twist;
  store(own.omega + lane, omega);

  const Lanes zero = Lanes{}, length = zero + k.reach.length;
  const Lanes x_free = g.x + k.dt * u;
  const Lanes x = select(x_free >= length, x_free - length, select(x_free < zero, x_free + length, x_free));
  const Lanes y = g.y + k.dt * v;
  store_fours(&place->x, x, y, g.r, omega * g.r);
  store_twos(&motion->u, u, v);

  const Lanes dx = nearest_image<Lanes>(x - load(x_built), k.reach.length), dy = y - load(y_built);
  const Lanes limit = zero + base::square(k.leash);
  return bits(~(dx * dx + dy * dy <= limit));  // a NaN counts as moved
}

/// Grains [begin, begin + width) as the records hold them.
[[gnu::always_inline]] inline Part part_of(const Level& now, int begin) {
  std::int32_t at[width];
  for (int l = 0; l < width; ++l) at[l] = begin + l;
  Lanes place[4], motion[2];
  load_fours(&now.place->x, at, place);
  load_twos(&now.motion->u, at, motion);
  return {.x = place[0], .y = place[1], .u = motion[0], .v = motion[1], .r = place[2], .w = place[3]};
}

/// Everything that touches the part of a slice from `lane` on pushes it.
template <class Form>
[[gnu::always_inline]] inline void push_all(const Sweep& k, Part& g, Contacts& c, Records& records, const Level& now,
                                            int slice, int lane) {
  const unsigned near = c.near[slice];
  if (near & near_seam) {
    push_pairs<Form, true>(k, g, c, now, slice, lane);
  } else {
    push_pairs<Form, false>(k, g, c, now, slice, lane);
  }
  const int wall = c.wall_place[slice] * lanes + lane;
  if (near & near_floor) push_floor<Form>(k, g, c, wall);
  if (near & near_pipe) push_pipe<Form>(k, g, c, wall, records.pipe_impulse_x[slice], records.pipe_impulse_y[slice]);
  if (near & near_wall) push_pieces<Form>(k, g, c, slice, lane);
}

/// One step of a slice.  Returns true when a grain of it is off the leash.
template <class Form>
inline bool step_slice(const Sweep& k, Contacts& c, Records& records, const Level& now, const Level& next, int slice) {
  unsigned moved = 0;
  for (int lane = 0; lane < lanes; lane += width) {
    const int begin = slice * lanes + lane;
    Part g = part_of(now, begin);
    push_all<Form>(k, g, c, records, now, slice, lane);
    moved |= move(k, g, records.own[slice], lane, &c.x_built[begin], &c.y_built[begin], next.place + begin,
                  next.motion + begin)
             << lane;
  }
  const int idle = (slice + 1) * lanes - k.count;  // the last slice may have lanes without a grain
  return (moved & (0xffu >> (idle > 0 ? idle : 0))) != 0;
}

/// Calls run(Form{}) for the laws of a case.
template <bool keeps, class Run>
auto with_form(const Sweep& k, Run&& run) {
  if (k.law == Law::hooke)
    return k.reach.rolling ? run(Form<Law::hooke, true, keeps>{}) : run(Form<Law::hooke, false, keeps>{});
  return k.reach.rolling ? run(Form<Law::paper, true, keeps>{}) : run(Form<Law::paper, false, keeps>{});
}

bool step_slices(const Sweep& k, Contacts& c, Records& r, int begin, int end, bool back) {
  const Level now = back ? next_of(r) : now_of(r), next = back ? now_of(r) : next_of(r);
  return with_form<true>(k, [&](auto form) {
    bool moved = false;
    for (int n = begin; n < end; ++n) moved |= step_slice<decltype(form)>(k, c, r, now, next, r.awake[n]);
    return moved;
  });
}

void push_slice(const Sweep& k, Contacts& c, Records& r, int slice, SliceForce& force) {
  with_form<false>(k, [&](auto form) {
    for (int lane = 0; lane < lanes; lane += width) {
      const Level now = now_of(r);
      Part g = part_of(now, slice * lanes + lane);
      push_all<decltype(form)>(k, g, c, r, now, slice, lane);
      store(force.x + lane, g.force_x);
      store(force.y + lane, g.force_y);
      store(force.twist + lane, g.twist);
    }
  });
}

/// The two or three different columns around column c of a periodic row of columns.
int columns_around(int c, int columns, int around[3]) {
  if (columns < 3) {
    for (int k = 0; k < columns; ++k) around[k] = k;
    return columns;
  }
  around[0] = c == 0 ? columns - 1 : c - 1;
  around[1] = c;
  around[2] = c == columns - 1 ? 0 : c + 1;
  return 3;
}

/// Writes the neighbours of one grain to `close`, where most_neighbours have room; returns how many.
int find_one(const Cells& cells, const Reach& reach, int rank, ListScratch& w, std::int32_t* close) {
  std::int32_t apart[most_neighbours];
  int n_close = 0, n_apart = 0;
  const double x = w.x[rank], y = w.y[rank], touching = w.touching[rank];
  const int cell = w.cell[w.old_of_rank[rank]], strip = cell / Cells::band, in_band = cell % Cells::band;
  const int band = strip / cells.columns, row = band * Cells::band + in_band;
  // Cells of a column follow one another within a band: one run, or two across an edge of it.
  const int low = row > 0 ? row - 1 : 0, high = row < cells.rows - 1 ? row + 1 : row;
  const int split = in_band == 0 ? row : (in_band == Cells::band - 1 ? high : low);
  int around[3];
  const int n_around = columns_around(strip - band * cells.columns, cells.columns, around);
  for (int run = 0; run < 2 * n_around; ++run) {
    const bool second = run % 2 != 0;
    const int column = around[run / 2], from = second ? split : low, to = second ? high : split - 1;
    if (from > to) continue;
    const int end = w.cell_start[cells.number(column, to) + 1];
    for (int j = w.cell_start[cells.number(column, from)]; j < end; j += width) {
      const Lanes contact = touching + load(w.touching.data() + j);
      const Lanes dx = nearest_image<Lanes>(load(w.x.data() + j) - x, reach.length), dy = load(w.y.data() + j) - y;
      const Lanes d2 = dx * dx + dy * dy, far = contact + reach.skin;
      unsigned here = bits(d2 <= far * far) & (end - j < width ? (1u << (end - j)) - 1 : 0xffu);
      if (rank >= j && rank < j + width) here &= ~(1u << (rank - j));
      const unsigned near = bits(d2 < close_by * close_by * contact * contact);
      if (n_close + n_apart + lanes > most_neighbours) {
        w.found_all[rank] = most_neighbours + 1;
        return 0;
      }
      n_close += append_lanes(close + n_close, j, here & near);
      n_apart += append_lanes(apart + n_apart, j, here & ~near);
    }
  }
  for (int k = 0; k < n_apart; ++k) close[n_close + k] = apart[k];
  w.found_close[rank] = n_close;
  return w.found_all[rank] = n_close + n_apart;
}

int find(const Cells& cells, const Reach& reach, int begin, int end, ListScratch& w, std::int32_t* found) {
  int count = 0;
  for (int rank = begin; rank < end; ++rank) {
    w.found_close[rank] = 0;
    w.found_first[rank] = count;
    count += find_one(cells, reach, rank, w, found + count);
  }
  return count;
}

}  // namespace

namespace LIVEBED_KERNELS {
extern const Kernels kernels;
const Kernels kernels{LIVEBED_KERNELS_NAME, step_slices, push_slice, find};
}  // namespace LIVEBED_KERNELS

}  // namespace livebed::grains
