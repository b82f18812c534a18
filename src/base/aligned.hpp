#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace livebed::base {

/// Allocator that starts every array on a cache line, so that vector loads of whole slices are aligned, and large
/// arrays on huge pages where the system has them: a walk down the columns of a field then does not miss the page
/// tables.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    if (bytes < huge_page) return static_cast<T*>(::operator new (bytes, std::align_val_t{cache_line}));
    auto* start = static_cast<char*>(::operator new (bytes + spread, std::align_val_t{huge_page}));
#if defined(__linux__)
    ::madvise(start, bytes + spread, MADV_HUGEPAGE);  // advice: nothing is wrong when it is not taken
#endif
    return reinterpret_cast<T*>(start + offset());
  }
  void deallocate(T* p, std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    if (bytes < huge_page) return ::operator delete (p, std::align_val_t{cache_line});
    char* start = reinterpret_cast<char*>(reinterpret_cast<std::uintptr_t>(p) / huge_page * huge_page);
    ::operator delete (start, std::align_val_t{huge_page});
  }
  template <class U>
  bool operator==(const AlignedAllocator<U>&) const {
    return true;
  }

private:
  static constexpr std::size_t cache_line = 64, huge_page = std::size_t{1} << 21, spread = std::size_t{1} << 17;
  /// Arrays that all began on a page of 2 MiB would fight for the same sets of the caches: each begins elsewhere in it.
  static std::size_t offset() {
    static std::atomic<unsigned> count{0};
    return (count.fetch_add(1, std::memory_order_relaxed) * std::size_t{37} * 4160) % spread / cache_line * cache_line;
  }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace livebed::base
