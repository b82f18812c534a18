#include "run/simulation.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "case/read.hpp"

namespace livebed::run {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// 240 grains under a pipe of 2 cm, packed once.
const Simulation::Start& small_start() {
  static const Simulation::Start start = Simulation::prepare(casefile::read_case(
      LIVEBED_SOURCE_DIR "/cases/quick",
      {"preset=livebed", "mesh.length=0.1", "mesh.height=0.06", "pipe.x=0.04", "bed.count=240", "time.spin_up=0.01"}));
  return start;
}

Simulation small_simulation() { return {small_start().resolved, small_start().bed}; }

Simulation released_simulation() {
  Simulation sim = small_simulation();
  while (sim.time() < 0) sim.spin_up_step();
  sim.release();
  return sim;
}

/// Hands the parts of a simulation to a saboteur.
template <class Change>
void change(Simulation& sim, Change&& what) {
  Simulation::each_part(sim, [&](flow::Solver& flow, grains::Bed& bed, auto&...) { what(flow.state, bed); });
}

template <class Action>
void expect_fault(base::Exit code, Action&& action, const std::vector<std::string>& words) {
  try {
    action();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), code) << fault.what();
    for (const std::string& word : words)
      EXPECT_NE(std::string(fault.what()).find(word), std::string::npos) << word << " is not in: " << fault.what();
  }
}

TEST(simulation, puts_the_pipe_on_the_measured_level) {
  const Simulation::Start& start = small_start();
  const double D = start.resolved.flow.pipe.diameter, level = start.resolved.bed_thickness;
  EXPECT_NEAR(start.resolved.flow.pipe.y, level + 0.5 * D, 1e-12);
  EXPECT_EQ(start.bed.pipe.y, start.resolved.flow.pipe.y);
  EXPECT_NEAR(level, 240 * base::sphere_area(2e-3) / (0.82 * 0.1), 1.5e-3);  // the nominal one within a grain
  ASSERT_FALSE(start.convergence.empty());
  for (std::size_t k = 1; k < start.convergence.size(); ++k)
    EXPECT_GT(start.convergence[k].time, start.convergence[k - 1].time);
  EXPECT_LT(start.convergence.back().mean_speed, 1e-5);
}

TEST(simulation, holds_the_grains_until_the_release) {
  Simulation sim = small_simulation();
  EXPECT_NEAR(sim.time(), -0.01, 1e-15);
  while (sim.time() < 0) sim.spin_up_step();
  EXPECT_TRUE(sim.bed().state.x == small_start().bed.state.x);
  EXPECT_GT(sim.flow_momentum(), 0.0);
  sim.release();
  EXPECT_EQ(sim.time(), 0.0);
  sim.step();
  EXPECT_FALSE(sim.bed().state.x == small_start().bed.state.x);
}

TEST(simulation, moves_the_flow_by_whole_grain_steps_below_the_courant_number) {
  Simulation sim = released_simulation();
  const double grain_step = sim.resolved().grains.step;
  std::int64_t before = 0;
  for (int n = 0; n < 5; ++n) {
    sim.step();
    const auto substeps = static_cast<double>(sim.clock().grain_steps - before);
    before = sim.clock().grain_steps;
    EXPECT_NEAR(sim.last_step(), substeps * grain_step, 1e-15);
    EXPECT_LE(sim.last_report().courant, sim.resolved().flow.courant * (1 + 1e-12));
    EXPECT_GT(sim.last_report().courant, 0.5 * sim.resolved().flow.courant);
    EXPECT_EQ(sim.time(), static_cast<double>(before) * grain_step);
  }
}

TEST(simulation, names_the_cell_and_the_time_of_a_number_that_is_not_finite) {
  for (const int part : {0, 1, 2}) {
    Simulation sim = released_simulation();
    sim.step();
    change(sim, [&](flow::State& s, grains::Bed&) { (part == 0 ? s.u : part == 1 ? s.k : s.p)(31, 20) = nan; });
    const flow::Mesh& m = sim.flow().mesh();
    std::vector<std::string> words = {fmt::format("t = {:.5g} s, flow step {}: ", sim.time(), sim.clock().flow_steps)};
    // Pressure and k reach neighbours before they are found; the velocity is told as it was before the step.
    if (part == 0)
      words.insert(words.end(), {"nan m/s in cell (31,20)", fmt::format("x = {:.4g} m", m.centre_x(31)), "y = "});
    else
      words.insert(words.end(), {"nan", "in cell (", "x = ", "y = "});
    expect_fault(
        base::Exit::diverged, [&] { sim.step(); }, words);
  }
}

TEST(simulation, names_the_grain_and_the_time_of_a_number_that_is_not_finite) {
  casefile::Case alone = small_start().resolved;
  alone.coupling.mode = coupling::Mode::none;  // or the water would be lost first
  Simulation sim(alone, small_start().bed);
  while (sim.time() < 0) sim.spin_up_step();
  sim.release();
  change(sim, [](flow::State&, grains::Bed& bed) { bed.state.u[17] = nan; });
  expect_fault(base::Exit::diverged, [&] { sim.step(); },
               {fmt::format("t = {:.5g} s, flow step {}: ", sim.time(), sim.clock().flow_steps), "grain ", "nan"});
}

TEST(simulation, stops_when_a_grain_is_lost_or_doubled) {
  Simulation doubled = released_simulation();
  change(doubled, [](flow::State&, grains::Bed& bed) {
    bed.state.id[3] = bed.state.id[4];
    bed.contacts.x_built.assign(bed.contacts.x_built.size(), -1);  // ids are looked at when all lists are made anew
  });
  expect_fault(base::Exit::internal, [&] { doubled.step(); }, {"t = 0 s", "doubled"});
  Simulation lost = released_simulation();
  change(lost, [](flow::State&, grains::Bed& bed) { bed.state.x.pop_back(); });
  expect_fault(base::Exit::internal, [&] { lost.step(); }, {"239 entries for 240 grains"});
}

TEST(simulation, takes_a_new_end_whatever_the_case_was_given_by) {
  casefile::Case c = small_start().resolved;
  std::replace(c.given.begin(), c.given.end(), std::string("time.end"), std::string("time.end_over_T"));
  Simulation sim(c, small_start().bed);
  sim.set_end(0.4);
  EXPECT_EQ(sim.resolved().time.end, 0.4);
  EXPECT_TRUE(sim.resolved().is_given("time.end"));
  EXPECT_FALSE(sim.resolved().is_given("time.end_over_T"));
  EXPECT_NEAR(sim.resolved().time.end_over_T * sim.resolved().time_scale, 0.4, 1e-12);
}

TEST(simulation, lets_a_current_rise_that_is_told_to) {
  const Simulation::Start start = Simulation::prepare(casefile::read_case(
      LIVEBED_SOURCE_DIR "/cases/quick", {"preset=livebed", "mesh.length=0.1", "mesh.height=0.06", "pipe.x=0.04",
                                          "bed.count=240", "time.spin_up=0.05", "current.rise=0.1"}));
  Simulation sim(start.resolved, start.bed);
  const double full = start.resolved.flow.current.mean_speed;
  const auto through_inlet = [&] {
    const flow::Mesh& m = sim.flow().mesh();
    double sum = 0;
    for (int j = 0; j < m.ny; ++j) sum += sim.flow().state.u(0, j) * m.aperture_x(0, j) * m.dy(j);
    return sum / (m.height() - start.resolved.bed_thickness) / full;
  };
  while (sim.time() < 0) sim.spin_up_step();
  const double still = through_inlet();
  EXPECT_NEAR(still, 0.1, 0.01);
  sim.release();
  while (sim.time() < 0.05) sim.step();
  const double half = through_inlet();
  EXPECT_NEAR(half / still, 5, 0.1);
  while (sim.time() < 0.12) sim.step();
  EXPECT_NEAR(through_inlet() / still, 10, 1e-6);
}

}  // namespace
}  // namespace livebed::run
