#pragma once
#include <string_view>

/// What this program was built from; written when it is built.
namespace livebed::base {

std::string_view version();  ///< "0.1.0"
std::string_view commit();   ///< "0786b76d1a2b", with "-dirty" when the tree had changes; "unknown" outside git
/// Digest of all that decides how this build packs a bed besides its case: sources and the compiler's options.
std::string_view packing_code();
std::string_view compiler();  ///< "GNU 12.2.0 -march=native"
/// The level of x86-64 that all but the grain kernels needs ("x86-64-v4"), or the processor's name on other machines.
std::string_view instruction_set();
std::string_view libraries();  ///< those built into the program or linked, "HDF5 1.10.8, fmt 9.1.0, ..."

}  // namespace livebed::base
