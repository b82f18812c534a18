#pragma once
#include <vector>

#include "base/aligned.hpp"

/// Conjugate gradients with a multigrid that coarsens in x alone and solves vertical lines exactly, in single
/// precision.
///
/// The columns of a level are split into F (even) and C (odd); C columns are the next coarser level.  Both kinds are
/// stored apart, so that a vertical line solve runs over many columns at once, in vector instructions.  F columns touch
/// only C columns: eliminating them is a line solve, so the gradients run on the C columns alone, and one V-cycle needs
/// no explicit interpolation: C solve, F solve, coarse correction of C, F solve, C solve.  Vertical lines make any
/// stretching in y harmless.  Solid cells are rows with a unit diagonal.
namespace livebed::flow {

/// Columns of one colour: nm columns x ny rows, padded on either side so that m-1 and m+1 may be read.
struct Columns {
  static constexpr int pad = 16;
  int nm = 0, ny = 0, pitch = 0;
  base::AlignedVector<float> data;
  Columns() = default;
  Columns(int nm_, int ny_) : nm(nm_), ny(ny_), pitch((nm_ + 3 * pad - 1) / pad * pad) {
    data.assign(static_cast<std::size_t>(pitch) * ny, 0.f);
  }
  float* row(int j) { return data.data() + static_cast<std::ptrdiff_t>(j) * pitch + pad; }
  const float* row(int j) const { return data.data() + static_cast<std::ptrdiff_t>(j) * pitch + pad; }
};

/// Columns of coefficients.  Where rows that follow one another are equal, as they are away from pipe and grains, all
/// are read from the first of them, which stays in the cache.
class Coefficients {
public:
  Coefficients() = default;
  Coefficients(int nm, int ny) : columns_(nm, ny), first_(ny) {}
  const float* row(int j) const { return columns_.row(first_[j]); }
  float* own_row(int j) { return columns_.row(j); }
  /// Looks for equal rows; after they were written and before they are read.
  void share();
  int nm() const { return columns_.nm; }

private:
  Columns columns_;
  std::vector<int> first_;  ///< row that is read for each
};

/// Something over all cells of a level, columns split by colour.
template <class Kind>
struct SplitOf {
  Kind F, C;
  SplitOf() = default;
  SplitOf(int nx, int ny) : F((nx + 1) / 2, ny), C(nx / 2, ny) {}
  Kind& colour(int i) { return i % 2 ? C : F; }
};
using Split = SplitOf<Columns>;

/// Coefficients of the five-point operator of one level: coupling of each F column to its western and eastern C column
/// and of every cell to its upper neighbour; extra is what the diagonal holds beyond the sum of couplings.
struct Stencil {
  Coefficients west, east;  ///< of F columns; symmetric, so C columns read them too
  Split north, extra;
  Stencil() = default;
  Stencil(int nx, int ny) : west((nx + 1) / 2, ny), east((nx + 1) / 2, ny), north(nx, ny), extra(nx, ny) {}
};

class Multigrid {
public:
  Multigrid() = default;
  Multigrid(int nx, int ny);

  /// Coefficients of the finest level, to be filled before `build`.
  Stencil& finest() { return levels_[0].a; }
  /// Coarser levels and line factors from the finest coefficients.
  void build();

  /// Right-hand side and solution on the finest level.
  Split& right() { return levels_[0].b; }
  const Split& solution() const { return levels_[0].x; }

  /// solution <- approximate solution of A x = right by conjugate gradients from 0, until the residual has fallen by
  /// `factor` or `most` iterations are done; right is overwritten.  Returns the iterations.  Single precision reaches
  /// factors of about 1e-6.
  int solve(double factor, int most);

private:
  struct Level {
    int nx = 0, ny = 0;
    Stencil a;
    SplitOf<Coefficients> pivot, slope;  ///< line factors: 1/d_j and north_j/d_j
    Split b, x;
  };
  static void factor(Level& level);
  static void coarsen(const Level& fine, Level& coarse);
  static void solve_F(Level& level, const Columns* b, bool coupled);
  static void solve_C(Level& level, bool coupled);
  void restrict_from(const Level& fine, Level& coarse);
  void prolong_to(Level& fine, const Level& coarse);
  void cycle(std::size_t depth);

  std::vector<Level> levels_;
  Columns r_, d_, q_, sz_, sum_;  ///< of the gradients, on C columns
  Columns right_F_;
  std::vector<double> partial_;
};

}  // namespace livebed::flow
