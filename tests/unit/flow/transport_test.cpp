#include "flow/transport.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "flow/advance.hpp"

namespace livebed::flow {
namespace {

/// Relative error of k after `end` in homogeneous turbulence without strain, which decays as a power of time:
/// k = k0 (1 + (C2 - 1) e0 t / k0)^(-1/(C2 - 1)).
double decay_error(double dt, double end) {
  Params p;
  p.mesh.length = 1, p.mesh.height = 1, p.mesh.cell_x = p.mesh.cell_y = 0.1;
  p.pipe.present = false;
  Boundary b;
  b.inlet = b.outlet = false;
  b.floor = b.top = Wall::slip;
  const Mesh m = make_mesh(p.mesh, p.pipe);
  Solver maker(p, m, b);
  State s = maker.state;
  Workspace w(m);
  Turbulence turbulence(m, b, p);
  const Staggering at = Staggering::centres(m);
  const double k0 = 0.02, e0 = 0.01, c2 = launder_spalding.c2;
  const auto k = [&](double t) { return k0 * std::pow(1 + (c2 - 1) * e0 * t / k0, -1 / (c2 - 1)); };
  const auto e = [&](double t) { return e0 * std::pow(1 + (c2 - 1) * e0 * t / k0, -c2 / (c2 - 1)); };
  s.k.fill(k(0)), s.epsilon.fill(e(0)), s.k_old.fill(k(-dt)), s.epsilon_old.fill(e(-dt));
  s.step = dt;
  evaluate_walls(m, b, p, s, w);
  for (int n = 0; n < std::lround(end / dt); ++n) advance_turbulence(m, b, p, at, dt, turbulence, s, w);
  EXPECT_NEAR(s.nut(4, 5) / (launder_spalding.c_mu * s.k(4, 5) * s.k(4, 5) / s.epsilon(4, 5)), 1, 1e-12);
  EXPECT_NEAR(s.k(1, 2), s.k(8, 7), 1e-14);
  return std::abs(s.k(4, 5) / k(end) - 1);
}

TEST(advance_turbulence, lets_homogeneous_turbulence_decay_as_it_must_with_order_two) {
  const double coarse = decay_error(0.00125, 0.8), fine = decay_error(0.000625, 0.8);
  EXPECT_LT(fine, 1e-7);
  EXPECT_GT(fine, 1e-9);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.15);
}

TEST(believed_change, is_all_of_a_small_change_and_fades_beyond) {
  EXPECT_NEAR(believed_change(1e-4, 1.0) / 1e-4, 1, 1e-5);
  EXPECT_NEAR(believed_change(0.05, 1.0), 0.025, 1e-15);
  EXPECT_LT(believed_change(0.5, 1.0), 0.006);
  EXPECT_EQ(believed_change(-0.05, 1.0), -believed_change(0.05, 1.0));
}

}  // namespace
}  // namespace livebed::flow
