#include "io/hdf5.hpp"

#include <algorithm>
#include <atomic>
#include <string_view>
#include <utility>
#include <zlib.h>

#include "base/fault.hpp"

namespace livebed::io {

using base::Exit;
using base::fail;

namespace {

template <class T>
hid_t native_type() {
  if constexpr (std::same_as<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::same_as<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::same_as<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::same_as<T, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::same_as<T, std::uint64_t>) return H5T_NATIVE_UINT64;
  if constexpr (std::same_as<T, char>) return H5T_NATIVE_CHAR;
}

/// The file ends with the CRC-32 of all bytes before it.  HDF5 tools ignore what follows the end of the data they know.
constexpr std::string_view checksum_mark = "livebed-crc32=";
constexpr std::size_t trailer_size = checksum_mark.size() + 8;

std::string trailer(std::string_view image) {
  const uLong crc = crc32_z(crc32(0, nullptr, 0), reinterpret_cast<const Bytef*>(image.data()), image.size());
  return fmt::format("{}{:08x}", checksum_mark, crc);
}

/// In-memory files; HDF5 writes nothing back to disk.
Handle memory_access() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr std::size_t growth = 1 << 20;
  H5Pset_fapl_core(access, growth, false);
  // Sub-groups may outlive the file's handle; the file closes with the last of them.
  H5Pset_fclose_degree(access, H5F_CLOSE_WEAK);
  return access;
}

/// Name under which HDF5 knows an in-memory file: one that no file on disk can have (HDF5 refuses an image whose name
/// exists) and that is never used twice (HDF5 would hand out the older file).
std::string memory_name(const Path& path) {
  static std::atomic<std::uint64_t> count{0};
  return fmt::format("/dev/null/{}/{}", count++, path.filename().string());
}

std::string shape_text(const std::vector<hsize_t>& shape) {
  std::string text;
  for (hsize_t n : shape) text += fmt::format("{}{}", text.empty() ? "" : " x ", n);
  return text;
}

}  // namespace

Handle::~Handle() {
  if (id_ >= 0 && close_ != nullptr) close_(id_);
}
Handle::Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

void Group::fault(const std::string& name, const std::string& what) const {
  fail(Exit::input_output, "{}/{}: {}", name_, name, what);
}

Group Group::make(const std::string& name) {
  Handle group(H5Gcreate2(handle_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  if (group < 0) fault(name, "cannot create the group");
  return {std::move(group), name_ + "/" + name};
}

Group Group::open(const std::string& name) const {
  if (!has(name)) fault(name, "the group is missing");
  Handle group(H5Gopen2(handle_, name.c_str(), H5P_DEFAULT), H5Gclose);
  if (group < 0) fault(name, "is not a readable group; the file is damaged or of another kind");
  return {std::move(group), name_ + "/" + name};
}

bool Group::has(const std::string& name) const { return H5Lexists(handle_, name.c_str(), H5P_DEFAULT) > 0; }

Handle Group::find(const std::string& name) const {
  if (!has(name)) fault(name, "the dataset is missing; the file is of another version or damaged");
  Handle dataset(H5Dopen2(handle_, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (dataset < 0) fault(name, "is not a readable dataset; the file is damaged");
  return dataset;
}

std::size_t Group::length(const std::string& name) const {
  const Handle dataset = find(name);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const hssize_t n = H5Sget_simple_extent_npoints(space);
  if (n < 0) fault(name, "its size cannot be read; the file is damaged");
  return static_cast<std::size_t>(n);
}

template <class T>
void Group::write_block(const std::string& name, const T* data, std::vector<hsize_t> shape) {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
  const Handle dataset(
      H5Dcreate2(handle_, name.c_str(), native_type<T>(), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (dataset < 0) fault(name, "cannot create the dataset (is the name used twice?)");
  if (H5Dwrite(dataset, native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    fault(name, "cannot write the dataset");
}

template <class T>
void Group::read_block(const std::string& name, T* data, const std::vector<hsize_t>& shape) const {
  const Handle dataset = find(name);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> found(rank < 0 ? 0 : static_cast<std::size_t>(rank));
  if (rank < 0 || (rank > 0 && H5Sget_simple_extent_dims(space, found.data(), nullptr) < 0))
    fault(name, "its shape cannot be read; the file is damaged");
  if (found != shape)
    fault(name, fmt::format("holds {} values where {} are needed", shape_text(found), shape_text(shape)));
  const Handle type(H5Dget_type(dataset), H5Tclose);
  if (H5Tequal(type, native_type<T>()) <= 0) fault(name, "holds numbers of another type");
  if (H5Dread(dataset, native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    fault(name, "cannot be read; the file is damaged, use an older one");
}

template <Number T>
void Group::write(const std::string& name, std::span<const T> values) {
  write_block(name, values.data(), {values.size()});
}
template <Number T>
void Group::read(const std::string& name, std::span<T> values) const {
  read_block(name, values.data(), {values.size()});
}

void Group::write(const std::string& name, const std::string& text) { write_block(name, text.data(), {text.size()}); }

void Group::read(const std::string& name, std::string& text) const {
  text.resize(length(name));
  read_block(name, text.data(), {text.size()});
}

void Group::write(const std::string& name, const base::Field& field) {
  const int g = field.ghosts(), width = field.nx() + 2 * g, height = field.ny() + 2 * g;
  std::vector<double> packed;
  packed.reserve(static_cast<std::size_t>(width) * height);
  for (int j = -g; j < field.ny() + g; ++j)
    packed.insert(packed.end(), field.row(j) - g, field.row(j) + field.nx() + g);
  write_block(name, packed.data(), {static_cast<hsize_t>(height), static_cast<hsize_t>(width)});
}

void Group::read(const std::string& name, base::Field& field) const {
  const int g = field.ghosts(), width = field.nx() + 2 * g, height = field.ny() + 2 * g;
  std::vector<double> packed(static_cast<std::size_t>(width) * height);
  read_block(name, packed.data(), {static_cast<hsize_t>(height), static_cast<hsize_t>(width)});
  const double* source = packed.data();
  for (int j = -g; j < field.ny() + g; ++j, source += width) std::copy(source, source + width, field.row(j) - g);
}

template <Number T>
void Group::write_attribute(const std::string& name, T value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(handle_, name.c_str(), native_type<T>(), space, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (attribute < 0 || H5Awrite(attribute, native_type<T>(), &value) < 0) fault(name, "cannot write the attribute");
}

template <Number T>
T Group::read_attribute(const std::string& name) const {
  const Handle attribute(H5Aopen(handle_, name.c_str(), H5P_DEFAULT), H5Aclose);
  if (attribute < 0) fault(name, "the attribute is missing; the file is of another version or damaged");
  const Handle type(H5Aget_type(attribute), H5Tclose);
  T value{};
  if (H5Tequal(type, native_type<T>()) <= 0 || H5Aread(attribute, native_type<T>(), &value) < 0)
    fault(name, "the attribute cannot be read as a number of its type");
  return value;
}

void Group::write_attribute(const std::string& name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, text.size() + 1);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(handle_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (attribute < 0 || H5Awrite(attribute, type, text.c_str()) < 0) fault(name, "cannot write the attribute");
}

std::string Group::read_text_attribute(const std::string& name) const {
  const Handle attribute(H5Aopen(handle_, name.c_str(), H5P_DEFAULT), H5Aclose);
  if (attribute < 0) fault(name, "the attribute is missing; the file is of another version or damaged");
  const Handle type(H5Aget_type(attribute), H5Tclose);
  std::string text(H5Tget_size(type), '\0');
  if (H5Tget_class(type) != H5T_STRING || H5Aread(attribute, type, text.data()) < 0)
    fault(name, "the attribute cannot be read as text");
  text.resize(text.find('\0') == std::string::npos ? text.size() : text.find('\0'));
  return text;
}

#define LIVEBED_HDF5_TYPE(T)                                             \
  template void Group::write<T>(const std::string&, std::span<const T>); \
  template void Group::read<T>(const std::string&, std::span<T>) const;  \
  template void Group::write_attribute<T>(const std::string&, T);        \
  template T Group::read_attribute<T>(const std::string&) const;
LIVEBED_HDF5_TYPE(double)
LIVEBED_HDF5_TYPE(float)
LIVEBED_HDF5_TYPE(std::int32_t)
LIVEBED_HDF5_TYPE(std::int64_t)
LIVEBED_HDF5_TYPE(std::uint64_t)
#undef LIVEBED_HDF5_TYPE

Hdf5Writer::Hdf5Writer(const Path& path) : path_(path) {
  const Handle access = memory_access();
  file_ = Handle(H5Fcreate(memory_name(path).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  if (file_ < 0) fail(Exit::input_output, "cannot prepare the HDF5 file {} in memory", path.string());
}

Group Hdf5Writer::root() { return {Handle(H5Gopen2(file_, "/", H5P_DEFAULT), H5Gclose), path_.string() + ":"}; }

void Hdf5Writer::save() {
  const bool flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  const ssize_t size = flushed ? H5Fget_file_image(file_, nullptr, 0) : -1;
  if (size <= 0) fail(Exit::input_output, "cannot finish the HDF5 file {} in memory", path_.string());
  std::string image(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file_, image.data(), image.size()) != size)
    fail(Exit::input_output, "cannot finish the HDF5 file {} in memory", path_.string());
  write_atomically(path_, image + trailer(image));
}

Hdf5Reader::Hdf5Reader(const Path& path) : path_(path) {
  std::string image = read_file(path);
  const std::size_t size = std::max(image.size(), trailer_size) - trailer_size;
  if (image.substr(size) != trailer(std::string_view(image).substr(0, size)))
    fail(Exit::input_output, "{} is not a whole checkpoint (truncated, damaged or of another kind); use an older one",
         path.string());
  const Handle access = memory_access();
  H5Pset_file_image(access, image.data(), size);  // HDF5 takes a copy
  file_ = Handle(H5Fopen(memory_name(path).c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (file_ < 0) fail(Exit::input_output, "{} cannot be opened as an HDF5 file", path.string());
}

Group Hdf5Reader::root() const { return {Handle(H5Gopen2(file_, "/", H5P_DEFAULT), H5Gclose), path_.string() + ":"}; }

}  // namespace livebed::io
