#include "coupling/exchange.hpp"

#include <any>
#include <array>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <string>
#include <type_traits>

#include "base/math.hpp"

namespace livebed::coupling {
namespace {

constexpr double rho = 1000, nu = 1e-6, d = 2e-3;

TEST(paper_drag, follows_equation_18_on_the_slip) {
  const PaperDrag drag{{DragCurve::sum, 24, 0.4}};
  for (double slip : {1e-6, 1e-3, 0.1, 0.5, 3.0}) {
    const double Re = slip * d / nu, C_D = 0.4 + 24 / Re;
    const double force = 0.5 * rho * C_D * base::pi / 4 * d * d * slip * slip;
    EXPECT_NEAR(drag({slip, d, rho, nu, 0.5}) * slip, force, 1e-12 * force) << slip;
  }
}

TEST(paper_drag, is_that_of_stokes_at_rest) {
  const double stokes = 3 * base::pi * rho * nu * d;
  EXPECT_NEAR(PaperDrag{}({0.0, d, rho, nu, 1}), stokes, 1e-14 * stokes);
}

/// Two grains of 2 mm in still water, one of them moving, and a coupler of a mode.
struct Pair {
  flow::Solver solver;
  Coupler coupler;
  grains::State g;

  explicit Pair(const Params& params)
      : solver(laminar(), make_mesh(), closed()), coupler(params, solver, {d, 2650, 0.5, nu, 2, 1}) {
    for (grains::Array* a : {&g.x, &g.y, &g.u, &g.v, &g.fluid.u, &g.fluid.v, &g.fluid.beta, &g.fluid.fx, &g.fluid.fy,
                             &g.impulse_x, &g.impulse_y})
      a->assign(2, 0.0);
    g.id = {0, 1};
    g.diameter = {d, 1.1 * d};
    g.x = {0.02, 0.031}, g.y = {0.01, 0.012}, g.u = {0.3, 0.0}, g.v = {-0.1, 0.0};
  }
  static flow::Mesh make_mesh() {
    flow::MeshParams grid;
    grid.length = 0.06, grid.height = 0.03, grid.cell_x = grid.cell_y = 2e-3;
    return flow::make_mesh(grid, {.present = false});
  }
  static flow::Params laminar() {
    flow::Params p;
    p.closure = flow::Closure::laminar;
    return p;
  }
  static flow::Boundary closed() {
    flow::Boundary b;
    b.inlet = b.outlet = false;
    b.floor = flow::Wall::slip;
    return b;
  }
  double total(const base::Field& per_volume, const flow::Staggering& at) const {
    double sum = 0;
    for (int j = at.j0; j < at.j1; ++j)
      for (int i = at.i0; i < at.i1; ++i) sum += per_volume(i, j) * at.volume(i, j) * d;
    return sum;
  }
  const flow::Load& load() const { return solver.state.load; }
  double largest_load() const {
    double largest = 0;
    for (const base::Field* f : {&load().beta_u, &load().beta_v, &load().force_u, &load().force_v})
      for (double v : f->storage()) largest = std::max(largest, std::abs(v));
    return largest;
  }
};

TEST(coupler, loads_the_flow_with_the_drag_of_the_grains) {
  Pair pair({});
  pair.coupler.load_flow(pair.g, pair.solver, 1e-3, false);
  const double beta_0 = PaperDrag{}({std::hypot(0.3, 0.1), d, rho, nu, 1}),
               beta_1 = PaperDrag{}({0, 1.1 * d, rho, nu, 1});
  EXPECT_NEAR(pair.g.fluid.beta[0], beta_0, 1e-14 * beta_0);
  EXPECT_NEAR(pair.total(pair.load().beta_u, pair.solver.at_u()), beta_0 + beta_1, 1e-12 * beta_0);
  EXPECT_NEAR(pair.total(pair.load().beta_v, pair.solver.at_v()), beta_0 + beta_1, 1e-12 * beta_0);
  EXPECT_NEAR(pair.total(pair.load().force_u, pair.solver.at_u()), 0.3 * beta_0, 1e-12 * beta_0);
  EXPECT_NEAR(pair.total(pair.load().force_v, pair.solver.at_v()), -0.1 * beta_0, 1e-12 * beta_0);
}

TEST(coupler, sees_a_held_grain_at_rest_even_when_the_exchange_is_lagged) {
  Pair pair({.exchange = Exchange::lagged});
  pair.solver.state.u.fill(0.2);
  pair.coupler.load_flow(pair.g, pair.solver, 1e-3, true);
  const double beta = PaperDrag{}({0.2, d, rho, nu, 1});
  EXPECT_NEAR(pair.g.fluid.beta[0], beta, 1e-14 * beta);
  EXPECT_GT(pair.total(pair.load().beta_u, pair.solver.at_u()), beta);
  EXPECT_EQ(pair.total(pair.load().force_u, pair.solver.at_u()), 0.0);
}

TEST(coupler, passes_over_held_grains_until_they_are_let_go) {
  Pair pair({});
  const auto load = [&](double speed, bool held) {
    pair.solver.state.u.fill(speed);
    pair.coupler.load_flow(pair.g, pair.solver, 1e-3, held);
    if (held) pair.coupler.hold(pair.g);
    return pair.total(pair.load().beta_u, pair.solver.at_u());
  };
  const auto beta = [](double slip) {
    return PaperDrag{}({slip, d, rho, nu, 1}) + PaperDrag{}({slip, 1.1 * d, rho, nu, 1});
  };
  EXPECT_NEAR(load(0.2, true), beta(0.2), 1e-12 * beta(0.2));
  // Another water is seen when the next round begins.
  for (int n = 1; n < steps_a_round; ++n) EXPECT_NEAR(load(0.4, true), beta(0.2), 1e-12 * beta(0.2)) << "step " << n;
  EXPECT_NEAR(load(0.4, true), beta(0.4), 1e-12 * beta(0.4));
  pair.coupler.let_go(pair.g);
  pair.g.u = {0.0, 0.0}, pair.g.v = {0.0, 0.0};
  EXPECT_NEAR(load(0.1, false), beta(0.1), 1e-12 * beta(0.1));
}

TEST(coupler, leaves_the_flow_alone_unless_two_way) {
  for (Mode mode : {Mode::none, Mode::one_way}) {
    Pair pair({.mode = mode});
    pair.solver.state.u.fill(0.2);
    pair.coupler.load_flow(pair.g, pair.solver, 1e-3, false);
    pair.coupler.push_grains(pair.solver, pair.g, 1e-3);
    pair.g.impulse_x = {1e-6, 1e-6};
    pair.coupler.collect(pair.g, pair.solver, 1e-3);
    pair.coupler.load_flow(pair.g, pair.solver, 1e-3, false);
    EXPECT_EQ(pair.largest_load(), 0.0);
    EXPECT_EQ(base::norm(pair.coupler.ledger().to_grains), 0.0);
    EXPECT_EQ(pair.g.fluid.beta[0] > 0, mode == Mode::one_way);
    EXPECT_NEAR(pair.g.fluid.u[1], mode == Mode::one_way ? 0.2 : 0.0, 1e-15);
  }
}

TEST(coupler, hands_the_whole_impulse_of_a_lagged_step_to_the_next) {
  Pair pair({.exchange = Exchange::lagged});
  const double dt = 1e-3;
  pair.coupler.load_flow(pair.g, pair.solver, dt, false);
  EXPECT_EQ(pair.largest_load(), 0.0);
  pair.coupler.push_grains(pair.solver, pair.g, 1e-3);
  pair.g.impulse_x = {3e-7, -1e-7}, pair.g.impulse_y = {0, 5e-8};
  pair.coupler.collect(pair.g, pair.solver, dt);
  EXPECT_NEAR(pair.coupler.ledger().carried.x, -2e-7, 1e-20);
  pair.coupler.load_flow(pair.g, pair.solver, dt, false);
  EXPECT_NEAR(pair.total(pair.load().force_u, pair.solver.at_u()) * dt, -2e-7, 1e-19);
  EXPECT_NEAR(pair.total(pair.load().force_v, pair.solver.at_v()) * dt, -5e-8, 1e-19);
  EXPECT_EQ(pair.total(pair.load().beta_u, pair.solver.at_u()), 0.0);
}

/// One step in which the grains keep their speeds and take what the drag of a constant slip gives; all wake in it or
/// not.
void coast(Pair& pair, double dt, bool all_wake = false) {
  pair.coupler.load_flow(pair.g, pair.solver, dt, false);
  pair.solver.advance(dt);
  pair.coupler.push_grains(pair.solver, pair.g, dt);
  for (int k = 0; k < 2; ++k) {
    const grains::FluidForce& f = pair.g.fluid;
    pair.g.impulse_x[k] = dt * (f.fx[k] + f.beta[k] * (f.u[k] - pair.g.u[k]));
    pair.g.impulse_y[k] = dt * (f.fy[k] + f.beta[k] * (f.v[k] - pair.g.v[k]));
  }
  if (all_wake) std::fill(pair.g.sleep.asleep.begin(), pair.g.sleep.asleep.end(), 0);
  pair.coupler.collect(pair.g, pair.solver, dt);
}

TEST(coupler, owes_nothing_when_grains_do_not_change_their_speed) {
  // A jet that is as narrow as the grains: the water that each part of a grain meets is not the mean around it.
  Pair pair({.drag = Drag::di_felice, .voidage = Voidage::on, .kernel = 2});
  for (int i = 0; i < pair.solver.mesh().nx; ++i) pair.solver.state.u(i, 5) = 0.3;
  coast(pair, 1e-4);
  const ImpulseLedger& ledger = pair.coupler.ledger();
  EXPECT_GT(base::norm(ledger.to_flow), 1e-9);
  EXPECT_LT(base::norm(ledger.carried), 1e-14 * base::norm(ledger.to_flow));
  EXPECT_LT(base::norm(ledger.error()), 1e-13 * base::norm(ledger.to_flow));
}

TEST(coupler, keeps_what_grains_asleep_do_to_the_water) {
  const Params params{.drag = Drag::di_felice, .voidage = Voidage::on, .kernel = 2};
  Pair awake(params), asleep(params);
  asleep.g.sleep.asleep = {0, 1};
  const double dt = 1e-4;
  const auto beta = [](const Pair& p) { return p.total(p.load().beta_u, p.solver.at_u()); };
  for (int n = 0; n < 3 * steps_a_round; ++n) {
    const int wakes = 2 * steps_a_round + 5;
    for (Pair* p : {&awake, &asleep}) {
      if (n > wakes) p->g.u[1] = -0.1;
      coast(*p, dt, n == wakes);
      for (int k = 0; k < 2; ++k) p->g.x[k] += dt * p->g.u[k], p->g.y[k] += dt * p->g.v[k];
      ASSERT_LT(base::norm(p->coupler.ledger().error()), 1e-12 * base::norm(p->coupler.ledger().to_flow)) << n;
    }
    // Its drag is looked at once a round; in between the water hardly changes.
    ASSERT_NEAR(beta(asleep), beta(awake), 0.05 * beta(awake)) << n;
    ASSERT_NEAR(asleep.solver.state.voidage(15, 5), awake.solver.state.voidage(15, 5), 1e-3) << n;
  }
  EXPECT_NE(asleep.coupler.ledger().to_flow.x, awake.coupler.ledger().to_flow.x) << "nobody was still";
  EXPECT_NEAR(asleep.coupler.ledger().to_flow.x, awake.coupler.ledger().to_flow.x,
              0.02 * std::abs(awake.coupler.ledger().to_flow.x));
}

TEST(coupler, of_a_checkpoint_wakes_a_grain_that_had_moved_as_the_old_one_does) {
  const Params params{.drag = Drag::di_felice, .voidage = Voidage::on, .kernel = 2};
  const double dt = 1e-4;
  Pair old(params);
  old.g.u[1] = 0.2;
  old.g.sleep.asleep = {0, 0};
  // It falls asleep in the first step of a round, still moving when that begins.
  old.coupler.load_flow(old.g, old.solver, dt, false);
  old.solver.advance(dt);
  old.coupler.push_grains(old.solver, old.g, dt);
  old.g.u[1] = 0, old.g.sleep.asleep[1] = 1;
  old.coupler.collect(old.g, old.solver, dt);
  coast(old, dt);
  ASSERT_EQ(old.g.fluid.still[1], 1);

  Pair restored(params);
  restored.g = old.g, restored.solver = old.solver;
  std::map<std::string, std::any> parts;
  Coupler::each_part(old.coupler, [&](const char* name, const auto& part) { parts[name] = part; });
  Coupler::each_part(restored.coupler, [&](const char* name, auto& part) {
    part = std::any_cast<std::remove_cvref_t<decltype(part)>>(parts.at(name));
  });
  for (Pair* pair : {&old, &restored}) coast(*pair, dt, true), coast(*pair, dt);
  EXPECT_NE(old.largest_load(), 0.0);
  EXPECT_EQ(old.load().force_u.storage(), restored.load().force_u.storage());
  EXPECT_EQ(old.load().force_v.storage(), restored.load().force_v.storage());
}

TEST(coupler, looks_at_sleepers_deep_in_the_bed_less_often) {
  Pair pair({});
  // One above the other in the same column, further apart than what counts as the surface.
  pair.g.x = {0.031, 0.032}, pair.g.y = {0.026, 0.026 - (surface_depth + 1) * d};
  pair.g.u = pair.g.v = {0.0, 0.0};
  pair.g.sleep.asleep = {1, 1};
  const auto looked_at = [&](double speed) {  // which of the two see the water that is there now
    pair.solver.state.u.fill(speed);
    pair.coupler.load_flow(pair.g, pair.solver, 1e-3, false);
    const auto sees = [&](int k) {
      const double beta = PaperDrag{}({speed, pair.g.diameter[k], rho, nu, 1});
      return std::abs(pair.g.fluid.beta[k] - beta) < 1e-12 * beta;
    };
    const std::array<bool, 2> both{sees(0), sees(1)};
    pair.coupler.collect(pair.g, pair.solver, 1e-3);
    return both;
  };
  EXPECT_EQ(looked_at(0.1), (std::array{true, true}));
  std::array<int, 2> looks{};
  for (int n = 1; n <= 2 * rounds_of_the_deep * steps_a_round; ++n) {
    const auto both = looked_at(0.1 + 1e-3 * n);
    for (int k : {0, 1}) looks[k] += both[k];
    ASSERT_TRUE(both[0] || !both[1]) << n;
  }
  EXPECT_EQ(looks[0], 2 * rounds_of_the_deep);
  EXPECT_EQ(looks[1], 2);
}

TEST(coupler, bounds_the_step_by_the_response_of_every_grain) {
  constexpr int count = 1500;
  const Params params{.drag = Drag::di_felice, .voidage = Voidage::on};
  Pair pair(params);
  grains::State& g = pair.g;
  for (grains::Array* a : {&g.x, &g.y, &g.u, &g.v, &g.fluid.u, &g.fluid.v, &g.fluid.beta, &g.fluid.fx, &g.fluid.fy,
                           &g.impulse_x, &g.impulse_y})
    a->assign(count, 0.0);
  g.diameter.assign(count, d);
  g.id.resize(count);
  std::iota(g.id.begin(), g.id.end(), 0);
  const Coupler coupler(params, pair.solver, {d, 2650, 0.5, nu, count, 1});
  const double common = 1e-4, response = (2650 + 0.5 * rho) * base::sphere_volume(d) / common;
  g.fluid.beta.assign(count, common);
  EXPECT_NEAR(coupler.step_limit(g), step_over_response * response, 1e-12 * response);
  g.fluid.beta[700] = 20 * common;
  EXPECT_NEAR(coupler.step_limit(g), step_over_response * response / 20, 1e-12 * response);
}

TEST(coupler, tells_the_water_of_a_share_of_each_change_of_the_void_fraction) {
  Pair pair({.drag = Drag::di_felice, .voidage = Voidage::on});
  const auto solid = [&](int i) {
    double sum = 0;
    for (int j = 0; j < pair.solver.mesh().ny; ++j) sum += 1 - pair.solver.state.voidage(i, j);
    return sum;
  };
  const auto step_to = [&](double x, bool held) {
    pair.coupler.load_flow(pair.g, pair.solver, 1e-4, held);
    pair.coupler.push_grains(pair.solver, pair.g, 1e-4);
    pair.g.x[0] = x;
    pair.coupler.collect(pair.g, pair.solver, 1e-4);
  };
  pair.g.x[0] = 0.021;
  step_to(0.041, false);
  const double all = solid(10);
  ASSERT_GT(all, 0.1);
  double left = 1;
  for (int n = 0; n < 4; ++n) {
    step_to(0.041, false);
    left *= 1 - share_passed;
    EXPECT_NEAR(solid(10), left * all, 1e-12) << n;
    EXPECT_NEAR(solid(20), (1 - left) * all, 1e-12) << n;
  }
  step_to(0.041, true);  // held, grains leave no room and take none: what they fill is known at once
  EXPECT_NEAR(solid(20), all, 1e-12);
}

TEST(coupler, finds_the_solid_volume_of_the_grains_in_the_cells) {
  Pair pair({});
  base::Field fraction(pair.solver.mesh().nx, pair.solver.mesh().ny);
  pair.coupler.solid_fraction(pair.g, fraction);
  const double volume = base::sphere_volume(d) + base::sphere_volume(1.1 * d);
  EXPECT_NEAR(pair.total(fraction, flow::Staggering::centres(pair.solver.mesh())), volume, 1e-13 * volume);
}

/// Two rows of grains, one a cell, on the floor, and one grain alone above them.
struct BedAndFlyer : Pair {
  static Params bounded() {
    Params p;
    p.voidage = Voidage::on, p.turbulence = Turbulence::bounded, p.kernel = 0.6, p.room_power = 3;
    return p;
  }
  BedAndFlyer() : Pair(bounded()) {
    g.x = {0.031}, g.y = {0.021};
    for (int n = 0; n < 60; ++n) g.x.push_back((n % 30 + 0.5) * d), g.y.push_back((n / 30 + 0.5) * d);
    for (grains::Array* a :
         {&g.u, &g.v, &g.fluid.u, &g.fluid.v, &g.fluid.beta, &g.fluid.fx, &g.fluid.fy, &g.impulse_x, &g.impulse_y})
      a->assign(g.x.size(), 0.0);
    g.diameter.assign(g.x.size(), d);
    g.id.resize(g.x.size());
    std::iota(g.id.begin(), g.id.end(), 0);
  }
};

TEST(eddies_among_grains, are_no_larger_than_their_distance_from_the_bed) {
  BedAndFlyer at;
  Coupler coupler(BedAndFlyer::bounded(), at.solver, {d, 2650, 0.5, nu, 61, 1});
  coupler.load_flow(at.g, at.solver, 1e-3, false);
  const base::Field& room = at.load().room;
  EXPECT_LT(room(5, 0), 0.05 * d);
  for (int j = 4; j <= 8; ++j) {
    // The surface is where half of the grains' kernel ends, on top of the second row.
    const flow::Mesh& m = at.solver.mesh();
    EXPECT_NEAR(room(5, j), m.centre_y(j) - 2 * d, 0.6 * d) << j;
    EXPECT_NEAR(room(5, j) - room(5, j - 1), m.dy_face(j), 1e-9 * d) << j;
  }
}

TEST(eddies_among_grains, pass_a_grain_that_flies_alone) {
  // It fills the cell it is in more than a packed bed does.
  BedAndFlyer at;
  Coupler coupler(BedAndFlyer::bounded(), at.solver, {d, 2650, 0.5, nu, 61, 1});
  coupler.load_flow(at.g, at.solver, 1e-3, false);
  const base::Field& room = at.load().room;
  EXPECT_GT(room(15, 10), 0.9 * room(5, 10));
}

}  // namespace
}  // namespace livebed::coupling
