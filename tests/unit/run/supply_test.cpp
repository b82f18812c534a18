#include "run/supply.hpp"

#include <gtest/gtest.h>

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
  EXPECT_EQ(std::ssize(ends.waiting), ends.left);
  EXPECT_EQ(sim.bed().state.count() + ends.left, sim.resolved().grains.count);
}

TEST(supply, periodic_sand_goes_round) {
  Simulation sim = released("periodic");
  while (sim.time() < 0.1) sim.step();
  EXPECT_EQ(sim.supply().state().left, 0);
  EXPECT_EQ(sim.bed().state.count(), sim.resolved().grains.count);
}

TEST(supply, equilibrium_feeds_what_passes_the_approach) {
  Simulation sim = released("equilibrium");
  // What passes the stretch, counted here over every step.
  const double from = 0.25 * 0.2, to = 0.5 * 0.2;
  double passed = 0, before = 0;
  std::vector<char> waits(sim.resolved().grains.count, 0);
  while (sim.time() < 0.8) {
    sim.step();
    const grains::State& s = sim.bed().state;
    double sum = 0;
    for (int k = 0; k < s.count(); ++k)
      if (s.x[k] >= from && s.x[k] < to) sum += s.u[k];
    passed += sum / (to - from) * (sim.time() - before);
    before = sim.time();
  }
  const SupplyState& ends = sim.supply().state();
  EXPECT_GT(ends.entered, 3);
  EXPECT_LE(ends.entered, ends.left);
  EXPECT_NEAR(static_cast<double>(ends.entered) + ends.owed, passed, 0.25 * passed);
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
