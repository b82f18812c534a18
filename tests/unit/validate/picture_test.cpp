#include "validate/picture.hpp"

#include <gtest/gtest.h>

namespace livebed::validate {
namespace {

int count(const std::string& text, const std::string& word) {
  int n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST(panels, share_one_legend_of_what_is_drawn) {
  const std::vector<double> x = {0, 1};
  report::Chart first{{"x"}, {"y"}, {{"both", "#000000", x, x}, {"never run", "#ff0000", {}, {}, true}}};
  report::Chart second{{"x"}, {"y"}, {{"both", "#000000", x, x}, {"the second alone", "#00ff00", x, x}}};
  second.bands.push_back({"scatter", "#dddddd", x, {0, 0}, {1, 1}});
  const std::string drawn = panels({{"left", first}, {"right", second}}, 2);
  EXPECT_EQ(count(drawn, ">both<"), 1);
  EXPECT_EQ(count(drawn, ">the second alone<"), 1);
  EXPECT_EQ(count(drawn, ">scatter<"), 1);
  EXPECT_EQ(count(drawn, "never run"), 0);
}

TEST(panels, of_one_name_in_two_colours_are_told_apart) {
  const std::vector<double> x = {0, 1};
  const report::Chart red{{"x"}, {"y"}, {{"run", "#ff0000", x, x}}}, blue{{"x"}, {"y"}, {{"run", "#0000ff", x, x}}};
  EXPECT_EQ(count(panels({{"a", red}, {"b", blue}}, 1), ">run<"), 2);
}

}  // namespace
}  // namespace livebed::validate
