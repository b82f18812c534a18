#include "flow/advance.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace livebed::flow {
namespace {

Solver current_past_pipe() {
  Params p;
  p.mesh.length = 0.3, p.mesh.height = 0.15, p.mesh.cell_x = p.mesh.cell_y = 0.0075;
  p.pipe.diameter = 0.05, p.pipe.x = 0.1, p.pipe.y = 0.05;
  p.floor = Wall::rough, p.floor_roughness = 0.001;
  p.current.profile = Profile::rough, p.current.roughness = 0.001, p.current.shear_velocity = 0.04;
  const Mesh m = make_mesh(p.mesh, p.pipe);
  return {p, m, make_boundary(m, p)};
}

/// Every value, ghosts and those beside the unknowns included: a checkpoint holds them all.
void expect_same_state(const State& a, const State& b) {
  const auto same = [](const char* name, const base::Field& x, const base::Field& y) {
    for (int j = -x.ghosts(); j < x.ny() + x.ghosts(); ++j)
      EXPECT_TRUE(std::equal(x.row(j) - x.ghosts(), x.row(j) + x.nx() + x.ghosts(), y.row(j) - y.ghosts()))
          << name << ", row " << j;
  };
  same("u", a.u, b.u), same("v", a.v, b.v), same("p", a.p, b.p), same("p_change", a.p_change, b.p_change);
  same("nut", a.nut, b.nut), same("k", a.k, b.k), same("epsilon", a.epsilon, b.epsilon);
  same("u_old", a.u_old, b.u_old), same("v_old", a.v_old, b.v_old);
  same("k_old", a.k_old, b.k_old), same("epsilon_old", a.epsilon_old, b.epsilon_old);
  same("convection_u", a.convection_u, b.convection_u), same("convection_v", a.convection_v, b.convection_v);
  same("convection_k", a.convection_k, b.convection_k), same("convection_e", a.convection_e, b.convection_e);
}

/// A solver that is given the state of another one, as a run that goes on is: its own scratch is new, and nothing in
/// the state may tell, however few steps it has made.
TEST(advance, goes_on_from_a_state_with_the_same_bits_after_any_number_of_steps) {
  for (const int before : {1, 2, 5}) {
    Solver whole = current_past_pipe();
    whole.start();
    for (int step = 0; step < before; ++step) whole.advance(0.01);
    Solver resumed = current_past_pipe();
    resumed.state = whole.state;
    for (int step = 0; step < 6; ++step) {
      SCOPED_TRACE(::testing::Message() << before << " steps, then " << step + 1);
      whole.advance(0.01);
      resumed.advance(0.01);
      expect_same_state(whole.state, resumed.state);
    }
  }
}

}  // namespace
}  // namespace livebed::flow
