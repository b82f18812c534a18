#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "base/aligned.hpp"

namespace livebed::base {

/// Memory that an arena has given to an array for a while.  A copy of its owner starts without.
template <class T>
class Lease {
public:
  Lease() = default;
  Lease(T* begin, std::size_t size) : begin_(begin), size_(size) {}
  Lease(const Lease&) {}
  Lease(Lease&&) = default;
  Lease& operator=(const Lease&) { return *this = Lease{}; }
  Lease& operator=(Lease&&) = default;

  T& operator[](std::size_t k) { return begin_[k]; }
  const T& operator[](std::size_t k) const { return begin_[k]; }
  T* data() { return begin_; }
  const T* data() const { return begin_; }
  T* begin() { return begin_; }
  T* end() { return begin_ + size_; }
  const T* begin() const { return begin_; }
  const T* end() const { return begin_ + size_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

private:
  T* begin_ = nullptr;
  std::size_t size_ = 0;
};

/// Exchanges two arrays of one size.
template <class T>
void swap(Lease<T>& a, Lease<T>& b) {
  Lease<T> kept = std::move(a);
  a = std::move(b);
  b = std::move(kept);
}

/// One piece of memory that several sets of arrays have in turn: those of one set are dead while another one is used.
class Arena {
public:
  Arena() = default;
  Arena(const Arena&) {}
  Arena(Arena&&) = default;
  Arena& operator=(const Arena&) { return *this = Arena{}; }
  Arena& operator=(Arena&&) = default;

  /// An array that is to have `count` entries of plain data.
  template <class T>
  struct Part {
    Lease<T>& array;
    std::size_t count;
  };

  /// Gives every part its memory, contents undefined.  What was given before is gone.
  template <class... T>
  void divide(Part<T>... parts) {
    const std::size_t bytes = (std::size_t{0} + ... + room(parts.count * sizeof(T)));
    if (memory_.size() < bytes) {
      memory_ = decltype(memory_)();  // the old one goes first
      memory_.resize(bytes + bytes / 32);
    }
    std::byte* next = memory_.data();
    const auto give = [&next](auto& array, std::size_t count, auto* type) {
      using Entry = std::remove_pointer_t<decltype(type)>;
      static_assert(std::is_trivially_copyable_v<Entry>);
      array = Lease<Entry>(reinterpret_cast<Entry*>(next), count);
      next += room(count * sizeof(Entry));
    };
    (give(parts.array, parts.count, static_cast<T*>(nullptr)), ...);
  }

private:
  /// Whole cache lines, and some between arrays: they would fight for the same sets of the caches if their sizes were
  /// multiples of a page.
  static std::size_t room(std::size_t bytes) { return (bytes + 63) / 64 * 64 + 13 * 64; }

  AlignedVector<std::byte> memory_;
};

}  // namespace livebed::base
