#include "io/png.hpp"

#include <string_view>
#include <zlib.h>

#include "base/fault.hpp"

namespace livebed::io {

namespace {

void append_number(std::string& out, std::uint32_t n) {
  for (int shift : {24, 16, 8, 0}) out.push_back(static_cast<char>(n >> shift & 0xff));
}

/// Length, type, data and the CRC-32 of type and data.
void append_chunk(std::string& out, std::string_view type, std::string_view data) {
  append_number(out, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = out.size();
  out.append(type).append(data);
  append_number(out, static_cast<std::uint32_t>(
                         crc32_z(0, reinterpret_cast<const Bytef*>(out.data() + start), out.size() - start)));
}

}  // namespace

std::string png(int width, int height, std::span<const std::uint8_t> rgb) {
  const std::size_t row = 3u * static_cast<std::size_t>(width);
  if (width < 1 || height < 1 || rgb.size() != row * static_cast<std::size_t>(height))
    base::fail(base::Exit::internal, "a picture of {} x {} pixels with {} bytes", width, height, rgb.size());
  // Each row carries a filter; "sub" (difference to the pixel on the left) suits smooth fields.
  std::string raw;
  raw.reserve((row + 1) * static_cast<std::size_t>(height));
  for (int j = 0; j < height; ++j) {
    const std::uint8_t* line = rgb.data() + row * static_cast<std::size_t>(j);
    raw.push_back(1);
    for (std::size_t n = 0; n < row; ++n) raw.push_back(static_cast<char>(line[n] - (n < 3 ? 0 : line[n - 3])));
  }
  uLongf size = compressBound(raw.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(raw.data()), raw.size(),
                6) != Z_OK)
    base::fail(base::Exit::internal, "zlib could not compress a picture of {} bytes", raw.size());
  packed.resize(size);

  std::string header;
  append_number(header, static_cast<std::uint32_t>(width));
  append_number(header, static_cast<std::uint32_t>(height));
  header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, RGB, deflate, standard filters, not interlaced
  std::string out = "\x89PNG\r\n\x1a\n";
  append_chunk(out, "IHDR", header);
  append_chunk(out, "IDAT", packed);
  append_chunk(out, "IEND", "");
  return out;
}

}  // namespace livebed::io
