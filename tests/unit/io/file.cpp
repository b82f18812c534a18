#include "io/file.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "expect_fault.hpp"
#include "file_size_limit.hpp"
#include "temporary_folder.hpp"

namespace livebed::io {
namespace {

TEST(file, atomic_write_replaces_the_whole_file_and_leaves_no_other) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.txt", "a longer first version");
  write_atomically(folder / "a.txt", std::string("second\0part", 11));
  EXPECT_EQ(read_file(folder / "a.txt"), std::string("second\0part", 11));
  EXPECT_EQ(folder.files(), 1u);
}

TEST(file, full_disk_leaves_the_old_file_and_no_rubbish) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.txt", "old");
  {
    const FileSizeLimit full(1000);
    expect_io_fault([&] { write_atomically(folder / "a.txt", std::string(5000, 'x')); }, {"a.txt", "write"});
  }
  EXPECT_EQ(read_file(folder / "a.txt"), "old");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(file, impossible_places_are_named) {
  const TemporaryFolder folder;
  expect_io_fault([&] { write_atomically(folder / "none/a.txt", "x"); }, {"none/a.txt", "No such file"});
  expect_io_fault([&] { read_file(folder / "absent"); }, {"absent", "No such file"});
  expect_io_fault([&] { read_file(folder.path()); }, {"folder"});
  std::ofstream(folder / "plain") << "x";
  expect_io_fault([&] { make_folder(folder / "plain/below"); }, {"plain/below"});
}

TEST(file, reads_files_whose_size_the_system_does_not_tell) { EXPECT_FALSE(read_file("/proc/self/status").empty()); }

}  // namespace
}  // namespace livebed::io
