#include "grains/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/fault.hpp"
#include "base/loops.hpp"
#include "base/math.hpp"

namespace livebed::grains {

using base::Exit;
using base::fail;
using base::square;

namespace {

constexpr int most_neighbours = 32;  ///< a plane packing has about six; more means grains lie on top of each other
constexpr double close_by = 1.02;    ///< pairs within this factor of touching come first in a list, see fill_rows

/// Cells of at least one reach, numbered column by column.  The lowest and the highest row are open: a grain that flies
/// far away costs no memory.
struct Cells {
  int columns, rows;
  double width, height, bottom;
  int column(double x) const { return std::clamp(static_cast<int>(x / width), 0, columns - 1); }
  int row(double y) const {
    return static_cast<int>(std::clamp(std::floor((y - bottom) / height), 0.0, static_cast<double>(rows - 1)));
  }
};

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

Cells make_cells(const State& s, double reach, double length) {
  if (length < 2 * reach) {
    fail(Exit::invalid_case, "grains.length = {} m is too short: two reaches of the neighbour lists are {} m", length,
         2 * reach);
  }
  const auto [low, high] = std::minmax_element(s.y.begin(), s.y.end());
  // Not more cells than about two per grain: beyond that the top row is open.
  const int columns = std::max(1, static_cast<int>(length / reach));
  const double most_rows = 2.0 * s.count() / columns + 16;
  const int rows = static_cast<int>(std::min((*high - *low) / reach + 1, most_rows));
  return {columns, std::max(1, rows), length / columns, reach, *low};
}

/// Counting sort of the grains by cell: order[new place] = old place; stable, so the result depends on the state alone.
void sort_by_cell(const State& s, const Cells& cells, ListScratch& w) {
  const int n = s.count(), count = cells.columns * cells.rows;
  w.cell.resize(n);
  w.order.resize(n);
  w.new_place.resize(n);
  w.cell_start.assign(count + 1, 0);
  for (int i = 0; i < n; ++i) {
    w.cell[i] = cells.column(s.x[i]) * cells.rows + cells.row(s.y[i]);
    ++w.cell_start[w.cell[i] + 1];
  }
  std::partial_sum(w.cell_start.begin(), w.cell_start.end(), w.cell_start.begin());
  for (int i = 0; i < n; ++i) {
    const int place = w.cell_start[w.cell[i]]++;
    w.order[place] = i;
    w.new_place[i] = place;
  }
  for (int c = count; c > 0; --c) w.cell_start[c] = w.cell_start[c - 1];
  w.cell_start[0] = 0;
}

void reorder(Array& a, ListScratch& w) {
  w.values.resize(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) w.values[k] = a[w.order[k]];
  a.swap(w.values);
}

void reorder_all(State& s, Contacts& c, ListScratch& w) {
  for (Array* a : {&s.x, &s.y, &s.u, &s.v, &s.omega, &s.diameter, &s.fluid.u, &s.fluid.v, &s.fluid.beta, &s.fluid.fx,
                   &s.fluid.fy, &s.impulse_x, &s.impulse_y}) {
    reorder(*a, w);
  }
  for (Array& a : c.wall_spring) reorder(a, w);
  w.ids.resize(s.id.size());
  for (std::size_t k = 0; k < s.id.size(); ++k) w.ids[k] = s.id[w.order[k]];
  s.id.swap(w.ids);
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

/// Neighbours of grain i into w.found, those close by first; their number into w.found_count (more than
/// most_neighbours: too many, the rest is not stored).
void find(const State& s, const Cells& cells, const Reach& reach, int i, ListScratch& w) {
  std::int32_t* const close = w.found.data() + static_cast<std::ptrdiff_t>(i) * most_neighbours;
  std::int32_t apart[most_neighbours];
  int n_close = 0, n_apart = 0;
  const double x = s.x[i], y = s.y[i], d = s.diameter[i];
  const int row = cells.row(y), low = std::max(0, row - 1), high = std::min(cells.rows - 1, row + 1);
  int around[3];
  const int n_around = columns_around(cells.column(x), cells.columns, around);
  for (int k = 0; k < n_around; ++k) {
    const int base = around[k] * cells.rows;
    for (int j = w.cell_start[base + low]; j < w.cell_start[base + high + 1]; ++j) {
      const double touching = 0.5 * reach.gamma * (d + s.diameter[j]);
      const double d2 = square(nearest_image(s.x[j] - x, reach.length)) + square(s.y[j] - y);
      if (d2 > square(touching + reach.skin) || j == i) continue;
      if (n_close + n_apart == most_neighbours) {
        w.found_count[i] = most_neighbours + 1;
        return;
      }
      if (d2 < square(close_by * touching)) {
        close[n_close++] = j;
      } else {
        apart[n_apart++] = j;
      }
    }
  }
  std::copy(apart, apart + n_apart, close + n_close);
  w.found_count[i] = n_close + n_apart;
}

/// Rows of a slice: slot s of lane l is the s-th neighbour of that grain.  As those close by come first, the last rows
/// mostly hold pairs that do not touch, which the force loop passes over.
void fill_rows(int slice, int n, Contacts& c, const ListScratch& w) {
  const int begin = slice * lanes, filled = std::min(lanes, n - begin);
  for (int row = c.first[slice]; row < c.first[slice + 1]; ++row) {
    const int s = row - c.first[slice];
    for (int l = 0; l < lanes; ++l) {
      const bool there = l < filled && s < w.found_count[begin + l];
      const std::ptrdiff_t slot = static_cast<std::ptrdiff_t>(row) * lanes + l;
      c.neighbour[slot] = there ? w.found[static_cast<std::ptrdiff_t>(begin + l) * most_neighbours + s] : nobody(n);
      c.spring[slot] = 0;
    }
  }
}

/// The history of every touching pair of the slice moves from the old lists to the new.  A touching pair is in both.
void carry_springs(int slice, int n, Contacts& c, const ListScratch& w) {
  for (int i = slice * lanes; i < std::min(n, (slice + 1) * lanes); ++i) {
    const int before = w.order[i], slice_before = before / lanes;
    const std::int32_t* const found = w.found.data() + static_cast<std::ptrdiff_t>(i) * most_neighbours;
    for (int row = w.first_before[slice_before]; row < w.first_before[slice_before + 1]; ++row) {
      const std::ptrdiff_t slot = static_cast<std::ptrdiff_t>(row) * lanes + before % lanes;
      if (w.spring_before[slot] == 0) continue;
      const std::int32_t other = w.new_place[w.neighbour_before[slot]];
      const auto s = std::find(found, found + w.found_count[i], other) - found;
      if (s < w.found_count[i]) c.spring[(c.first[slice] + s) * lanes + i % lanes] = w.spring_before[slot];
    }
  }
}

std::uint8_t walls_near(const State& s, int slice, const Reach& reach, const Circle& pipe) {
  std::uint8_t walls = 0;
  for (int i = slice * lanes; i < std::min(s.count(), (slice + 1) * lanes); ++i) {
    const double contact = 0.5 * reach.gamma * s.diameter[i] + reach.skin;
    if (s.y[i] < contact + 0.5 * (reach.gamma - 1) * reach.floor_diameter) walls |= wall_floor;
    const double d2 = square(nearest_image(pipe.x - s.x[i], reach.length)) + square(pipe.y - s.y[i]);
    if (pipe.present && d2 < square(0.5 * pipe.diameter + contact)) walls |= wall_pipe;
  }
  return walls;
}

}  // namespace

void rebuild(State& s, Contacts& c, ListScratch& w, const Reach& reach, const Circle& pipe) {
  check_places(s, reach.length);
  const int n = s.count(), slices = (n + lanes - 1) / lanes;
  if (n == 0) fail(Exit::invalid_case, "grains.count = 0: a bed needs at least one grain");
  const double largest = *std::max_element(s.diameter.begin(), s.diameter.end());
  const Cells cells = make_cells(s, reach.gamma * largest + reach.skin, reach.length);
  for (Array& a : c.wall_spring) a.resize(n, 0.0);
  sort_by_cell(s, cells, w);
  reorder_all(s, c, w);

  w.found.resize(static_cast<std::size_t>(n) * most_neighbours);
  w.found_count.resize(n);
  base::for_each_item(0, slices, [&](int slice) {
    for (int i = slice * lanes; i < std::min(n, (slice + 1) * lanes); ++i) find(s, cells, reach, i, w);
  });

  w.first_before.swap(c.first);
  w.neighbour_before.swap(c.neighbour);
  w.spring_before.swap(c.spring);
  const bool carry = !w.first_before.empty();
  c.first.resize(slices + 1);
  c.first[0] = 0;
  for (int k = 0; k < slices; ++k) {
    int rows = 0;
    for (int i = k * lanes; i < std::min(n, (k + 1) * lanes); ++i) {
      if (w.found_count[i] > most_neighbours) {
        fail(Exit::diverged,
             "grain {} at x = {} m, y = {} m has more than {} neighbours: grains lie on top of each other; use a "
             "smaller grain step or a stiffer contact",
             s.id[i], s.x[i], s.y[i], most_neighbours);
      }
      rows = std::max(rows, w.found_count[i]);
    }
    c.first[k + 1] = c.first[k] + rows;
  }
  c.neighbour.resize(static_cast<std::size_t>(c.first[slices]) * lanes);
  c.spring.resize(c.neighbour.size());
  c.walls.resize(slices);
  base::for_each_item(0, slices, [&](int slice) {
    fill_rows(slice, n, c, w);
    if (carry) carry_springs(slice, n, c, w);
    c.walls[slice] = walls_near(s, slice, reach, pipe);
  });
  c.x_built = s.x;
  c.y_built = s.y;
  c.pipe_built = pipe;
  ++c.rebuilds;
}

bool lists_hold(const State& s, const Contacts& c, const Reach& reach, const Circle& pipe) {
  if (!c.built() || static_cast<int>(c.x_built.size()) != s.count()) return false;
  if (pipe.present != c.pipe_built.present || pipe.diameter != c.pipe_built.diameter) return false;
  const double limit = square(0.5 * reach.skin);
  const auto within = [&](double dx, double dy) {
    return square(nearest_image(dx, reach.length)) + square(dy) <= limit;
  };
  if (!within(pipe.x - c.pipe_built.x, pipe.y - c.pipe_built.y)) return false;
  for (int i = 0; i < s.count(); ++i) {
    if (!within(s.x[i] - c.x_built[i], s.y[i] - c.y_built[i])) return false;
  }
  return true;
}

std::vector<int> neighbours_of(const State& s, const Contacts& c, int grain) {
  std::vector<int> result;
  for (int row = c.first[grain / lanes]; row < c.first[grain / lanes + 1]; ++row) {
    const int other = c.neighbour[static_cast<std::size_t>(row) * lanes + grain % lanes];
    if (other < s.count()) result.push_back(other);
  }
  return result;
}

}  // namespace livebed::grains
