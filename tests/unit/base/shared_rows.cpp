#include "base/shared_rows.hpp"

#include <gtest/gtest.h>

namespace livebed::base {
namespace {

TEST(shared_rows, say_what_the_field_says_and_store_equal_rows_once) {
  Field f(7, 5, 2, 1.0);
  f(3, 2) = 0.5, f(6, 4) = 0.25;
  const SharedRows rows(f);
  for (int j = -2; j < 7; ++j)
    for (int i = -2; i < 9; ++i) ASSERT_EQ(rows(i, j), f(i, j)) << i << "," << j;
  EXPECT_EQ(rows.row(0), rows.row(1));
  EXPECT_EQ(rows.row(0), rows.row(3));
  EXPECT_NE(rows.row(0), rows.row(2));
  EXPECT_NE(rows.row(2), rows.row(4));
  EXPECT_TRUE(rows.is_one(-2));
  EXPECT_TRUE(rows.is_one(3));
  EXPECT_FALSE(rows.is_one(2));
  EXPECT_FALSE(rows.is_one(4));
}

TEST(shared_rows, a_ghost_makes_a_row_different) {
  Field f(4, 3, 2, 1.0);
  f(-2, 1) = 2.0;
  const SharedRows rows(f);
  EXPECT_FALSE(rows.is_one(1));
  EXPECT_EQ(rows(-2, 1), 2.0);
}

TEST(shared_rows, rows_of_their_own_are_written_alone) {
  SharedRows rows(6, {0, 1, 0, 1}, 1.0);
  EXPECT_TRUE(rows.owns(1));
  EXPECT_FALSE(rows.owns(2));
  rows.own_row(1)[3] = 5.0;
  EXPECT_EQ(rows(3, 1), 5.0);
  EXPECT_EQ(rows(3, 0), 1.0);
  EXPECT_EQ(rows(3, 3), 1.0);
  const SharedRows copy = rows;
  rows.own_row(1)[3] = 6.0;
  EXPECT_EQ(copy(3, 1), 5.0);
}

}  // namespace
}  // namespace livebed::base
