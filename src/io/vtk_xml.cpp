#include "io/vtk_xml.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <zlib.h>

#include "base/fault.hpp"
#include "io/base64.hpp"

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

/// Bytes before the sizes of the blocks.
constexpr std::size_t head_size = 3 * sizeof(std::uint64_t);
std::size_t base64_size(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

/// vtkZLibDataCompressor: number of blocks, block size, size of a partial last block (0 = none), compressed sizes;
/// then, as a text of their own, the blocks.
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
  return base64(head) + base64(body);
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

std::string element(const DataArray& array, const std::string& extra) {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"binary\">\n{}\n</DataArray>\n",
      vtk_name(array.store), array.name, array.components, extra, compressed(packed(array)));
}

std::string xml_file(std::string_view type, std::string_view body) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n{}</VTKFile>\n",
      type, body);
}

XmlReader::XmlReader(const Path& path, std::string_view type) : path_(path), bytes_(read_file(path)) {
  constexpr std::string_view mark = "<AppendedData encoding=\"raw\">\n_";
  xml_ = bytes_;
  if (const auto at = xml_.find(mark); at != xml_.npos) {
    block_ = xml_.substr(at + mark.size());
    xml_ = xml_.substr(0, at);
  }
  const auto start = xml_.find(fmt::format("<VTKFile type=\"{}\"", type));
  if (start == xml_.npos || xml_.find("compressor=\"vtkZLibDataCompressor\"", start) == xml_.npos)
    fault(fmt::format("is not a {} file written by this program", type));
}

void XmlReader::fault(const std::string& what) const { fail(Exit::input_output, "{} {}", path_.string(), what); }

std::map<std::string, std::string> XmlReader::attributes(std::string_view element) const {
  const auto start = xml_.find(fmt::format("<{} ", element));
  if (start == xml_.npos) fault(fmt::format("has no element {}", element));
  return parse_attributes(xml_.substr(start, xml_.find('>', start) - start));
}

std::vector<DataArray> XmlReader::arrays(std::string_view section) const {
  std::vector<DataArray> found;
  auto start = xml_.find(fmt::format("<{}>", section));
  if (start == xml_.npos) return found;
  const std::string_view inside = xml_.substr(start, xml_.find(fmt::format("</{}>", section), start) - start);
  for (auto at = inside.find("<DataArray "); at != inside.npos; at = inside.find("<DataArray ", at + 1)) {
    const auto end = std::min(inside.find('>', at), inside.size());
    const std::string_view content = inside.substr(std::min(end + 1, inside.size()));
    found.push_back(
        decode(parse_attributes(inside.substr(at, end - at)), content.substr(0, content.find("</DataArray>"))));
  }
  return found;
}

DataArray XmlReader::array(std::string_view section, std::string_view name) const {
  auto all = arrays(section);
  for (auto& one : all)
    if (one.name == name) return std::move(one);
  fault(fmt::format("has no array {} in {}", name, section));
}

namespace {

const std::string& value_of(const std::map<std::string, std::string>& attributes, const char* key) {
  static const std::string none;
  const auto found = attributes.find(key);
  return found == attributes.end() ? none : found->second;
}

std::optional<std::uint64_t> whole_number(const std::string& text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

}  // namespace

std::string XmlReader::packed_bytes(const std::map<std::string, std::string>& attributes,
                                    std::string_view content) const {
  const std::string& name = value_of(attributes, "Name");
  if (value_of(attributes, "format") == "appended") {
    const auto offset = whole_number(value_of(attributes, "offset"));
    if (!offset) fault(fmt::format("has an array {} with offset = {}", name, value_of(attributes, "offset")));
    return std::string(block_.substr(std::min<std::uint64_t>(*offset, block_.size())));
  }
  // The head says how long it is, and ends in a text of its own.
  const auto from = content.find_first_not_of(" \n"), to = content.find_last_not_of(" \n");
  if (from == content.npos) fault(fmt::format("ends inside the array {}", name));
  content = content.substr(from, to - from + 1);
  const auto decoded = [&](std::string_view text) {
    std::optional<std::string> bytes = from_base64(text);
    if (!bytes) fault(fmt::format("{} the array {}", text.size() % 4 == 0 ? "is damaged in" : "ends inside", name));
    return *bytes;
  };
  const std::string start = decoded(content.substr(0, base64_size(head_size)));
  std::uint64_t blocks = 0;
  if (start.size() < head_size) fault(fmt::format("ends inside the array {}", name));
  std::memcpy(&blocks, start.data(), sizeof blocks);
  if (blocks > content.size()) fault(fmt::format("is damaged in the array {}", name));
  const std::size_t head = base64_size(head_size + blocks * sizeof blocks);
  if (head > content.size()) fault(fmt::format("ends inside the array {}", name));
  return decoded(content.substr(0, head)) + decoded(content.substr(head));
}

DataArray XmlReader::decode(const std::map<std::string, std::string>& attributes, std::string_view content) const {
  DataArray array;
  array.name = value_of(attributes, "Name");
  const auto components = whole_number(value_of(attributes, "NumberOfComponents"));
  const std::string& type = value_of(attributes, "type");
  array.store = type == "Float64" ? Store::float64 : type == "Int32" ? Store::int32 : Store::float32;
  if (array.name.empty() || !components) fault("has an array without name or components");
  if (type != vtk_name(array.store)) fault(fmt::format("has an array {} of type {}", array.name, type));
  array.components = static_cast<int>(*components);

  const std::string bytes = packed_bytes(attributes, content);
  std::uint64_t at = 0;
  const auto next = [&] {
    std::uint64_t result = 0;
    if (at + sizeof(result) > bytes.size()) fault(fmt::format("ends inside the array {}", array.name));
    std::memcpy(&result, bytes.data() + at, sizeof(result));
    at += sizeof(result);
    return result;
  };
  const std::uint64_t blocks = next(), size = next(), last = next();
  if (blocks > bytes.size() / sizeof(blocks) || size > largest_block || last >= std::max<std::uint64_t>(size, 1))
    fault(fmt::format("is damaged in the array {}", array.name));
  std::vector<std::uint64_t> sizes(blocks);
  for (auto& s : sizes) s = next();
  std::string raw;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    uLongf length = b + 1 == blocks && last > 0 ? last : size;
    const std::size_t from = raw.size(), expected = length;
    raw.resize(from + expected);
    if (sizes[b] > bytes.size() || at + sizes[b] > bytes.size())
      fault(fmt::format("ends inside the array {}", array.name));
    if (uncompress(reinterpret_cast<Bytef*>(raw.data() + from), &length,
                   reinterpret_cast<const Bytef*>(bytes.data() + at), sizes[b]) != Z_OK ||
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
