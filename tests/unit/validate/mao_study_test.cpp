#include "validate/mao_study.hpp"

#include <gtest/gtest.h>
#include <set>

#include "case/read.hpp"
#include "case/resolved.hpp"

using namespace livebed;

TEST(mao_study, each_variant_is_a_case_of_its_own) {
  const validate::Experiment e = validate::study_of_mao();
  ASSERT_GT(e.runs.size(), 10u);
  std::set<std::string> hashes, labels;
  unsigned number = 0;
  for (const validate::MaoRun& run : e.runs) {
    EXPECT_EQ(run.number, ++number);
    const casefile::Case c = casefile::read_text(e.text, run.label, run.keys);
    EXPECT_EQ(c.grains.diameter, 0.7e-3) << run.label;
    hashes.insert(casefile::hash(c)), labels.insert(run.label);
  }
  EXPECT_EQ(hashes.size(), e.runs.size());
  EXPECT_EQ(labels.size(), e.runs.size());
}
