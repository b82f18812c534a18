#include "io/paraview.hpp"

#include "base/fault.hpp"

namespace livebed::io {

extern const std::string_view paraview_script;  // made of the file when the program is built

std::string paraview_state(const Path& run) {
  constexpr std::string_view mark = "{folder of the run}";
  std::string folder;
  for (char c : std::filesystem::absolute(run).lexically_normal().string()) {
    if (c == '\\' || c == '"') folder += '\\';
    folder += c;
  }
  std::string text(paraview_script);
  const std::size_t at = text.find(mark);
  if (at == text.npos) base::fail(base::Exit::internal, "python/paraview-state.py has lost its {}", mark);
  return text.replace(at, mark.size(), folder);
}

}  // namespace livebed::io
