#pragma once
#include <algorithm>
#include <cassert>

#include "base/aligned.hpp"

namespace livebed::base {

/// Two-dimensional array with a rim of ghost cells, x fastest.  f(i,j) for i in [-ghosts, nx+ghosts), j likewise; rows
/// are padded so that row starts share one alignment.
template <class T>
class FieldOf {
public:
  FieldOf() = default;
  FieldOf(int nx, int ny, int ghosts = 2, T value = T{})
      : nx_(nx),
        ny_(ny),
        ghosts_(ghosts),
        pitch_((nx + 2 * ghosts + lane - 1) / lane * lane),
        data_(static_cast<std::size_t>(pitch_) * (ny + 2 * ghosts), value) {}

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int ghosts() const { return ghosts_; }
  std::ptrdiff_t pitch() const { return pitch_; }

  T& operator()(int i, int j) { return data_[index(i, j)]; }
  const T& operator()(int i, int j) const { return data_[index(i, j)]; }

  /// Pointer to f(0,j); row(j)[i] is f(i,j), ghosts included.
  T* row(int j) { return data_.data() + index(0, j); }
  const T* row(int j) const { return data_.data() + index(0, j); }

  void fill(T value) { std::fill(data_.begin(), data_.end(), value); }
  void swap(FieldOf& other) noexcept { std::swap(*this, other); }

  /// The whole storage, ghosts and padding included (checkpoints).
  AlignedVector<T>& storage() { return data_; }
  const AlignedVector<T>& storage() const { return data_; }

private:
  static constexpr int lane = 64 / sizeof(T);
  std::size_t index(int i, int j) const {
    assert(i >= -ghosts_ && i < nx_ + ghosts_ && j >= -ghosts_ && j < ny_ + ghosts_);
    return static_cast<std::size_t>((j + ghosts_) * pitch_ + i + ghosts_);
  }
  int nx_ = 0, ny_ = 0, ghosts_ = 0;
  std::ptrdiff_t pitch_ = 0;
  AlignedVector<T> data_;
};

using Field = FieldOf<double>;

}  // namespace livebed::base
