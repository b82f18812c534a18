#include "io/table.hpp"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "expect_fault.hpp"
#include "file_size_limit.hpp"
#include "temporary_folder.hpp"

namespace livebed::io {
namespace {

const std::vector<std::string> columns{"time_s", "S_over_D"};

TEST(table, numbers_read_back_to_the_bit) {
  const TemporaryFolder folder;
  std::mt19937_64 random(7);
  std::vector<double> values{0.1, 1.0 / 3, -0.0, 5e-324, std::numeric_limits<double>::max(), 1e22, INFINITY, NAN};
  while (values.size() < 500) {
    const std::uint64_t bits = random();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) values.push_back(value);
  }
  TableWriter out(folder / "series.csv", columns);
  for (std::size_t n = 0; n < values.size(); n += 2) out.row(std::span(values).subspan(n, 2));
  const Table table = read_table(folder / "series.csv");
  ASSERT_EQ(table.rows(), values.size() / 2);
  for (std::size_t n = 0; n < values.size(); ++n) {
    const double back = table.columns[n % 2][n / 2];
    EXPECT_TRUE(std::memcmp(&back, &values[n], sizeof back) == 0 || (std::isnan(back) && std::isnan(values[n])))
        << values[n];
  }
}

TEST(table, every_row_is_on_disk_at_once) {
  const TemporaryFolder folder;
  TableWriter out(folder / "series.csv", columns);
  out.row(std::vector<double>{0.5, 2});
  EXPECT_EQ(read_file(folder / "series.csv"), "time_s,S_over_D\n0.5,2\n");
  EXPECT_EQ(out.offset(), 22u);
}

TEST(table, continuing_at_an_offset_gives_the_bytes_of_an_unbroken_run) {
  const TemporaryFolder folder;
  const auto row = [](int n) { return std::vector<double>{0.1 * n, std::sqrt(n)}; };
  std::uint64_t offset = 0;
  {
    TableWriter out(folder / "series.csv", columns);
    for (int n = 0; n < 9; ++n) {
      if (n == 5) offset = out.offset();
      out.row(row(n));
    }
  }
  {
    TableWriter out(folder / "series.csv", columns, offset);
    EXPECT_EQ(out.offset(), offset);
    for (int n = 5; n < 12; ++n) out.row(row(n));
  }
  TableWriter unbroken(folder / "unbroken.csv", columns);
  for (int n = 0; n < 12; ++n) unbroken.row(row(n));
  EXPECT_EQ(read_file(folder / "series.csv"), read_file(folder / "unbroken.csv"));
}

TEST(table, a_file_that_is_not_the_one_of_the_checkpoint_is_refused) {
  const TemporaryFolder folder;
  { TableWriter(folder / "a.csv", columns).row(std::vector<double>{1, 2}); }
  expect_io_fault([&] { TableWriter(folder / "a.csv", {"time_s"}, 16); }, {"a.csv", "columns"});
  expect_io_fault([&] { TableWriter(folder / "a.csv", columns, 500); }, {"a.csv", "500"});
  expect_io_fault([&] { TableWriter(folder / "a.csv", columns, 17); }, {"a.csv", "17"});
  expect_io_fault([&] { TableWriter(folder / "none.csv", columns, 17); }, {"none.csv"});
}

TEST(table, full_disks_are_reported) {
  const TemporaryFolder folder;
  expect_io_fault([] { TableWriter("/dev/full", columns); }, {"/dev/full", "No space left"});
  TableWriter out(folder / "a.csv", columns);
  const FileSizeLimit full(40);
  expect_io_fault(
      [&] {
        for (int n = 0; n < 10; ++n) out.row(std::vector<double>{1.25, 2.5});
      },
      {"a.csv", "write"});
}

TEST(table, reads_comments_and_leaves_out_a_row_being_written) {
  const Table table = parse_table("# source: x\n#second\nt_s, y\n1,2\n\n 3 , 4e-1\r\n5", "text");
  EXPECT_EQ(table.comments, (std::vector<std::string>{"source: x", "second"}));
  EXPECT_EQ(table.names, (std::vector<std::string>{"t_s", "y"}));
  EXPECT_EQ(table.column("y"), (std::vector<double>{2, 0.4}));
  EXPECT_EQ(parse_table("a,b\n1,2", "text").rows(), 1u);
  EXPECT_TRUE(table.has("t_s"));
  EXPECT_FALSE(table.has("t"));
}

TEST(table, faults_name_line_and_column) {
  expect_io_fault([] { parse_table("a,b\n1,2\n3,x\n", "t.csv"); }, {"t.csv:3", "b", "x"});
  expect_io_fault([] { parse_table("a,b\n1,2,3\n", "t.csv"); }, {"t.csv:2", "3 values for 2"});
  expect_io_fault([] { parse_table("a,b\n1\n2,3\n", "t.csv"); }, {"t.csv:2"});
  expect_io_fault([] { parse_table("# only\n", "t.csv"); }, {"t.csv", "header"});
  expect_io_fault([] { parse_table("a,b\n1,2\n", "t.csv").column("c"); }, {"t.csv", "no column c", "a, b"});
}

}  // namespace
}  // namespace livebed::io
