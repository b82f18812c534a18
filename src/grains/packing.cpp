#include "grains/packing.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <random>

#include "base/fault.hpp"
#include "base/loops.hpp"
#include "base/math.hpp"
#include "grains/measures.hpp"
#include "grains/sizes.hpp"

namespace livebed::grains {

using base::Exit;
using base::fail;

namespace {

constexpr int looks_in_a_row = 10;      ///< below settled_speed before a bed counts as settled
constexpr int looks_per_fall = 10;      ///< in the time a grain falls its own diameter
constexpr int looks_for_a_trend = 150;  ///< a bed that gets no slower from one such stretch to the next shakes
/// Grains that may go on trembling in a bed at rest, of all [-]: one that is wedged between more neighbours, or fixed
/// grains of the floor, than an explicit dashpot can damp changes its spin with every step and never stops.
constexpr double share_that_may_tremble = 1e-3;
/// Speed to which they may shake the others (root mean square), over settled_speed [-]: nothing stops the sound of a
/// dense bed, in which grains stay where they are.
constexpr double shaken_by_them = 10;
constexpr double least_above_cut =
    1.5;  ///< of the mean level of a bed above the level it is cut to, over the largest d [-]

/// Time in which a grain falls its own diameter [s]: the measure of everything here.
double fall_time(const Params& p) { return std::sqrt(2 * p.diameter / submerged_gravity(p)); }

/// Root mean square of the speeds when a share of all grains, the fastest, is left out [m/s].
double rms_speed_without(const State& s, double share) {
  std::vector<double> squares(s.count());
  for (int i = 0; i < s.count(); ++i) squares[i] = base::square(s.u[i]) + base::square(s.v[i]);
  const auto left = static_cast<std::ptrdiff_t>(share * s.count());
  std::nth_element(squares.begin(), squares.end() - 1 - left, squares.end());
  const double sum = base::vector_sum(0, s.count() - static_cast<int>(left), [&](int i) { return squares[i]; });
  return std::sqrt(sum / static_cast<double>(s.count() - left));
}

/// A fluid at rest that slows every grain down within `time`; none for time = 0.
void thicken(Bed& bed, double time) {
  State& s = bed.state;
  for (Array* a : {&s.fluid.u, &s.fluid.v, &s.fluid.fx, &s.fluid.fy}) std::fill(a->begin(), a->end(), 0.0);
  for (int i = 0; i < s.count(); ++i) s.fluid.beta[i] = time > 0 ? mass(bed.params, s.diameter[i]) / time : 0.0;
}

void forget_impulses(Bed& bed) {
  for (Array* a : {&bed.state.impulse_x, &bed.state.impulse_y}) std::fill(a->begin(), a->end(), 0.0);
  bed.pipe_impulse = {};
}

/// A number in [0, 1) from 53 bits of the generator; std::uniform_real_distribution differs between libraries.
double unit(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

Bed bed_of_sizes(const Params& given) {
  Bed bed = make_bed(derive(given));
  const std::vector<double> diameters = sample_diameters(bed.params);
  std::copy(diameters.begin(), diameters.end(), bed.state.diameter.begin());
  return bed;
}

}  // namespace

Bed lattice(const Params& given) {
  Bed bed = bed_of_sizes(given);
  const Params& p = bed.params;
  const double largest = largest_diameter(p);
  const double gap = p.lattice_gap * p.diameter;
  const int columns = static_cast<int>(p.length / (p.gamma * largest + gap));
  if (columns < 2) {
    fail(Exit::invalid_case, "grains.length = {} m holds no two grains of {} m", p.length, largest);
  }
  const double pitch = p.length / columns, rise = p.gamma * largest + gap;
  std::mt19937_64 generator(p.seed);
  State& s = bed.state;
  for (int i = 0; i < p.count; ++i) {
    const double shift_x = 0.5 * gap * (unit(generator) - 0.5), shift_y = 0.5 * gap * (unit(generator) - 0.5);
    s.x[i] = (i % columns + 0.5) * pitch + shift_x;
    s.y[i] = (i / columns + 0.5) * rise + shift_y;
  }
  return bed;
}

Bed scattered(const Params& given) {
  Bed bed = bed_of_sizes(given);
  const Params p = bed.params;
  State& s = bed.state;
  // One grain anywhere in each of as many boxes: as even as a lattice, as irregular as chance.
  const double area = base::sphere_area(1) * mean_power(p, 2) / p.packing_fraction, side = std::sqrt(area);
  const int columns = std::max(1, static_cast<int>(std::lround(p.length / side)));
  const double box_width = p.length / columns, height = area / box_width;
  std::mt19937_64 generator(p.seed);
  for (int i = 0; i < p.count; ++i) {
    s.x[i] = (i % columns + unit(generator)) * box_width;
    s.y[i] = (i / columns + unit(generator)) * height;
  }
  // They overlap: without weight and friction, in a fluid so thick that they creep, they push each other apart.
  bed.params.gravity = 0;
  bed.params.friction = 0;
  bed.params.skin = 0.1;
  thicken(bed, 10 * p.step);
  for (int look = 0; look < 40; ++look) {
    advance(bed, 50);
    if (measure_contacts(bed).largest_overlap < 0.02) break;
  }
  thicken(bed, 0);
  for (Array* a : {&s.u, &s.v, &s.omega}) std::fill(a->begin(), a->end(), 0.0);
  forget_impulses(bed);
  bed.params = p;
  bed.contacts = {};
  return bed;
}
std::vector<SettleRow> settle(Bed& bed, const OnLook& on_look) {
  const Params& p = bed.params;
  const double time = fall_time(p);
  const int steps = std::max(1, static_cast<int>(time / looks_per_fall / p.step));
  std::vector<SettleRow> rows;
  bool thick = true;
  int calm = 0;
  const std::int64_t begin = bed.steps;
  // A bed that neither sinks nor gets slower from one stretch of looks to the next shakes: it will never rest.
  const auto shakes = [&](int stretch) {
    const auto last = rows.end();
    if (static_cast<int>(rows.size()) < 2 * stretch) return false;
    const auto slower = [](const SettleRow& a, const SettleRow& b) { return a.mean_speed < b.mean_speed; };
    const double before = std::min_element(last - 2 * stretch, last - stretch, slower)->mean_speed;
    const double now = std::min_element(last - stretch, last, slower)->mean_speed;
    return now > 0.9 * before && std::abs((last - 1)->height - (last - stretch)->height) < 1e-3 * p.diameter;
  };
  const auto give_up = [&](const std::string& why) {
    fail(Exit::stopped_by_limit,
         "the bed has not come to rest after {:.3g} s: {}; mean grain speed {:.3g} m/s (asked for: below "
         "bed.settled_speed = {} m/s), largest {:.3g} m/s",
         rows.back().time, why, rows.back().mean_speed, p.settled_speed, rows.back().max_speed);
  };
  const std::string why_shaking = "its contacts shake and get no slower; use more contact.steps or less damping";
  thicken(bed, time);
  while (true) {
    advance(bed, steps);
    const double now = static_cast<double>(bed.steps - begin) * p.step;
    rows.push_back({now, mean_speed(bed.state), max_speed(bed.state), bed_height(bed.state)});
    if (on_look) on_look(rows.back());
    const bool slow = rows.back().mean_speed < p.settled_speed;
    const bool shaking = !slow && shakes(looks_for_a_trend);
    const bool trembling =
        shaking && rms_speed_without(bed.state, share_that_may_tremble) < shaken_by_them * p.settled_speed;
    calm = (slow || trembling) && now > time ? calm + 1 : 0;
    if (calm == looks_in_a_row) {
      if (!thick) break;
      // Ten looks, not one: a bed that swings as a whole is slow at its turning points, too.
      thick = false;
      calm = 0;
      thicken(bed, 0);
    }
    if (shaking && !trembling) give_up(why_shaking);
    if (now > p.settle_time) {
      give_up(
          shakes(2 * looks_in_a_row)
              ? why_shaking
              : fmt::format("it still sinks or creeps; allow more time than bed.settle_time = {} s", p.settle_time));
    }
  }
  forget_impulses(bed);
  return rows;
}

namespace {

/// Gives a bed made of another's grains what their contacts remember; origin: the place there of each id, -1: none.
void carry_histories(const Bed& from, const std::vector<int>& origin, Bed& to) {
  advance(to, 0);  // makes its lists
  const Contacts& old = from.contacts;
  Contacts& now = to.contacts;
  const State& s = to.state;
  for (int i = 0; i < s.count(); ++i) {
    const int was = origin[s.id[i]], slice = i / lanes;
    if (was < 0) continue;
    for (std::ptrdiff_t row = now.first[slice]; row < now.last[slice]; ++row) {
      const std::ptrdiff_t slot = row * lanes + i % lanes;
      const int j = now.neighbour[slot] < s.count() ? origin[s.id[now.neighbour[slot]]] : -1;
      const std::ptrdiff_t before = j < 0 ? -1 : slot_of(old, was, j);
      if (before < 0) continue;
      now.spring.set(slot, old.spring[before]);
      if (!now.rolling.empty()) now.rolling.set(slot, old.rolling[before]);
    }
    const int there = old.wall_place[was / lanes], here = now.wall_place[slice];
    if (there < 0 || here < 0) continue;
    for (int wall = 0; wall < wall_slots; ++wall) {
      now.wall_spring[wall][here * lanes + i % lanes] = old.wall_spring[wall][there * lanes + was % lanes];
      if (!now.rolling.empty())
        now.wall_rolling[wall][here * lanes + i % lanes] = old.wall_rolling[wall][there * lanes + was % lanes];
    }
  }
}

/// The bed with the grains for which keep(i) holds and, if asked for, more of them in rows above; the ids are new.
template <class Keep>
Bed changed(const Bed& bed, Keep&& keep, int more) {
  const State& s = bed.state;
  std::vector<int> kept;
  for (int i = 0; i < s.count(); ++i) {
    if (keep(i)) kept.push_back(i);
  }
  Params p = bed.params;
  p.count = more;
  p.seed += static_cast<unsigned>(s.count());  // not the sizes of those that lie already
  const Bed above = more > 0 ? lattice(p) : Bed{};
  const double floor = highest_grain(s, p.length, 0, p.length);
  p = bed.params;
  p.count = static_cast<int>(kept.size()) + more;
  Bed result = make_bed(p);
  for (int i = 0; i < p.count; ++i) {
    const bool old = i < static_cast<int>(kept.size());
    const State& from = old ? s : above.state;
    const int k = old ? kept[i] : i - static_cast<int>(kept.size());
    result.state.x[i] = from.x[k];
    result.state.y[i] = from.y[k] + (old ? 0 : floor);
    result.state.diameter[i] = from.diameter[k];
  }
  result.pipe = bed.pipe;
  result.steps = bed.steps;
  kept.resize(p.count, -1);
  carry_histories(bed, kept, result);
  return result;
}

void append(std::vector<SettleRow>& rows, const std::vector<SettleRow>& later) {
  const double before = rows.empty() ? 0 : rows.back().time;
  for (SettleRow row : later) {
    row.time += before;
    rows.push_back(row);
  }
}

/// Number of grains whose circles fill a layer of this thickness.
int count_in_layer(const Params& p, double thickness) {
  return static_cast<int>(
      std::ceil(thickness * p.length * p.packing_fraction / (base::sphere_area(1) * mean_power(p, 2))));
}

}  // namespace

std::vector<SettleRow> level(Bed& bed, double height, const OnLook& on_look) {
  std::vector<SettleRow> rows;
  const double needed = height + least_above_cut * largest_diameter(bed.params);
  for (double now = bed_height(bed.state); now < needed; now = bed_height(bed.state)) {
    const double missing = needed - now + largest_diameter(bed.params);
    bed = changed(
        bed, [](int) { return true; }, count_in_layer(bed.params, missing));
    append(rows, settle(bed, on_look));
  }
  bed = changed(
      bed, [&](int i) { return bed.state.y[i] < height; }, 0);
  append(rows, settle(bed, on_look));
  return rows;
}

namespace {

/// One piece of the bed packed, its copies side by side settled together.
Packing pack_in_pieces(const Params& p, const OnLook& on_look) {
  Params one = p;
  one.pieces = 1;
  one.length /= p.pieces;
  if (p.thickness == 0 && p.count % p.pieces != 0)
    fail(Exit::invalid_case, "bed.count = {} cannot be divided into bed.pieces = {} alike", p.count, p.pieces);
  one.count /= p.pieces;
  Packing result = pack(one, on_look);
  result.bed = side_by_side(result.bed, p.pieces);
  append(result.convergence, settle(result.bed, on_look));
  return result;
}

}  // namespace

Packing pack(const Params& given, const OnLook& on_look) {
  Params p = derive(given);
  if (p.pieces > 1) return pack_in_pieces(p, on_look);
  if (p.thickness > 0) p.count = count_in_layer(p, p.thickness + 2 * least_above_cut * largest_diameter(p));
  Packing result{.bed = p.start == Placing::lattice ? lattice(p) : scattered(p), .convergence = {}};
  result.convergence = settle(result.bed, on_look);
  if (p.thickness > 0) append(result.convergence, level(result.bed, p.thickness, on_look));
  return result;
}

Bed side_by_side(const Bed& tile, int tiles) {
  const int n = tile.params.count;
  Params p = tile.params;
  p.count *= tiles;
  p.length *= tiles;
  p.pieces *= tiles;
  Bed bed = make_bed(p);
  std::vector<int> origin(p.count);
  for (int i = 0; i < p.count; ++i) {
    bed.state.x[i] = tile.state.x[i % n] + i / n * tile.params.length;
    bed.state.y[i] = tile.state.y[i % n];
    bed.state.diameter[i] = tile.state.diameter[i % n];
    origin[i] = i % n;
  }
  if (tile.contacts.built()) carry_histories(tile, origin, bed);
  return bed;
}

std::vector<SettleRow> place_pipe(Bed& bed, const Circle& target, double speed, const OnLook& on_look) {
  const Params& p = bed.params;
  const double radius = 0.5 * target.diameter;
  if (target.y - radius < 0) {
    fail(Exit::invalid_case, "the pipe reaches {} m through the floor of the bed; raise it or make the bed thicker",
         radius - target.y);
  }
  const double top = highest_grain(bed.state, p.length, target.x, radius + largest_diameter(p));
  bed.pipe = target;
  bed.pipe.present = true;
  bed.pipe.y = std::max(target.y, top + radius);
  const int steps = 10;
  const double lowering = speed * p.step * steps;
  thicken(bed, fall_time(p));
  while (bed.pipe.y > target.y) {
    bed.pipe.y = std::max(target.y, bed.pipe.y - lowering);
    advance(bed, steps);
  }
  return settle(bed, on_look);
}

}  // namespace livebed::grains
