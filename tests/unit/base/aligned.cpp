#include "base/aligned.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <set>

namespace livebed::base {
namespace {

TEST(aligned, arrays_of_all_sizes_begin_on_a_cache_line_and_keep_their_values) {
  for (std::size_t n :
       {std::size_t{1}, std::size_t{1000}, std::size_t{1} << 18, (std::size_t{1} << 18) + 1, std::size_t{1} << 20}) {
    AlignedVector<double> a(n, 3.0), b = a;
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(a.data()) % 64, 0u) << n;
    a.back() = 4.0;
    b.swap(a);
    EXPECT_EQ(b.back(), 4.0);
    EXPECT_EQ(a.front(), 3.0);
  }
}

TEST(aligned, large_arrays_begin_at_different_places_of_a_page) {
  std::vector<AlignedVector<double>> arrays;
  std::set<std::uintptr_t> places;
  for (int k = 0; k < 8; ++k) {
    arrays.emplace_back(std::size_t{1} << 18);
    places.insert(reinterpret_cast<std::uintptr_t>(arrays.back().data()) % 4096);
  }
  EXPECT_GE(places.size(), 6u);
}

}  // namespace
}  // namespace livebed::base
