#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "flow/advance.hpp"
#include "laminar.hpp"

/// Decaying vortices in [0, pi]^2 with frictionless sides (Taylor and Green 1937): u = sin x cos y exp(-2 nu t).  The
/// solution solves the full equations, so the error of every term shows.
namespace livebed::flow {
namespace {

using base::pi;
using base::square;

struct TaylorGreen {
  double nu = 0.02;
  double amplitude = 1;  ///< largest speed at the start
  Convection scheme = Convection::bounded;
  double stretch = 0;  ///< cells at the far sides are 1 + stretch times as wide as those in the middle
  int flat = 1;        ///< cells are so many times as wide as high
  double courant_y = 0;

  Params params(int n) const {
    Params p = laminar(pi, pi, n, flat * n, nu);
    p.courant_y = courant_y;
    if (amplitude < 1) p.pressure_tolerance = 1e-6;  // what is left of the divergence is near round-off
    p.convection = scheme;
    if (stretch > 0) {  // the grading scales with the cells: all grids of a series are the same map
      const double from = 0.5, to = 1.0;
      p.mesh.growth = 1 + stretch * p.mesh.cell_x;
      p.mesh.fine_x_from = from, p.mesh.fine_x_to = to, p.mesh.fine_y_from = from, p.mesh.fine_y_to = to;
    }
    return p;
  }

  /// The flow after `end` on n x n cells (about, when stretched) with steps of dt.
  Solver run(int n, double dt, double end) const {
    const Params p = params(n);
    Boundary b;
    b.inlet = b.outlet = false;
    b.floor = b.top = Wall::slip;
    Solver flow(p, make_mesh(p.mesh, p.pipe), b);
    const Mesh& m = flow.mesh();
    State& s = flow.state;
    set(m, b, 0, s.u, s.v);
    set(m, b, -dt, s.u_old, s.v_old);
    s.step = dt;
    for (int j = 0; j < m.ny; ++j)
      for (int i = 0; i < m.nx; ++i) {
        s.p(i, j) = 0.25 * square(amplitude) * p.density * (std::cos(2 * m.centre_x(i)) + std::cos(2 * m.centre_y(j))) *
                    std::exp(2 * nu * dt);
        // Acceleration by convection at the start: all of it but pressure gradient and friction.
        s.convection_u(i, j) =
            (s.u(i, j) - s.u_old(i, j)) / dt - 0.5 * square(amplitude) * std::sin(2 * m.x[i]) + 2 * nu * s.u(i, j);
        s.convection_v(i, j) =
            (s.v(i, j) - s.v_old(i, j)) / dt - 0.5 * square(amplitude) * std::sin(2 * m.y[j]) + 2 * nu * s.v(i, j);
      }
    const int steps = static_cast<int>(std::lround(end / dt));
    for (int k = 0; k < steps; ++k) flow.advance(dt);
    return flow;
  }

  void set(const Mesh& m, const Boundary& b, double t, base::Field& u, base::Field& v) const {
    const double decay = amplitude * std::exp(-2 * nu * t);
    for (int j = 0; j < m.ny; ++j)
      for (int i = 0; i < m.nx; ++i) {
        u(i, j) = std::sin(m.x[i]) * std::cos(m.centre_y(j)) * decay;
        v(i, j) = -std::cos(m.centre_x(i)) * std::sin(m.y[j]) * decay;
      }
    fill_velocity_ghosts(m, b, u, v);
  }

  /// L2 error at the end of a run.
  double error(int n, double dt, double end) const {
    const Solver flow = run(n, dt, end);
    const Mesh& m = flow.mesh();
    base::Field u(m.nx, m.ny), v(m.nx, m.ny);
    set(m, flow.boundary(), std::lround(end / dt) * dt, u, v);
    return distance(m, flow.state.u, flow.state.v, u, v);
  }
};

/// Errors on three grids or steps, each half the one before, and the order between the last two.
double order(const char* name, double coarse, double middle, double fine) {
  const double first = std::log2(coarse / middle), second = std::log2(middle / fine);
  std::printf("%s: %.3e %.3e %.3e, orders %.3f %.3f\n", name, coarse, middle, fine, first, second);
  return second;
}

TEST(taylor_green, order_two_when_cells_and_steps_shrink_together) {
  const TaylorGreen c;
  const double fine = c.error(128, 0.01, 1);
  const double p = order("space and time", c.error(32, 0.04, 1), c.error(64, 0.02, 1), fine);
  EXPECT_GT(p, 1.9);
  EXPECT_LT(p, 2.1);
  EXPECT_LT(fine, 1e-3);
}

TEST(taylor_green, order_two_in_space_with_tiny_steps) {
  // Friction alone is of order two; convection on equal cells does better here (its leading errors are gradients, which
  // the pressure takes up), so the two are looked at apart.
  TaylorGreen creeping;
  creeping.amplitude = 1e-4, creeping.nu = 0.5;
  const auto error = [&](int n) { return creeping.error(n, 0.001, 0.2) / creeping.amplitude; };
  const double p = order("space, creeping", error(20), error(40), error(80));
  EXPECT_GT(p, 1.9);
  EXPECT_LT(p, 2.1);
  const TaylorGreen c;
  const double q = order("space", c.error(24, 0.0025, 0.25), c.error(48, 0.0025, 0.25), c.error(96, 0.0025, 0.25));
  EXPECT_GT(q, 1.9);
  EXPECT_LT(q, 3.1);
}

TEST(taylor_green, order_two_in_space_on_a_stretched_grid) {
  TaylorGreen c;
  c.stretch = 1.0;
  const double p =
      order("space, stretched", c.error(24, 0.0025, 0.25), c.error(48, 0.0025, 0.25), c.error(96, 0.0025, 0.25));
  EXPECT_GT(p, 1.9);
  EXPECT_LT(p, 2.1);
}

/// Differences between runs with successive steps on one grid: the error of the grid drops out (Richardson).
double order_in_time(const char* name, const TaylorGreen& c, int n, double dt, double end) {
  std::vector<Solver> runs;
  for (int k = 0; k < 4; ++k) runs.push_back(c.run(n, dt / (1 << k), end));
  const auto difference = [&](int a) {
    return distance(runs[a].mesh(), runs[a].state.u, runs[a].state.v, runs[a + 1].state.u, runs[a + 1].state.v);
  };
  return order(name, difference(0) / c.amplitude, difference(1) / c.amplitude, difference(2) / c.amplitude);
}

TEST(taylor_green, order_two_in_time_of_friction_and_projection) {
  // Creeping: convection is negligible, all else is there.
  TaylorGreen c;
  c.amplitude = 1e-4;
  const double p = order_in_time("time, creeping", c, 24, 0.4, 6.4);
  EXPECT_GT(p, 1.9);
  EXPECT_LT(p, 2.1);
}

/// Difference that halving the step makes on n x n cells.
double step_error(const TaylorGreen& c, int n) {
  const Solver a = c.run(n, 0.016, 1.28), b = c.run(n, 0.008, 1.28);
  return distance(a.mesh(), a.state.u, a.state.v, b.state.u, b.state.v);
}

TEST(taylor_green, convection_mixes_step_and_cell) {
  // A Hancock step has errors h^2, h dt and dt^2: with both shrinking it is of order two (above), on one grid the
  // middle term is left, and it halves with the cells.
  const TaylorGreen c;
  const double coarse = step_error(c, 24), fine = step_error(c, 48);
  std::printf("h dt term: %.3e %.3e\n", coarse, fine);
  EXPECT_NEAR(coarse / fine, 2.0, 0.2);
  EXPECT_LT(fine, 1e-4);
}

TEST(taylor_green, order_one_where_convection_along_y_is_implicit) {
  TaylorGreen c;
  c.flat = 4;  // the step passes 0.4 of a cell along x and 1.6 along y
  const auto error = [&](int n) { return c.error(n, 0.4 * pi / n, 0.4 * pi); };
  c.courant_y = 2;
  const double fine = error(96), p = order("implicit along y", error(24), error(48), fine);
  EXPECT_GT(p, 0.9);
  EXPECT_LT(p, 1.2);
  EXPECT_LT(fine, 0.02);
  c.courant_y = 0;
  EXPECT_FALSE(error(48) < 1) << "the explicit scheme bears this step, so the test shows nothing";
}

TEST(taylor_green, order_one_where_the_hybrid_scheme_is_upwind) {
  TaylorGreen c;
  c.nu = 1e-5;  // cell Peclet numbers far above 2 almost everywhere
  c.scheme = Convection::hybrid;
  const double p = order("hybrid", c.error(48, 0.005, 0.5), c.error(96, 0.005, 0.5), c.error(192, 0.005, 0.5));
  EXPECT_GT(p, 0.9);
  EXPECT_LT(p, 1.1);
}

}  // namespace
}  // namespace livebed::flow
