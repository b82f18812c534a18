#include "grains/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/fault.hpp"
#include "base/loops.hpp"
#include "base/math.hpp"
#include "grains/kernels.hpp"

namespace livebed::grains {

using base::Exit;
using base::fail;
using base::square;

namespace {

/// Ranks of which the grains are sorted among each other: few, so that neighbours stay close in memory; more where
/// grains may sleep, since one slice of a window may hold sleepers and others.
constexpr int narrow_window = 64, wide_window = 256;
int window_of(const State& s) { return s.sleep.asleep.empty() ? narrow_window : wide_window; }

void check_places(const State& s, double length) {
  for (int i = 0; i < s.count(); ++i) {
    if (!(std::isfinite(s.x[i]) && std::isfinite(s.y[i]) && std::isfinite(s.u[i]) && std::isfinite(s.v[i]) &&
          std::isfinite(s.omega[i]))) {
      fail(Exit::diverged,
           "grain {} is lost: x = {} m, y = {} m, u = {} m/s, v = {} m/s, spin = {} 1/s; all must be finite; "
           "a smaller grain step (more contact.steps) or less damping cures an unstable contact",
           s.id[i], s.x[i], s.y[i], s.u[i], s.v[i], s.omega[i]);
    }
    if (s.x[i] < 0 || s.x[i] > length || s.y[i] < -s.diameter[i]) {
      fail(Exit::diverged,
           "grain {} has left the box: x = {} m, y = {} m, u = {} m/s, v = {} m/s; allowed are 0 <= x <= {} m and y "
           "above the floor at 0; a smaller grain step or a stiffer contact keeps it in",
           s.id[i], s.x[i], s.y[i], s.u[i], s.v[i], length);
    }
  }
}

bool leaves(const ListScratch& w, int i) { return !w.leaves.empty() && w.leaves[i] != 0; }

/// Counting sort by cell of the n grains that stay; stable, so that the result depends on the state alone.
void rank_by_cell(const State& s, const Cells& cells, double gamma, int n, ListScratch& w) {
  const int count = cells.count();
  std::fill(w.cell_start.begin(), w.cell_start.end(), 0);
  for (int i = 0; i < s.count(); ++i) {
    if (leaves(w, i)) continue;
    w.cell[i] = cells.number_of(s.x[i], s.y[i]);
    ++w.cell_start[w.cell[i] + 1];
  }
  std::partial_sum(w.cell_start.begin(), w.cell_start.end(), w.cell_start.begin());
  for (int i = 0; i < s.count(); ++i)
    if (!leaves(w, i)) w.old_of_rank[w.cell_start[w.cell[i]]++] = i;
  for (int c = count; c > 0; --c) w.cell_start[c] = w.cell_start[c - 1];
  w.cell_start[0] = 0;

  // Whole lanes may be read past the end.
  for (int rank = n; rank < n + lanes; ++rank) w.x[rank] = w.y[rank] = w.touching[rank] = 0;
  for (int rank = 0; rank < n; ++rank) {
    const int i = w.old_of_rank[rank];
    w.x[rank] = s.x[i];
    w.y[rank] = s.y[i];
    w.touching[rank] = 0.5 * gamma * s.diameter[i];
  }
}

/// The final order of one window of ranks: sleepers last, by their places alone, before them those found calm; the
/// others by the number of pairs close by, then of all pairs.  Slices then hold grains with equally long lists, few
/// lanes idle, and one restless grain does not keep seven calm ones from falling asleep.
void sort_window(int begin, int end, const Sleep& sleep, ListScratch& w) {
  std::int32_t by_all[wide_window], by_close[wide_window];
  const auto counting_sort = [&](const std::int32_t* from, const base::Lease<std::int32_t>& key, std::int32_t* to) {
    int start[most_neighbours + 3] = {};
    for (int k = 0; k < end - begin; ++k) ++start[key[from[k]] + 1];
    std::partial_sum(start, start + most_neighbours + 3, start);
    for (int k = 0; k < end - begin; ++k) to[start[key[from[k]]]++] = from[k];
  };
  std::int32_t ranks[wide_window];
  std::iota(ranks, ranks + (end - begin), begin);
  counting_sort(ranks, w.found_all, by_all);
  counting_sort(by_all, w.found_close, by_close);
  if (!sleep.asleep.empty()) {
    const auto awake = [&](std::int32_t rank) { return sleep.asleep[w.old_of_rank[rank]] == 0; };
    const auto restless = [&](std::int32_t rank) { return sleep.calm[w.old_of_rank[rank]] == 0; };
    std::int32_t* const sleepers = std::stable_partition(by_close, by_close + (end - begin), awake);
    std::sort(sleepers, by_close + (end - begin));
    std::stable_partition(by_close, sleepers, restless);
  }
  std::copy_n(by_close, end - begin, &w.rank_of_new[begin]);
  for (int place = begin; place < end; ++place) {
    const int rank = w.rank_of_new[place];
    w.new_of_rank[rank] = place;
    w.old_of_new[place] = w.old_of_rank[rank];
    w.new_of_old[w.old_of_rank[rank]] = place;
  }
}

/// The array in the new order of `count` grains.
template <class T>
void reorder(T& a, int count, ListScratch& w) {
  if (a.empty()) return;
  constexpr int block = 8192;
  const int before = static_cast<int>(a.size());
  const auto in_blocks = [](int n, auto&& body) {
    base::for_each_item(0, (n + block - 1) / block, [&](int b) {
      for (int k = b * block; k < std::min(n, (b + 1) * block); ++k) body(k);
    });
  };
  in_blocks(before, [&](int k) { w.values[k] = static_cast<double>(a[k]); });  // integers fit into doubles
  in_blocks(count, [&](int k) { a[k] = static_cast<typename T::value_type>(w.values[w.old_of_new[k]]); });
  a.resize(count);
}

/// Calls body(slot, i, j) once for every pair of a slice with a history.  Both sides keep the same one, but a sleeper's
/// may be old: then the side that is awake tells.
template <class Body>
void each_history(const State& s, const Contacts& c, int slice, Body&& body) {
  const auto& asleep = s.sleep.asleep;
  const int none = static_cast<int>(c.x_built.size());  // grains may have come since the lists were made
  for (std::ptrdiff_t slot = static_cast<std::ptrdiff_t>(c.first[slice]) * lanes;
       slot < static_cast<std::ptrdiff_t>(c.first_apart[slice]) * lanes; ++slot) {
    if (c.neighbour[slot] >= none) continue;
    if (c.spring[slot] == 0 && (c.rolling.empty() || c.rolling[slot] == 0)) continue;
    const int i = slice * lanes + static_cast<int>(slot % lanes), j = c.neighbour[slot];
    if (asleep.empty() || asleep[i] == asleep[j] ? i < j : asleep[i] == 0) body(slot, i, j);
  }
}

/// Where the histories of each slice of the present lists are to go; returns how many they are.
int count_histories(const State& s, const Contacts& c, ListScratch& w) {
  w.remembered_first.assign(c.slices() + 1, 0);
  base::for_each_item(0, c.slices(), [&](int slice) {
    each_history(s, c, slice, [&](std::ptrdiff_t, int, int) { ++w.remembered_first[slice + 1]; });
  });
  std::partial_sum(w.remembered_first.begin(), w.remembered_first.end(), w.remembered_first.begin());
  return w.remembered_first.back();
}

void remember(const State& s, const Contacts& c, ListScratch& w) {
  base::for_each_item(0, c.slices(), [&](int slice) {
    int next = w.remembered_first[slice];
    each_history(s, c, slice, [&](std::ptrdiff_t slot, int i, int j) {
      if (!c.rolling.empty()) w.remembered_rolling[next] = c.rolling[slot];
      w.remembered[next++] = {i, j, c.spring[slot]};
    });
  });
}

/// Exactly as many entries, their contents undefined.  Grows with little to spare and without the old entries beside.
template <class Vector>
void fit(Vector& a, std::size_t size) {
  if (a.capacity() < size) {
    a = Vector();
    a.reserve(size + size / 32);
  }
  a.resize(size);
}

/// Row numbers of every slice: as many as its longest list, of these as many at the front as pairs close by.
void count_rows(const State& s, Contacts& c, const ListScratch& w, bool rolling) {
  const int n = s.count(), slices = (n + lanes - 1) / lanes;
  for (auto* a : {&c.first, &c.last, &c.first_apart}) a->resize(slices);
  const int step = rows_at_once(c);
  std::int32_t next = 0;
  for (int k = 0; k < slices; ++k) {
    int rows = 0, close = 0;
    for (int i = k * lanes; i < std::min(n, (k + 1) * lanes); ++i) {
      const int rank = w.rank_of_new[i];
      if (w.found_all[rank] > most_neighbours) {
        fail(Exit::diverged,
             "grain {} at x = {} m, y = {} m has more than {} neighbours: grains lie on top of each other; use a "
             "smaller grain step or a stiffer contact",
             s.id[i], s.x[i], s.y[i], most_neighbours - lanes);
      }
      rows = std::max(rows, w.found_all[rank]);
      close = std::max(close, w.found_close[rank]);
    }
    close = (close + step - 1) / step * step, rows = (rows + step - 1) / step * step;
    c.first[k] = next;
    c.first_apart[k] = next + close;
    c.last[k] = next += rows;
  }
  fit(c.neighbour, static_cast<std::size_t>(next) * lanes);
  c.spring.visit([&](auto& a) { fit(a, c.neighbour.size()); });
  c.rolling.visit([&](auto& a) { fit(a, rolling ? c.neighbour.size() : 0); });
}

/// Rows of a slice: slot s of lane l is the s-th neighbour of that grain.
void fill_rows(int slice, int n, int window, Contacts& c, const ListScratch& w) {
  const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(c.first[slice]) * lanes;
  const std::ptrdiff_t end = static_cast<std::ptrdiff_t>(c.last[slice]) * lanes;
  std::fill(c.neighbour.begin() + begin, c.neighbour.begin() + end, nobody(n));
  const auto forget = [&](auto& a) { std::fill(a.begin() + begin, a.begin() + end, 0); };
  c.spring.visit(forget);
  if (!c.rolling.empty()) c.rolling.visit(forget);
  for (int i = slice * lanes; i < std::min(n, (slice + 1) * lanes); ++i) {
    const int rank = w.rank_of_new[i];
    const std::int32_t* const found = w.found[rank / window].data() + w.found_first[rank];
    for (int s = 0; s < w.found_all[rank]; ++s) {
      c.neighbour[begin + s * lanes + i % lanes] = w.new_of_rank[found[s]];
    }
  }
}

/// The histories of the pairs that an old slice remembered, into the new lists.  A touching pair is among those close
/// by.
void carry_springs(int old_slice, Contacts& c, const ListScratch& w) {
  const auto put = [&](int i, int j, double spring, double rolling) {
    if (i < 0 || j < 0) return;  // one of them has left
    const std::ptrdiff_t slot = slot_of(c, i, j);
    if (slot < 0) return;
    c.spring.set(slot, spring);
    if (!c.rolling.empty()) c.rolling.set(slot, rolling);
  };
  for (int k = w.remembered_first[old_slice]; k < w.remembered_first[old_slice + 1]; ++k) {
    const Remembered& pair = w.remembered[k];
    const int i = w.new_of_old[pair.i], j = w.new_of_old[pair.j];
    const double rolling = w.remembered_rolling.empty() ? 0.0 : w.remembered_rolling[k];
    put(i, j, pair.spring, rolling);
    put(j, i, pair.spring, -rolling);
  }
}

/// Histories of the contacts with floor and pipe: of the slices near them only.
void carry_wall_springs(const State& s, Contacts& c, ListScratch& w, const Reach& reach) {
  w.wall_place_before.swap(c.wall_place);
  c.wall_place.resize(c.slices());
  std::int32_t places = 0;
  for (int slice = 0; slice < c.slices(); ++slice)
    c.wall_place[slice] = (c.near[slice] & (near_floor | near_pipe)) != 0 ? places++ : -1;
  const auto carry = [&](Array& now, Array& before, bool wanted) {
    before.swap(now);
    now.assign(wanted ? static_cast<std::size_t>(places) * lanes : 0, 0.0);
    if (now.empty() || before.empty()) return;
    for (int i = 0; i < s.count(); ++i) {
      const int old = w.old_of_new[i], old_slice = old / lanes, to = c.wall_place[i / lanes];
      if (old_slice >= static_cast<int>(w.wall_place_before.size())) continue;  // a newcomer
      const int from = w.wall_place_before[old_slice];
      if (from >= 0 && to >= 0) now[to * lanes + i % lanes] = before[from * lanes + old % lanes];
    }
  };
  for (int slot = 0; slot < wall_slots; ++slot) {
    carry(c.wall_spring[slot], w.wall_spring_before[slot], true);
    carry(c.wall_rolling[slot], w.wall_rolling_before[slot], reach.rolling);
  }
}

/// Which pieces of walls reach into which column of cells: those of column k are wall_in_column[wall_start[k]] and on.
void sort_walls(const std::vector<Segment>& walls, const Cells& cells, double reach, ListScratch& w) {
  w.wall_start.assign(cells.columns + 1, 0);
  const auto columns_of = [&](const Segment& piece) {
    const auto [low, high] = std::minmax({piece.x, piece.x + piece.ex});
    return std::pair{cells.column_of(std::max(0.0, low - reach)), cells.column_of(std::max(0.0, high + reach))};
  };
  for (const Segment& piece : walls) {
    const auto [low, high] = columns_of(piece);
    for (int k = low; k <= high; ++k) ++w.wall_start[k + 1];
  }
  std::partial_sum(w.wall_start.begin(), w.wall_start.end(), w.wall_start.begin());
  w.wall_in_column.resize(w.wall_start.back());
  std::vector<std::int32_t> next(w.wall_start.begin(), w.wall_start.end() - 1);
  for (std::size_t n = 0; n < walls.size(); ++n) {
    const auto [low, high] = columns_of(walls[n]);
    for (int k = low; k <= high; ++k) w.wall_in_column[next[k]++] = static_cast<std::int32_t>(n);
  }
}

/// Lists and histories of the contacts with pieces of walls, in the form of those with grains.
void list_walls(const State& s, Contacts& c, ListScratch& w, const Reach& reach, const Cells& cells,
                const std::vector<Segment>& walls) {
  const int n = s.count(), slices = c.slices();
  w.wall_first_before.swap(c.wall_first);
  w.wall_before.swap(c.wall);
  w.piece_spring_before.swap(c.piece_spring);
  w.piece_rolling_before.swap(c.piece_rolling);
  c.wall_first.assign(slices + 1, 0);
  c.wall.clear();
  sort_walls(walls, cells, 0.5 * reach.gamma * *std::max_element(s.diameter.begin(), s.diameter.end()) + reach.skin, w);
  for (int slice = 0; slice < slices; ++slice) {
    const std::size_t begin = c.wall.size();
    for (int i = slice * lanes; i < std::min(n, (slice + 1) * lanes); ++i) {
      const int column = cells.column_of(s.x[i]);
      std::size_t slot = begin + i % lanes;
      for (int k = w.wall_start[column]; k < w.wall_start[column + 1]; ++k) {
        const Segment& piece = walls[w.wall_in_column[k]];
        const double t = std::clamp(piece.along(s.x[i], s.y[i]), 0.0, 1.0);
        const double d2 = square(piece.x + t * piece.ex - s.x[i]) + square(piece.y + t * piece.ey - s.y[i]);
        if (d2 > square(0.5 * reach.gamma * s.diameter[i] + reach.skin)) continue;
        if (slot >= c.wall.size()) c.wall.resize(c.wall.size() + lanes, -1);
        c.wall[slot] = w.wall_in_column[k];
        slot += lanes;
      }
    }
    c.wall_first[slice + 1] = static_cast<std::int32_t>(c.wall.size() / lanes);
    if (c.wall.size() > begin) c.near[slice] |= near_wall;
  }
  c.piece_spring.assign(c.wall.size(), 0.0);
  c.piece_rolling.assign(reach.rolling ? c.wall.size() : 0, 0.0);
  if (w.wall_before.empty()) return;
  for (int i = 0; i < n; ++i) {
    const int old = w.old_of_new[i];
    for (int row = w.wall_first_before[old / lanes]; row < w.wall_first_before[old / lanes + 1]; ++row) {
      const std::size_t old_slot = static_cast<std::size_t>(row) * lanes + old % lanes;
      for (int other = c.wall_first[i / lanes]; other < c.wall_first[i / lanes + 1]; ++other) {
        const std::size_t slot = static_cast<std::size_t>(other) * lanes + i % lanes;
        if (c.wall[slot] < 0 || c.wall[slot] != w.wall_before[old_slot]) continue;
        c.piece_spring[slot] = w.piece_spring_before[old_slot];
        if (reach.rolling && !w.piece_rolling_before.empty()) c.piece_rolling[slot] = w.piece_rolling_before[old_slot];
      }
    }
  }
}

}  // namespace

int Cells::column_of(double x) const { return std::clamp(static_cast<int>(x / width), 0, columns - 1); }
int Cells::row_of(double y) const {
  return static_cast<int>(std::clamp(std::floor((y - bottom) / height), 0.0, static_cast<double>(rows - 1)));
}

Cells make_cells(const Array& y, int count, double reach, double length) {
  if (length < 2 * reach) {
    fail(Exit::invalid_case, "grains.length = {} m is too short: two reaches of the neighbour lists are {} m", length,
         2 * reach);
  }
  const auto [low, high] = std::minmax_element(y.begin(), y.begin() + count);
  // Not more cells than about two per grain: beyond that the top row is open.
  const int columns = std::max(1, static_cast<int>(length / reach));
  const double most_rows = 2.0 * count / columns + 16;
  const int bands = static_cast<int>(std::min((*high - *low) / reach + 1, most_rows)) / Cells::band + 1;
  return {columns, bands * Cells::band, length / columns, reach, *low};
}

std::uint8_t near_what(double x, double y, double diameter, const Reach& reach, double list_reach, const Circle& pipe) {
  std::uint8_t near = 0;
  const double contact = 0.5 * reach.gamma * diameter + reach.skin;
  if (y < contact + 0.5 * (reach.gamma - 1) * reach.floor_diameter) near |= near_floor;
  const double d2 = square(nearest_image(pipe.x - x, reach.length)) + square(pipe.y - y);
  if (pipe.present && d2 < square(0.5 * pipe.diameter + contact)) near |= near_pipe;
  // Farther from the seam than this, neither the grain nor a neighbour can cross it before it is listed anew.
  const double seam = list_reach + reach.skin;
  if (x < seam || x > reach.length - seam) near |= near_seam;
  return near;
}

std::ptrdiff_t slot_of(const Contacts& c, int i, int j) {
  const std::ptrdiff_t end = static_cast<std::ptrdiff_t>(c.last[i / lanes]) * lanes;
  for (std::ptrdiff_t slot = static_cast<std::ptrdiff_t>(c.first[i / lanes]) * lanes + i % lanes; slot < end;
       slot += lanes)
    if (c.neighbour[slot] == j) return slot;
  return -1;
}

void rebuild(State& s, Contacts& c, ListScratch& w, const Reach& reach, const Circle& pipe,
             const std::vector<Segment>& walls) {
  check_places(s, reach.length);
  const int before = s.count();
  const int n = before - static_cast<int>(std::count(w.leaves.begin(), w.leaves.end(), 1));
  const int slices = (n + lanes - 1) / lanes;
  const int window = window_of(s), windows = (n + window - 1) / window;
  if (n == 0) fail(Exit::invalid_case, "bed.count = 0: a bed needs at least one grain");
  const double largest = *std::max_element(s.diameter.begin(), s.diameter.end());
  const double list_reach = reach.gamma * largest + reach.skin;
  const Cells cells = make_cells(s.y, before, list_reach, reach.length);
  const std::size_t histories = c.built() ? count_histories(s, c, w) : 0;
  const std::size_t grains = before, padded = before + lanes;
  w.memory.divide<std::int32_t, std::int32_t, std::int32_t, std::int32_t, std::int32_t, std::int32_t, std::int32_t,
                  double, double, double, std::int32_t, std::int32_t, std::int32_t, Remembered, double, double>(
      {w.cell, grains}, {w.cell_start, static_cast<std::size_t>(cells.count()) + 1}, {w.old_of_rank, grains},
      {w.old_of_new, grains}, {w.new_of_old, grains}, {w.rank_of_new, grains}, {w.new_of_rank, grains}, {w.x, padded},
      {w.y, padded}, {w.touching, padded}, {w.found_first, grains}, {w.found_close, grains}, {w.found_all, grains},
      {w.remembered, histories}, {w.remembered_rolling, c.rolling.empty() ? 0 : histories}, {w.values, grains});
  if (histories > 0) remember(s, c, w);

  rank_by_cell(s, cells, reach.gamma, n, w);
  if (n < before) std::fill_n(w.new_of_old.begin(), before, -1);
  w.found.resize(windows);
  const auto find = kernels().find;
  base::for_each_item(0, windows, [&](int k) {
    const int begin = k * window, end = std::min(n, begin + window);
    std::int32_t found[wide_window * most_neighbours];
    w.found[k].assign(found, found + find(cells, reach, begin, end, w, found));
    sort_window(begin, end, s.sleep, w);
  });
  each_grain_array(s, [&](auto& a) { reorder(a, n, w); });

  const int old_slices = c.slices();
  c.set_single(reach.single);
  count_rows(s, c, w, reach.rolling);
  c.near.resize(slices);
  base::for_each_item(0, slices, [&](int slice) {
    fill_rows(slice, n, window, c, w);
    c.near[slice] = 0;
    for (int i = slice * lanes; i < std::min(n, (slice + 1) * lanes); ++i)
      c.near[slice] |= near_what(s.x[i], s.y[i], s.diameter[i], reach, list_reach, pipe);
  });
  if (histories > 0) base::for_each_item(0, old_slices, [&](int slice) { carry_springs(slice, c, w); });
  carry_wall_springs(s, c, w, reach);
  if (!walls.empty() || !c.wall.empty()) list_walls(s, c, w, reach, cells, walls);
  for (auto [built, now] : {std::pair{&c.x_built, &s.x}, {&c.y_built, &s.y}}) {
    built->assign(nobody(n), 0.0);
    std::copy(now->begin(), now->end(), built->begin());
  }
  c.pipe_built = pipe;
  c.refreshed = 0;
  ++c.rebuilds;
  w.grid.head.clear();
}

bool lists_hold(const State& s, const Contacts& c, const Reach& reach, const Circle& pipe) {
  if (!c.built() || c.spring.single() != reach.single || static_cast<int>(c.x_built.size()) != nobody(s.count()))
    return false;
  if (pipe.present != c.pipe_built.present || pipe.diameter != c.pipe_built.diameter) return false;
  const double limit = square(0.5 * reach.skin);
  const auto within = [&](double dx, double dy) {
    return square(nearest_image(dx, reach.length)) + square(dy) <= limit;
  };
  if (!within(pipe.x - c.pipe_built.x, pipe.y - c.pipe_built.y)) return false;
  const bool any_asleep = !s.sleep.asleep.empty();
  for (int i = 0; i < s.count(); ++i) {
    if (any_asleep && s.sleep.asleep[i] != 0) continue;
    if (!within(s.x[i] - c.x_built[i], s.y[i] - c.y_built[i])) return false;
  }
  return true;
}

std::vector<int> neighbours_of(const State& s, const Contacts& c, int grain) {
  std::vector<int> result;
  for (int row = c.first[grain / lanes]; row < c.last[grain / lanes]; ++row) {
    const int other = c.neighbour[static_cast<std::size_t>(row) * lanes + grain % lanes];
    if (other < s.count()) result.push_back(other);
  }
  return result;
}

}  // namespace livebed::grains
