#include <cmath>
#include <gtest/gtest.h>

#include "grains/laws.hpp"
#include "tank.hpp"

/// One grain of 2 mm quartz let go in still water, against its equation of motion
///   (rho_s + C_M rho) V dw/dt = (rho_s - rho) V g - rho/2 A (C_Dinf w + 24 nu/d) w      (Eq. 15, 18 of the paper)
namespace livebed::coupling {
namespace {

constexpr double d = Experiment::diameter, rho = Experiment::density, rho_s = 2650, nu = 1e-6, gravity = 9.81;
constexpr double drag_infinity = 0.4, added_mass = 0.5;

double acceleration(double w) {
  const double volume = base::pi / 6 * d * d * d, area = base::pi / 4 * d * d;
  const double drag = 0.5 * rho * area * (drag_infinity * w + 24 * nu / d) * w;
  return ((rho_s - rho) * volume * gravity - drag) / ((rho_s + added_mass * rho) * volume);
}

/// Root of the quadratic: weight = drag.
double terminal_speed(double size = d) {
  const double b = 24 * nu / size, c = (rho_s / rho - 1) * gravity * 4 * size / 3;
  return (-b + std::sqrt(b * b + 4 * drag_infinity * c)) / (2 * drag_infinity);
}

/// Speed after time t from rest (Runge-Kutta of fourth order).
double speed_after(double t) {
  const int steps = 2000;
  const double h = t / steps;
  double w = 0;
  for (int n = 0; n < steps; ++n) {
    const double a = acceleration(w), b = acceleration(w + 0.5 * h * a), c = acceleration(w + 0.5 * h * b),
                 e = acceleration(w + h * c);
    w += h / 6 * (a + 2 * b + 2 * c + e);
  }
  return w;
}

struct Fall {
  double largest_error = 0;  ///< of the speed over the terminal speed
  double last_speed = 0;     ///< [m/s]
};

Fall fall(const Tank& tank, int substeps, double until) {
  Experiment experiment(tank, {{.x = 0.5 * tank.length + 3e-4, .y = tank.height - 0.02}});
  Fall result;
  const int steps = static_cast<int>(std::lround(until / (substeps * experiment.grain_step())));
  for (int n = 1; n <= steps; ++n) {
    experiment.step(substeps);
    if (n * 10 % steps != 0) continue;
    const double exact = speed_after(n * substeps * experiment.grain_step());
    result.last_speed = -experiment.bed().state.v[0];
    result.largest_error = std::max(result.largest_error, std::abs(result.last_speed - exact) / terminal_speed());
  }
  EXPECT_EQ(steps % 10, 0);
  return result;
}

TEST(sinking_grain, follows_the_drag_law_one_way) {
  EXPECT_NEAR(terminal_speed(), 0.314, 0.001);
  EXPECT_NEAR(acceleration(terminal_speed()), 0, 1e-12);
  const Tank tank{.length = 0.05, .coupling = {.mode = Mode::one_way}};
  const Fall coarse = fall(tank, 200, 0.5), fine = fall(tank, 100, 0.5);
  EXPECT_NEAR(fine.last_speed, terminal_speed(), 1e-5 * terminal_speed());
  EXPECT_LT(fine.largest_error, 4e-3);
  EXPECT_NEAR(coarse.largest_error / fine.largest_error, 2, 0.1);  // the drag coefficient is frozen over a flow step
}

TEST(sinking_grain, of_every_size_reaches_its_own_speed) {
  const std::vector<double> sizes{1.0e-3, 1.6e-3, 2.4e-3, 4.0e-3};
  const Tank tank{.length = 0.1, .height = 0.3, .coupling = {.mode = Mode::one_way}};
  std::vector<Body> bodies;
  for (const double size : sizes)
    bodies.push_back({.x = 0.0123 + 0.02 * static_cast<double>(bodies.size()), .y = 0.28, .diameter = size});
  Experiment experiment(tank, bodies);
  const double dt = 100 * experiment.grain_step();
  for (int n = 0; n < static_cast<int>(std::lround(0.5 / dt)); ++n) experiment.step(100);
  const grains::State& g = experiment.bed().state;
  for (int i = 0; i < g.count(); ++i)
    EXPECT_NEAR(-g.v[i] / terminal_speed(g.diameter[i]), 1, 2e-4) << g.diameter[i] << " m";
}

TEST(sinking_grain, drags_water_along_two_way) {
  // The grain falls in the plume it drives, in a slab one grain thick: a few percent faster than in water that cannot
  // move (measured 1.03).
  for (Exchange exchange : {Exchange::implicit, Exchange::lagged}) {
    const Tank tank{.length = 0.12, .height = 0.2, .cell = 2.5e-3, .coupling = {.exchange = exchange}};
    const Fall result = fall(tank, 100, 0.4);
    EXPECT_GT(result.last_speed / terminal_speed(), 1.01);
    EXPECT_LT(result.last_speed / terminal_speed(), 1.08);
  }
}

}  // namespace
}  // namespace livebed::coupling
