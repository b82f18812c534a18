#include <algorithm>
#include <cstdlib>

#include "base/fault.hpp"
#include "grains/kernels.hpp"

namespace livebed::grains {

// Those that kernels.cpp has been compiled for.
namespace kernels_avx512 {
extern const Kernels kernels;
}
namespace kernels_avx2 {
extern const Kernels kernels;
}
namespace kernels_plain {
extern const Kernels kernels;
}

namespace {

/// Those that run here, widest first.
const std::vector<const Kernels*>& usable() {
  static const std::vector<const Kernels*> all = [] {
    std::vector<const Kernels*> found;
#if defined(LIVEBED_WIDE_KERNELS)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd"))
      found.push_back(&kernels_avx512::kernels);
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
      found.push_back(&kernels_avx2::kernels);
#endif
    found.push_back(&kernels_plain::kernels);
    return found;
  }();
  return all;
}

const Kernels*& chosen() {
  static const Kernels* set = usable().front();
  return set;
}

}  // namespace

const Kernels& kernels() { return *chosen(); }

std::vector<std::string_view> kernel_names() {
  std::vector<std::string_view> names;
  for (const Kernels* set : usable()) names.emplace_back(set->name);
  return names;
}

void use_kernels(std::string_view name) {
  for (const Kernels* set : usable())
    if (set->name == name) {
      chosen() = set;
      return;
    }
  std::string known;
  for (const Kernels* set : usable()) known += (known.empty() ? "" : ", ") + std::string(set->name);
  base::fail(base::Exit::command_line, "there are no grain kernels \"{}\" for this machine; it runs {}", name, known);
}

}  // namespace livebed::grains
