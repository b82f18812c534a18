#include "flow/multigrid.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "base/loops.hpp"

namespace livebed::flow {
namespace {

/// A five-point system by cells, as it goes into the finest level, and its residual in double precision.
struct Plain {
  int nx, ny;
  std::vector<double> east, north, extra, b;  ///< coupling to the next column, to the next row; diagonal beyond them
  Plain(int nx_, int ny_) : nx(nx_), ny(ny_) { east = north = extra = b = std::vector<double>(nx * ny, 0.0); }
  double& at(std::vector<double>& a, int i, int j) const { return a[j * nx + i]; }

  void fill(Multigrid& multigrid) {
    Stencil& a = multigrid.finest();
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int m = i / 2;
        // West and east of F columns: columns i-1 and i+1 of even i.
        if (i % 2 == 0) {
          a.west.own_row(j)[m] = static_cast<float>(i > 0 ? at(east, i - 1, j) : 0.0);
          a.east.own_row(j)[m] = static_cast<float>(i + 1 < nx ? at(east, i, j) : 0.0);
        }
        a.north.colour(i).row(j)[m] = static_cast<float>(j + 1 < ny ? at(north, i, j) : 0.0);
        a.extra.colour(i).row(j)[m] = static_cast<float>(at(extra, i, j));
        multigrid.right().colour(i).row(j)[m] = static_cast<float>(at(b, i, j));
      }
    multigrid.build();
  }

  /// Euclidean norm of b - A x over that of b, x as the multigrid holds it.
  double residual(const Multigrid& multigrid) {
    const auto x = [&](int i, int j) -> double {
      const Split& s = multigrid.solution();
      return (i % 2 ? s.C : s.F).row(j)[i / 2];
    };
    double sum = 0, all = 0;
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        double r = at(b, i, j) - at(extra, i, j) * x(i, j);
        if (i > 0) r -= at(east, i - 1, j) * (x(i, j) - x(i - 1, j));
        if (i + 1 < nx) r -= at(east, i, j) * (x(i, j) - x(i + 1, j));
        if (j > 0) r -= at(north, i, j - 1) * (x(i, j) - x(i, j - 1));
        if (j + 1 < ny) r -= at(north, i, j) * (x(i, j) - x(i, j + 1));
        sum += r * r, all += at(b, i, j) * at(b, i, j);
      }
    return std::sqrt(sum / all);
  }
};

/// Laplacian on cells `aspect` times as wide as high, held at 0 beyond the last column; random right-hand side.
Plain laplacian(int nx, int ny, double aspect) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(-1, 1);
  Plain a(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      a.at(a.east, i, j) = 1 / aspect, a.at(a.north, i, j) = aspect;
      a.at(a.b, i, j) = value(random);
      if (i == nx - 1) a.at(a.extra, i, j) = 2 / aspect;
    }
  return a;
}

TEST(multigrid, solves_a_single_column_without_an_iteration) {
  Plain a = laplacian(1, 37, 1);
  Multigrid multigrid(1, 37);
  a.fill(multigrid);
  EXPECT_EQ(multigrid.solve(1e-5, 10), 0);  // even columns are eliminated
  EXPECT_LT(a.residual(multigrid), 1e-5);
}

TEST(multigrid, takes_few_iterations_whatever_the_size_and_shape_of_cells) {
  for (const auto& [nx, ny] : {std::pair{32, 16}, {129, 40}, {512, 64}, {600, 7}})
    for (double aspect : {0.1, 1.0, 10.0}) {
      Plain a = laplacian(nx, ny, aspect);
      Multigrid multigrid(nx, ny);
      a.fill(multigrid);
      const int iterations = multigrid.solve(1e-3, 50);
      EXPECT_LE(iterations, 6) << nx << " x " << ny << ", aspect " << aspect;
      EXPECT_GE(iterations, 1);
      // The gradients look at the odd columns after elimination, not at all of b.
      EXPECT_LT(a.residual(multigrid), 1e-2) << nx << " x " << ny << ", aspect " << aspect;
    }
}

TEST(multigrid, says_how_many_iterations_it_took_and_stops_where_it_is_told) {
  Plain a = laplacian(256, 64, 1);
  Multigrid multigrid(256, 64);
  double last = 1;
  for (int most : {1, 2, 3}) {
    a.fill(multigrid);
    EXPECT_EQ(multigrid.solve(1e-6, most), most);
    const double now = a.residual(multigrid);
    EXPECT_LT(now, 0.5 * last) << most;
    last = now;
  }
}

TEST(multigrid, bears_jumps_of_coefficients_and_leaves_solid_cells_alone) {
  // Openings of 1e-2 to 1 and a solid block.
  std::mt19937 random(8);
  std::uniform_real_distribution<double> decade(-2, 0);
  Plain a = laplacian(96, 48, 1);
  for (double& c : a.east) c *= std::pow(10, decade(random));
  for (double& c : a.north) c *= std::pow(10, decade(random));
  const auto solid = [](int i, int j) { return i >= 30 && i < 45 && j >= 11 && j < 29; };
  for (int j = 0; j < 48; ++j)
    for (int i = 0; i < 96; ++i) {
      if (solid(i, j) || solid(i + 1, j)) a.at(a.east, i, j) = 0;
      if (solid(i, j) || solid(i, j + 1)) a.at(a.north, i, j) = 0;
      if (solid(i, j)) a.at(a.b, i, j) = 0;
    }
  Multigrid multigrid(96, 48);
  a.fill(multigrid);
  EXPECT_LE(multigrid.solve(1e-3, 60), 10);
  EXPECT_LT(a.residual(multigrid), 5e-3);
  const Split& x = multigrid.solution();
  for (int j = 0; j < 48; ++j)
    for (int i = 0; i < 96; ++i) {
      const float value = (i % 2 ? x.C : x.F).row(j)[i / 2];
      ASSERT_TRUE(std::isfinite(value));
      if (solid(i, j)) {
        ASSERT_EQ(value, 0.f) << i << "," << j;
      }
    }
}

TEST(multigrid, gives_the_same_bits_for_any_number_of_threads) {
  std::vector<Multigrid> runs;
  for (int threads : {1, 2}) {
    base::set_threads(threads);
    Plain a = laplacian(700, 90, 2);  // enough cells a colour for all threads
    Multigrid multigrid(700, 90);
    a.fill(multigrid);
    multigrid.solve(1e-3, 20);
    runs.push_back(multigrid);
  }
  base::set_threads(1);
  EXPECT_EQ(runs[0].solution().F.data, runs[1].solution().F.data);
  EXPECT_EQ(runs[0].solution().C.data, runs[1].solution().C.data);
}

}  // namespace
}  // namespace livebed::flow
