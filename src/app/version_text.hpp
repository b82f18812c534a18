#pragma once
#include <string>

namespace livebed::app {

/// What `livebed --version` prints: version, commit, compiler, instruction sets, libraries.
std::string version_text();

}  // namespace livebed::app
