#include "flow/boundary.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "flow/constants.hpp"
#include "flow/profiles.hpp"

namespace livebed::flow {
namespace {

using base::cube;
using base::square;

Params channel(Profile profile) {
  Params p;
  p.mesh.length = 0.4, p.mesh.height = 0.2, p.mesh.cell_x = p.mesh.cell_y = 0.005;
  p.pipe.present = false;
  p.floor = Wall::rough, p.floor_roughness = 0.001;
  p.current.profile = profile, p.current.roughness = 0.001, p.current.shear_velocity = 0.05;
  p.current.mean_speed = 0.6;
  p.current.bed_level = 0.0521;  // within the eleventh row
  return p;
}

Boundary boundary(const Params& p) { return make_boundary(make_mesh(p.mesh, p.pipe), p); }

TEST(profiles, rough_and_smooth_level) {
  EXPECT_NEAR(zero_level(Profile::rough, 0.003, 0.1, 1e-6), 1e-4, 1e-18);
  EXPECT_NEAR(zero_level(Profile::smooth, 0.003, 0.1, 1e-6), 1e-6 / 0.9, 1e-18);
  EXPECT_EQ(log_law(1e-5, 0.1, 1e-4), 0.0);
  EXPECT_NEAR(log_law(1e-4 * std::exp(4.1), 0.1, 1e-4), 1.0, 1e-12);
}

TEST(profiles, depth_mean_is_the_integral_of_the_log_law) {
  const double h = 0.15, u_star = 0.07, z0 = 1e-4;
  double sum = 0;
  const int n = 200000;
  for (int k = 0; k < n; ++k) sum += log_law((k + 0.5) * h / n, u_star, z0) / n;
  EXPECT_NEAR(depth_mean(h, u_star, z0), sum, 1e-6);
  for (Profile profile : {Profile::rough, Profile::smooth}) {
    const double found = shear_velocity_from_mean(profile, 0.869, h, 0.003, 1e-6);
    EXPECT_NEAR(depth_mean(h, found, zero_level(profile, 0.003, found, 1e-6)), 0.869, 1e-9);
  }
}

TEST(profiles, shields_number_and_back) {
  EXPECT_NEAR(shear_velocity_from_shields(shields(0.103, 2.65, 9.81, 0.002), 2.65, 9.81, 0.002), 0.103, 1e-15);
  EXPECT_NEAR(shields(0.103, 2.65, 9.81, 0.002), 0.3277, 1e-4);
}

TEST(inlet, log_law_above_the_bed_and_nothing_below) {
  for (Profile profile : {Profile::rough, Profile::smooth}) {
    const Params p = channel(profile);
    const Boundary b = boundary(p);
    const double z0 = zero_level(profile, 0.001, 0.05, 1e-6), h = 0.2 - 0.0521;
    for (int j = 0; j < 10; ++j) {
      EXPECT_EQ(b.inlet_u[j], 0.0);
      EXPECT_EQ(b.inlet_k[j], k_floor);
      EXPECT_EQ(b.inlet_epsilon[j], epsilon_floor);
    }
    // The row of the bed's level: the open share of the speed in the middle of the open part.
    const double wet = (0.055 - 0.0521) / 0.005;
    EXPECT_NEAR(b.inlet_u[10], wet * log_law(0.5 * (0.055 - 0.0521), 0.05, z0), 1e-12);
    for (int j = 11; j < 40; ++j) {
      const double y = (j + 0.5) * 0.005 - 0.0521;
      EXPECT_NEAR(b.inlet_u[j], log_law(y, 0.05, z0), 1e-12);
      EXPECT_NEAR(b.inlet_k[j], 0.0025 / 0.3 * (1 - y / h), 1e-12);
      EXPECT_NEAR(launder_spalding.c_mu * square(b.inlet_k[j]) / b.inlet_epsilon[j], kappa * 0.05 * y * (1 - y / h),
                  1e-12);
    }
  }
}

TEST(inlet, flow_rate_is_that_of_the_profile) {
  const Boundary rough = boundary(channel(Profile::rough)), uniform = boundary(channel(Profile::uniform));
  double q_rough = 0, q_uniform = 0;
  for (int j = 0; j < 40; ++j) q_rough += rough.inlet_u[j] * 0.005, q_uniform += uniform.inlet_u[j] * 0.005;
  const double h = 0.2 - 0.0521;
  EXPECT_NEAR(q_uniform, 0.6 * h, 1e-12);
  EXPECT_NEAR(q_rough / (depth_mean(h, 0.05, 0.001 / 30) * h), 1, 0.003);  // mid-points of a logarithm
}

TEST(developed_column, balances_the_model_and_follows_the_log_law_near_the_bed) {
  const double h = 0.2, u_star = 0.05, ks = 0.001;
  std::vector<double> y;
  for (int n = 1; n < 40; ++n) y.push_back(h * n / 40.0);
  const Column c = developed_column(y, h, u_star, ks, 1e-6);
  for (std::size_t n = 0; n < y.size(); ++n) {
    EXPECT_GT(c.k[n], 0);
    EXPECT_GT(c.epsilon[n], 0);
    const double z = y[n] / h;
    if (z < 0.3) {
      EXPECT_NEAR(c.u[n] / log_law(y[n], u_star, ks / 30), 1, 0.03) << z;
      EXPECT_NEAR(c.k[n] / equilibrium_k(y[n], h, u_star), 1, 0.06) << z;
    }
  }
  // The stress that the profile implies is u*^2 (1 - y/h).
  for (std::size_t n = 4; n + 1 < y.size(); ++n) {
    const double nut =
        launder_spalding.c_mu * square(0.5 * (c.k[n] + c.k[n - 1])) / (0.5 * (c.epsilon[n] + c.epsilon[n - 1]));
    const double stress = (nut + 1e-6) * (c.u[n] - c.u[n - 1]) / (y[n] - y[n - 1]);
    EXPECT_NEAR(stress / square(u_star), 1 - 0.5 * (y[n] + y[n - 1]) / h, 0.02);
  }
}

TEST(wall_friction, follows_each_law) {
  const double nu = 1e-6;
  EXPECT_EQ(wall_friction(Wall::slip, 1, 0.01, 0.001, nu), 0);
  EXPECT_NEAR(wall_friction(Wall::no_slip, 1, 0.01, 0.001, nu), 1e-4, 1e-18);
  // Rough: speed of the log law gives its u* back.
  const double rough = wall_friction(Wall::rough, log_law(0.01, 0.05, 0.001 / 30), 0.01, 0.001, nu);
  EXPECT_NEAR(std::sqrt(rough * log_law(0.01, 0.05, 0.001 / 30)), 0.05, 1e-12);
  // Smooth, turbulent: likewise; the iteration of 8 contracts by 1/ln(E y+) each time.
  const double speed = log_law(0.01, 0.05, nu / (smooth_E * 0.05));
  EXPECT_NEAR(std::sqrt(wall_friction(Wall::smooth, speed, 0.01, 0, nu) * speed), 0.05, 1e-6);
  // Smooth, viscous layer: y+ below 11.
  EXPECT_NEAR(wall_friction(Wall::smooth, 0.01, 0.001, 0, nu), nu / 0.001, 1e-15);
  // Without flow there is still viscosity, and never less than it.
  for (Wall wall : {Wall::rough, Wall::smooth})
    for (double u : {0.0, 1e-9, 1e-3, 1.0}) EXPECT_GE(wall_friction(wall, u, 0.004, 0.001, nu), nu / 0.004);
}

TEST(wall_values, follow_equations_10_to_12) {
  const double u_star = 0.05, nu = 1e-6;
  EXPECT_NEAR(wall_k(u_star), 0.0025 / 0.3, 1e-15);
  EXPECT_NEAR(wall_epsilon(u_star, 0.01, nu, true), cube(u_star) / (kappa * 0.01 * (1 - std::exp(-500 / 26.0))), 1e-12);
  EXPECT_EQ(wall_k(0), k_floor);
  EXPECT_NEAR(wall_epsilon(u_star, 1e-4, nu, false), cube(u_star) / (kappa * 1e-4), 1e-9);
  EXPECT_GT(wall_epsilon(u_star, 1e-4, nu, true), 4 * wall_epsilon(u_star, 1e-4, nu, false));
  EXPECT_NEAR(wall_epsilon(u_star, 0.05, nu, true), wall_epsilon(u_star, 0.05, nu, false), 1e-9);
  for (bool damped : {true, false}) EXPECT_EQ(wall_epsilon(0, 0.01, nu, damped), epsilon_floor);
}

TEST(ghosts, mirror_at_walls_and_carry_on_at_the_outlet) {
  Params p = channel(Profile::uniform);
  const Mesh m = make_mesh(p.mesh, p.pipe);
  Boundary b = make_boundary(m, p);
  b.floor = Wall::no_slip;
  b.top_speed = 0.2;
  const auto filled = [&](Wall top) {
    b.top = top;
    base::Field u(m.nx, m.ny), v(m.nx, m.ny);
    for (int j = 0; j < m.ny; ++j)
      for (int i = 0; i <= m.nx; ++i) u(i, j) = 1 + i + 0.1 * j, v(i, j) = 2 - 0.3 * i + j;
    fill_velocity_ghosts(m, b, u, v);
    return std::pair{u, v};
  };
  const auto [u, v] = filled(Wall::no_slip);
  for (int i = 1; i < m.nx; ++i) {
    EXPECT_EQ(u(i, -1), -u(i, 0));
    EXPECT_NEAR(0.5 * (u(i, m.ny) + u(i, m.ny - 1)), 0.2, 1e-12);
    EXPECT_EQ(v(i, 0), 0);
    EXPECT_EQ(v(i, m.ny), 0);
    EXPECT_EQ(v(i, -1), -v(i, 1));
  }
  for (int j = 1; j < m.ny; ++j) {
    EXPECT_EQ(u(0, j), b.inlet_u[j]);
    EXPECT_EQ(v(-1, j), -v(0, j));
    EXPECT_EQ(v(m.nx, j), v(m.nx - 1, j));
    EXPECT_EQ(u(m.nx + 1, j), u(m.nx, j));
  }
  const auto [u_slip, v_slip] = filled(Wall::slip);
  for (int i = 1; i < m.nx; ++i) EXPECT_EQ(u_slip(i, m.ny), u_slip(i, m.ny - 1));

  b.inlet = b.outlet = false;
  b.west = Wall::no_slip, b.east = Wall::slip;
  const auto [u_shut, v_shut] = filled(Wall::slip);
  for (int j = 1; j < m.ny; ++j) {
    EXPECT_EQ(u_shut(0, j), 0);
    EXPECT_EQ(u_shut(m.nx, j), 0);
    EXPECT_EQ(v_shut(-1, j), -v_shut(0, j));
    EXPECT_EQ(v_shut(m.nx, j), v_shut(m.nx - 1, j));
  }
}

}  // namespace
}  // namespace livebed::flow
