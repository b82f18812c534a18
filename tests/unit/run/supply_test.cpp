#include "run/supply.hpp"

#include <gtest/gtest.h>

#include "base/math.hpp"
#include "case/read.hpp"
#include "run/simulation.hpp"

namespace livebed::run {
namespace {

/// A flat bed of 800 grains in a current that moves its surface.
Simulation::Start start_with(const std::string& supply) {
  return Simulation::prepare(
      casefile::read_text("preset = \"livebed\"\n"
                          "[mesh]\nlength = 0.2\nheight = 0.05\ncell_x = 0.003\n"
                          "cell_y = 0.0015\n[current]\ntheta = 0.5\n"
                          "[pipe]\npresent = false\n[bed]\nthickness = 0.014\n[grains]\ndiameter = 2e-3\n"
                          "[time]\nspin_up = 0.05\nend = 1\n",
                          "flat", {"bed.supply=" + supply}));
}

Simulation released(const std::string& supply) {
  const Simulation::Start start = start_with(supply);
  Simulation sim(start.resolved, start.bed);
  while (sim.time() < 0) sim.spin_up_step();
  sim.release();
  return sim;
}

TEST(supply, none_lets_sand_out_and_nothing_in) {
  Simulation sim = released("none");
  while (sim.time() < 0.6) sim.step();
  const SupplyState& ends = sim.supply().state();
  EXPECT_GT(ends.left, 3);
  EXPECT_EQ(ends.entered, 0);
  EXPECT_EQ(ends.owed, 0);
  EXPECT_EQ(std::ssize(ends.waiting), ends.left);
  EXPECT_EQ(sim.bed().state.count() + ends.left, sim.resolved().grains.count);
}

TEST(supply, periodic_sand_goes_round) {
  Simulation sim = released("periodic");
  while (sim.time() < 0.1) sim.step();
  EXPECT_EQ(sim.supply().state().left, 0);
  EXPECT_EQ(sim.bed().state.count(), sim.resolved().grains.count);
}

TEST(supply, equilibrium_keeps_the_sand_of_the_approach_within_what_the_current_brings) {
  Simulation sim = released("equilibrium");
  const double end = 0.5 * 0.2, mean = 2e-3;
  const auto in_approach = [&] {  // in mean grains
    const grains::State& s = sim.bed().state;
    double sum = 0;
    for (int k = 0; k < s.count(); ++k) sum += s.x[k] < end ? s.diameter[k] * s.diameter[k] / (mean * mean) : 0.0;
    return sum;
  };
  const double at_release = in_approach();
  std::vector<char> waits(sim.resolved().grains.count, 0);
  const SupplyState& ends = sim.supply().state();
  int enough = 0;
  while (sim.time() < 0.8) {
    const SupplyState before = ends;
    sim.step();
    if (ends.looks == before.looks) continue;
    // What it is owed it lacks; and it is owed nothing, but for the last to enter, while somebody waits.
    const double lacks = at_release - in_approach();
    EXPECT_LE(ends.owed, std::max(0.0, lacks) + 1e-9) << "t = " << sim.time();
    if (ends.owed > 0) {
      EXPECT_EQ(std::ssize(ends.waiting), ends.left - before.left) << "t = " << sim.time();
    }
    enough += ends.owed <= 0 && ends.entered > 3;
  }
  EXPECT_GT(enough, 3);
  // No more than the current brings over a flat bed: 8 (theta - 0.047)^1.5 sqrt((s-1) g d^3) a second.
  const double flux = 8 * std::pow(0.5 - 0.047, 1.5) * std::sqrt(1.65 * 9.81 * mean * mean * mean);
  EXPECT_GT(ends.entered, 3);
  EXPECT_LE(static_cast<double>(ends.entered), sim.time() * flux * mean / (base::pi / 6 * mean * mean * mean) + 1);
  EXPECT_LE(ends.entered, ends.left);
  // Nobody is lost or doubled, in the bed or outside.
  for (const std::int32_t id : ends.waiting) EXPECT_EQ(waits[id]++, 0);
  for (const std::int32_t id : sim.bed().state.id) EXPECT_EQ(waits[id]++, 0);
  EXPECT_EQ(sim.bed().state.count() + std::ssize(ends.waiting), sim.resolved().grains.count);
  // The exchange of impulses still closes.
  const coupling::ImpulseLedger& ledger = sim.coupler().ledger();
  EXPECT_LT(base::norm(ledger.error()), 1e-9 * base::norm(ledger.to_grains));
}

}  // namespace
}  // namespace livebed::run
