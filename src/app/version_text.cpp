#include "app/version_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/version.hpp"
#include "grains/kernels.hpp"

namespace livebed::app {

std::string version_text() {
  return fmt::format(
      "livebed {} ({}, {})\n"
      "instruction set {}; grain kernels {} (this machine runs {})\n"
      "built with {}",
      base::version(), base::commit(), base::compiler(), base::instruction_set(), grains::kernels().name,
      fmt::join(grains::kernel_names(), ", "), base::libraries());
}

}  // namespace livebed::app
