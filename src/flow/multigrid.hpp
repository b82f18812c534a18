#pragma once
#include <vector>

#include "base/aligned.hpp"

/// Multigrid that coarsens in x alone, with exact solves along vertical lines.
///
/// The columns of a level are split into F (even) and C (odd); C columns are the next coarser level.  Both kinds are
/// stored apart, so that a vertical line solve runs over many columns at once, in vector instructions.  As F columns
/// touch only C columns, one V-cycle needs five line passes and no explicit interpolation: C solve, F solve, coarse
/// correction of C, F solve, C solve.  Vertical lines make any stretching in y harmless; solid cells are rows with a
/// unit diagonal.
namespace livebed::flow {

/// Columns of one colour: nm columns x ny rows, one pad of columns on either side so that m-1 and m+1 may be read.
template <class T>
struct Columns {
  static constexpr int pad = 64 / sizeof(T);
  int nm = 0, ny = 0, pitch = 0;
  base::AlignedVector<T> data;
  Columns() = default;
  Columns(int nm_, int ny_) : nm(nm_), ny(ny_), pitch((nm_ + 3 * pad - 1) / pad * pad) {
    data.assign(static_cast<std::size_t>(pitch) * ny, T{0});
  }
  T* row(int j) { return data.data() + static_cast<std::ptrdiff_t>(j) * pitch + pad; }
  const T* row(int j) const { return data.data() + static_cast<std::ptrdiff_t>(j) * pitch + pad; }
};

/// A vector over all cells of a level, columns split by colour.
template <class T>
struct Split {
  Columns<T> F, C;
  Split() = default;
  Split(int nx, int ny) : F((nx + 1) / 2, ny), C(nx / 2, ny) {}
};

/// Coefficients of the five-point operator of one level: coupling of each F column to its western and eastern C column
/// and of every cell to its upper neighbour; extra is what the diagonal holds beyond the sum of couplings.
template <class T>
struct Stencil {
  Columns<T> west, east;  ///< of F columns; symmetric, so C columns read them too
  Split<T> north, extra;
  Stencil() = default;
  Stencil(int nx, int ny) : west((nx + 1) / 2, ny), east((nx + 1) / 2, ny), north(nx, ny), extra(nx, ny) {}
};

class Multigrid {
public:
  Multigrid() = default;
  Multigrid(int nx, int ny);

  /// New coefficients of the finest level; builds all coarser ones and the factors of the line solves.
  void set(const Stencil<double>& finest);

  /// z = one V-cycle applied to r (zero start): symmetric, so it can precondition conjugate gradients.
  void apply(const Split<double>& r, Split<double>& z);

private:
  struct Level {
    int nx = 0, ny = 0;
    Stencil<float> a;
    Split<float> pivot, slope;  ///< line factors: 1/d_j and north_j/d_j
    Split<float> b, x;
  };
  static void factor(Level& level);
  static void coarsen(const Level& fine, Level& coarse);
  void cycle(std::size_t depth);
  std::vector<Level> levels_;
};

}  // namespace livebed::flow
