// Compiled once for each instruction set, see kernels.hpp.
#include "grains/kernels.hpp"

#include "base/math.hpp"

namespace livebed::grains {

namespace {

/// Pairs within this factor of touching come first in a list: what touches, or will soon.
constexpr double close_by = 1.005;

/// In double precision a row of neighbours is one vector of doubles.  In mixed precision two rows are taken at a time:
/// places are two vectors of doubles, all the rest is one vector of singles.
template <class Number>
struct Precise;
template <>
struct Precise<double> {
  using Real = Lanes;
  static constexpr int rows = 1;
};
template <>
struct Precise<float> {
  using Real = Singles;
  static constexpr int rows = 2;
};

Lanes in_double(const Lanes& a, int) { return a; }
Lanes in_double(const Singles& a, int n) { return widen(n == 0 ? first_row(a) : second_row(a)); }
Lanes of_rows(const Lanes (&a)[1]) { return a[0]; }
Singles of_rows(const Lanes (&a)[2]) { return join_rows(narrow(a[0]), narrow(a[1])); }
Lanes total(const Lanes& a) { return a; }
Singles total(const Singles& a) { return sum_of_rows(a); }

/// What contacts remember: those with grains in the precision of the forces, those with walls in double and in the
/// first row alone.
Lanes load_history(const double* from, Lanes*) { return load(from); }
Singles load_history(const float* from, Singles*) { return load_rows(from); }
Singles load_history(const double* from, Singles*) { return join_rows(narrow(load(from)), SingleRow{}); }
void store_history(double* to, const Lanes& a) { store(to, a); }
void store_history(float* to, const Singles& a) { store_rows(to, a); }
void store_history(double* to, const Singles& a) { store(to, in_double(a, 0)); }

/// The grains of a part of a slice, as many as a vector of doubles holds, and the forces on them so far.
template <class Real>
struct Part {
  Lanes x, y;
  Real u, v, r, w;
  Real force_x{}, force_y{}, twist{};  ///< twist: sum of f_s and of rolling moments over r; the torque is r times that
};

/// What a contact computes: a kernel for each of the laws, with and without rolling resistance, and whether it keeps
/// its histories; Number: of velocities and forces.
template <Law dashpots, bool rolls, bool keeps, class NumberOfForces>
struct Form {
  using Number = NumberOfForces;
  using Real = typename Precise<Number>::Real;
  static constexpr int rows = Precise<Number>::rows;
  using Mask = decltype(Real{} > Real{});
  using Contact = ContactOf<Number>;
  static constexpr bool single = std::is_same_v<Number, float>;
  static constexpr bool remembers = keeps;
  static constexpr Law law = dashpots;
  static constexpr bool rolling = rolls;
  static constexpr bool sized = rolls || dashpots == Law::hooke;  ///< needs what mass and size decide
};

/// How near two surfaces are, in each lane.
template <class Form>
struct Gap {
  typename Form::Mask touching;
  typename Form::Real overlap, n_x, n_y;  ///< n: from the grain to the other
};

/// One contact in each lane.
template <class Form>
struct Touch {
  Gap<Form> gap;
  typename Form::Real u, v;  ///< velocity of the other relative to the grain
  typename Form::Real spin;  ///< w_i + w_j
};

/// Ways from the centres of grains to those of others, and at which distance they touch.  The sum of two radii is not a
/// single, so it is kept in double, too.
template <class Form>
struct Way {
  Lanes dx[Form::rows], dy[Form::rows], contact_distance[Form::rows];
  typename Form::Real about;  ///< contact_distance, for what need not be exact
};

/// An overlap is the small difference of two lengths, and from single precision it would come out wrong by a
/// thousandth: the difference of their squares is taken in double.
template <class Form>
[[gnu::always_inline]] inline Gap<Form> gap_of(const Way<Form>& way) {
  if constexpr (Form::single) {
    Lanes room[2];
    for (int n = 0; n < 2; ++n)
      room[n] = way.contact_distance[n] * way.contact_distance[n] - (way.dx[n] * way.dx[n] + way.dy[n] * way.dy[n]);
    const Singles dx = of_rows(way.dx), dy = of_rows(way.dy), space = of_rows(room);
    const Singles distance = root(dx * dx + dy * dy), inverse = 1.0f / distance;
    return {space > 0.0f, space / (way.about + distance), dx * inverse, dy * inverse};
  } else {
    const Lanes dx = way.dx[0], dy = way.dy[0], contact_distance = way.contact_distance[0];
    const Lanes d2 = dx * dx + dy * dy, inverse = reciprocal_root(d2), distance = d2 * inverse;
    return {d2 < contact_distance * contact_distance, contact_distance - distance, dx * inverse, dy * inverse};
  }
}

/// Adds the force of one contact in each lane that touches.  reduced() and rate() (spin of the grain minus spin of the
/// other) are asked for only by the laws that need them.
/// Stored: the precision of the histories, that of the forces or double.
template <class Form, class Stored, class ReducedOf, class Rate>
[[gnu::always_inline]] inline void push(const typename Form::Contact& law, Part<typename Form::Real>& g,
                                        const Touch<Form>& t, const ReducedOf& reduced_of, const Rate& rate,
                                        Stored* spring, Stored* rolling) {
  using Real = typename Form::Real;
  const Gap<Form>& gap = t.gap;
  const Real before = load_history(spring, static_cast<Real*>(nullptr));
  const Real closing = -(t.u * gap.n_x + t.v * gap.n_y);
  const Real slip = (t.v * gap.n_x - t.u * gap.n_y) - t.spin;
  Reduced<Real> reduced;
  if constexpr (Form::sized) reduced = reduced_of();
  const ContactForce<Real> f = [&] {
    if constexpr (Form::law == Law::hooke) {
      return contact_force<Real>(law, law.eta_n * root(reduced.mass), gap.overlap, closing, slip, before);
    } else {
      return contact_force<Real>(law, law.eta_n, gap.overlap, closing, slip, before);
    }
  }();
  const Real zero = Real{};
  const Real f_n = select(gap.touching, f.normal, zero), f_s = select(gap.touching, f.tangential, zero);
  const Real after = select(gap.touching, f.spring, zero);
  g.force_x -= f_n * gap.n_x + f_s * gap.n_y;
  g.force_y += f_s * gap.n_x - f_n * gap.n_y;
  g.twist += f_s;
  if constexpr (Form::remembers) store_history(spring, after);
  if constexpr (Form::rolling) {
    const RollingMoment<Real> m =
        rolling_moment<Real>(law, reduced, f_n, rate(), load_history(rolling, static_cast<Real*>(nullptr)));
    g.twist += select(gap.touching, m.moment, zero) / g.r;
    if constexpr (Form::remembers) store_history(rolling, select(gap.touching, m.spring, zero));
  }
}

/// Contact with something that does not move.
template <class Form>
[[gnu::always_inline]] inline void push_wall(const Contact& wall, Part<typename Form::Real>& g, const Gap<Form>& gap,
                                             double* spring, double* rolling) {
  const typename Form::Contact law = in_precision<typename Form::Number>(wall);
  push<Form>(
      law, g, {gap, -g.u, -g.v, g.w}, [&] { return reduced_at_wall<typename Form::Real>(law, g.r); },
      [&] { return g.w / g.r; }, spring, rolling);
}

/// Contact with a circle that does not move: a grain of the floor, or the pipe.
template <class Form>
[[gnu::always_inline]] inline void push_circle(const Contact& law, Part<typename Form::Real>& g, const Lanes& dx,
                                               const Lanes& dy, const Lanes& contact_distance, double* spring,
                                               double* rolling) {
  const Way<Form> way = [&] {
    if constexpr (Form::single)  // nothing is in the second row
      return Way<Form>{{dx, dx},
                       {dy, Lanes{} + far_away},
                       {contact_distance, contact_distance},
                       of_rows({contact_distance, contact_distance})};
    else
      return Way<Form>{{dx}, {dy}, {contact_distance}, contact_distance};
  }();
  push_wall<Form>(law, g, gap_of<Form>(way), spring, rolling);
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
void push_floor(const Sweep& k, Part<typename Form::Real>& g, Contacts& c, int begin) {
  using Real = typename Form::Real;
  const Lanes r = in_double(g.r, 0);
  if (k.floor == Floor::plane) {
    Lanes overlaps[Form::rows]{k.reach.gamma * r - g.y};  // none in a second row
    const Real zero = Real{}, one = zero + 1, overlap = of_rows(overlaps);
    push_wall<Form>(k.bottom, g, {overlap > zero, overlap, zero, -one}, c.wall_spring[slot_floor].data() + begin,
                    rolling_of<Form>(c.wall_rolling[slot_floor], begin));
    return;
  }
  // A row of fixed grains with their tops at y = 0.  A grain touches at most one of even and one of odd number.
  const double radius = 0.5 * k.reach.floor_diameter;
  for (const int slot : {slot_floor, slot_floor_odd}) {
    const double start = (slot == slot_floor ? 0.5 : 1.5) * k.floor_spacing;
    push_circle<Form>(k.bottom, g, to_nearest(g.x, start, 2 * k.floor_spacing), -radius - g.y,
                      k.reach.gamma * (r + radius), c.wall_spring[slot].data() + begin,
                      rolling_of<Form>(c.wall_rolling[slot], begin));
  }
}

/// Adds to (impulse_x, impulse_y) what the pipe receives.
template <class Form>
void push_pipe(const Sweep& k, Part<typename Form::Real>& g, Contacts& c, int begin, double& impulse_x,
               double& impulse_y) {
  Part<typename Form::Real> alone = g;
  alone.force_x = alone.force_y = alone.twist = typename Form::Real{};
  push_circle<Form>(k.pipe_wall, alone, nearest_image<Lanes>(k.pipe.x - g.x, k.reach.length), k.pipe.y - g.y,
                    k.reach.gamma * in_double(g.r, 0) + 0.5 * k.pipe.diameter, c.wall_spring[slot_pipe].data() + begin,
                    rolling_of<Form>(c.wall_rolling[slot_pipe], begin));
  g.force_x += alone.force_x;
  g.force_y += alone.force_y;
  g.twist += alone.twist;
  impulse_x -= k.dt * sum(in_double(alone.force_x, 0));
  impulse_y -= k.dt * sum(in_double(alone.force_y, 0));
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
void push_pieces(const Sweep& k, Part<typename Form::Real>& g, Contacts& c, int slice, int lane) {
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
    push_circle<Form>(k.bottom, g, load(dx), load(dy), k.reach.gamma * in_double(g.r, 0), c.piece_spring.data() + begin,
                      rolling_of<Form>(c.piece_rolling, begin));
  }
}

/// Places and motions of all grains when a step begins, or when it ends.
struct Level {
  Place* place;
  Motion* motion;
  Compact* compact;  ///< in mixed precision instead of those
};
Level now_of(Records& r) { return {r.place.data(), r.motion.data(), r.compact.data()}; }
Level next_of(Records& r) { return {r.place_next.data(), r.motion_next.data(), r.compact_next.data()}; }

/// Grains as their records show them.
template <class Form>
struct Shown {
  Lanes x[Form::rows], y[Form::rows];
  typename Form::Real r, w, u, v;
};

/// Where they are and how large: in mixed precision the same load brings their speeds.
template <class Form>
[[gnu::always_inline]] inline void load_places(const Level& now, const std::int32_t* at, Shown<Form>& shown) {
  Lanes a[4];
  if constexpr (Form::single) {
    Lanes b[4];
    load_fours(&now.compact->x, at, a);
    load_fours(&now.compact->x, at + lanes, b);
    shown = {{a[0], b[0]},
             {a[1], b[1]},
             first_halves(a[2], b[2]),
             second_halves(a[2], b[2]),
             first_halves(a[3], b[3]),
             second_halves(a[3], b[3])};
  } else {
    load_fours(&now.place->x, at, a);
    shown.x[0] = a[0], shown.y[0] = a[1], shown.r = a[2], shown.w = a[3];
  }
}
template <class Form>
[[gnu::always_inline]] inline void load_speeds(const Level& now, const std::int32_t* at, Shown<Form>& shown) {
  if constexpr (!Form::single) {
    Lanes a[2];
    load_twos(&now.motion->u, at, a);
    shown.u = a[0], shown.v = a[1];
  }
}

/// The way from grains to the others of as many rows as are taken at a time.
template <class Form, bool across_seam>
[[gnu::always_inline]] inline void look(const Reach& reach, const Part<typename Form::Real>& g,
                                        const Shown<Form>& other, Way<Form>& way) {
  way.about = static_cast<typename Form::Number>(reach.gamma) * (g.r + other.r);
  for (int n = 0; n < Form::rows; ++n) {
    way.contact_distance[n] = reach.gamma * (in_double(g.r, n) + in_double(other.r, n));
    way.dx[n] = other.x[n] - g.x, way.dy[n] = other.y[n] - g.y;
    if constexpr (across_seam) way.dx[n] = nearest_image<Lanes>(way.dx[n], reach.length);
  }
}

template <class Form, bool across_seam>
[[gnu::always_inline]] inline void push_pairs(const Sweep& k, Part<typename Form::Real>& part, Contacts& c,
                                              const Level& now, int slice, int lane) {
  using Real = typename Form::Real;
  using Number = typename Form::Number;
  const std::int32_t* const neighbour = c.neighbour.data() + lane;
  Number* const springs = c.spring.data<Number>() + lane;
  Number* const rolling = c.rolling.data<Number>() + (Form::rolling ? lane : 0);
  const typename Form::Contact law = in_precision<Number>(k.pair);  // copies stay in registers
  const Reach reach = k.reach;
  Part<Real> g = part;
  Shown<Form> other;
  Way<Form> way;
  int row = c.first[slice], end = c.first_apart[slice];
  const int last = c.last[slice];
  while (true) {
    for (; row < end; row += Form::rows) {
      const std::ptrdiff_t slot = static_cast<std::ptrdiff_t>(row) * lanes;
      const std::int32_t* const at = neighbour + slot;
      load_places<Form>(now, at, other);
      look<Form, across_seam>(reach, g, other, way);
      load_speeds<Form>(now, at, other);
      push<Form>(
          law, g, {gap_of<Form>(way), other.u - g.u, other.v - g.v, g.w + other.w},
          [&] { return reduced_of_pair<Real>(law, g.r, other.r); }, [&] { return g.w / g.r - other.w / other.r; },
          springs + slot, rolling + (Form::rolling ? slot : 0));
    }
    // Pairs that were apart when the lists were built have no spring yet.  The first of them to touch moves them all to
    // the front part until the next lists.
    Mask met{};
    for (int apart = row; apart < last; apart += Form::rows) {
      load_places<Form>(now, neighbour + static_cast<std::ptrdiff_t>(apart) * lanes, other);
      look<Form, across_seam>(reach, g, other, way);
      for (int n = 0; n < Form::rows; ++n)
        met |= way.dx[n] * way.dx[n] + way.dy[n] * way.dy[n] < way.contact_distance[n] * way.contact_distance[n];
    }
    if (bits(met) == 0) break;
    c.first_apart[slice] = end = last;
  }
  part = g;
}

template <class Real>
struct Speed {
  Real u, v;
};

/// New velocities of the part of a slice from `lane` on.
template <class Form, class OwnOf>
[[gnu::always_inline]] inline Speed<typename Form::Real> kicked(const Sweep& k, const Part<typename Form::Real>& g,
                                                                const typename Form::Real& kick, const OwnOf& own,
                                                                int lane) {
  using Number = typename Form::Number;
  const auto get = [&](const Number* of) {
    if constexpr (Form::single)
      return join_rows(load_row(of + lane), load_row(of + lane));
    else
      return load(of + lane);
  };
  const typename Form::Real damped = Number(1) / (Number(1) + kick * get(own.beta));
  return {(g.u + kick * (g.force_x + get(own.push_x))) * damped,
          (g.v - static_cast<Number>(k.dt * k.gravity) + kick * (g.force_y + get(own.push_y))) * damped};
}

/// Moves the part of a slice from `lane` on and writes its records.  Returns a bit for every lane that is off the
/// leash.
template <class Form, bool across_seam>
[[gnu::always_inline]] inline unsigned move(const Sweep& k, const Part<typename Form::Real>& g, const Contacts& c,
                                            Records& records, const Level& next, int slice, int lane) {
  using Real = typename Form::Real;
  using Number = typename Form::Number;
  const int begin = slice * lanes + lane;
  // Masses and inertias are made of the radius anew: large beds wait for memory, not for a division.
  const Real per_r = Number(1) / g.r, kick = static_cast<Number>(k.kick_r3) * (per_r * per_r * per_r);
  Speed<Real> speed;
  Real w;
  if constexpr (Form::single) {
    speed = kicked<Form>(k, g, kick, records.compact_own[slice], lane);
    w = g.w + static_cast<Number>(k.spin) * kick * g.twist;
  } else {
    Own& own = records.own[slice];
    speed = kicked<Form>(k, g, kick, own, lane);
    const Lanes omega = load(own.omega + lane) + k.spin * (kick * per_r) * g.twist;
    store(own.omega + lane, omega);
    w = omega * g.r;
  }

  const Lanes zero = Lanes{};
  Lanes x = g.x + k.dt * in_double(speed.u, 0);
  if constexpr (across_seam) {
    const Lanes length = zero + k.reach.length;
    x = select(x >= length, x - length, select(x < zero, x + length, x));
  }
  const Lanes y = g.y + k.dt * in_double(speed.v, 0);
  if constexpr (Form::single) {
    store_fours(&next.compact[begin].x, x, y, join_halves(g.r, w), join_halves(speed.u, speed.v));
  } else {
    store_fours(&next.place[begin].x, x, y, g.r, w);
    store_twos(&next.motion[begin].u, speed.u, speed.v);
  }

  Lanes dx = x - load(&c.x_built[begin]);
  if constexpr (across_seam) dx = nearest_image<Lanes>(dx, k.reach.length);
  const Lanes dy = y - load(&c.y_built[begin]);
  const Lanes limit = zero + base::square(k.leash);
  return bits(~(dx * dx + dy * dy <= limit));  // a NaN counts as moved
}

/// Grains [begin, begin + width) as the records hold them.
template <class Form>
[[gnu::always_inline]] inline Part<typename Form::Real> part_of(const Level& now, int begin) {
  std::int32_t at[Form::rows * lanes];
  for (int l = 0; l < width; ++l)
    for (int n = 0; n < Form::rows; ++n) at[n * lanes + l] = begin + l;
  Shown<Form> shown;
  load_places<Form>(now, at, shown);
  load_speeds<Form>(now, at, shown);
  return {.x = shown.x[0], .y = shown.y[0], .u = shown.u, .v = shown.v, .r = shown.r, .w = shown.w};
}

/// Everything that touches the part of a slice from `lane` on pushes it.
template <class Form, bool across_seam>
[[gnu::always_inline]] inline void push_all(const Sweep& k, Part<typename Form::Real>& g, Contacts& c, Records& records,
                                            const Level& now, int slice, int lane) {
  const unsigned near = c.near[slice];
  push_pairs<Form, across_seam>(k, g, c, now, slice, lane);
  const int wall = c.wall_place[slice] * lanes + lane;
  if (near & near_floor) push_floor<Form>(k, g, c, wall);
  if (near & near_pipe) push_pipe<Form>(k, g, c, wall, records.pipe_impulse_x[slice], records.pipe_impulse_y[slice]);
  if (near & near_wall) push_pieces<Form>(k, g, c, slice, lane);
  g.force_x = total(g.force_x), g.force_y = total(g.force_y), g.twist = total(g.twist);
}

/// One step of a slice.  Returns true when a grain of it is off the leash.  across_seam: it is so near the ends of the
/// periodic box that a grain of it may meet one across them, or cross them.
template <class Form, bool across_seam>
inline bool step_slice(const Sweep& k, Contacts& c, Records& records, const Level& now, const Level& next, int slice) {
  unsigned moved = 0;
  for (int lane = 0; lane < lanes; lane += width) {
    Part<typename Form::Real> g = part_of<Form>(now, slice * lanes + lane);
    push_all<Form, across_seam>(k, g, c, records, now, slice, lane);
    moved |= move<Form, across_seam>(k, g, c, records, next, slice, lane) << lane;
  }
  const int idle = (slice + 1) * lanes - k.count;  // the last slice may have lanes without a grain
  return (moved & (0xffu >> (idle > 0 ? idle : 0))) != 0;
}

/// Calls run(Form{}) for the laws of a case.
template <bool keeps, class Number, class Run>
auto with_laws(const Sweep& k, Run&& run) {
  if (k.law == Law::hooke)
    return k.reach.rolling ? run(Form<Law::hooke, true, keeps, Number>{})
                           : run(Form<Law::hooke, false, keeps, Number>{});
  return k.reach.rolling ? run(Form<Law::paper, true, keeps, Number>{}) : run(Form<Law::paper, false, keeps, Number>{});
}

/// The same for its laws and its precision.
template <bool keeps, class Run>
auto with_form(const Sweep& k, Run&& run) {
  return k.reach.single ? with_laws<keeps, float>(k, run) : with_laws<keeps, double>(k, run);
}

bool step_slices(const Sweep& k, Contacts& c, Records& r, int begin, int end, bool back) {
  const Level now = back ? next_of(r) : now_of(r), next = back ? now_of(r) : next_of(r);
  return with_form<true>(k, [&](auto form) {
    bool moved = false;
    for (int n = begin; n < end; ++n) {
      const int slice = r.awake[n];
      moved |= c.near[slice] & near_seam ? step_slice<decltype(form), true>(k, c, r, now, next, slice)
                                         : step_slice<decltype(form), false>(k, c, r, now, next, slice);
    }
    return moved;
  });
}

void push_slice(const Sweep& k, Contacts& c, Records& r, int slice, SliceForce& force) {
  with_form<false>(k, [&](auto form) {
    for (int lane = 0; lane < lanes; lane += width) {
      const Level now = now_of(r);
      auto g = part_of<decltype(form)>(now, slice * lanes + lane);
      push_all<decltype(form), true>(k, g, c, r, now, slice, lane);  // where there is no seam it changes nothing
      store(force.x + lane, in_double(g.force_x, 0));
      store(force.y + lane, in_double(g.force_y, 0));
      store(force.twist + lane, in_double(g.twist, 0));
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
