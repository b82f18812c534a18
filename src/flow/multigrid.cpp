#include "flow/multigrid.hpp"

#include <algorithm>

#include "base/loops.hpp"

namespace livebed::flow {

using base::vector_loop;

namespace {

constexpr int block_columns = 64;  // columns a thread takes at once; four vectors of floats
constexpr int cells_worth_threads = 20000;
constexpr float pivot_least = 1e-5f;  // of the diagonal: below it a line floats free (pure Neumann) and keeps 0

/// Calls pass(m0, m1) over blocks of columns, on all threads when there is work for them.
template <class Pass>
void over_blocks(int nm, int ny, Pass&& pass) {
  if (nm * ny < cells_worth_threads) return pass(0, nm);
  base::for_each_item(0, (nm + block_columns - 1) / block_columns,
                      [&](int k) { pass(k * block_columns, std::min(nm, (k + 1) * block_columns)); });
}

/// Solves all vertical lines of one colour: x = T^-1 (b + west_coupling x_west + east_coupling x_east).  `other` holds
/// the columns of the other colour; shift says where they sit: F column m lies between C columns m-1 and m, C column m
/// between F columns m and m+1.  A null `other` stands for zero.
void solve_lines(const Columns<float>& pivot, const Columns<float>& slope, const Columns<float>& west,
                 const Columns<float>& east, int coupling_shift, const Columns<float>& b, const Columns<float>* other,
                 int shift, Columns<float>& x) {
  const int ny = x.ny;
  over_blocks(x.nm, ny, [&](int m0, int m1) {
    for (int j = 0; j < ny; ++j) {
      float* xj = x.row(j);
      const float* bj = b.row(j);
      const float* below = x.row(std::max(j - 1, 0));
      const float* sj = slope.row(std::max(j - 1, 0));
      const float up = j > 0 ? 1.f : 0.f;
      if (other) {
        const float* w = west.row(j);
        const float* e = east.row(j) + coupling_shift;
        const float* oj = other->row(j) + shift;
        if (j == 0)
          vector_loop(m0, m1, [&](int m) { xj[m] = bj[m] + w[m] * oj[m] + e[m] * oj[m + 1]; });
        else
          vector_loop(m0, m1, [&](int m) { xj[m] = bj[m] + w[m] * oj[m] + e[m] * oj[m + 1] + sj[m] * below[m]; });
      } else {
        vector_loop(m0, m1, [&](int m) { xj[m] = bj[m] + up * sj[m] * below[m]; });
      }
    }
    for (int j = ny - 1; j >= 0; --j) {
      float* xj = x.row(j);
      const float* pj = pivot.row(j);
      const float* sj = slope.row(j);
      if (j == ny - 1) {
        vector_loop(m0, m1, [&](int m) { xj[m] *= pj[m]; });
      } else {
        const float* above = x.row(j + 1);
        vector_loop(m0, m1, [&](int m) { xj[m] = pj[m] * xj[m] + sj[m] * above[m]; });
      }
    }
  });
}

}  // namespace

Multigrid::Multigrid(int nx, int ny) {
  for (int n = nx; n >= 1; n /= 2) {
    Level level;
    level.nx = n;
    level.ny = ny;
    level.a = Stencil<float>(n, ny);
    level.pivot = level.slope = level.b = level.x = Split<float>(n, ny);
    levels_.push_back(std::move(level));
  }
}

void Multigrid::factor(Level& level) {
  const auto one = [&](Columns<float>& pivot, Columns<float>& slope, const Columns<float>& north,
                       const Columns<float>& extra, auto&& sideways) {
    over_blocks(pivot.nm, level.ny, [&](int m0, int m1) {
      for (int j = 0; j < level.ny; ++j) {
        for (int m = m0; m < m1; ++m) {
          const float south = j > 0 ? north.row(j - 1)[m] : 0.f;
          const float up = north.row(j)[m];
          const float diagonal = sideways(j, m) + south + up + extra.row(j)[m];
          const float d = diagonal - (j > 0 ? south * slope.row(j - 1)[m] : 0.f);
          pivot.row(j)[m] = diagonal == 0.f ? 1.f : (d > pivot_least * diagonal ? 1.f / d : 0.f);
          slope.row(j)[m] = up * pivot.row(j)[m];
        }
      }
    });
  };
  const Stencil<float>& a = level.a;
  one(level.pivot.F, level.slope.F, a.north.F, a.extra.F,
      [&](int j, int m) { return a.west.row(j)[m] + a.east.row(j)[m]; });
  one(level.pivot.C, level.slope.C, a.north.C, a.extra.C,
      [&](int j, int m) { return a.east.row(j)[m] + a.west.row(j)[m + 1]; });
}

void Multigrid::coarsen(const Level& fine, Level& coarse) {
  // Eliminating an F column that has no vertical coupling leaves its two C neighbours joined in series; what it couples
  // vertically is shared between them in the proportion of its sideways couplings.
  const Stencil<float>& a = fine.a;
  const int nm = fine.a.west.nm, nc = coarse.nx, ny = fine.ny;
  const auto share = [&](int j, int m, float side) {
    const float sum = a.west.row(j)[m] + a.east.row(j)[m] + a.extra.F.row(j)[m];
    return sum > 0 ? side / sum : 0.f;
  };
  const auto colour = [&](Split<float>& s, int k) -> Columns<float>& { return k % 2 ? s.C : s.F; };
  for (int j = 0; j < ny; ++j) {
    for (int k = 0; k < nc; ++k) {
      const bool last = k + 1 >= nm;
      const auto from_west = [&](int row) { return share(row, k, a.east.row(row)[k]); };
      const auto from_east = [&](int row) { return last ? 0.f : share(row, k + 1, a.west.row(row)[k + 1]); };
      float north = 0;
      if (j + 1 < ny) {
        north = a.north.C.row(j)[k] + a.north.F.row(j)[k] * std::min(from_west(j), from_west(j + 1));
        if (!last) north += a.north.F.row(j)[k + 1] * std::min(from_east(j), from_east(j + 1));
      }
      float extra = a.extra.C.row(j)[k] + a.extra.F.row(j)[k] * from_west(j);
      if (!last) extra += a.extra.F.row(j)[k + 1] * from_east(j);
      colour(coarse.a.north, k).row(j)[k / 2] = north;
      colour(coarse.a.extra, k).row(j)[k / 2] = extra;
      // Coupling of coarse columns k-1 and k through F column k: the eastern one of column k-1, the western one of k.
      const float series = k > 0 ? a.west.row(j)[k] * from_west(j) : 0.f;
      if (k % 2 == 0)
        coarse.a.west.row(j)[k / 2] = series;
      else
        coarse.a.east.row(j)[k / 2] = series;
    }
    if (nc % 2) coarse.a.east.row(j)[nc / 2] = 0;
  }
}

void Multigrid::set(const Stencil<double>& finest) {
  const auto narrow = [](const Columns<double>& from, Columns<float>& to) {
    for (int j = 0; j < from.ny; ++j) {
      const double* f = from.row(j);
      float* t = to.row(j);
      vector_loop(0, from.nm, [&](int m) { t[m] = static_cast<float>(f[m]); });
    }
  };
  Stencil<float>& a = levels_[0].a;
  narrow(finest.west, a.west);
  narrow(finest.east, a.east);
  narrow(finest.north.F, a.north.F);
  narrow(finest.north.C, a.north.C);
  narrow(finest.extra.F, a.extra.F);
  narrow(finest.extra.C, a.extra.C);
  factor(levels_[0]);
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    coarsen(levels_[k - 1], levels_[k]);
    factor(levels_[k]);
  }
}

void Multigrid::cycle(std::size_t depth) {
  Level& l = levels_[depth];
  const Stencil<float>& a = l.a;
  const auto solve_F = [&](bool coupled) {
    solve_lines(l.pivot.F, l.slope.F, a.west, a.east, 0, l.b.F, coupled ? &l.x.C : nullptr, -1, l.x.F);
  };
  const auto solve_C = [&](bool coupled) {
    // C column m: its western coupling is the eastern one of F column m, its eastern the western one of F column m+1.
    solve_lines(l.pivot.C, l.slope.C, a.east, a.west, 1, l.b.C, coupled ? &l.x.F : nullptr, 0, l.x.C);
  };
  if (l.nx == 1) return solve_F(false);
  solve_C(false);
  solve_F(true);
  // After these two passes F rows are exact and the residual of C rows is what the F columns have just brought.
  Level& coarse = levels_[depth + 1];
  over_blocks(coarse.b.F.nm, l.ny, [&](int m0, int m1) {
    for (int j = 0; j < l.ny; ++j) {
      const float* w = a.east.row(j);
      const float* e = a.west.row(j) + 1;
      const float* xF = l.x.F.row(j);
      float* even = coarse.b.F.row(j);
      float* odd = coarse.b.C.row(j);
      const int nodd = std::min(m1, coarse.b.C.nm);
      for (int m = m0; m < m1; ++m) even[m] = w[2 * m] * xF[2 * m] + e[2 * m] * xF[2 * m + 1];
      for (int m = m0; m < nodd; ++m) odd[m] = w[2 * m + 1] * xF[2 * m + 1] + e[2 * m + 1] * xF[2 * m + 2];
    }
  });
  cycle(depth + 1);
  over_blocks(coarse.x.F.nm, l.ny, [&](int m0, int m1) {
    for (int j = 0; j < l.ny; ++j) {
      float* xC = l.x.C.row(j);
      const float* even = coarse.x.F.row(j);
      const float* odd = coarse.x.C.row(j);
      const int nodd = std::min(m1, coarse.x.C.nm);
      for (int m = m0; m < m1; ++m) xC[2 * m] += even[m];
      for (int m = m0; m < nodd; ++m) xC[2 * m + 1] += odd[m];
    }
  });
  solve_F(true);
  solve_C(true);
}

void Multigrid::apply(const Split<double>& r, Split<double>& z) {
  Level& l = levels_[0];
  const auto copy = [&](const auto& from, auto& to) {
    over_blocks(from.nm, l.ny, [&](int m0, int m1) {
      for (int j = 0; j < l.ny; ++j) {
        const auto* f = from.row(j);
        auto* t = to.row(j);
        vector_loop(m0, m1, [&](int m) { t[m] = static_cast<std::decay_t<decltype(t[m])>>(f[m]); });
      }
    });
  };
  copy(r.F, l.b.F);
  copy(r.C, l.b.C);
  cycle(0);
  copy(l.x.F, z.F);
  copy(l.x.C, z.C);
}

}  // namespace livebed::flow
