#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace livebed::io {

/// A PNG file (8 bits a channel, RGB, top row first) of width x height pixels; as many bytes as 3 width height.
std::string png(int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace livebed::io
