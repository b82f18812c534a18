#include <cmath>
#include <gtest/gtest.h>

#include "bodies.hpp"

/// Grains that fall through a fluid: how the linearised drag is stepped.  The drag law is the test's own.
using namespace livebed;
using namespace livebed::grains;
using namespace livebed::grains::bodies;

namespace {

/// Schiller and Naumann (1933), C_D = 24/Re (1 + 0.15 Re^0.687), as beta [N s/m].
double schiller_naumann(double slip, double d, double rho, double nu) {
  const double Re = slip * d / nu;
  return 3 * base::pi * rho * nu * d * (1 + 0.15 * std::pow(Re, 0.687));
}

/// A small sphere in a fluid that rises with `rise` [m/s].
struct Falling {
  double rho, nu, rise;
  Bed bed;
  Falling(double density, double step, double fluid_density, double viscosity, double up)
      : rho(fluid_density), nu(viscosity), rise(up) {
    Params p = dry(1e-4, density, 0);
    p.fluid_density = fluid_density;
    p.step = step;
    p.length = 0.01;
    bed = bed_of(p, {{0.005, 0.0925}});
    bed.state.fluid.v[0] = rise;
  }
  void fall(int steps) {
    for (int k = 0; k < steps; ++k) {
      bed.state.fluid.beta[0] = schiller_naumann(std::abs(rise - body(bed, 0).v), bed.params.diameter, rho, nu);
      advance(bed, 1);
    }
  }
};

}  // namespace

TEST(drag, grain_settles_in_rising_gas_as_in_mfix_dem06) {
  const double step = 5e-5;
  Falling grain(2000, step, 1.2, 1.8e-5 / 1.2, 0.4);
  grain.bed.params.gravity = 9.80665;  // with this value and buoyancy the table is met to all its digits
  double worst_y = 0, worst_v = 0;
  const auto rows = read_csv("dem_mfix06_terminal_velocity.csv");
  for (const auto& row : rows) {
    grain.fall(static_cast<int>(std::lround(row[0] / step) - grain.bed.steps));
    worst_y = std::max(worst_y, std::abs(body(grain.bed, 0).y - row[1]));
    worst_v = std::max(worst_v, std::abs(body(grain.bed, 0).v - row[2]));
  }
  EXPECT_EQ(rows.size(), 36u);
  std::printf("largest difference: %.2g m, %.2g m/s\n", worst_y, worst_v);
  EXPECT_LT(worst_y, 3e-6);  // of 18 mm
  EXPECT_LT(worst_v, 6e-5);  // of 0.057 m/s
  // What the weight gave, the gas took up and the grain carries.
  const Params& p = grain.bed.params;
  const double m = mass(p, p.diameter), t = static_cast<double>(grain.bed.steps) * step;
  EXPECT_NEAR(grain.bed.state.impulse_y[0], m * (body(grain.bed, 0).v + submerged_gravity(p) * t), 1e-12 * m);
}

TEST(drag, settling_speed_of_the_cfdem_tutorial) {
  Falling grain(3000, 1e-3, 10, 1e-5, 0);
  grain.fall(400);
  EXPECT_NEAR(body(grain.bed, 0).v, -0.1373, 5e-5);
}
