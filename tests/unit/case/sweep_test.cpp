#include "case/sweep.hpp"

#include <gtest/gtest.h>
#include <set>

#include "base/fault.hpp"
#include "case/read.hpp"
#include "case/resolved.hpp"

namespace livebed::casefile {
namespace {

const char* quick = LIVEBED_SOURCE_DIR "/cases/quick";

template <class Action>
void expect_fault(Action&& action, base::Exit code, const std::vector<std::string>& words) {
  try {
    action();
    ADD_FAILURE() << "nothing was thrown";
  } catch (const base::Fault& fault) {
    const std::string told = fault.what();
    EXPECT_EQ(fault.code(), code) << told;
    for (const std::string& word : words) {
      const std::size_t at = told.find(word);
      EXPECT_NE(at, told.npos) << word << " is not in: " << told;
      EXPECT_EQ(told.find(word, at + 1), told.npos) << word << " is told twice: " << told;
    }
  }
}

TEST(sweep, takes_lists_of_values_apart_but_not_the_commas_within_a_value) {
  const auto keys = swept_keys(
      {"current.theta=0.2, 0.3", "grains.grading=\"0.2 mm: 10 %, 0.4 mm: 90 %\",'a,b'", "pipe.diameter=5 cm"});
  ASSERT_EQ(keys.size(), 3u);
  EXPECT_EQ(keys[0].key, "current.theta");
  EXPECT_EQ(keys[0].values, (std::vector<std::string>{"0.2", "0.3"}));
  EXPECT_EQ(keys[1].values, (std::vector<std::string>{"\"0.2 mm: 10 %, 0.4 mm: 90 %\"", "'a,b'"}));
  EXPECT_EQ(keys[2].values, std::vector<std::string>{"5 cm"});
}

TEST(sweep, says_what_is_wrong_with_a_list) {
  using base::Exit;
  expect_fault([] { swept_keys({"current.theta"}); }, Exit::command_line, {"--set current.theta is not"});
  expect_fault([] { swept_keys({"current.theta=0.2,"}); }, Exit::command_line, {"has an empty value"});
  expect_fault([] { swept_keys({"current.theta=0.2,0.2"}); }, Exit::command_line, {"names 0.2 twice"});
  expect_fault([] { swept_keys({"a.b=1", "a.b=2"}); }, Exit::command_line, {"--set a.b is given twice"});
  expect_fault([] { swept_keys({"bed.seed=1,2"}); }, Exit::command_line, {"--seeds 1,2"});
  expect_fault([] { sweep(quick, {}, {1, 2, 1}); }, Exit::command_line, {"--seeds names 1 twice"});
}

TEST(sweep, is_every_combination_with_every_seed) {
  const auto cases =
      sweep(quick, swept_keys({"current.theta=0.2,0.3", "coupling.drag=paper,di_felice,rong", "time.end=2"}), {7, 8});
  ASSERT_EQ(cases.size(), 12u);
  EXPECT_EQ(cases[0].name, "current.theta=0.2,coupling.drag=paper,seed=7");
  EXPECT_EQ(cases[1].name, "current.theta=0.2,coupling.drag=paper,seed=8");
  EXPECT_EQ(cases[11].name, "current.theta=0.3,coupling.drag=rong,seed=8");
  std::set<std::string> names, hashes;
  for (std::size_t n = 0; n < cases.size(); ++n) {
    names.insert(cases[n].name);
    hashes.insert(hash(cases[n].given));
    EXPECT_EQ(cases[n].combination, n / 2);
    EXPECT_EQ(cases[n].given.grains.seed, 7 + n % 2);
    EXPECT_EQ(cases[n].given.theta, n < 6 ? 0.2 : 0.3);
    EXPECT_EQ(cases[n].given.time.end, 2.0);
  }
  EXPECT_EQ(names.size(), 12u);
  EXPECT_EQ(hashes.size(), 12u);
}

TEST(sweep, of_nothing_is_the_case_with_its_own_seed) {
  const auto cases = sweep(quick, {}, {});
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_EQ(cases[0].name, "seed=1");
  EXPECT_EQ(hash(cases[0].given), hash(read_case(quick)));
}

TEST(sweep, names_are_tame_and_differ_even_when_values_look_alike) {
  const auto cases = sweep(quick, swept_keys({"pipe.diameter=2 cm,\"2 cm\",20 mm"}), {});
  ASSERT_EQ(cases.size(), 3u);
  EXPECT_EQ(cases[0].name, "pipe.diameter=2_cm,seed=1");
  EXPECT_EQ(cases[1].name, "pipe.diameter=2_cm,combination-2,seed=1");
  EXPECT_EQ(cases[2].name, "pipe.diameter=20_mm,seed=1");
  std::string many = "case.title=";
  for (int n = 0; n < 3; ++n) many += std::string(n > 0, ',') + std::string(150, static_cast<char>('a' + n));
  EXPECT_EQ(sweep(quick, swept_keys({many}), {})[2].name, "combination-3,seed=1");
}

TEST(sweep, tells_every_fault_of_all_combinations_once) {
  expect_fault(
      [] {
        sweep(quick, swept_keys({"current.theta=0.2,-1", "coupling.drag=paper,papr"}), {1, 2});
      },
      base::Exit::invalid_case, {"current.theta = -1", "coupling.drag = \"papr\"", "did you mean paper"});
}

TEST(sweep, columns_carry_their_units_and_values_are_in_si) {
  const auto cases = sweep(quick, swept_keys({"pipe.diameter=2 cm,25 mm"}), {});
  EXPECT_EQ(column_of("pipe.diameter"), "pipe.diameter_m");
  EXPECT_EQ(column_of("flow.viscosity"), "flow.viscosity_m2_s");
  EXPECT_EQ(column_of("current.theta"), "current.theta");
  EXPECT_EQ(plain_value(cases[1].given, "pipe.diameter"), "0.025");
  EXPECT_EQ(plain_value(cases[1].given, "coupling.drag"), "paper");
}

TEST(sweep, a_case_read_back_from_its_resolved_text_has_no_differences) {
  const Case given = read_case(quick, {"current.mean_speed=0.9"});
  EXPECT_TRUE(differences(given, read_text(resolved_text(given), "kept")).empty());
  const Case other = read_case(quick, {"flow.density=1020"});
  EXPECT_EQ(differences(given, other),
            (std::vector<std::string>{"flow.density = 1000, not 1020", "current.theta = not given, not 0.33",
                                      "current.mean_speed = 0.9, not not given"}));
}

}  // namespace
}  // namespace livebed::casefile
