#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "case/case.hpp"

/// The case as a run keeps it: every default and every derived number, in SI units.
namespace livebed::casefile {

/// TOML text with every key of the schema and a table [derived]; read_text gives the identical case from it.
std::string resolved_text(const Case& c);

/// Writes that text.  Throws base::Fault (input_output) when the file cannot be written.
void write_resolved(const Case& c, const std::filesystem::path& path);

/// FNV-1a, 64 bits, of the resolved text, as 16 hexadecimal digits: equal cases have equal hashes.  `check` and
/// committed results tell that of the case before its packing.
std::string hash(const Case& c);

/// What two cases were given differently, as "table.key = a, not b"; numbers that follow from others are left out.
std::vector<std::string> differences(const Case& a, const Case& b);

}  // namespace livebed::casefile
