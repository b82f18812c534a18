#include "validate/pipe_current.hpp"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

/// Short form of `livebed validate oner`: half the cells, a short record.
namespace livebed::validate {
namespace {

const Tell silent = [](const std::string&) {};

TEST(pipe_current, sheds_at_a_gap_of_a_third_and_not_when_it_lies_on_the_bed) {
  PipeSetup setup;
  setup.nx = 270, setup.ny = 48;
  setup.spin_up = 60, setup.record = 40;
  const PipeRun run = run_pipe(setup, silent);
  const PipeNumbers n = measure(run);
  std::printf("e/D 0.3: St %.4f, Cd %.4f, box %+.4f, shear ratio %.2f at %.2f D\n", n.strouhal, n.cd,
              run.cd_box / n.cd - 1, n.peak_shear / n.far_shear, n.peak_at);
  EXPECT_NEAR(n.strouhal, 0.255, 0.02);  // body-fitted OpenFOAM: 0.264
  EXPECT_NEAR(n.strouhal_wake, n.strouhal, 0.01);
  EXPECT_NEAR(run.cd_box / n.cd, 1, 0.01);
  EXPECT_NEAR(n.peak_at, 0.1, 0.2);
  EXPECT_NEAR(n.periods, 10, 1);

  setup.gap_ratio = 0;
  const PipeNumbers on_bed = measure(run_pipe(setup, silent));
  std::printf("e/D 0: rms Cl %.5f, eddy %.2f D in front, reattachment %.2f D\n", on_bed.cl_rms, on_bed.eddy_before,
              on_bed.reattachment);
  EXPECT_TRUE(on_bed.steady());
  EXPECT_NEAR(on_bed.eddy_before, 0.7, 0.6);
}

TEST(pipe_current, a_kept_run_is_read_not_repeated) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "livebed-kept-run";
  std::filesystem::remove_all(folder);
  PipeSetup setup;
  setup.nx = 120, setup.ny = 24;
  setup.spin_up = 1, setup.record = 12;
  const PipeRun made = kept_run(setup, folder.string(), silent);
  bool read = false;
  const PipeRun kept = kept_run(setup, folder.string(), [&](const std::string&) { read = true; });
  EXPECT_TRUE(read);
  ASSERT_EQ(kept.t.size(), made.t.size());
  ASSERT_EQ(kept.psi_mean.size(), made.psi_mean.size());
  ASSERT_EQ(kept.section_u[3].size(), made.section_u[3].size());
  for (std::size_t k = 0; k < made.t.size(); ++k) EXPECT_NEAR(kept.drag[k], made.drag[k], 1e-5);
  EXPECT_NEAR(measure(kept).peak_shear, measure(made).peak_shear, 1e-5);
  setup.spin_up = 2;  // another setup of the same name is made anew
  read = false;
  EXPECT_NE(kept_run(setup, folder.string(), [&](const std::string&) { read = true; }).t, made.t);
  EXPECT_FALSE(read);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace livebed::validate
