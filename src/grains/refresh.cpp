#include "grains/refresh.hpp"

#include <algorithm>
#include <cmath>

#include "base/math.hpp"

namespace livebed::grains {

using base::square;

namespace {

/// Grains listed alone between two times that all are, over all grains [-]: an eighth of the grains costs about what
/// new lists of all cost.
constexpr double most_refreshed = 0.125;

/// Calls body(head) for the chains of the cells in and around the one of (x, y).
template <class Body>
void each_chain_around(const Grid& grid, double x, double y, Body&& body) {
  const Cells& cells = grid.cells;
  const int column = cells.column_of(x), row = cells.row_of(y);
  for (const int by : {-1, 0, 1}) {
    const int beside = (column + by + cells.columns) % cells.columns;
    for (int at = std::max(0, row - 1); at <= std::min(cells.rows - 1, row + 1); ++at)
      body(grid.head[cells.number(beside, at)]);
  }
}

std::int32_t& head_of(Grid& grid, double x, double y) { return grid.head[grid.cells.number_of(x, y)]; }

void put_into(Grid& grid, int i, double x, double y) {
  std::int32_t& head = head_of(grid, x, y);
  grid.next[i] = head;
  head = i;
}

void take_from(Grid& grid, int i, double x, double y) {
  std::int32_t* at = &head_of(grid, x, y);
  while (*at != i) at = &grid.next[*at];
  *at = grid.next[i];
}

void fill_grid(const State& s, const Contacts& c, const Reach& reach, Grid& grid) {
  grid.reach = reach.gamma * *std::max_element(s.diameter.begin(), s.diameter.end()) + reach.skin;
  grid.cells = make_cells(c.y_built, s.count(), grid.reach, reach.length);
  grid.head.assign(grid.cells.count(), -1);
  grid.next.resize(s.count());
  for (int i = 0; i < s.count(); ++i) put_into(grid, i, c.x_built[i], c.y_built[i]);
}

void find_moved(const Sweep& k, const State& s, const Contacts& c, const Records& r, std::vector<std::int32_t>& moved) {
  moved.clear();
  const double limit = square(k.leash);
  const int slices = static_cast<int>(r.awake.size());
  for (std::size_t block = 0; block < r.moved.size(); ++block) {
    if (r.moved[block] == 0) continue;
    const int begin = static_cast<int>(block) * slices_per_block;
    for (int n = begin; n < std::min(slices, begin + slices_per_block); ++n) {
      const int first = r.awake[n] * lanes;
      for (int i = first; i < std::min(s.count(), first + lanes); ++i) {
        const Grain at = r.grain(i);
        const double d2 = square(nearest_image(at.x - c.x_built[i], k.reach.length)) + square(at.y - c.y_built[i]);
        if (!(d2 <= limit)) moved.push_back(i);  // a NaN counts as moved
      }
    }
  }
  std::sort(moved.begin(), moved.end());
}

/// Makes room for `more` slots.
template <class Vector>
void extend(Vector& a, std::size_t more, typename Vector::value_type with) {
  const std::size_t size = a.size() + more;
  if (a.capacity() < size) a.reserve(size + size / 16);
  a.resize(size, with);
}

/// One or two more rows for a slice.  Where others follow, its rows move to the end; what they leave is lost until all
/// lists are made anew.
int add_row(Contacts& c, int slice, int none) {
  const int added = rows_at_once(c), rows = c.last[slice] - c.first[slice],
            end = static_cast<int>(c.neighbour.size()) / lanes;
  const bool at_end = c.last[slice] == end;
  const std::size_t more = static_cast<std::size_t>(at_end ? added : rows + added) * lanes;
  extend(c.neighbour, more, none);
  const auto add = [&](auto& a) { extend(a, more, 0); };
  c.spring.visit(add);
  if (!c.rolling.empty()) c.rolling.visit(add);
  if (!at_end) {
    const auto move = [&](auto& a) {
      std::copy_n(a.begin() + static_cast<std::ptrdiff_t>(c.first[slice]) * lanes, rows * lanes,
                  a.begin() + static_cast<std::ptrdiff_t>(end) * lanes);
    };
    move(c.neighbour), c.spring.visit(move);
    if (!c.rolling.empty()) c.rolling.visit(move);
    c.first_apart[slice] += end - c.first[slice];
    c.first[slice] = end;
    c.last[slice] = end + rows;
  }
  c.last[slice] += added;
  return c.last[slice] - added;
}

/// Lists j as a neighbour of i, without a history.
void put_neighbour(Contacts& c, int i, int j, int none) {
  std::ptrdiff_t slot = slot_of(c, i, none);
  if (slot < 0) slot = static_cast<std::ptrdiff_t>(add_row(c, i / lanes, none)) * lanes + i % lanes;
  c.neighbour[slot] = j;
}

void drop_neighbour(Contacts& c, int i, int j, int none) {
  const std::ptrdiff_t slot = slot_of(c, i, j);
  c.neighbour[slot] = none;
  c.spring.set(slot, 0);
  if (!c.rolling.empty()) c.rolling.set(slot, 0);
}

/// Room for the histories of a slice with floor and pipe.
void add_wall_place(Contacts& c, int slice) {
  c.wall_place[slice] = static_cast<std::int32_t>(c.wall_spring[slot_floor].size()) / lanes;
  for (Array& a : c.wall_spring) extend(a, lanes, 0.0);
  for (Array& a : c.wall_rolling)
    if (!c.rolling.empty()) extend(a, lanes, 0.0);
}

/// Lists one grain anew where it is now; false where it may not be, or when it has too many neighbours.
bool list_anew(const Sweep& k, const State& s, Contacts& c, const Records& r, ListScratch& w, int i) {
  const Grain at = r.grain(i);
  if (!(at.x >= 0 && at.x <= k.reach.length && at.y >= -2 * at.r && std::isfinite(at.y))) return false;
  w.around.clear();
  each_chain_around(w.grid, at.x, at.y, [&](std::int32_t head) {
    for (std::int32_t j = head; j >= 0; j = w.grid.next[j]) {
      const double dx = nearest_image(c.x_built[j] - at.x, k.reach.length), dy = c.y_built[j] - at.y;
      const double far = k.reach.gamma * (at.r + r.grain(j).r) + k.reach.skin;
      if (j != i && dx * dx + dy * dy <= far * far) w.around.push_back(j);
    }
  });
  if (static_cast<int>(w.around.size()) + lanes > most_neighbours) return false;
  std::sort(w.around.begin(), w.around.end());  // whatever the order of the chains

  take_from(w.grid, i, c.x_built[i], c.y_built[i]);
  c.x_built[i] = at.x, c.y_built[i] = at.y;
  put_into(w.grid, i, at.x, at.y);
  const int none = nobody(s.count()), slice = i / lanes;
  for (int row = c.first[slice]; row < c.last[slice]; ++row) {
    const int j = c.neighbour[static_cast<std::ptrdiff_t>(row) * lanes + i % lanes];
    if (j == none || std::binary_search(w.around.begin(), w.around.end(), j)) continue;
    drop_neighbour(c, i, j, none);
    drop_neighbour(c, j, i, none);
  }
  for (const int j : w.around) {
    if (slot_of(c, i, j) >= 0) continue;
    put_neighbour(c, i, j, none);
    put_neighbour(c, j, i, none);
  }
  c.near[slice] |= near_what(at.x, at.y, 2 * at.r, k.reach, w.grid.reach, c.pipe_built);
  if ((c.near[slice] & (near_floor | near_pipe)) != 0 && c.wall_place[slice] < 0) add_wall_place(c, slice);
  return true;
}

}  // namespace

bool refresh(const Sweep& k, const State& s, Contacts& c, const Records& r, ListScratch& w) {
  if (!k.walls.empty()) return false;
  find_moved(k, s, c, r, w.moved);
  c.refreshed += static_cast<std::int64_t>(w.moved.size());
  if (static_cast<double>(c.refreshed) > most_refreshed * s.count()) return false;
  if (w.grid.head.empty()) fill_grid(s, c, k.reach, w.grid);
  if (w.grid.cells.columns < 3) return false;
  return std::all_of(w.moved.begin(), w.moved.end(), [&](std::int32_t i) { return list_anew(k, s, c, r, w, i); });
}

}  // namespace livebed::grains
