#include "base/fault.hpp"
#include "program.hpp"
#include "same_run.hpp"

namespace livebed {
namespace {

class BedCache : public Program {};

TEST_F(BedCache, gives_the_second_run_the_same_bits) {
  const std::string words = "--threads 1 run " + small_case + " --quiet --set time.end=0.05";
  ASSERT_EQ(run(words + " --out first").exit, 0);
  ASSERT_EQ(run(words + " --out second").exit, 0);
  EXPECT_EQ(content(*this / "first/log.txt").find("taken from"), std::string::npos);
  expect_contains(content(*this / "second/log.txt"), {"bed of 500 grains taken from"});
  expect_same_run(*this / "first", *this / "second");
  EXPECT_EQ(content(*this / "first/packing.csv"), content(*this / "second/packing.csv"));
  ASSERT_EQ(run(words + " --no-bed-cache --out third").exit, 0);
  EXPECT_EQ(content(*this / "third/log.txt").find("taken from"), std::string::npos);
  expect_same_run(*this / "first", *this / "third");
}

}  // namespace
}  // namespace livebed
