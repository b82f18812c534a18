#include "run/execute.hpp"

#include <gtest/gtest.h>

namespace livebed::run {
namespace {

TEST(thread_advice, is_given_to_large_cases_on_one_of_several_cores) {
  EXPECT_NE(thread_advice(600'000, 1, 4).find("--threads 4 "), std::string::npos);
  EXPECT_EQ(thread_advice(600'000, 1, 1), "");
  EXPECT_EQ(thread_advice(600'000, 2, 4), "");
  EXPECT_EQ(thread_advice(20'000, 1, 4), "");
}

}  // namespace
}  // namespace livebed::run
