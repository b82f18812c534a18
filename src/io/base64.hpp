#pragma once
#include <optional>
#include <string>
#include <string_view>

/// Bytes as text of the letters A-Z a-z 0-9 + / (RFC 4648), for files that hold text alone.
namespace livebed::io {

std::string base64(std::string_view bytes);
/// The bytes again; nothing when the text has other letters or another length.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace livebed::io
