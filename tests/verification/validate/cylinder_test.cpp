#include "validate/cylinder.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "validate/duct.hpp"

/// Short forms of `livebed validate cylinder` and `duct`: coarse grids, nearby sides.
namespace livebed::validate {
namespace {

TEST(cylinder, steady_wake_at_reynolds_40_wherever_it_lies_on_the_grid) {
  std::vector<double> drag;
  for (double shift : {0.0, 0.37}) {
    CylinderSetup setup{40, 14, 20, 1.12, 30};
    setup.shift = shift;
    const CylinderRun run = run_cylinder(setup);
    std::printf("Re 40, shift %.2f: Cd %.4f, by a box %.4f, bubble %.3f\n", shift, run.cd, run.cd_box, run.bubble);
    EXPECT_NEAR(run.cd, 1.56, 0.04);  // 1.50 to 1.58 without sides; these are 40 diameters apart
    EXPECT_NEAR(run.cd_box / run.cd, 1, 0.01);
    EXPECT_NEAR(run.bubble, 2.2, 0.15);
    EXPECT_NEAR(run.lift.back(), 0, 0.01);
    drag.push_back(run.cd);
  }
  EXPECT_NEAR(drag[1] / drag[0], 1, 0.01);
}

TEST(cylinder, sheds_at_reynolds_100) {
  const CylinderRun run = run_cylinder({100, 12, 15, 1.14, 80});
  std::printf("Re 100: Cd %.4f, by a box %.4f, rms Cl %.4f, St %.4f\n", run.cd, run.cd_box, run.cl_rms, run.strouhal);
  EXPECT_NEAR(run.strouhal, 0.167, 0.006);
  EXPECT_NEAR(run.cd, 1.38, 0.05);
  EXPECT_NEAR(run.cd_box / run.cd, 1, 0.015);
  EXPECT_NEAR(run.cl_rms, 0.24, 0.03);
}

TEST(potential_flow, cut_cells_are_of_second_order) {
  // Impulsive start against the finest grid, over some places on the grid.
  double impulse[3] = {}, flux[3] = {};
  for (double shift : {0.0, 0.013, 0.029, 0.041}) {
    const ImpulseRun exact = run_impulse(128, shift, 1.3 * shift);
    for (int k = 0; k < 3; ++k) {
      const ImpulseRun run = run_impulse(8 << k, shift, 1.3 * shift);
      impulse[k] += std::pow(run.impulse / exact.impulse - 1, 2),
          flux[k] += std::pow(run.flux_below / exact.flux_below - 1, 2);
    }
  }
  const double order_force = 0.25 * std::log2(impulse[0] / impulse[2]),
               order_flux = 0.25 * std::log2(flux[0] / flux[2]);
  std::printf("potential flow: order %.2f in force, %.2f in flux\n", order_force, order_flux);
  EXPECT_GT(order_force, 1.5);
  EXPECT_LT(order_force, 3.0);
  EXPECT_GT(order_flux, 1.8);
  EXPECT_LT(order_flux, 4.0);
}

TEST(duct, drag_of_the_benchmark_at_ten_cells_a_diameter) {
  const DuctRun run = run_duct(10);
  std::printf("channel, Re 20, 10 cells a diameter: Cd %.4f, Cl %.4f\n", run.cd, run.cl);
  EXPECT_NEAR(run.cd / 5.57953523, 1, 0.02);
  EXPECT_NEAR(run.cl, 0.0106, 0.01);
}

}  // namespace
}  // namespace livebed::validate
