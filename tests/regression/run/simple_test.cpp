#include "io/table.hpp"
#include "same_run.hpp"

/// Runs with the paper's algorithm.
namespace livebed {
namespace {

using RunWithSimple = Program;

TEST_F(RunWithSimple, goes_on_bit_for_bit_and_tells_its_residuals) {
  for (const std::string closure : {"k_epsilon", "k_omega_sst"}) {
    const std::string words = " --set flow.algorithm=simple --set flow.max_step=0.005 --set flow.closure=" + closure,
                      out = "whole_" + closure, parts = "parts_" + closure;
    ASSERT_EQ(run("--threads 1 " + small_run("0.06", out + words)).exit, 0);
    EXPECT_EQ(run("--threads 2 " + small_run("0.06", parts + " --wall-limit 1e-6" + words)).exit, 6);
    EXPECT_EQ(run("--threads 2 resume " + parts + " --quiet --wall-limit 0.05").exit, 6);
    EXPECT_EQ(run("--threads 1 resume " + parts + " --quiet").exit, 0);
    expect_same_run(*this / out, *this / parts);
    const io::Table series = io::read_table(*this / (out + "/series.csv"));
    for (double residual : series.column("mass_residual")) EXPECT_LT(residual, 0.01);
    for (double step : series.column("flow_step_s")) EXPECT_NEAR(step, 0.005, 1e-4);
    EXPECT_NE(content(*this / (out + "/log.txt")).find(" outer iterations, residuals Ux "), std::string::npos);
  }
}

TEST_F(RunWithSimple, finds_the_steady_flow_in_the_spin_up) {
  const std::string start =
      " --set bed.count=0 --set coupling.mode=none --set time.spin_up=0.1 --set flow.steady=true"
      " --set flow.algorithm=simple --set flow.outer_iterations=300";
  ASSERT_EQ(run(small_run("0.1", "steady", start)).exit, 0);
  // Once converged, a step needs one outer iteration.
  EXPECT_NE(content(*this / "steady/log.txt").find(": 1 outer iterations"), std::string::npos);
}

}  // namespace
}  // namespace livebed
