#pragma once
#include <string>

#include "case/schema.hpp"

/// The manual of the case file, made from the schema.
namespace livebed::casefile {

/// "(0, 1]", "hybrid, bounded" or nothing: what a row allows.
std::string allowed(const Row& row);

/// Default of a row under a preset as a case file would write it; "required", "computed" or "from ..." where there is
/// none.
std::string default_of(const Row& row, const std::string& preset);

/// docs/keys.md.
std::string manual_markdown();

/// The listing on a terminal: one key a paragraph of two lines.
std::string manual_text(const std::string& preset);

}  // namespace livebed::casefile
