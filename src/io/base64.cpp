#include "io/base64.hpp"

#include <array>
#include <cstdint>

namespace livebed::io {
namespace {

constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// The six bits of each letter; -1 for what is none.
constexpr std::array<std::int8_t, 256> bits = [] {
  std::array<std::int8_t, 256> all{};
  all.fill(-1);
  for (std::size_t n = 0; n < letters.size(); ++n)
    all[static_cast<std::uint8_t>(letters[n])] = static_cast<std::int8_t>(n);
  return all;
}();

}  // namespace

std::string base64(std::string_view bytes) {
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    std::uint32_t triple = 0;
    for (std::size_t k = 0; k < 3; ++k)
      triple = triple << 8 | (n + k < bytes.size() ? static_cast<std::uint8_t>(bytes[n + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += n + k > bytes.size() ? '=' : letters[triple >> (18 - 6 * k) & 63];
  }
  return out;
}

std::optional<std::string> from_base64(std::string_view text) {
  if (text.size() % 4 != 0) return std::nullopt;
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  std::string out;
  out.reserve(text.size() / 4 * 3);
  for (std::size_t n = 0; n < text.size(); n += 4) {
    std::uint32_t triple = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int8_t six = n + k >= text.size() - padding ? 0 : bits[static_cast<std::uint8_t>(text[n + k])];
      if (six < 0) return std::nullopt;
      triple = triple << 6 | static_cast<std::uint32_t>(six);
    }
    for (int shift : {16, 8, 0}) out += static_cast<char>(triple >> shift & 255);
  }
  out.resize(out.size() - padding);
  return out;
}

}  // namespace livebed::io
