#include "run/cost.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

#include "case/read.hpp"
#include "run/simulation.hpp"

namespace livebed::run {
namespace {

casefile::Case small_case(const std::vector<std::string>& more = {}) {
  std::vector<std::string> keys{"mesh.length=0.12", "mesh.height=0.06",  "pipe.x=0.05",
                                "bed.count=500",    "time.spin_up=0.05", "time.end=0.1"};
  for (const std::string& key : more) {
    const std::string name = key.substr(0, key.find('=') + 1);
    std::erase_if(keys, [&](const std::string& old) { return old.starts_with(name); });
    keys.push_back(key);
  }
  return casefile::read_case(LIVEBED_SOURCE_DIR "/cases/quick", keys);
}

TEST(work, counts_what_the_case_asks_for) {
  const casefile::Case c = small_case();
  const Work w = work_of(c);
  EXPECT_EQ(w.grains, 500);
  EXPECT_EQ(w.cells, 60 * 30);
  EXPECT_EQ(w.grain_steps, 5000);
  EXPECT_NEAR(w.held_steps * w.flow_step, 0.05, w.flow_step);
  EXPECT_NEAR(w.flow_steps * w.flow_step, 0.1, w.flow_step);
  EXPECT_NEAR(w.series, 10, 1e-9);
}

TEST(work, of_finer_sand_scales_in_all_its_parts) {
  const Work w = work_of(small_case()), finer = w.scaled(4);
  EXPECT_EQ(finer.grains, 4 * w.grains);
  EXPECT_EQ(finer.cells, 4 * w.cells);
  EXPECT_EQ(finer.flow_steps, 4 * w.flow_steps);
  EXPECT_EQ(finer.grain_steps, 4 * w.grain_steps);
  EXPECT_EQ(finer.frames, w.frames);
}

TEST(prediction, is_the_sum_of_work_times_speed) {
  Work w;
  w.grains = 10, w.packed = 6, w.cells = 100, w.held_steps = 5, w.flow_steps = 20, w.grain_steps = 1000;
  w.series = 7, w.frames = 2, w.checkpoints = 3;
  Speeds s;
  s.packing = 0.5, s.held_flow = 0.01, s.flow = 0.02, s.held_exchange = 0.1, s.exchange = 0.2, s.grain = 0.001;
  s.series = 1, s.frame = 0.01, s.checkpoint = 0.02;
  s.held_step_ratio = 0.5, s.step_ratio = 2, s.cpu = 0.5, s.memory_base = 1000, s.memory = 2;
  const Prediction p = predict(w, s);
  EXPECT_NEAR(p.packing, 3, 1e-12);
  EXPECT_NEAR(p.spin_up, 10 * (1 + 1), 1e-12);
  EXPECT_NEAR(p.flow, 10 * 2, 1e-12);
  EXPECT_NEAR(p.exchange, 10 * 2, 1e-12);
  EXPECT_NEAR(p.grains, 10, 1e-12);
  EXPECT_NEAR(p.output, 7 + 110 * (0.02 + 0.06), 1e-12);
  EXPECT_NEAR(p.wall(), 3 + 20 + 20 + 20 + 10 + 15.8, 1e-12);
  EXPECT_NEAR(p.cpu, 0.5 * p.wall(), 1e-12);
  EXPECT_NEAR(p.memory, 1000 + 220, 1e-12);
  EXPECT_NEAR(p.flow_steps, 20, 1e-12);
}

TEST(timing, of_a_model_finds_every_part_at_work_and_leaves_no_file) {
  const casefile::Case c = small_case();
  const auto temporary = [] {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::temp_directory_path()))
      count += entry.path().filename() == "livebed-plan-" + std::to_string(::getpid());
    return count;
  };
  const Speeds s = time_model(c, 0.3);
  for (double part : {s.packing, s.held_flow, s.flow, s.held_exchange, s.exchange, s.grain, s.series, s.checkpoint})
    EXPECT_GT(part, 0);
  EXPECT_NEAR(s.grains, 500, 5);
  EXPECT_EQ(s.cells, 60 * 30);
  EXPECT_EQ(temporary(), 0);
}

TEST(timing, predicts_the_number_of_flow_steps) {
  const casefile::Case c = small_case();
  Simulation::Start start = Simulation::prepare(c);
  Simulation sim(start.resolved, std::move(start.bed));
  while (sim.time() < 0) sim.spin_up_step();
  sim.release();
  while (sim.time() < c.time.end) sim.step();
  const Prediction p = predict(work_of(c), time_model(c, 5));  // long enough for the whole of it
  const auto steps = static_cast<double>(sim.clock().flow_steps);
  EXPECT_NEAR(p.flow_steps, steps, 0.25 * steps);
}

TEST(timing, works_without_a_pipe_and_without_grains) {
  const Speeds bare = time_model(small_case({"pipe.present=false"}), 0.1);
  EXPECT_GT(bare.grain, 0);
  const Speeds water = time_model(small_case({"bed.count=0", "pipe.present=false"}), 0.1);
  EXPECT_GT(water.flow, 0);
  EXPECT_EQ(water.grain, 0);
  EXPECT_EQ(water.packing, 0);
}

}  // namespace
}  // namespace livebed::run
