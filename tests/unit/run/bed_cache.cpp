#include "run/bed_cache.hpp"

#include <fstream>
#include <gtest/gtest.h>

#include "../io/temporary_folder.hpp"
#include "case/read.hpp"

namespace livebed::run {
namespace {

namespace fs = std::filesystem;

const casefile::Case& small_case() {
  static const casefile::Case c =
      casefile::read_case(LIVEBED_SOURCE_DIR "/cases/quick",
                          {"preset=livebed", "mesh.length=0.1", "mesh.height=0.06", "pipe.x=0.04", "bed.count=120"});
  return c;
}

/// A cache in a folder of its own and what it said.
class Cache : public testing::Test {
protected:
  grains::Packing get(const std::string& key, std::uintmax_t limit = BedCache::most_bytes) {
    said.clear();
    const BedCache cache(
        folder(), [this](const std::string& line) { said += line + "\n"; }, limit);
    return cache.get(key, small_case().grains, [this] {
      ++packed;
      return grains::pack(small_case().grains);
    });
  }
  fs::path folder() const { return root / "cache"; }
  fs::path file_of(const std::string& key) const { return BedCache(folder()).file_of(key); }
  void expect_said(const std::string& words) const { EXPECT_NE(said.find(words), std::string::npos) << said; }

  TemporaryFolder root;
  int packed = 0;
  std::string said;
};

TEST_F(Cache, gives_the_bed_that_was_packed_and_it_goes_on_with_the_same_bits) {
  grains::Packing first = get("a"), second = get("a");
  EXPECT_EQ(packed, 1);
  expect_said("taken from " + file_of("a").string());
  ASSERT_EQ(first.convergence.size(), second.convergence.size());
  EXPECT_EQ(first.convergence.back().mean_speed, second.convergence.back().mean_speed);
  for (grains::Packing* packing : {&first, &second}) {
    packing->bed.state.u[7] += 0.1;
    grains::advance(packing->bed, 500);
  }
  EXPECT_TRUE(first.bed.state.x == second.bed.state.x && first.bed.state.omega == second.bed.state.omega);
  EXPECT_TRUE(first.bed.contacts.spring == second.bed.contacts.spring);
  EXPECT_EQ(first.bed.steps, second.bed.steps);
}

TEST_F(Cache, passes_over_files_that_are_damaged_or_of_another_case) {
  get("a");
  fs::copy_file(file_of("a"), file_of("b"));
  get("b");
  EXPECT_EQ(packed, 2);
  expect_said("holds the bed of another case; packing the bed anew");
  get("b");
  EXPECT_EQ(packed, 2);
  std::fstream(file_of("b"), std::ios::in | std::ios::out | std::ios::binary).seekp(5000).write("scratch", 7);
  get("b");
  EXPECT_EQ(packed, 3);
  expect_said("packing the bed anew");
  std::ofstream(file_of("b")) << "no bed";
  get("b");
  EXPECT_EQ(packed, 4);
  get("b");
  EXPECT_EQ(packed, 4);
}

TEST_F(Cache, stays_below_its_limit_and_forgets_what_was_used_least_recently) {
  get("a");
  const std::uintmax_t size = fs::file_size(file_of("a"));
  get("b");
  std::ofstream(folder() / "mine.txt") << "not a bed";
  fs::last_write_time(file_of("b"), fs::file_time_type::clock::now() - std::chrono::hours(1));
  get("c", size + 140000);  // room for two: more is reckoned for a bed than its file has
  EXPECT_TRUE(fs::exists(file_of("a")));
  EXPECT_FALSE(fs::exists(file_of("b")));
  EXPECT_TRUE(fs::exists(file_of("c")));
  EXPECT_TRUE(fs::exists(folder() / "mine.txt"));
  get("d", 1000);
  expect_said("the bed is not kept");
  EXPECT_FALSE(fs::exists(file_of("d")));
}

TEST_F(Cache, that_cannot_be_written_stops_nobody) {
  std::ofstream(folder()) << "a file where the folder should be";
  EXPECT_EQ(get("a").bed.state.count(), 120);
  expect_said("the bed is not kept");
}

TEST(packing_key, knows_what_decides_a_bed_and_nothing_else) {
  const std::string text = "[current]\ntheta = 0.25\n";
  const auto key = [&](const std::vector<std::string>& overrides) {
    return packing_key(casefile::read_text(text, "key.toml", overrides));
  };
  for (const char* same : {"current.theta=0.3", "pipe.x=0.22", "time.end=1", "case.title=other", "mesh.cell_y=0.002"})
    EXPECT_EQ(key({}), key({same})) << same;
  for (const char* other : {"bed.seed=2", "bed.thickness=0.051", "grains.density=2600", "contact.friction=0.5",
                            "time.grain_step=9e-6", "mesh.length=0.6", "flow.density=1001", "bed.start=lattice"})
    EXPECT_NE(key({}), key({other})) << other;
}

}  // namespace
}  // namespace livebed::run
