#include "validate/cavity.hpp"

#include <gtest/gtest.h>

namespace livebed::validate {
namespace {

/// The short form of `livebed validate cavity`.
TEST(cavity, follows_ghia_at_reynolds_100) {
  const CavityRun run = run_cavity(100, 64);
  std::printf("Re 100, 64 x 64: largest difference %.4f of the lid speed\n", run.worst);
  EXPECT_LT(run.worst, 0.01);
  EXPECT_GT(run.worst, 1e-4);  // the table has four digits
  ASSERT_EQ(run.u.size(), run.u_ghia.size());
  EXPECT_NEAR(run.u.front(), 1, 1e-12);  // the lid and the floor
  EXPECT_NEAR(run.u.back(), 0, 1e-12);
}

}  // namespace
}  // namespace livebed::validate
