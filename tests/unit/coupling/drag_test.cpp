#include "coupling/drag.hpp"

#include <gtest/gtest.h>

/// Drag laws against numbers worked out apart from them, at both ends of their range and in between.
namespace livebed::coupling {
namespace {

constexpr double rho = 1000, nu = 1e-6, d = 2e-3, mu = rho * nu;
constexpr SingleGrain sphere{DragCurve::dallavalle, 23.04, 0.397};

/// Pressure gradient that a fixed bed of void fraction e needs for the superficial velocity w [Pa/m]: in model A the
/// drag of the grains in a volume over its void fraction.
template <class Law>
double pressure_gradient(const Law& law, double w, double e) {
  const double grains = (1 - e) / base::sphere_volume(d), slip = w / e;
  return grains * law({slip, d, rho, nu, e}) * slip / e;
}
double ergun(double w, double e) {
  return 150 * mu * (1 - e) * (1 - e) * w / (e * e * e * d * d) + 1.75 * rho * (1 - e) * w * w / (e * e * e * d);
}

TEST(single_grain, has_the_drag_coefficient_of_its_curve) {
  for (double Re : {0.01, 1.0, 50.0, 1e4}) {
    const double w = Re * nu / d;
    EXPECT_NEAR((SingleGrain{DragCurve::sum, 24, 0.4}(w, d, nu) / w), 0.4 + 24 / Re, 1e-12 * (0.4 + 24 / Re));
    const double dallavalle = std::pow(0.63 + 4.8 / std::sqrt(Re), 2);
    EXPECT_NEAR(sphere(w, d, nu) / w, dallavalle, 3e-4 * dallavalle) << Re;
  }
}

TEST(crowded_drag, is_that_of_one_grain_where_there_is_only_water) {
  for (double slip : {1e-4, 0.05, 0.8}) {
    const Immersed alone{slip, d, rho, nu, 1.0};
    const double single = PaperDrag{sphere}(alone);
    EXPECT_NEAR(DiFeliceDrag{sphere}(alone), single, 1e-12 * single);
    EXPECT_NEAR(RongDrag{sphere}(alone), single, 1e-12 * single);
    // The smooth switch still holds 0.6 % of the drag in a packed bed, up to six times that of one grain.
    EXPECT_NEAR(GidaspowDrag{sphere}(alone) / single, 1.01, 0.025);
  }
}

TEST(gidaspow_drag, is_the_equation_of_ergun_in_a_packed_bed) {
  for (double w : {1e-4, 1e-2, 0.2})
    for (double e : {0.4, 0.45, 0.5})
      EXPECT_NEAR(pressure_gradient(GidaspowDrag{sphere}, w, e), ergun(w, e), 0.01 * ergun(w, e)) << w << " " << e;
}

TEST(crowded_drag, needs_the_pressure_of_a_packed_bed) {
  // Both laws were fitted to packed beds, whose own scatter about Ergun's equation is some 25 %.
  for (double w : {1e-4, 1e-2, 0.2}) {
    EXPECT_NEAR(pressure_gradient(DiFeliceDrag{sphere}, w, 0.42) / ergun(w, 0.42), 0.9, 0.25) << w;
    EXPECT_NEAR(pressure_gradient(RongDrag{sphere}, w, 0.42) / ergun(w, 0.42), 1.1, 0.35) << w;
  }
}

TEST(di_felice_drag, has_its_exponent) {
  EXPECT_NEAR(DiFeliceDrag::exponent(1e-4, 0.5), 3.7, 1e-5);
  EXPECT_NEAR(DiFeliceDrag::exponent(std::pow(10, 1.5), 0.5), 3.05, 1e-12);
  EXPECT_NEAR(DiFeliceDrag::exponent(1e6, 0.5), 3.7, 1e-4);
}

TEST(rong_drag, has_its_exponent) {
  EXPECT_NEAR(RongDrag::exponent(1e-4, 0.5), 2.65 * 1.5, 1e-6);
  EXPECT_NEAR(RongDrag::exponent(std::pow(10, 1.5), 0.5), 2.65 * 1.5 - (5.3 - 1.75) * 0.25, 1e-12);
}

TEST(every_drag, is_finite_in_water_at_rest) {
  for (double e : {0.3, 0.6, 1.0}) {
    const Immersed rest{0, d, rho, nu, e};
    for (double beta : {PaperDrag{}(rest), DiFeliceDrag{}(rest), RongDrag{}(rest), GidaspowDrag{}(rest)}) {
      EXPECT_GE(beta, 0.8 * 3 * base::pi * mu * d);
      EXPECT_LT(beta, 500 * mu * d);
    }
  }
}

}  // namespace
}  // namespace livebed::coupling
