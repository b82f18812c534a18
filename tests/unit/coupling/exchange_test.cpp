#include "coupling/exchange.hpp"

#include <gtest/gtest.h>

#include "base/math.hpp"

namespace livebed::coupling {
namespace {

constexpr double rho = 1000, nu = 1e-6, d = 2e-3;

TEST(paper_drag, follows_equation_18_on_the_slip) {
  const PaperDrag drag{0.4};
  for (double slip : {1e-6, 1e-3, 0.1, 0.5, 3.0}) {
    const double Re = slip * d / nu, C_D = 0.4 + 24 / Re;
    const double force = 0.5 * rho * C_D * base::pi / 4 * d * d * slip * slip;
    EXPECT_NEAR(drag(slip, d, rho, nu) * slip, force, 1e-12 * force) << slip;
  }
}

TEST(paper_drag, is_that_of_stokes_at_rest) {
  const double stokes = 3 * base::pi * rho * nu * d;
  EXPECT_NEAR(PaperDrag{0.4}(0.0, d, rho, nu), stokes, 1e-14 * stokes);
}

/// Two grains of 2 mm in still water, one of them moving, and a coupler of a mode.
struct Pair {
  flow::Mesh mesh;
  flow::Staggering at_u, at_v;
  Coupler coupler;
  grains::State g;
  flow::State s;

  explicit Pair(const Params& params)
      : mesh(make_mesh()),
        at_u(flow::Staggering::west_faces(mesh)),
        at_v(flow::Staggering::south_faces(mesh)),
        coupler(params, mesh, at_u, at_v, d, rho, nu) {
    for (grains::Array* a : {&g.x, &g.y, &g.u, &g.v, &g.fluid.u, &g.fluid.v, &g.fluid.beta, &g.impulse_x, &g.impulse_y})
      a->assign(2, 0.0);
    g.diameter = {d, 1.1 * d};
    g.x = {0.02, 0.031}, g.y = {0.01, 0.012}, g.u = {0.3, 0.0}, g.v = {-0.1, 0.0};
    const base::Field zero(mesh.nx, mesh.ny);
    s.u = s.v = zero;
    s.load = {0, zero, zero, zero, zero};
  }
  static flow::Mesh make_mesh() {
    flow::MeshParams grid;
    grid.length = 0.06, grid.height = 0.03, grid.cell_x = grid.cell_y = 2e-3;
    return flow::make_mesh(grid, {.present = false});
  }
  double total(const base::Field& per_volume, const flow::Staggering& at) const {
    double sum = 0;
    for (int j = at.j0; j < at.j1; ++j)
      for (int i = at.i0; i < at.i1; ++i) sum += per_volume(i, j) * at.volume(i, j) * d;
    return sum;
  }
  double largest_load() const {
    double largest = 0;
    for (const base::Field* f : {&s.load.beta_u, &s.load.beta_v, &s.load.force_u, &s.load.force_v})
      for (double v : f->storage()) largest = std::max(largest, std::abs(v));
    return largest;
  }
};

TEST(coupler, loads_the_flow_with_the_drag_of_the_grains) {
  Pair pair({});
  pair.coupler.load_flow(pair.g, pair.s, 1e-3, false);
  const double beta_0 = PaperDrag{0.4}(std::hypot(0.3, 0.1), d, rho, nu), beta_1 = PaperDrag{0.4}(0, 1.1 * d, rho, nu);
  EXPECT_NEAR(pair.g.fluid.beta[0], beta_0, 1e-14 * beta_0);
  EXPECT_NEAR(pair.total(pair.s.load.beta_u, pair.at_u), beta_0 + beta_1, 1e-12 * beta_0);
  EXPECT_NEAR(pair.total(pair.s.load.beta_v, pair.at_v), beta_0 + beta_1, 1e-12 * beta_0);
  EXPECT_NEAR(pair.total(pair.s.load.force_u, pair.at_u), 0.3 * beta_0, 1e-12 * beta_0);
  EXPECT_NEAR(pair.total(pair.s.load.force_v, pair.at_v), -0.1 * beta_0, 1e-12 * beta_0);
}

TEST(coupler, sees_a_held_grain_at_rest_even_when_the_exchange_is_lagged) {
  Pair pair({.exchange = Exchange::lagged});
  pair.s.u.fill(0.2);
  pair.coupler.load_flow(pair.g, pair.s, 1e-3, true);
  const double beta = PaperDrag{0.4}(0.2, d, rho, nu);
  EXPECT_NEAR(pair.g.fluid.beta[0], beta, 1e-14 * beta);
  EXPECT_GT(pair.total(pair.s.load.beta_u, pair.at_u), beta);
  EXPECT_EQ(pair.total(pair.s.load.force_u, pair.at_u), 0.0);
}

TEST(coupler, leaves_the_flow_alone_unless_two_way) {
  for (Mode mode : {Mode::none, Mode::one_way}) {
    Pair pair({.mode = mode});
    pair.s.u.fill(0.2);
    pair.coupler.load_flow(pair.g, pair.s, 1e-3, false);
    pair.coupler.push_grains(pair.s, pair.g);
    pair.g.impulse_x = {1e-6, 1e-6};
    pair.coupler.collect(pair.g, pair.s, 1e-3);
    pair.coupler.load_flow(pair.g, pair.s, 1e-3, false);
    EXPECT_EQ(pair.largest_load(), 0.0);
    EXPECT_EQ(base::norm(pair.coupler.ledger().to_grains), 0.0);
    EXPECT_EQ(pair.g.fluid.beta[0] > 0, mode == Mode::one_way);
    EXPECT_NEAR(pair.g.fluid.u[1], mode == Mode::one_way ? 0.2 : 0.0, 1e-15);
  }
}

TEST(coupler, hands_the_whole_impulse_of_a_lagged_step_to_the_next) {
  Pair pair({.exchange = Exchange::lagged});
  const double dt = 1e-3;
  pair.coupler.load_flow(pair.g, pair.s, dt, false);
  EXPECT_EQ(pair.largest_load(), 0.0);
  pair.coupler.push_grains(pair.s, pair.g);
  pair.g.impulse_x = {3e-7, -1e-7}, pair.g.impulse_y = {0, 5e-8};
  pair.coupler.collect(pair.g, pair.s, dt);
  EXPECT_NEAR(pair.coupler.ledger().carried.x, -2e-7, 1e-20);
  pair.coupler.load_flow(pair.g, pair.s, dt, false);
  EXPECT_NEAR(pair.total(pair.s.load.force_u, pair.at_u) * dt, -2e-7, 1e-19);
  EXPECT_NEAR(pair.total(pair.s.load.force_v, pair.at_v) * dt, -5e-8, 1e-19);
  EXPECT_EQ(pair.total(pair.s.load.beta_u, pair.at_u), 0.0);
}

TEST(coupler, finds_the_solid_volume_of_the_grains_in_the_cells) {
  Pair pair({});
  base::Field fraction(pair.mesh.nx, pair.mesh.ny);
  pair.coupler.solid_fraction(pair.g, fraction);
  const double volume = base::sphere_volume(d) + base::sphere_volume(1.1 * d);
  EXPECT_NEAR(pair.total(fraction, flow::Staggering::centres(pair.mesh)), volume, 1e-13 * volume);
}

}  // namespace
}  // namespace livebed::coupling
