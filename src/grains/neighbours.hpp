#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/arena.hpp"
#include "grains/lanes.hpp"
#include "grains/params.hpp"
#include "grains/slot_array.hpp"
#include "grains/state.hpp"
#include "grains/walls.hpp"

/// Who may touch whom until some grain has moved half a skin, and what each contact remembers.
///
/// Grains are sorted by cells, so that eight consecutive ones, a slice, are close together.  Every pair
/// stands in the lists of both its grains: a slice computes all forces on its grains by itself, and both sides of a
/// contact go through the same arithmetic with the signs turned, so that their forces and histories are equal to the
/// bit.
namespace livebed::grains {

/// What the grains of a slice may meet before the lists are rebuilt; bits of Contacts::near.
enum Near : std::uint8_t { near_floor = 1, near_pipe = 2, near_seam = 4, near_wall = 8 };

/// Slots for what a contact with a wall remembers: a plane, or the even and the odd grains of a floor of grains; the
/// pipe.
enum WallSlot : int { slot_floor = 0, slot_floor_odd = 1, slot_pipe = 2, wall_slots = 3 };

/// Lists and histories: everything beside State that a checkpoint must hold to go on with the same bits.
struct Contacts {
  std::vector<std::int32_t> first, last;  ///< slice k owns rows first[k] to last[k] - 1 of eight slots each
  std::vector<std::int32_t> first_apart;  ///< from this row of a slice on no pair has touched since the lists exist
  base::AlignedVector<std::int32_t> neighbour;  ///< the other grain, row by row; nobody() where a lane has no more
  SlotArray spring;                             ///< e_s of the same slot [N]
  SlotArray rolling;                     ///< rolling spring of the same slot [N m]; empty without rolling resistance
  std::vector<std::int32_t> wall_place;  ///< of each slice near floor or pipe: which of them it is; -1: no such
  std::array<Array, wall_slots> wall_spring;   ///< e_s with floor and pipe of the slices near them [N]
  std::array<Array, wall_slots> wall_rolling;  ///< rolling springs likewise [N m]
  std::vector<std::int32_t> wall_first;        ///< as first, for the pieces of walls near a slice
  std::vector<std::int32_t> wall;              ///< as neighbour: index of the piece, -1 where a lane has no more
  Array piece_spring, piece_rolling;           ///< of the same slots [N], [N m]
  std::vector<std::uint8_t> near;              ///< of each slice, bits of Near
  Array x_built, y_built;                      ///< centres when each grain was listed, whole slices [m]
  Circle pipe_built;                           ///< and the pipe
  std::int64_t rebuilds = 0;
  std::int64_t refreshed = 0;  ///< grains listed anew one by one (refresh) since all were

  int slices() const { return static_cast<int>(near.size()); }
  bool built() const { return !first.empty(); }
  void set_single(bool single) { spring.set_single(single), rolling.set_single(single); }
};

/// Cells of at least one reach, numbered column by column within bands of some rows: what follows one another lies in a
/// compact patch.  The lowest and the highest row are open: a grain that flies far away costs no memory.
struct Cells {
  static constexpr int band = 8;  ///< rows
  int columns, rows;              ///< rows: whole bands
  double width, height, bottom;

  int count() const { return columns * rows; }
  int column_of(double x) const;
  int row_of(double y) const;
  int number(int column, int row) const { return (row / band * columns + column) * band + row % band; }
  int number_of(double x, double y) const { return number(column_of(x), row_of(y)); }
};

/// Which grains were listed in which cell: chains that change with every grain listed anew.
struct Grid {
  Cells cells;
  double reach;                    ///< of the longest pair, skin included [m]
  std::vector<std::int32_t> head;  ///< of each cell: the first of its grains, -1: none; empty: not filled
  std::vector<std::int32_t> next;  ///< of each grain: the next one in its cell, -1: none
};

/// What a touching pair remembers while the lists are made anew.
struct Remembered {
  std::int32_t i, j;  ///< grains of the old order; the history is that of i
  double spring;
};

/// Buffers of rebuild, kept so that a running simulation allocates nothing.  "Rank": the place of a grain when all are
/// sorted by cells alone.
struct ListScratch {
  base::Arena memory;  ///< of the arrays below while lists are made, of the records of the force loop in between
  base::Lease<std::int32_t> cell, cell_start;  ///< of each grain; first rank of each cell
  base::Lease<std::int32_t> old_of_rank, old_of_new, new_of_old, rank_of_new, new_of_rank;
  base::Lease<double> x, y, touching;                             ///< by rank: centre, gamma r
  base::Lease<std::int32_t> found_first, found_close, found_all;  ///< by rank: place in its window, numbers
  base::Lease<Remembered> remembered;
  base::Lease<double> remembered_rolling;
  base::Lease<double> values;                    ///< an array in its old order
  std::vector<std::int32_t> leaves;              ///< 1 = the grain leaves the bed; empty: nobody does
  std::vector<std::vector<std::int32_t>> found;  ///< of each window of ranks: neighbours (ranks) grain by grain
  std::vector<std::int32_t> remembered_first;    ///< of each slice of the old order
  std::vector<std::int32_t> wall_place_before;
  std::array<Array, wall_slots> wall_spring_before, wall_rolling_before;
  std::vector<std::int32_t> wall_first_before, wall_before, wall_start, wall_in_column;
  Array piece_spring_before, piece_rolling_before;
  Grid grid;                                ///< of refresh, since the last rebuild
  std::vector<std::int32_t> moved, around;  ///< of refresh: grains out of their half skin; who is near one of them
};

/// The steps in mixed precision take the rows of a slice two by two.
inline int rows_at_once(const Contacts& c) { return c.spring.single() ? 2 : 1; }

/// A plane packing has about six; a grain with nearly that many lies on others.
inline constexpr int most_neighbours = 32;

/// Pairs may touch when their centres are within gamma (r_i + r_j); the lists reach one skin further.
struct Reach {
  double length;          ///< period in x [m]
  double gamma;           ///< [-]
  double skin;            ///< [m]
  double floor_diameter;  ///< of the fixed grains of the floor, 0 for a plane [m]
  bool rolling = false;   ///< contacts remember rolling, too
  bool single = false;    ///< what they remember is kept in single precision
};

inline Reach reach_of(const Params& p) {
  return {period(p),
          p.gamma,
          p.skin * p.diameter,
          p.floor == Floor::grains ? p.diameter : 0.0,
          p.rolling_friction > 0,
          p.precision == Precision::mixed};
}

/// The index that stands for "no neighbour" among n grains: one past the last lane of the last slice.
inline constexpr int nobody(int n) { return (n + lanes - 1) / lanes * lanes; }

inline namespace LIVEBED_SET {
/// Shortest way from one x to another in the periodic box, for 0 <= x < length.  Odd in dx to the bit.
template <class Real>
inline Real nearest_image(const Real& dx, double length) {
  const Real zero = Real{};
  const Real back = select(dx > zero + 0.5 * length, zero - length, zero);
  return dx + select(dx < zero - 0.5 * length, zero + length, back);
}
}  // namespace LIVEBED_SET

/// Sorts the grains, builds the lists for the present positions and carries every history over.  Grains that leave
/// (ListScratch::leaves) are dropped, those appended to the state since the lists were made come in.  Throws Fault
/// (diverged) for a grain that is not finite, outside the box or with more neighbours than space allows, (invalid case)
/// for a box shorter than two reaches.  Walls are pieces besides floor and pipe.
void rebuild(State& state, Contacts& contacts, ListScratch& scratch, const Reach& reach, const Circle& pipe,
             const std::vector<Segment>& walls = {});

/// Cells of `reach` for grains at these heights.  Throws Fault (invalid case) for a box shorter than two reaches.
Cells make_cells(const Array& y, int count, double reach, double length);

/// What a grain at (x, y) may meet before it is listed anew, bits of Near but near_wall.  list_reach: of the longest
/// pair.
std::uint8_t near_what(double x, double y, double diameter, const Reach& reach, double list_reach, const Circle& pipe);

/// The slot that grain i has for its neighbour j; -1: it has none.
std::ptrdiff_t slot_of(const Contacts& c, int i, int j);

/// True while the lists are complete and their histories in the precision asked for: no grain and no pipe has moved
/// more than half a skin since they were built.  Two grains outside each other's lists were then more than one skin
/// apart and cannot have met.  Sleepers do not move.
bool lists_hold(const State& state, const Contacts& contacts, const Reach& reach, const Circle& pipe);

/// The neighbours of one grain in the order of its list.
std::vector<int> neighbours_of(const State& state, const Contacts& contacts, int grain);

}  // namespace livebed::grains
