#include "flow/multigrid.hpp"

#include <algorithm>
#include <cmath>

#include "base/loops.hpp"

namespace livebed::flow {

using base::vector_loop;

namespace {

constexpr int widest_block = 256;  // columns, so that what a line solve touches stays in the second cache
constexpr int cells_worth_threads = 8000;

/// Calls pass(m0, m1) over blocks of columns, on all threads when there is work for them.  The blocks depend on the
/// grid alone, not on the threads, and with them every rounding.
template <class Pass>
void over_blocks(int nm, int ny, Pass&& pass) {
  const int width = std::clamp((nm + 3) / 4, 32, widest_block) / 16 * 16;
  base::for_each_item(
      0, (nm + width - 1) / width, [&](int k) { pass(k * width, std::min(nm, (k + 1) * width)); },
      nm * ny < cells_worth_threads);
}

/// Solves the vertical lines of one colour, x = T^-1 (b + west x_west + east x_east).  Column m of this colour lies
/// between columns m + shift and m + shift + 1 of the other; null b or other stand for zero.
struct LineSolve {
  const Coefficients &pivot, &slope, &west, &east;
  int east_shift, shift;

  void operator()(const Columns* b, const Columns* other, Columns& x) const {
    const int ny = x.ny;
    over_blocks(x.nm, ny, [&](int m0, int m1) {
      for (int j = 0; j < ny; ++j) {
        float* xj = x.row(j);
        if (other) {
          const float *w = west.row(j), *e = east.row(j) + east_shift, *o = other->row(j) + shift;
          if (b) {
            const float* bj = b->row(j);
            vector_loop(m0, m1, [&](int m) { xj[m] = bj[m] + w[m] * o[m] + e[m] * o[m + 1]; });
          } else {
            vector_loop(m0, m1, [&](int m) { xj[m] = w[m] * o[m] + e[m] * o[m + 1]; });
          }
        } else {
          const float* bj = b->row(j);
          vector_loop(m0, m1, [&](int m) { xj[m] = bj[m]; });
        }
        if (j == 0) continue;
        const float *below = x.row(j - 1), *s = slope.row(j - 1);
        vector_loop(m0, m1, [&](int m) { xj[m] += s[m] * below[m]; });
      }
      float* top = x.row(ny - 1);
      const float* top_pivot = pivot.row(ny - 1);
      vector_loop(m0, m1, [&](int m) { top[m] *= top_pivot[m]; });
      for (int j = ny - 2; j >= 0; --j) {
        float* xj = x.row(j);
        const float *p = pivot.row(j), *s = slope.row(j), *above = x.row(j + 1);
        vector_loop(m0, m1, [&](int m) { xj[m] = p[m] * xj[m] + s[m] * above[m]; });
      }
    });
  }
};

}  // namespace

void Coefficients::share() {
  const Columns& c = columns_;
  for (int j = 0; j < c.ny; ++j) {
    // The column beyond the last is read, too.
    const bool equal = j > 0 && std::equal(c.row(j), c.row(j) + c.nm + 1, c.row(first_[j - 1]));
    first_[j] = equal ? first_[j - 1] : j;
  }
}

Multigrid::Multigrid(int nx, int ny) {
  for (int n = nx; n >= 1; n /= 2) {
    Level level;
    level.nx = n;
    level.ny = ny;
    level.a = Stencil(n, ny);
    level.pivot = level.slope = SplitOf<Coefficients>(n, ny);
    level.b = level.x = Split(n, ny);
    levels_.push_back(std::move(level));
  }
  r_ = d_ = q_ = sz_ = sum_ = Columns(nx / 2, ny);
  right_F_ = Columns((nx + 1) / 2, ny);
}

void Multigrid::solve_F(Level& l, const Columns* b, bool coupled) {
  LineSolve{l.pivot.F, l.slope.F, l.a.west, l.a.east, 0, -1}(b, coupled ? &l.x.C : nullptr, l.x.F);
}

void Multigrid::solve_C(Level& l, bool coupled) {
  // C column m: its western coupling is the eastern one of F column m, its eastern the western one of F column m+1.
  LineSolve{l.pivot.C, l.slope.C, l.a.east, l.a.west, 1, 0}(&l.b.C, coupled ? &l.x.F : nullptr, l.x.C);
}

void Multigrid::factor(Level& l) {
  // A pivot is d = north + excess, where the excess is what the line up to here holds beyond its vertical couplings.
  // Passed on from row to row, excess = west + east + extra + south x excess_below / d_below, it is a sum of positive
  // numbers: in long lines of flat cells, where it is tiny beside d, a difference would lose it.
  const auto one = [&](Coefficients& pivot, Coefficients& slope, Columns& passed, const Columns& north,
                       const Columns& extra, const Coefficients& west, const Coefficients& east, int east_shift) {
    over_blocks(passed.nm, l.ny, [&](int m0, int m1) {
      for (int j = 0; j < l.ny; ++j) {
        const int below = std::max(j - 1, 0);
        const float has_south = j > 0 ? 1.f : 0.f;
        const float *south = north.row(below), *passed_below = passed.row(below), *up = north.row(j),
                    *ex = extra.row(j);
        const float *w = west.row(j), *e = east.row(j) + east_shift;
        float *p = pivot.own_row(j), *s = slope.own_row(j), *pass = passed.row(j);
        vector_loop(m0, m1, [&](int m) {
          const float from_south = has_south * south[m];
          const float excess = w[m] + e[m] + ex[m] + (from_south > 0.f ? from_south * passed_below[m] : 0.f);
          const float d = up[m] + excess;
          // A solid cell is a row of its own; a line that floats free (pure Neumann) keeps 0.
          const float alone = from_south > 0.f ? 0.f : 1.f;
          p[m] = d > 0.f ? 1.f / d : alone;
          s[m] = up[m] * p[m];
          pass[m] = d > 0.f ? excess * p[m] : 0.f;
        });
      }
    });
    pivot.share(), slope.share();
  };
  one(l.pivot.F, l.slope.F, l.x.F, l.a.north.F, l.a.extra.F, l.a.west, l.a.east, 0);
  one(l.pivot.C, l.slope.C, l.x.C, l.a.north.C, l.a.extra.C, l.a.east, l.a.west, 1);
}

void Multigrid::coarsen(const Level& fine, Level& coarse) {
  // Eliminating an F column that has no vertical coupling leaves its two C neighbours joined in series; what it couples
  // vertically is shared between them in the proportion of its sideways couplings.  Coarse column k lies between F
  // columns k and k+1 (the last may be missing: its coefficients read as 0 from the padding).
  const Stencil& a = fine.a;
  const int nc = coarse.nx, ny = fine.ny;
  base::for_each_item(0, ny, [&](int j) {
    const int above = std::min(j + 1, ny - 1);
    const float inside = j + 1 < ny ? 1.f : 0.f;
    const float *w = a.west.row(j), *e = a.east.row(j), *x = a.extra.F.row(j);
    const float *wa = a.west.row(above), *ea = a.east.row(above), *xa = a.extra.F.row(above);
    const float *nF = a.north.F.row(j), *nC = a.north.C.row(j), *xC = a.extra.C.row(j);
    const auto over = [](float side, float west, float east, float extra) {
      const float sum = west + east + extra;
      return sum > 0.f ? side / sum : 0.f;
    };
    for (int parity = 0; parity < 2; ++parity) {
      float *north = coarse.a.north.colour(parity).row(j), *extra = coarse.a.extra.colour(parity).row(j);
      float* series = (parity == 0 ? coarse.a.west : coarse.a.east).own_row(j);
      vector_loop(0, (nc - parity + 1) / 2, [&](int m) {
        const int k = 2 * m + parity;
        const float from_west = over(e[k], w[k], e[k], x[k]), from_east = over(w[k + 1], w[k + 1], e[k + 1], x[k + 1]);
        const float west_above = over(ea[k], wa[k], ea[k], xa[k]),
                    east_above = over(wa[k + 1], wa[k + 1], ea[k + 1], xa[k + 1]);
        north[m] =
            inside * (nC[k] + nF[k] * std::min(from_west, west_above) + nF[k + 1] * std::min(from_east, east_above));
        extra[m] = xC[k] + x[k] * from_west + x[k + 1] * from_east;
        // Coarse columns k-1 and k are joined through F column k: the western coupling of k if k is even, the eastern
        // one of k-1 if k is odd.
        series[m] = w[k] * from_west;
      });
    }
    if (nc % 2) coarse.a.east.own_row(j)[nc / 2] = 0.f;
  });
  coarse.a.west.share(), coarse.a.east.share();
}

void Multigrid::build() {
  levels_[0].a.west.share(), levels_[0].a.east.share();
  factor(levels_[0]);
  for (std::size_t k = 1; k < levels_.size(); ++k) {
    coarsen(levels_[k - 1], levels_[k]);
    factor(levels_[k]);
  }
}

void Multigrid::restrict_from(const Level& fine, Level& coarse) {
  // After a C and an F solve, F rows are exact and the residual of C rows is what the F columns have just brought.
  over_blocks(coarse.b.F.nm, fine.ny, [&](int m0, int m1) {
    for (int j = 0; j < fine.ny; ++j) {
      const float *w = fine.a.east.row(j), *e = fine.a.west.row(j) + 1, *x = fine.x.F.row(j);
      float *even = coarse.b.F.row(j), *odd = coarse.b.C.row(j);
      vector_loop(m0, m1, [&](int m) { even[m] = w[2 * m] * x[2 * m] + e[2 * m] * x[2 * m + 1]; });
      vector_loop(m0, std::min(m1, coarse.b.C.nm),
                  [&](int m) { odd[m] = w[2 * m + 1] * x[2 * m + 1] + e[2 * m + 1] * x[2 * m + 2]; });
    }
  });
}

void Multigrid::prolong_to(Level& fine, const Level& coarse) {
  over_blocks(coarse.x.F.nm, fine.ny, [&](int m0, int m1) {
    for (int j = 0; j < fine.ny; ++j) {
      float* x = fine.x.C.row(j);
      const float *even = coarse.x.F.row(j), *odd = coarse.x.C.row(j);
      vector_loop(m0, m1, [&](int m) { x[2 * m] += even[m]; });
      vector_loop(m0, std::min(m1, coarse.x.C.nm), [&](int m) { x[2 * m + 1] += odd[m]; });
    }
  });
}

void Multigrid::cycle(std::size_t depth) {
  Level& l = levels_[depth];
  // On the finest level the F columns are eliminated: their right-hand side is zero.
  const Columns* b = depth == 0 ? nullptr : &l.b.F;
  if (l.nx == 1) return solve_F(l, &l.b.F, false);
  solve_C(l, false);
  solve_F(l, b, true);
  restrict_from(l, levels_[depth + 1]);
  cycle(depth + 1);
  prolong_to(l, levels_[depth + 1]);
  solve_F(l, b, true);
  solve_C(l, true);
}

int Multigrid::solve(double factor, int most) {
  Level& l = levels_[0];
  const int n = l.x.C.nm;
  // What the F columns bring to the C columns: east_m x_m + west_(m+1) x_(m+1).
  struct Brought {
    const float *w, *e, *x;
    float operator()(int m) const { return w[m] * x[m] + e[m] * x[m + 1]; }
  };
  const auto brought = [&l](int j) { return Brought{l.a.east.row(j), l.a.west.row(j) + 1, l.x.F.row(j)}; };
  // Sum over rows of what a row returns; rows in order, so the bits do not depend on threads.
  const auto sum_rows = [&](auto&& row) { return base::ordered_sum(0, l.ny, partial_, row); };

  std::swap(right_F_, l.b.F);
  solve_F(l, &right_F_, false);
  const double start = std::sqrt(sum_rows([&](int j) {
    float *r = r_.row(j), *s = sum_.row(j), *d = d_.row(j), *q = q_.row(j);
    const float* b = l.b.C.row(j);
    const Brought from_F = brought(j);
    vector_loop(0, n, [&](int m) { r[m] = b[m] + from_F(m), s[m] = d[m] = q[m] = 0.f; });
    return base::vector_sum_f(0, n, [&](int m) { return r[m] * r[m]; });
  }));

  int iterations = 0;
  double residual = start, rz_before = 1;
  while (residual > factor * start && iterations < most) {
    std::swap(l.b.C, r_);
    cycle(0);
    std::swap(l.b.C, r_);
    // The last C solve made T z = r + (what F brought); with F solved once more for z itself, S z = r + before - after.
    const double rz = sum_rows([&](int j) {
      const float *r = r_.row(j), *z = l.x.C.row(j);
      float* sz = sz_.row(j);
      const Brought from_F = brought(j);
      vector_loop(0, n, [&](int m) { sz[m] = r[m] + from_F(m); });
      return base::vector_sum_f(0, n, [&](int m) { return r[m] * z[m]; });
    });
    solve_F(l, nullptr, true);
    const auto beta = static_cast<float>(iterations == 0 ? 0.0 : rz / rz_before);
    const double dq = sum_rows([&](int j) {
      const float *z = l.x.C.row(j), *sz = sz_.row(j);
      float *d = d_.row(j), *q = q_.row(j);
      const Brought from_F = brought(j);
      vector_loop(0, n, [&](int m) { d[m] = z[m] + beta * d[m], q[m] = sz[m] - from_F(m) + beta * q[m]; });
      return base::vector_sum_f(0, n, [&](int m) { return d[m] * q[m]; });
    });
    if (!(dq > 0)) break;  // single precision has nothing left to give; the caller looks at the true residual
    const auto step = static_cast<float>(rz / dq);
    residual = std::sqrt(sum_rows([&](int j) {
      const float *d = d_.row(j), *q = q_.row(j);
      float *s = sum_.row(j), *r = r_.row(j);
      vector_loop(0, n, [&](int m) { s[m] += step * d[m], r[m] -= step * q[m]; });
      return base::vector_sum_f(0, n, [&](int m) { return r[m] * r[m]; });
    }));
    rz_before = rz;
    ++iterations;
    if (!std::isfinite(residual)) break;
  }
  std::swap(l.x.C, sum_);
  solve_F(l, &right_F_, true);
  std::swap(right_F_, l.b.F);
  return iterations;
}

}  // namespace livebed::flow
