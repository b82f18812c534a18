#include "validate/run_table.hpp"

#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "validate/result.hpp"

using namespace livebed::validate;

namespace {

RunTable table() { return {"depths", "seed,t_s,S_over_D"}; }

}  // namespace

TEST(run_table, keeps_other_runs_of_a_file_and_replaces_its_own) {
  RunTable first = table();
  first.add(3, "commit c", "3,0,0.1\n3,1,0.2\n");
  first.add(1, "commit a", "1,0,0.3\n");
  const std::string file = first.text();
  EXPECT_EQ(file, "# depths\n# seed 1: commit a\n# seed 3: commit c\nseed,t_s,S_over_D\n1,0,0.3\n3,0,0.1\n3,1,0.2\n");

  RunTable second = table();
  second.add(2, "commit b", "2,0,0.4\n");
  second.add(3, "commit d", "3,0,0.5\n");
  second.keep(file, "a file");
  EXPECT_TRUE(second.has(1));
  EXPECT_EQ(second.text(),
            "# depths\n# seed 1: commit a\n# seed 2: commit b\n# seed 3: commit d\nseed,t_s,S_over_D\n1,0,0.3\n"
            "2,0,0.4\n3,0,0.5\n");
}

TEST(run_table, names_the_line_that_is_wrong) {
  const auto why = [](const char* file) {
    try {
      table().keep(file, "file.csv");
    } catch (const livebed::base::Fault& fault) {
      return std::string(fault.what());
    }
    return std::string();
  };
  EXPECT_NE(why("# seed 1: a\nseed,t_s,y\n").find("file.csv, line 2"), std::string::npos);
  EXPECT_NE(why("# seed 1: a\nseed,t_s,S_over_D\n2,0,0\n").find("file.csv, line 3"), std::string::npos);
  EXPECT_NE(why("# seed 1: a\nseed,t_s,S_over_D\nx,0,0\n").find("file.csv, line 3"), std::string::npos);
  EXPECT_EQ(why("# seed 1: a\nseed,t_s,S_over_D\n1,0,0\n"), "");
}

TEST(result, rows_survive_the_file) {
  Row judged{"mao seed 2: rms", 0.05, "-", 0, 0.07, "Mao", "case 1"}, told{"mao seed 2: wall time", 3, "h"};
  judged.commit = told.commit = "abc", judged.seconds = 7;
  const std::string text = to_json({{judged, told}, {}});
  EXPECT_EQ(to_json({rows_of_json(text, "file"), {}}), text);
  EXPECT_THROW(rows_of_json("{\"a\": 1}", "file"), livebed::base::Fault);
}
