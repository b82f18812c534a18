#include "base/arena.hpp"

#include <gtest/gtest.h>

using namespace livebed::base;

TEST(arena, gives_apart_and_aligned_memory_and_takes_it_back) {
  Arena arena;
  Lease<double> a, b;
  Lease<char> c;
  arena.divide<double, char, double>({a, 100}, {c, 3}, {b, 50});
  EXPECT_EQ(a.size(), 100u);
  EXPECT_EQ(b.size(), 50u);
  for (const void* begin : {static_cast<void*>(a.data()), static_cast<void*>(b.data())})
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(begin) % 64, 0u);
  std::fill(a.begin(), a.end(), 1.0);
  std::fill(c.begin(), c.end(), 'c');
  std::fill(b.begin(), b.end(), 2.0);
  for (const double value : a) EXPECT_EQ(value, 1.0);
  for (const char value : c) EXPECT_EQ(value, 'c');

  // Another set of no greater size lies in the same memory.
  const double* const before = a.data();
  Lease<int> d;
  arena.divide<int>({d, 10});
  EXPECT_EQ(static_cast<const void*>(d.data()), static_cast<const void*>(before));
}

TEST(arena, copies_start_without_memory) {
  Arena arena;
  Lease<double> a, b;
  arena.divide<double, double>({a, 8}, {b, 8});
  const Lease<double> copy = a;
  EXPECT_TRUE(copy.empty());
  const double *first = a.data(), *second = b.data();
  swap(a, b);
  EXPECT_EQ(a.data(), second);
  EXPECT_EQ(b.data(), first);
  const Arena other = arena;
  a = copy;
  EXPECT_TRUE(a.empty());
}
