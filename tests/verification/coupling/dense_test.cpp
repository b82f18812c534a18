#include <cmath>
#include <gtest/gtest.h>
#include <utility>

#include "grains/laws.hpp"
#include "tank.hpp"

/// Water through grains that fill much of it: the pressure it costs, and how they fall together.
namespace livebed::coupling {
namespace {

constexpr double d = Experiment::diameter, rho = Experiment::density, rho_s = 2650, nu = 1e-6, gravity = 9.81;
constexpr SingleGrain sphere{DragCurve::dallavalle, 23.04, 0.397};
constexpr double volume = base::sphere_volume(d);

Params volume_averaged(Drag drag) {
  Params p;
  p.drag = drag, p.drag_curve = sphere.curve, p.drag_viscous = sphere.viscous, p.drag_infinity = sphere.infinity;
  p.voidage = Voidage::on;
  return p;
}

double ergun(double w, double e) {
  return 150 * rho * nu * base::square((1 - e) / d) * w / base::cube(e) +
         1.75 * rho * (1 - e) * w * w / (base::cube(e) * d);
}

/// Pressure gradient in the middle of a stretch of fixed grains, spheres on a square lattice, and their void fraction.
struct Bed {
  double gradient = 0, voidage = 0;
};
Bed push_water_through(Drag drag, double w, double spacing) {
  flow::Params params;
  params.viscosity = nu, params.closure = flow::Closure::laminar, params.floor = flow::Wall::slip;
  params.pressure_tolerance = 1e-9;
  params.mesh.length = 0.12, params.mesh.height = 10 * spacing, params.mesh.cell_x = params.mesh.cell_y = 2.5e-3;
  params.pipe.present = false;
  flow::Boundary sides;
  sides.floor = flow::Wall::slip;
  const flow::Mesh mesh = flow::make_mesh(params.mesh, params.pipe);
  sides.inlet_u.assign(mesh.ny, w);
  flow::Solver solver(params, mesh, sides);
  solver.start();
  grains::State g;
  for (int row = 0; row < 10; ++row)
    for (double x = 0.03; x < 0.09; x += spacing) g.x.push_back(x), g.y.push_back((row + 0.5) * spacing);
  const int count = g.count();
  for (grains::Array* a :
       {&g.u, &g.v, &g.fluid.u, &g.fluid.v, &g.fluid.beta, &g.fluid.fx, &g.fluid.fy, &g.impulse_x, &g.impulse_y})
    a->assign(count, 0.0);
  g.diameter.assign(count, d);
  for (int k = 0; k < count; ++k) g.id.push_back(k);
  Coupler coupler(volume_averaged(drag), solver, {d, rho_s, 0.5, nu, count, 1});
  const double dt = 0.2 * params.mesh.cell_x / w;
  for (int n = 0; n < 400; ++n) {
    coupler.load_flow(g, solver, dt, true);
    solver.advance(dt);
  }
  const auto pressure = [&](double x) { return solver.state.p(static_cast<int>(x / 2.5e-3), mesh.ny / 2); };
  return {(pressure(0.045) - pressure(0.075)) / 0.03, 1 - volume / (spacing * spacing * d)};
}

TEST(fixed_bed, costs_the_pressure_of_ergun) {
  for (double w : {5e-4, 0.05})
    for (double spacing : {1.05 * d, 1.2 * d}) {
      const Bed bed = push_water_through(Drag::gidaspow, w, spacing);
      EXPECT_NEAR(bed.gradient / ergun(w, bed.voidage), 1, 0.03) << w << " m/s, void fraction " << bed.voidage;
    }
}

TEST(fixed_bed, costs_about_the_pressure_of_ergun_by_the_other_laws) {
  for (Drag drag : {Drag::di_felice, Drag::rong})
    for (double w : {5e-4, 0.05}) {
      const Bed bed = push_water_through(drag, w, 1.05 * d);
      EXPECT_NEAR(bed.gradient / ergun(w, bed.voidage), 1, 0.35) << w << " m/s";
    }
}

/// Speed at which grains fall together in a closed box: each carries its weight by drag and by the pressure gradient,
/// and the water rises by what they displace, so the slip is w / e and its drag e times the weight.
double hindered_speed(double e, double viscosity = nu) {
  const DiFeliceDrag law{sphere};
  const double weight = (rho_s - rho) * volume * gravity;
  double w = 0.1;
  for (int n = 0; n < 300; ++n) w = 0.5 * (w + e * weight / law({w / e, d, rho, viscosity, e}) * e);
  return w;
}

TEST(suspension, falls_slower_the_denser_it_is) {
  const double alone = hindered_speed(1.0);
  for (double spacing : {1.3 * d, 1.8 * d}) {
    Tank tank;
    tank.length = 16 * spacing, tank.height = 0.3, tank.cell = spacing;  // no channel of clear water beside the grains
    tank.coupling = volume_averaged(Drag::di_felice);
    std::vector<Body> bodies;
    for (double y = 0.14; y < 0.28; y += spacing)
      for (double x = 0.5 * spacing; x < tank.length - 0.4 * spacing; x += spacing) bodies.push_back({.x = x, .y = y});
    Experiment experiment(tank, bodies);
    const double e = 1 - volume / (spacing * spacing * d);
    const int substeps = 100;
    for (int n = 0; n < 150; ++n) experiment.step(substeps);
    const grains::State& g = experiment.bed().state;
    double speed = 0;
    int middle = 0;
    const auto [low, high] = std::minmax_element(g.y.begin(), g.y.end());
    for (int k = 0; k < g.count(); ++k)
      if (g.y[k] > *low + 0.3 * (*high - *low) && g.y[k] < *high - 0.3 * (*high - *low)) speed -= g.v[k], ++middle;
    speed /= middle;
    EXPECT_NEAR(speed / hindered_speed(e), 1, 0.05) << "void fraction " << e;
    // Richardson and Zaki (1954): n = 2.4 to 3.1 at these Reynolds numbers (400).
    EXPECT_LT(speed / alone, std::pow(e, 2.2));
    EXPECT_GT(speed / alone, std::pow(e, 3.4));
    EXPECT_LT(base::norm(experiment.coupler().ledger().error()), 1e-12);
  }
}

TEST(suspension, does_not_swing_in_the_longest_step) {
  constexpr double spacing = 1.05 * d;  // a void fraction of 0.52, and no contact
  Tank tank;
  tank.length = 16 * spacing, tank.height = 0.2, tank.cell = spacing;
  tank.viscosity = 2e-5;  // or they would fall several cells in such a step
  tank.coupling = volume_averaged(Drag::di_felice);
  std::vector<Body> bodies;
  for (double y = 0.1; y < 0.18; y += spacing)
    for (double x = 0.5 * spacing; x < tank.length - 0.4 * spacing; x += spacing) bodies.push_back({.x = x, .y = y});
  Experiment experiment(tank, bodies);
  const grains::State& g = experiment.bed().state;
  const int middle = g.count() / 2;
  for (int n = 0; n < 20; ++n) experiment.step(100);  // drag and with it the limit are those of grains at rest before
  double speed = g.v[middle], change = 0;
  for (int n = 0; n < 28; ++n) {
    experiment.step(static_cast<int>(experiment.coupler().step_limit(g) / experiment.grain_step()));
    change = g.v[middle] - std::exchange(speed, g.v[middle]);
  }
  EXPECT_NEAR(-speed / hindered_speed(1 - volume / (spacing * spacing * d), tank.viscosity), 1, 0.1);
  EXPECT_LT(std::abs(change), 0.01 * std::abs(speed));
  EXPECT_LT(base::norm(experiment.coupler().ledger().error()), 1e-12);
}

}  // namespace
}  // namespace livebed::coupling
