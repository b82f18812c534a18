#include "flow/closures.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "flow/advance.hpp"
#include "flow/transport.hpp"

namespace livebed::flow {
namespace {

constexpr double u_star = 0.05, y = 0.01, nu = 1e-6, c_mu = 0.09;

/// Log layer: k = u*^2/sqrt(Cmu), epsilon = u*^3/(kappa y), S = u*/(kappa y).
Local log_layer(bool omega) {
  const double k = u_star * u_star / std::sqrt(c_mu), epsilon = u_star * u_star * u_star / (kappa * y);
  const double slope = u_star / (kappa * y);
  return {k, omega ? epsilon / (c_mu * k) : epsilon, c_mu * k * k / epsilon, slope * slope, 0.0, 1.0};
}
double net(const Rates& r, double c) { return r.gain - r.decay * c; }

TEST(closures, production_meets_dissipation_in_a_log_layer) {
  for (const ClosureLaw& law : {ClosureLaw{StandardKEpsilon{}}, ClosureLaw{RealizableKEpsilon{}}, ClosureLaw{KOmega{}},
                                ClosureLaw{KOmegaSst{}}})
    std::visit(
        [](const auto& closure) {
          const Local a = log_layer(closure.transports_omega);
          const double epsilon = u_star * u_star * u_star / (kappa * y);
          EXPECT_NEAR(closure.k(a).gain / epsilon, 1, 1e-12);
          EXPECT_NEAR(net(closure.k(a), a.k) / epsilon, 0, 1e-12);
          EXPECT_NEAR(closure.eddy_viscosity(a.k, a.e, 0.9 * a.strain, y, nu) / (kappa * u_star * y), 1, 1e-12);
        },
        law);
}

TEST(closures, second_equation_balances_diffusion_in_a_log_layer) {
  // epsilon ~ 1/y diffuses at rate kappa u* y / sigma -> 1/sigma kappa u* epsilon / y; the constants of 1974 balance it
  // for kappa = 0.433, not 0.41.
  const StandardKEpsilon standard;
  const Local a = log_layer(false);
  const double diffusion = standard.diffusion_e(0) * kappa * u_star * a.e / y;
  EXPECT_NEAR(-net(standard.e(a), a.e) / diffusion, base::square(0.4327 / kappa), 2e-3);
  // omega likewise; Menter rounded gamma to 5/9.
  const KOmegaSst sst;
  const Local b = log_layer(true);
  EXPECT_NEAR(-net(sst.e(b), b.e) / (sst.diffusion_e(1) * kappa * u_star * b.e / y), 1, 0.02);
  // Wilcox's constants give kappa = 0.40.
  const KOmega wilcox;
  EXPECT_NEAR(-net(wilcox.e(b), b.e) / (wilcox.diffusion_e(1) * kappa * u_star * b.e / y), base::square(0.4 / kappa),
              0.01);
}

TEST(k_omega, bounds_the_stress_but_not_what_spreads_k) {
  const KOmega law;
  const double k = 0.01, omega = 20;
  for (double S : {1.0, 5.0, 6.8, 6.9, 30.0, 1000.0}) {
    const double nut = law.eddy_viscosity(k, omega, S * S, y, nu);
    EXPECT_NEAR(nut * S / k, std::min(S / omega, 0.3 / 0.875), 1e-12) << S;
    const Local a{k, omega, nut, S * S, 0, 0};
    EXPECT_NEAR(nut * law.diffusion_k(law.blend(a, y, nu)), 0.6 * k / omega, 1e-12) << S;
    EXPECT_NEAR(nut * law.diffusion_e(law.blend(a, y, nu)), 0.5 * k / omega, 1e-12) << S;
  }
}

TEST(k_omega, diffuses_across_only_where_k_and_omega_rise_together) {
  const KOmega law;
  Local a{0.01, 20, 0, 0, 3.0, 1};
  EXPECT_DOUBLE_EQ(law.e(a).gain, 0.125 * 3.0 / 20);
  a.cross = -3.0;
  EXPECT_EQ(law.e(a).gain, 0);
}

TEST(realizable, is_the_standard_model_where_the_strain_is_small) {
  const Local a = log_layer(false);
  EXPECT_DOUBLE_EQ(RealizableKEpsilon{}.e(a).gain, StandardKEpsilon{}.e(a).gain);
  EXPECT_DOUBLE_EQ(RealizableKEpsilon{}.e(a).decay, StandardKEpsilon{}.e(a).decay);
}

TEST(realizable, holds_the_stress_below_what_k_allows) {
  const double k = 0.01, epsilon = 0.02;
  for (double alpha : {0.6, 1.0}) {
    Params params;
    params.closure = Closure::k_epsilon_realizable;
    params.realizability = alpha;
    const ClosureLaw any = closure_law(params);
    const auto& law = std::get<RealizableKEpsilon>(any);
    for (double S : {1.0, 10.0, 30.0, 1000.0}) {
      const double stress = law.eddy_viscosity(k, epsilon, S * S, y, nu) * S / k;
      EXPECT_NEAR(stress, std::min(alpha / std::sqrt(3.0), c_mu * k / epsilon * S), 1e-12) << alpha << ' ' << S;
      // T times its S is the stress over Cmu k, also where epsilon asks it.
      const Local a{k, epsilon, stress * k / S, S * S, 0, 0};
      EXPECT_NEAR(law.e(a).decay, StandardKEpsilon::c.c2 * c_mu * S / stress, 1e-9 * law.e(a).decay) << S;
    }
  }
}

TEST(sst, blends_from_wall_to_outer_flow) {
  const KOmegaSst law;
  Local a = log_layer(true);
  EXPECT_NEAR(law.blend(a, 0.2 * y, nu), 1, 1e-3);
  EXPECT_NEAR(law.blend(a, 1000 * y, nu), 0, 1e-3);
  a.cross = 1e6;  // a sharp edge of the turbulence switches to k-epsilon
  EXPECT_NEAR(law.blend(a, y, nu), 0, 1e-3);
  EXPECT_EQ(law.diffusion_k(1), 0.85);
  EXPECT_EQ(law.diffusion_e(0), 0.856);
}

TEST(sst, bounds_stress_and_production) {
  const KOmegaSst law;
  Local a = log_layer(true);
  const double S = 100 * std::sqrt(a.strain);
  EXPECT_NEAR(law.eddy_viscosity(a.k, a.e, S * S, y, nu) * S / a.k, KOmegaSst::a1, 1e-3);  // Bradshaw: stress = a1 k
  a.strain = S * S;
  EXPECT_NEAR(law.k(a).gain, 10 * c_mu * a.k * a.e, 1e-12 * law.k(a).gain);
}

TEST(sst, omega_at_a_wall_is_viscous_below_and_logarithmic_above) {
  const auto at = [&](double y_plus, bool smooth) {
    return KOmegaSst::wall_omega(u_star, y_plus * nu / u_star, nu, smooth) * nu / (u_star * u_star);
  };
  EXPECT_NEAR(at(1, true), 6 / 0.075, 0.5);
  EXPECT_NEAR(at(300, true) * 300 * 0.3 * kappa, 1, 0.01);
  EXPECT_NEAR(at(3, false) * 3 * 0.3 * kappa, 1, 1e-12);  // a rough wall has no viscous layer
}

TEST(blending_tanh, is_tanh) {
  for (double a = 0; a < 12; a += 0.01) EXPECT_NEAR(blending_tanh(a), std::tanh(a), 1e-4) << a;
}

TEST(spalding, is_viscous_at_the_wall_and_logarithmic_away) {
  const auto u_plus = [&](double y_plus) {  // of the speed that gives this y+
    double speed = 15 * u_star;
    for (int n = 0; n < 200; ++n) {
      const double found = std::sqrt(spalding_friction(speed, y, nu / y_plus * 500) * speed) * y / (nu / y_plus * 500);
      speed *= std::sqrt(y_plus / found);
    }
    return speed / std::sqrt(spalding_friction(speed, y, nu / y_plus * 500) * speed);
  };
  EXPECT_NEAR(u_plus(1), 1, 0.01);
  EXPECT_NEAR(u_plus(5), 5, 0.25);
  EXPECT_NEAR(u_plus(12), 9.2, 0.5);  // measured in the buffer layer: 9-9.5
  EXPECT_NEAR(u_plus(300) / (std::log(9 * 300.0) / kappa), 1, 0.005);
  EXPECT_EQ(spalding_friction(0, y, nu), nu / y);
}

/// A step far longer than any time scale, on turbulence drawn at random over three decades past a pipe.
class AnyClosure : public ::testing::TestWithParam<Closure> {};
TEST_P(AnyClosure, stays_positive_in_steps_of_any_length) {
  Params p;
  p.closure = GetParam();
  p.mesh.length = 0.4, p.mesh.height = 0.2, p.mesh.cell_x = p.mesh.cell_y = 0.01;
  p.pipe.diameter = 0.06, p.pipe.x = 0.15, p.pipe.y = 0.08;
  p.floor = Wall::smooth;
  p.current.profile = Profile::smooth, p.current.shear_velocity = u_star;
  const Mesh m = make_mesh(p.mesh, p.pipe);
  Solver flow(p, m, make_boundary(m, p));
  flow.start();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> decade(-3, 0), speed(-1, 1);
  Workspace w(m);
  Turbulence turbulence(m, flow.boundary(), p);
  const Staggering at = Staggering::centres(m);
  for (double dt : {1e-3, 1.0, 100.0}) {
    State s = flow.state;
    for (int j = 0; j < m.ny; ++j)
      for (int i = 0; i < m.nx; ++i) {
        if (m.volume(i, j) <= 0) continue;
        s.k(i, j) = std::pow(10, decade(random)), s.epsilon(i, j) = std::pow(10, decade(random));
        s.nut(i, j) = std::pow(10, decade(random) - 2);
        s.u(i, j) *= 1 + speed(random), s.v(i, j) = 0.1 * speed(random) * (m.aperture_y(i, j) > 0);
      }
    fill_scalar_ghosts(m, nullptr, s.nut);
    fill_velocity_ghosts(m, flow.boundary(), s.u, s.v);
    s.k_old = s.k, s.epsilon_old = s.epsilon;
    evaluate_walls(m, flow.boundary(), p, s, w);
    advance_turbulence(m, flow.boundary(), p, at, dt, turbulence, s, w);
    double lowest_k = 1, lowest_epsilon = 1, lowest_nut = 1;
    for (int j = 0; j < m.ny; ++j)
      for (int i = 0; i < m.nx; ++i) {
        EXPECT_TRUE(std::isfinite(s.k(i, j) + s.epsilon(i, j) + s.nut(i, j)));
        if (m.volume(i, j) <= 0) continue;
        lowest_k = std::min(lowest_k, s.k(i, j)), lowest_epsilon = std::min(lowest_epsilon, s.epsilon(i, j));
        lowest_nut = std::min(lowest_nut, s.nut(i, j));
      }
    EXPECT_GT(lowest_k, k_floor) << dt;  // by construction, not by the floor
    EXPECT_GE(lowest_epsilon, epsilon_floor) << dt;
    EXPECT_GT(lowest_nut, 0) << dt;
  }
}
INSTANTIATE_TEST_SUITE_P(closures, AnyClosure,
                         ::testing::Values(Closure::k_epsilon, Closure::k_epsilon_realizable, Closure::k_omega,
                                           Closure::k_omega_sst));

}  // namespace
}  // namespace livebed::flow
