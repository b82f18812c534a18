#pragma once
#include <cstddef>

#include "base/aligned.hpp"
#include "grains/state.hpp"

namespace livebed::grains {

/// A number for every slot of the lists of neighbours, in double or in single precision.
class SlotArray {
public:
  bool single() const { return single_; }
  /// From now on in this precision.  When it is another one the numbers are gone, and so is their memory.
  void set_single(bool single) {
    if (single == single_) return;
    doubles_ = Array(), singles_ = base::AlignedVector<float>();
    single_ = single;
  }

  std::size_t size() const { return single_ ? singles_.size() : doubles_.size(); }
  bool empty() const { return size() == 0; }
  double operator[](std::ptrdiff_t slot) const { return single_ ? singles_[slot] : doubles_[slot]; }
  void set(std::ptrdiff_t slot, double value) {
    if (single_)
      singles_[slot] = static_cast<float>(value);
    else
      doubles_[slot] = value;
  }

  /// Calls body(vector) with the one that is in use.
  template <class Body>
  void visit(Body&& body) {
    if (single_)
      body(singles_);
    else
      body(doubles_);
  }
  /// The numbers; Number is double or float, whichever is in use.
  template <class Number>
  Number* data() {
    if constexpr (sizeof(Number) == sizeof(double))
      return doubles_.data();
    else
      return singles_.data();
  }

  Array doubles() const { return single_ ? Array(singles_.begin(), singles_.end()) : doubles_; }
  void assign(const Array& values) {
    visit([&](auto& a) { a.assign(values.begin(), values.end()); });
  }
  bool operator==(const SlotArray&) const = default;

private:
  bool single_ = false;
  Array doubles_;
  base::AlignedVector<float> singles_;
};

}  // namespace livebed::grains
