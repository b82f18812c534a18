#pragma once
#include <cstdint>
#include <type_traits>
#include <vector>

#include "grains/advance.hpp"
#include "io/hdf5.hpp"

/// A bed in a group of an HDF5 file, complete: read back it goes on with the same bits.  Checkpoints and the cache of
/// packed beds share it.
namespace livebed::run {

/// Writes or reads one scalar: the same list of names serves both ways.
template <class T>
void pass(io::Group& group, const char* name, const T& value) {
  if constexpr (std::is_same_v<T, bool>)
    group.write(name, static_cast<std::int32_t>(value));
  else
    group.write(name, value);
}
template <class T>
void pass(const io::Group& group, const char* name, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    std::int32_t number = 0;
    group.read(name, number);
    value = number != 0;
  } else {
    group.read(name, value);
  }
}

/// Puts the bed into the group.
void write_bed(io::Group& group, const grains::Bed& bed);
/// The bed of complete parameters that write_bed has put there.
grains::Bed read_bed(const io::Group& group, const grains::Params& complete);

}  // namespace livebed::run
