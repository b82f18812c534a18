#include "flow/turbulence.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/math.hpp"
#include "flow/advance.hpp"

/// What the closures' home makes of the fields; the formulas of each closure are in closures_test.cpp.
namespace livebed::flow {
namespace {

using base::square;

constexpr double c_mu = launder_spalding.c_mu;

/// Uniform shear u = shear y over a smooth floor, a pipe where asked for, uniform k and epsilon.
struct Sheared {
  static constexpr double shear = 8, k = 0.02, epsilon = 0.05;
  Params params;
  Mesh mesh;
  Boundary boundary;
  State state;
  explicit Sheared(Closure closure, bool pipe = false) {
    params.closure = closure;
    params.viscosity = 1e-5;
    params.mesh.length = 1, params.mesh.height = 0.5, params.mesh.cell_x = 0.05, params.mesh.cell_y = 0.025;
    params.pipe.present = pipe;
    params.pipe.diameter = 0.21, params.pipe.x = 0.512, params.pipe.y = 0.263, params.pipe.wall = Wall::smooth;
    mesh = make_mesh(params.mesh, params.pipe);
    boundary.floor = Wall::smooth, boundary.top = Wall::slip;
    for (int j = 0; j < mesh.ny; ++j) boundary.inlet_u.push_back(shear * mesh.centre_y(j));
    boundary.inlet_k.assign(mesh.ny, k);
    boundary.inlet_epsilon.assign(mesh.ny, epsilon);
    state = Solver(params, mesh, boundary).state;
    for (int j = -2; j < mesh.ny + 2; ++j)
      for (int i = -2; i < mesh.nx + 2; ++i) state.u(i, j) = shear * mesh.centre_y(j);
    state.k.fill(k), state.k_old.fill(k), state.epsilon.fill(epsilon), state.epsilon_old.fill(epsilon);
  }
  Turbulence prepared(double ahead = 0) {
    Turbulence turbulence(mesh, boundary, params);
    Workspace w(mesh);
    evaluate_walls(mesh, boundary, params, state, w);
    turbulence.prepare(mesh, boundary, params, ahead, state, w);
    return turbulence;
  }
};

struct Row {
  std::vector<double> gain_k, decay_k, gain_e, decay_e;
  Row(const Turbulence& turbulence, const Sheared& s, int j) {
    for (auto* row : {&gain_k, &decay_k, &gain_e, &decay_e}) row->assign(s.mesh.nx + 16, 0.0);
    turbulence.fill_rates(s.mesh, j, s.state, {gain_k.data(), decay_k.data(), gain_e.data(), decay_e.data()});
  }
};

TEST(turbulence, produces_and_decays_in_uniform_shear) {
  Sheared s(Closure::k_epsilon);
  const Turbulence turbulence = s.prepared();
  const double nut = c_mu * s.k * s.k / s.epsilon, production = nut * square(s.shear);
  for (int j : {3, 10, 16}) {
    const Row row(turbulence, s, j);
    for (int i : {2, 9, 17}) {
      EXPECT_NEAR(turbulence.nut()(i, j) / nut, 1, 1e-12);
      EXPECT_NEAR(row.gain_k[i] / production, 1, 1e-11);
      EXPECT_NEAR(row.decay_k[i] / (s.epsilon / s.k), 1, 1e-12);
      EXPECT_NEAR(row.gain_e[i] / (1.44 * s.epsilon / s.k * production), 1, 1e-11);
      EXPECT_NEAR(row.decay_e[i] / (1.92 * s.epsilon / s.k), 1, 1e-12);
    }
  }
}

TEST(turbulence, adds_the_sources_it_is_given) {
  Sheared s(Closure::k_epsilon);
  const Row before(s.prepared(), s, 7);
  Turbulence turbulence = s.prepared();
  const base::Field of_k(s.mesh.nx, s.mesh.ny, 2, 0.25), of_e(s.mesh.nx, s.mesh.ny, 2, -0.5);
  turbulence.set_sources(&of_k, &of_e);
  const Row after(turbulence, s, 7);
  EXPECT_NEAR(after.gain_k[5] - before.gain_k[5], 0.25, 1e-12);
  EXPECT_NEAR(after.gain_e[5] - before.gain_e[5], -0.5, 1e-12);
  EXPECT_EQ(after.decay_k[5], before.decay_k[5]);
}

TEST(turbulence, gives_wall_cells_the_values_of_the_wall_function) {
  Sheared s(Closure::k_epsilon);
  const Turbulence turbulence = s.prepared();
  const double y = 0.5 * s.mesh.dy(0), nu = s.params.viscosity;
  const double u_star = std::sqrt(wall_friction(Wall::smooth, s.shear * y, y, 0, nu) * s.shear * y);
  for (const bool of_k : {true, false}) {
    int count = 0;
    turbulence.fixed_cells(of_k, 0, [&](int i, double value) {
      EXPECT_EQ(i, count++);
      EXPECT_NEAR(value / (of_k ? wall_k(u_star) : wall_epsilon(u_star, y, nu, true)), 1, 1e-12);
      EXPECT_EQ(turbulence.factor(of_k)(i, 0), fixed_row);
    });
    EXPECT_EQ(count, s.mesh.nx);
    for (int j : {1, s.mesh.ny - 1}) {  // the lid has no friction
      turbulence.fixed_cells(of_k, j, [&](int i, double) { ADD_FAILURE() << i << "," << j; });
      EXPECT_EQ(turbulence.factor(of_k)(4, j), 1.0);
    }
  }
}

TEST(turbulence, solves_k_at_the_wall_with_omega_given) {
  Sheared s(Closure::k_omega_sst);
  const Turbulence turbulence = s.prepared();
  int of_k = 0, of_e = 0;
  turbulence.fixed_cells(true, 0, [&](int, double) { ++of_k; });
  const double y = 0.5 * s.mesh.dy(0), nu = s.params.viscosity, speed = s.shear * y;
  const double u_star = std::sqrt(spalding_friction(speed, y, nu) * speed);
  turbulence.fixed_cells(false, 0, [&](int, double value) {
    ++of_e;
    EXPECT_NEAR(value / KOmegaSst::wall_omega(u_star, y, nu, true), 1, 1e-12);
  });
  EXPECT_EQ(of_k, 0);
  EXPECT_EQ(of_e, s.mesh.nx);
  // The work of the wall's stress, not that of the slope across the coarse cell.
  const Row row(turbulence, s, 0);
  const double nut = turbulence.nut()(6, 0);
  EXPECT_NEAR(row.gain_k[6] / (nut * square(square(u_star) / (nu + nut))), 1, 1e-12);
  EXPECT_GT(row.decay_k[6], 0.09 * s.epsilon / (c_mu * s.k));
}

TEST(turbulence, keeps_omega_beside_k_and_epsilon) {
  Sheared s(Closure::k_omega_sst);
  const Turbulence turbulence = s.prepared();
  const double omega = s.epsilon / (c_mu * s.k);
  EXPECT_TRUE(turbulence.with_omega());
  EXPECT_NEAR(turbulence.second(s.state)(5, 5) / omega, 1, 1e-12);
  std::vector<double> k(4, 0.03), e(4, 7.0), to_k(8), to_epsilon(8), to_nut(8);
  turbulence.store(s.params, 5, 2, 6, k.data(), e.data(), to_k.data(), to_epsilon.data(), to_nut.data());
  EXPECT_NEAR(to_k[3], 0.03, 1e-15);
  EXPECT_NEAR(to_epsilon[3], c_mu * 0.03 * 7.0, 1e-15);
  // a1 k / max(a1 omega, S F2) with F2 between 0 and 1.
  EXPECT_LE(to_nut[3], 0.03 / 7.0 * (1 + 1e-12));
  EXPECT_GE(to_nut[3], 0.31 * 0.03 / s.shear * (1 - 1e-12));
}

TEST(turbulence, runs_ahead_by_a_share_of_the_last_change) {
  Sheared s(Closure::k_epsilon);
  s.state.k_old.fill(0.999 * s.k);
  const double now = s.prepared().nut()(8, 8), ahead = s.prepared(0.5).nut()(8, 8);
  EXPECT_NEAR(ahead / now, square(1 + 0.5 * 0.001), 2e-6);
  EXPECT_GT(ahead, now);
}

TEST(turbulence, exchanges_nothing_through_floor_lid_and_ends) {
  Sheared s(Closure::k_epsilon);
  const Turbulence turbulence = s.prepared();
  const Staggering at = Staggering::centres(s.mesh);
  const double nut = c_mu * s.k * s.k / s.epsilon, nu = s.params.viscosity;
  std::vector<double> x(s.mesh.nx + 16), y(s.mesh.nx + 16);
  for (const bool of_k : {true, false}) {
    const double diffusivity = nu + nut / (of_k ? 1.0 : 1.3);
    turbulence.fill_exchange_x(s.mesh, s.params, at, of_k, 9, x.data());
    EXPECT_EQ(x[0], 0);
    EXPECT_EQ(x[s.mesh.nx], 0);
    EXPECT_NEAR(x[7] * s.mesh.dx_face(7) / diffusivity, 1, 1e-12);
    for (int j : {0, 9, s.mesh.ny}) {
      turbulence.fill_exchange_y(s.mesh, s.params, at, of_k, j, 0, s.mesh.nx, y.data());
      EXPECT_NEAR(y[7] * s.mesh.dy_face(9), j == 9 ? diffusivity : 0.0, 1e-12 * diffusivity) << j;
    }
  }
}

TEST(turbulence, is_at_its_floor_inside_the_pipe_and_at_the_wall_function_on_it) {
  Sheared s(Closure::k_epsilon, true);
  const Turbulence turbulence = s.prepared();
  const Mesh& m = s.mesh;
  int solid = 0, wall = 0;
  for (int j = 1; j < m.ny; ++j)
    turbulence.fixed_cells(true, j, [&](int i, double value) {
      if (m.volume(i, j) <= 0) {
        EXPECT_EQ(value, k_floor);
        EXPECT_EQ(turbulence.nut()(i, j), 0.0);
        ++solid;
      } else {
        EXPECT_GT(m.wall_length(i, j), 0);
        const double speed = s.shear * m.centre_y(j), y = m.wall_distance(i, j);
        const double u_star = std::sqrt(wall_friction(Wall::smooth, speed, y, 0, s.params.viscosity) * speed);
        EXPECT_NEAR(value / wall_k(u_star), 1, 1e-12) << i << "," << j;
        ++wall;
      }
    });
  EXPECT_GT(solid, 5);
  EXPECT_GT(wall, 10);
}

TEST(turbulence, caps_the_eddy_viscosity) {
  Sheared s(Closure::k_epsilon);
  s.state.epsilon.fill(epsilon_floor), s.state.epsilon_old.fill(epsilon_floor);
  EXPECT_DOUBLE_EQ(s.prepared().nut()(8, 8), nut_over_nu_most * s.params.viscosity);
}

}  // namespace
}  // namespace livebed::flow
