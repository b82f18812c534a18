#include "case/walls.hpp"

#include <gtest/gtest.h>

namespace livebed::casefile {
namespace {

TEST(walls, are_read_line_by_line) {
  const WallsRead read = read_walls("0.1 0.3, 0.1 -1e-3;  2 3,4 5 ,6 7");
  EXPECT_EQ(read.fault, "");
  ASSERT_EQ(read.lines.size(), 2u);
  ASSERT_EQ(read.lines[0].size(), 2u);
  EXPECT_EQ(read.lines[0][1].x, 0.1);
  EXPECT_EQ(read.lines[0][1].y, -1e-3);
  ASSERT_EQ(read.lines[1].size(), 3u);
  EXPECT_EQ(read.lines[1][2].y, 7);
}

TEST(walls, of_no_text_are_none) {
  EXPECT_TRUE(read_walls(" \n").lines.empty());
  EXPECT_EQ(read_walls("").fault, "");
}

TEST(walls, of_bad_text_are_refused) {
  for (const char* text : {"0 1", "0 1, x 2", "0 1 2, 3 4", "0 1, 2 3;", "0 1, 0 1"})
    EXPECT_NE(read_walls(text).fault, "") << text;
}

}  // namespace
}  // namespace livebed::casefile
