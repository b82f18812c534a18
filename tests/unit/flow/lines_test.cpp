#include "flow/lines.hpp"

#include <gtest/gtest.h>
#include <random>

#include "base/loops.hpp"

namespace livebed::flow {
namespace {

Mesh grid(int nx, int ny) {
  MeshParams g;
  g.length = nx, g.height = ny, g.cell_x = g.cell_y = 1;
  PipeParams none;
  none.present = false;
  return make_mesh(g, none);
}

/// Random couplings over three decades, one way stronger than the other as convection makes them.
LineSystem random_system(const Mesh& m, const Staggering& at) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> decade(-1.5, 1.5), value(-1, 1);
  LineSystem a(m);
  for (int j = at.j0; j < at.j1; ++j)
    for (int i = at.i0; i < at.i1; ++i) {
      for (base::Field* coupling : {&a.west, &a.east, &a.south, &a.north})
        (*coupling)(i, j) = std::pow(10, decade(random));
      a.centre(i, j) = 1.02 * (a.west(i, j) + a.east(i, j) + a.south(i, j) + a.north(i, j));
      a.rhs(i, j) = value(random);
    }
  return a;
}

double worst_imbalance(const Staggering& at, const LineSystem& a) {
  double worst = 0;
  const auto c = [&](int i, int j) {
    return i >= at.i0 && i < at.i1 && j >= at.j0 && j < at.j1 ? a.correction(i, j) : 0.0;
  };
  for (int j = at.j0; j < at.j1; ++j)
    for (int i = at.i0; i < at.i1; ++i)
      worst = std::max(worst,
                       std::abs(a.rhs(i, j) + a.west(i, j) * c(i - 1, j) + a.east(i, j) * c(i + 1, j) +
                                a.south(i, j) * c(i, j - 1) + a.north(i, j) * c(i, j + 1) - a.centre(i, j) * c(i, j)));
  return worst;
}

TEST(lines, converge_to_the_solution_wherever_the_unknowns_sit) {
  const Mesh m = grid(22, 14);
  for (const Staggering& at : {Staggering::centres(m), Staggering::west_faces(m), Staggering::south_faces(m)}) {
    LineSystem a = random_system(m, at);
    sweep_lines(at, 1, a);
    const double once = worst_imbalance(at, a);
    sweep_lines(at, 400, a);
    EXPECT_LT(worst_imbalance(at, a), 1e-11);
    EXPECT_GT(once, 1e-3);
  }
}

TEST(lines, solve_a_single_line_at_once) {
  const Mesh m = grid(20, 4);
  const Staggering at = Staggering::centres(m);
  for (const bool along_x : {true, false}) {
    LineSystem a = random_system(m, at);
    if (along_x)
      a.south.fill(0), a.north.fill(0);
    else
      a.west.fill(0), a.east.fill(0);
    sweep_lines(at, 1, a);
    EXPECT_LT(worst_imbalance(at, a), 1e-13);
  }
}

TEST(lines, keep_fixed_values) {
  const Mesh m = grid(12, 10);
  const Staggering at = Staggering::centres(m);
  LineSystem a = random_system(m, at);
  a.fix(5, 4, 0.25);
  sweep_lines(at, 3, a);
  EXPECT_EQ(a.correction(5, 4), 0.25);
}

TEST(lines, give_the_same_bits_for_any_number_of_threads) {
  const Mesh m = grid(70, 50);
  const Staggering at = Staggering::centres(m);
  LineSystem one = random_system(m, at), two = one;
  sweep_lines(at, 3, one);
  base::set_threads(2);
  sweep_lines(at, 3, two);
  base::set_threads(1);
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) ASSERT_EQ(one.correction(i, j), two.correction(i, j));
}

TEST(lines, scaled_residual_is_zero_for_the_solution_and_one_for_a_constant) {
  const Mesh m = grid(16, 12);
  const Staggering at = Staggering::centres(m);
  LineSystem a = random_system(m, at);
  std::vector<double> scratch;
  base::Field x(m.nx, m.ny);
  // x = 0 with mean 0: A x = 0, so |rhs| / |rhs| = 1.
  EXPECT_NEAR(scaled_residual(at, a, x, scratch), 1, 1e-14);
  sweep_lines(at, 400, a);
  x = a.correction;
  a.rhs.fill(0);  // the imbalance of the solution
  EXPECT_EQ(scaled_residual(at, a, x, scratch), 0);
}

}  // namespace
}  // namespace livebed::flow
