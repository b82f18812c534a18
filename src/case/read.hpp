#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "case/case.hpp"

namespace livebed::casefile {

/// The case file a path means: the file itself, or case.toml in a folder.
std::filesystem::path case_file(const std::filesystem::path& path);

/// Reads, checks and completes a case.  Layers: the structs' defaults, the preset's choices, the file's keys, the
/// overrides "table.key=value".  Throws base::Fault: input_output when the file cannot be read, invalid_case with every
/// fault found, each with its place.
Case read_case(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});

/// The same from a text; name stands for the file in the messages.
Case read_text(std::string_view toml, const std::string& name, const std::vector<std::string>& overrides = {});

/// The defaults under a preset: what a file says that only names the preset.  Nothing is derived.
Case preset_case(std::string_view preset);

}  // namespace livebed::casefile
