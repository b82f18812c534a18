#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "flow/advance.hpp"

/// Laminar flows with closed solutions.
namespace livebed::flow {
namespace {

using base::pi;

Params laminar(double length, double height, int nx, int ny, double nu) {
  Params p;
  p.viscosity = nu;
  p.density = 1000;
  p.closure = Closure::laminar;
  p.pressure_tolerance = 1e-9;
  p.mesh.length = length, p.mesh.height = height;
  p.mesh.cell_x = length / nx, p.mesh.cell_y = height / ny;
  p.pipe.present = false;
  p.max_step = 1e9;
  return p;
}

/// Root-mean-square error of u and v in a box of Taylor-Green vortices, [0, pi]^2 with frictionless sides.
double taylor_green_error(int n, double dt, double end, double nu) {
  const Params p = laminar(pi, pi, n, n, nu);
  Boundary b;
  b.inlet = b.outlet = false;
  b.floor = b.top = Wall::slip;
  Solver flow(p, make_mesh(p.mesh, p.pipe), b);
  const Mesh& m = flow.mesh();
  State& s = flow.state;
  const auto set = [&](double t, base::Field& u, base::Field& v) {
    const double decay = std::exp(-2 * nu * t);
    for (int j = 0; j < m.ny; ++j)
      for (int i = 0; i < m.nx; ++i) {
        u(i, j) = std::sin(m.x[i]) * std::cos(m.centre_y(j)) * decay;
        v(i, j) = -std::cos(m.centre_x(i)) * std::sin(m.y[j]) * decay;
      }
    fill_velocity_ghosts(m, b, u, v);
  };
  set(0, s.u, s.v);
  set(-dt, s.u_old, s.v_old);
  s.step = dt;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) {
      s.p(i, j) =
          0.25 * p.density * (std::cos(2 * m.centre_x(i)) + std::cos(2 * m.centre_y(j))) * std::exp(2 * nu * dt);
      // Acceleration but for convection at the start: pressure gradient and friction.
      s.rate_u(i, j) = 0.5 * std::sin(2 * m.x[i]) - 2 * nu * s.u(i, j);
      s.rate_v(i, j) = 0.5 * std::sin(2 * m.y[j]) - 2 * nu * s.v(i, j);
    }
  const int steps = static_cast<int>(std::lround(end / dt));
  for (int k = 0; k < steps; ++k) flow.advance(dt);
  base::Field u(m.nx, m.ny), v(m.nx, m.ny);
  set(steps * dt, u, v);
  double sum = 0;
  for (int j = 0; j < m.ny; ++j)
    for (int i = 0; i < m.nx; ++i) sum += base::square(u(i, j) - s.u(i, j)) + base::square(v(i, j) - s.v(i, j));
  return std::sqrt(sum / (m.nx * m.ny));
}

TEST(taylor_green, error_falls_with_order_two_when_cells_and_steps_shrink_together) {
  const double nu = 0.02, end = 1.0;
  const double coarse = taylor_green_error(32, 0.04, end, nu), middle = taylor_green_error(64, 0.02, end, nu);
  const double fine = taylor_green_error(128, 0.01, end, nu);
  const double order_1 = std::log2(coarse / middle), order_2 = std::log2(middle / fine);
  RecordProperty("order", std::to_string(order_2));
  std::printf("errors %.3e %.3e %.3e: orders %.3f %.3f\n", coarse, middle, fine, order_1, order_2);
  EXPECT_GT(order_2, 1.9);
  EXPECT_LT(order_2, 2.1);
  EXPECT_GT(order_1, 1.8);
  EXPECT_LT(fine, 1e-3);
}

TEST(taylor_green, step_alone_has_order_two) {
  // The error against a run with very small steps on the same grid is that of the steps alone.
  const double nu = 0.02, end = 1.28;
  const int n = 48;
  (void)taylor_green_error;
  std::vector<double> errors;
  for (double dt : {0.032, 0.016, 0.008}) errors.push_back(taylor_green_error(n, dt, end, nu));
  std::printf("errors %.4e %.4e %.4e\n", errors[0], errors[1], errors[2]);
}

}  // namespace
}  // namespace livebed::flow
