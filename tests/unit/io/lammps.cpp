#include "io/lammps.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "expect_fault.hpp"
#include "temporary_folder.hpp"

namespace livebed::io {
namespace {

grains::State some_grains() {
  grains::State s;
  s.id = {2, 0, 1};
  s.x = {0.1 / 3, 0, 0.0999999};
  s.y = {0.01 / 7, 0.002, 0.003};
  s.u = {1e-300, -0.1, 0.2 / 3};
  s.v = {0, 1.0 / 3, -2};
  s.omega = {-31.4159, 0, 1e-9};
  s.diameter = {0.002 / 1.1, 0.002, 0.0021};
  return s;
}

constexpr const char* head = "a bed\n\n2 atoms\n1 atom types\n\n-0.1 0.1 xlo xhi\n0 1 ylo yhi\n-1 1 zlo zhi\n\n";

TEST(lammps, a_bed_written_and_read_has_the_same_bits) {
  const TemporaryFolder folder;
  const grains::State s = some_grains();
  grains::Params p;
  p.length = 0.1;
  p.density = 2650.5;
  write_lammps(folder / "bed.data", p, s, 0.05);
  const LammpsBed bed = read_lammps(folder / "bed.data");
  EXPECT_EQ(bed.length, 0.1);
  ASSERT_EQ(bed.x.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t id = static_cast<std::size_t>(s.id[k]);
    EXPECT_EQ(bed.x[id], s.x[k]);
    EXPECT_EQ(bed.y[id], s.y[k]);
    EXPECT_EQ(bed.u[id], s.u[k]);
    EXPECT_EQ(bed.v[id], s.v[k]);
    EXPECT_EQ(bed.omega[id], s.omega[k]);
    EXPECT_EQ(bed.diameter[id], s.diameter[k]);
    EXPECT_EQ(bed.density[id], 2650.5);
  }
}

TEST(lammps, what_others_write_is_read) {
  const TemporaryFolder folder;
  write_atomically(
      folder / "bed.data",
      std::string(head) +
          "Pair Coeffs # granular\n\n1 5500 0.3\n\nAtoms  # sphere\n\n7 1 2e-3 2500 0.1 4e-3 0.0 0 0 0\n"
          "3 2 1e-3 2600 -0.05 1e-3 1e-10 0 -1 0  # a comment\r\n\nVelocities\n\n3 1 2 0 0 0 -4\n7 0 0 0 0 0 0\n");
  const LammpsBed bed = read_lammps(folder / "bed.data");
  EXPECT_EQ(bed.length, 0.2);
  ASSERT_EQ(bed.x.size(), 2u);  // in the order of their ids
  EXPECT_NEAR(bed.x[0], 0.05, 1e-16);
  EXPECT_EQ(bed.x[1], 0.0);  // the upper end of a periodic box is its lower one
  EXPECT_EQ(bed.diameter[0], 1e-3);
  EXPECT_EQ(bed.u[0], 1.0);
  EXPECT_EQ(bed.omega[0], -4.0);
}

TEST(lammps, what_is_no_bed_is_told_with_its_line) {
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& atoms, std::initializer_list<std::string> words) {
    write_atomically(folder / "bed.data", head + atoms);
    expect_io_fault([&] { read_lammps(folder / "bed.data"); }, words);
  };
  expect("", {"bed.data is no LAMMPS data file of grains"});
  expect("Atoms\n\n1 1 2e-3 2500 0 1e-3 0\n", {"bed.data holds 1 atoms and tells of 2"});
  expect("Atoms\n\n1 1 2e-3 2500 0 1e-3\n", {"bed.data:12: 6 numbers; atom_style sphere has 7"});
  expect("Atoms\n\n1 1 2e-3 2500 0 high 0\n", {"bed.data:12: y = \"high\" is not a number"});
  expect("Atoms\n\n1 1 0 2500 0 1e-3 0\n", {"bed.data:12: diameter = 0 m"});
  expect("Atoms\n\n1 1 2e-3 2500 0 1e-3 1e-3\n", {"bed.data:12: z = 0.001 m", "plane z = 0"});
  expect("Atoms\n\n1 1 2e-3 2500 0 -1e-3 0\n", {"bed.data:12: y = -0.001 m"});
  expect("Atoms\n\n1 1 2e-3 2500 0 1e-3 0\n1 1 2e-3 2500 0 3e-3 0\n", {"bed.data:13: the id 1 comes twice"});
  expect("Atoms\n\n1 1 2e-3 2500 0 1e-3 0\n2 1 2e-3 2500 0.3 1e-3 0\n", {"atom 2 at x = 0.3 m lies outside the box"});
  expect("Atoms\n\n1 1 2e-3 2500 0 1e-3 0\n2 1 2e-3 2500 0 3e-3 0\n\nVelocities\n\n5 0 0 0 0 0 0\n",
         {"bed.data:17: velocity of atom 5"});
}

}  // namespace
}  // namespace livebed::io
