#pragma once
#include <string_view>

/// What this program was built from; written when it is built.
namespace livebed::base {

std::string_view version();   ///< "0.1.0"
std::string_view commit();    ///< "0786b76d1a2b", with "-dirty" when the tree had changes; "unknown" outside git
std::string_view compiler();  ///< "GNU 12.2.0 -march=native"

}  // namespace livebed::base
