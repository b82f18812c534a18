#include "io/hdf5.hpp"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>

#include "expect_fault.hpp"
#include "file_size_limit.hpp"
#include "temporary_folder.hpp"

namespace livebed::io {
namespace {

base::Field numbered_field(int nx, int ny) {
  base::Field f(nx, ny, 2);
  for (int j = -2; j < ny + 2; ++j)
    for (int i = -2; i < nx + 2; ++i) f(i, j) = std::sin(i + 100.0 * j);
  return f;
}

void write_sample(const Path& path, double first = 1.5) {
  Hdf5Writer file(path);
  Group root = file.root();
  root.write("clock", first);
  root.write("doubles", std::vector<double>{0.1, -0.0, std::numeric_limits<double>::denorm_min(), NAN});
  root.write("floats", std::vector<float>{0.1f, 3e38f});
  root.write("ids", std::vector<std::int32_t>{-1, 2147483647});
  root.write("steps", std::int64_t{-9007199254740993});
  root.write("random", std::vector<std::uint64_t>{18446744073709551615u, 1u});
  root.write("title", std::string("Mao, \xC2\xB0"));
  root.write("empty", std::vector<double>{});
  root.write_attribute("version", std::int32_t{3});
  root.write_attribute("program", std::string("livebed"));
  Group flow = root.make("flow");
  flow.write("u", numbered_field(13, 5));
  flow.make("load").write("beta", std::vector<double>(1000, 0.25));
  file.save();
}

TEST(hdf5, everything_reads_back_to_the_bit) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const Hdf5Reader file(folder / "a.h5");
  const Group root = file.root();
  double clock = 0;
  root.read("clock", clock);
  EXPECT_EQ(clock, 1.5);
  std::vector<double> doubles;
  root.read("doubles", doubles);
  const std::vector<double> expected{0.1, -0.0, std::numeric_limits<double>::denorm_min(), NAN};
  ASSERT_EQ(doubles.size(), 4u);
  EXPECT_EQ(std::memcmp(doubles.data(), expected.data(), sizeof(double) * 4), 0);
  base::AlignedVector<float> floats;
  root.read("floats", floats);
  EXPECT_EQ(floats[1], 3e38f);
  std::vector<std::int32_t> ids;
  root.read("ids", ids);
  EXPECT_EQ(ids, (std::vector<std::int32_t>{-1, 2147483647}));
  std::int64_t steps = 0;
  root.read("steps", steps);
  EXPECT_EQ(steps, -9007199254740993);
  std::vector<std::uint64_t> random;
  root.read("random", random);
  EXPECT_EQ(random, (std::vector<std::uint64_t>{18446744073709551615u, 1u}));
  std::string title;
  root.read("title", title);
  EXPECT_EQ(title, "Mao, \xC2\xB0");
  doubles.assign(7, 1.0);
  root.read("empty", doubles);
  EXPECT_TRUE(doubles.empty());
  EXPECT_EQ(root.read_attribute<std::int32_t>("version"), 3);
  EXPECT_EQ(root.read_text_attribute("program"), "livebed");
  EXPECT_EQ(root.open("flow").open("load").length("beta"), 1000u);
  EXPECT_TRUE(root.has("flow"));
  EXPECT_FALSE(root.has("grains"));
}

TEST(hdf5, a_field_keeps_its_ghosts) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const Hdf5Reader file(folder / "a.h5");
  base::Field u(13, 5, 2);
  file.root().open("flow").read("u", u);
  const base::Field expected = numbered_field(13, 5);
  for (int j = -2; j < 7; ++j)
    for (int i = -2; i < 15; ++i) ASSERT_EQ(u(i, j), expected(i, j)) << i << ' ' << j;
}

TEST(hdf5, missing_wrong_size_and_wrong_type_name_file_and_dataset) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const Hdf5Reader file(folder / "a.h5");
  const Group root = file.root(), flow = root.open("flow");
  double clock = 0;
  std::vector<double> three(3);
  expect_io_fault([&] { root.read("absent", clock); }, {"a.h5", "absent", "missing"});
  expect_io_fault([&] { root.open("absent"); }, {"a.h5", "absent", "missing"});
  expect_io_fault([&] { root.read("doubles", std::span<double>(three)); }, {"a.h5", "doubles", "4", "3"});
  expect_io_fault([&] { root.read("steps", clock); }, {"a.h5", "steps", "type"});
  expect_io_fault([&] { root.read_attribute<double>("version"); }, {"a.h5", "version"});
  expect_io_fault([&] { root.read_attribute<double>("absent"); }, {"a.h5", "absent"});
  base::Field wide(14, 5, 2);
  expect_io_fault([&] { flow.read("u", wide); }, {"a.h5", "flow/u", "9 x 17", "9 x 18"});
}

TEST(hdf5, files_that_are_no_checkpoint_are_refused) {
  const TemporaryFolder folder;
  expect_io_fault([&] { Hdf5Reader(folder / "absent.h5"); }, {"absent.h5"});
  write_atomically(folder / "text.h5", "this is a text");
  expect_io_fault([&] { Hdf5Reader(folder / "text.h5"); }, {"text.h5", "not a whole checkpoint"});
  write_atomically(folder / "empty.h5", "");
  expect_io_fault([&] { Hdf5Reader(folder / "empty.h5"); }, {"empty.h5"});
}

/// Reads all of the sample; whether that succeeds.  A Fault of another kind than input/output fails the test.
bool reads_whole(const Path& path) {
  try {
    const Hdf5Reader file(path);
    const Group root = file.root();
    double clock;
    std::vector<double> values;
    std::string title;
    base::Field u(13, 5, 2);
    root.read("clock", clock);
    root.read("doubles", values);
    root.read("title", title);
    root.open("flow").read("u", u);
    root.open("flow").open("load").read("beta", values);
    return true;
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), base::Exit::input_output);
    EXPECT_NE(std::string(fault.what()).find(path.filename()), std::string::npos) << fault.what();
    return false;
  }
}

TEST(hdf5, truncation_anywhere_is_noticed) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  const std::string whole = read_file(folder / "a.h5");
  ASSERT_TRUE(reads_whole(folder / "a.h5"));
  for (int part = 0; part < 16; ++part) {
    write_atomically(folder / "cut.h5",
                     std::string_view(whole).substr(0, whole.size() * static_cast<std::size_t>(part) / 16));
    EXPECT_FALSE(reads_whole(folder / "cut.h5")) << part << "/16";
  }
  write_atomically(folder / "cut.h5", std::string_view(whole).substr(0, whole.size() - 1));
  EXPECT_FALSE(reads_whole(folder / "cut.h5"));
}

TEST(hdf5, a_flipped_bit_in_the_numbers_is_noticed) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  std::string whole = read_file(folder / "a.h5");
  const double quarter = 0.25;
  const auto at = whole.find(std::string(reinterpret_cast<const char*>(&quarter), 8) +
                             std::string(reinterpret_cast<const char*>(&quarter), 8));
  ASSERT_NE(at, std::string::npos);
  whole[at + 800] ^= 4;
  write_atomically(folder / "flipped.h5", whole);
  EXPECT_FALSE(reads_whole(folder / "flipped.h5"));
}

TEST(hdf5, full_disk_leaves_the_old_checkpoint_whole) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5", 1.0);
  {
    const FileSizeLimit full(2000);
    expect_io_fault([&] { write_sample(folder / "a.h5", 2.0); }, {"a.h5", "write"});
  }
  double clock = 0;
  Hdf5Reader(folder / "a.h5").root().read("clock", clock);
  EXPECT_EQ(clock, 1.0);
  EXPECT_EQ(folder.files(), 1u);
}

TEST(hdf5, an_unsaved_writer_leaves_nothing_and_a_name_is_used_once) {
  const TemporaryFolder folder;
  {
    Hdf5Writer file(folder / "a.h5");
    Group root = file.root();
    root.write("x", 1.0);
    expect_io_fault([&] { root.write("x", 2.0); }, {"a.h5", "x", "twice"});
  }
  EXPECT_EQ(folder.files(), 0u);
}

TEST(hdf5, the_same_content_gives_the_same_bytes) {
  const TemporaryFolder folder;
  write_sample(folder / "a.h5");
  write_sample(folder / "b.h5");
  EXPECT_EQ(read_file(folder / "a.h5"), read_file(folder / "b.h5"));
}

}  // namespace
}  // namespace livebed::io
