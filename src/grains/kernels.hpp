#pragma once
#include <string_view>
#include <vector>

#include "grains/contact.hpp"

/// The loops that decide the speed of the grains: the step of a slice and the search for neighbours.  kernels.cpp is
/// compiled once for each instruction set; which one runs is chosen when the program starts.
namespace livebed::grains {

/// Contact forces on the grains of a slice [N]; the torque is twist times the radius.
struct SliceForce {
  double x[lanes], y[lanes], twist[lanes];
};

struct Kernels {
  const char* name;  ///< of the instruction set
  /// One step of the slices [begin, end) of Records::awake, from place and motion to place_next and motion_next or,
  /// back, from these to those.  Returns true when a grain of them is off the leash.
  bool (*step_slices)(const Sweep& k, Contacts& c, Records& r, int begin, int end, bool back);
  /// Forces on a slice that does not move.  What its contacts remember stays as it is.
  void (*push_slice)(const Sweep& k, Contacts& c, Records& r, int slice, SliceForce& force);
  /// Neighbours of the grains of ranks [begin, end) one after the other into `found`, where (end - begin) x
  /// most_neighbours have room, of each grain those close by first; where each begins and their numbers into w, one
  /// more than most_neighbours standing for too many.  Returns how many in all.
  int (*find)(const Cells& cells, const Reach& reach, int begin, int end, ListScratch& w, std::int32_t* found);
};

/// Those in use: the widest this machine has, unless another set was asked for.
const Kernels& kernels();

/// Names of the sets that are built in and run on this machine, widest first: avx512, avx2, plain.
std::vector<std::string_view> kernel_names();

/// From now on the kernels of this set.  Throws Fault (usage) for a name that kernel_names does not give.
void use_kernels(std::string_view name);

}  // namespace livebed::grains
