#include "io/vtk_xml.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <zlib.h>

#include "base/fault.hpp"

namespace livebed::io {

using base::Exit;
using base::fail;

namespace {

constexpr std::uint64_t block_size = 1 << 18;     ///< uncompressed bytes a block
constexpr std::uint64_t largest_block = 1 << 24;  ///< that the reader believes
/// Fast compression: the default level takes four times as long for a tenth less.
constexpr int compression_level = 1;

const char* vtk_name(Store store) {
  switch (store) {
    case Store::float32:
      return "Float32";
    case Store::float64:
      return "Float64";
    case Store::int32:
      return "Int32";
  }
  fail(Exit::internal, "unknown storage of an array");
}

template <class T>
std::string packed(const std::vector<double>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  for (std::size_t n = 0; n < values.size(); ++n) {
    const T value = static_cast<T>(values[n]);
    std::memcpy(bytes.data() + n * sizeof(T), &value, sizeof(T));
  }
  return bytes;
}

template <class T>
std::vector<double> unpacked(const std::string& bytes) {
  std::vector<double> values(bytes.size() / sizeof(T));
  for (std::size_t n = 0; n < values.size(); ++n) {
    T value;
    std::memcpy(&value, bytes.data() + n * sizeof(T), sizeof(T));
    values[n] = static_cast<double>(value);
  }
  return values;
}

std::string packed(const DataArray& array) {
  switch (array.store) {
    case Store::float32:
      return packed<float>(array.values);
    case Store::float64:
      return packed<double>(array.values);
    case Store::int32:
      return packed<std::int32_t>(array.values);
  }
  fail(Exit::internal, "unknown storage of an array");
}

void append(std::string& bytes, std::uint64_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

/// vtkZLibDataCompressor: number of blocks, block size, size of a partial last block (0 = none), compressed sizes,
/// blocks.
std::string compressed(const std::string& raw) {
  const std::uint64_t blocks = (raw.size() + block_size - 1) / block_size;
  std::string head, body;
  append(head, blocks);
  append(head, block_size);
  append(head, raw.size() % block_size);
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::size_t from = b * block_size, size = std::min<std::size_t>(block_size, raw.size() - from);
    uLongf length = compressBound(size);
    std::string part(length, '\0');
    if (compress2(reinterpret_cast<Bytef*>(part.data()), &length, reinterpret_cast<const Bytef*>(raw.data() + from),
                  size, compression_level) != Z_OK)
      fail(Exit::internal, "zlib could not compress a block of {} bytes", size);
    append(head, length);
    body.append(part, 0, length);
  }
  return head + body;
}

std::map<std::string, std::string> parse_attributes(std::string_view tag) {
  std::map<std::string, std::string> found;
  while (true) {
    const auto equals = tag.find("=\"");
    if (equals == tag.npos) return found;
    const auto start = tag.find_last_of(" \n\t", equals) + 1;
    const auto end = tag.find('"', equals + 2);
    if (end == tag.npos) return found;
    found.emplace(tag.substr(start, equals - start), tag.substr(equals + 2, end - equals - 2));
    tag.remove_prefix(end + 1);
  }
}

}  // namespace

std::string AppendedWriter::element(const DataArray& array, const std::string& extra) {
  std::string text =
      fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}"{} format="appended" offset="{}"/>)",
                  vtk_name(array.store), array.name, array.components, extra, block_.size());
  block_ += compressed(packed(array));
  return text + "\n";
}

std::string AppendedWriter::file(std::string_view type, std::string_view body) const {
  return fmt::format(
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" "
             "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n{}<AppendedData encoding=\"raw\">\n_",
             type, body) +
         block_ + "\n</AppendedData>\n</VTKFile>\n";
}

AppendedReader::AppendedReader(const Path& path, std::string_view type) : path_(path), bytes_(read_file(path)) {
  constexpr std::string_view mark = "<AppendedData encoding=\"raw\">\n_";
  const std::string_view all = bytes_;
  const auto at = all.find(mark);
  if (at == all.npos || all.substr(0, at).find(fmt::format("<VTKFile type=\"{}\"", type)) == all.npos)
    fault(fmt::format("is not a {} file written by this program", type));
  xml_ = all.substr(0, at);
  block_ = all.substr(at + mark.size());
}

void AppendedReader::fault(const std::string& what) const { fail(Exit::input_output, "{} {}", path_.string(), what); }

std::map<std::string, std::string> AppendedReader::attributes(std::string_view element) const {
  const auto start = xml_.find(fmt::format("<{} ", element));
  if (start == xml_.npos) fault(fmt::format("has no element {}", element));
  return parse_attributes(xml_.substr(start, xml_.find('>', start) - start));
}

std::vector<DataArray> AppendedReader::arrays(std::string_view section) const {
  std::vector<DataArray> found;
  auto start = xml_.find(fmt::format("<{}>", section));
  if (start == xml_.npos) return found;
  const std::string_view inside = xml_.substr(start, xml_.find(fmt::format("</{}>", section), start) - start);
  for (auto at = inside.find("<DataArray "); at != inside.npos; at = inside.find("<DataArray ", at + 1))
    found.push_back(decode(parse_attributes(inside.substr(at, inside.find('>', at) - at))));
  return found;
}

DataArray AppendedReader::array(std::string_view section, std::string_view name) const {
  auto all = arrays(section);
  for (auto& one : all)
    if (one.name == name) return std::move(one);
  fault(fmt::format("has no array {} in {}", name, section));
}

DataArray AppendedReader::decode(const std::map<std::string, std::string>& attributes) const {
  const auto value = [&](const std::string& key) {
    const auto found = attributes.find(key);
    if (found == attributes.end()) fault("has an array without " + key);
    return found->second;
  };
  const auto number = [&](const std::string& key) {
    const std::string text = value(key);
    std::uint64_t result = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), result).ec != std::errc{})
      fault(fmt::format("has an array with {} = {}", key, text));
    return result;
  };
  DataArray array;
  array.name = value("Name");
  array.components = static_cast<int>(number("NumberOfComponents"));
  const std::string type = value("type");
  array.store = type == "Float64" ? Store::float64 : type == "Int32" ? Store::int32 : Store::float32;
  if (type != vtk_name(array.store)) fault(fmt::format("has an array {} of type {}", array.name, type));

  std::uint64_t at = number("offset");
  const auto next = [&] {
    std::uint64_t result = 0;
    if (at + sizeof(result) > block_.size()) fault(fmt::format("ends inside the array {}", array.name));
    std::memcpy(&result, block_.data() + at, sizeof(result));
    at += sizeof(result);
    return result;
  };
  const std::uint64_t blocks = next(), size = next(), last = next();
  if (blocks > block_.size() / sizeof(blocks) || size > largest_block || last >= std::max<std::uint64_t>(size, 1))
    fault(fmt::format("is damaged in the array {}", array.name));
  std::vector<std::uint64_t> sizes(blocks);
  for (auto& s : sizes) s = next();
  std::string raw;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    uLongf length = b + 1 == blocks && last > 0 ? last : size;
    const std::size_t from = raw.size(), expected = length;
    raw.resize(from + expected);
    if (sizes[b] > block_.size() || at + sizes[b] > block_.size())
      fault(fmt::format("ends inside the array {}", array.name));
    if (uncompress(reinterpret_cast<Bytef*>(raw.data() + from), &length,
                   reinterpret_cast<const Bytef*>(block_.data() + at), sizes[b]) != Z_OK ||
        length != expected)
      fault(fmt::format("is damaged in the array {}", array.name));
    at += sizes[b];
  }
  array.values = array.store == Store::float64   ? unpacked<double>(raw)
                 : array.store == Store::float32 ? unpacked<float>(raw)
                                                 : unpacked<std::int32_t>(raw);
  return array;
}

}  // namespace livebed::io
