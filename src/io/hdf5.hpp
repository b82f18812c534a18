#pragma once
#include <concepts>
#include <cstdint>
#include <hdf5.h>
#include <span>
#include <string>
#include <vector>

#include "base/aligned.hpp"
#include "base/field.hpp"
#include "io/file.hpp"

/// HDF5 for checkpoints.  A file is made and read in memory; the disk sees one atomic write or one read, so that a full
/// disk can never leave half a checkpoint.  The whole file carries a checksum.  All errors are Faults
/// (input/output) that name the file and the dataset; HDF5's own error printing is off.
namespace livebed::io {

/// What a dataset or attribute can hold.
template <class T>
concept Number = std::same_as<T, double> || std::same_as<T, float> || std::same_as<T, std::int32_t> ||
    std::same_as<T, std::int64_t> || std::same_as<T, std::uint64_t>;

/// Owns an identifier of the HDF5 library together with the function that closes it.
class Handle {
public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Handle();
  Handle(Handle&& other) noexcept;
  Handle& operator=(Handle&& other) noexcept;
  operator hid_t() const { return id_; }

private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// A group of datasets.  Valid as long as the file it came from.
class Group {
public:
  Group(Handle handle, std::string name) : handle_(std::move(handle)), name_(std::move(name)) {}

  /// The group of this name below: make() creates it, open() finds it.
  Group make(const std::string& name);
  Group open(const std::string& name) const;
  bool has(const std::string& name) const;

  template <Number T>
  void write(const std::string& name, std::span<const T> values);
  template <Number T>
  void write(const std::string& name, T value) {
    write(name, std::span<const T>(&value, 1));
  }
  template <Number T, class Allocator>
  void write(const std::string& name, const std::vector<T, Allocator>& values) {
    write(name, std::span<const T>(values));
  }
  void write(const std::string& name, const std::string& text);
  /// Ghosts included, padding left out: (ny + 2 ghosts) x (nx + 2 ghosts).
  void write(const std::string& name, const base::Field& field);

  /// The dataset's values, which must be as many as the span has.
  template <Number T>
  void read(const std::string& name, std::span<T> values) const;
  template <Number T>
  void read(const std::string& name, T& value) const {
    read(name, std::span<T>(&value, 1));
  }
  /// Resized to the dataset's length.
  template <Number T, class Allocator>
  void read(const std::string& name, std::vector<T, Allocator>& values) const {
    values.resize(length(name));
    read(name, std::span<T>(values));
  }
  void read(const std::string& name, std::string& text) const;
  /// The field's own size must be that of the dataset.
  void read(const std::string& name, base::Field& field) const;

  /// Number of values in a dataset.
  std::size_t length(const std::string& name) const;

  /// Attributes of the group: versions, units, notes.
  template <Number T>
  void write_attribute(const std::string& name, T value);
  void write_attribute(const std::string& name, const std::string& text);
  template <Number T>
  T read_attribute(const std::string& name) const;
  std::string read_text_attribute(const std::string& name) const;

private:
  [[noreturn]] void fault(const std::string& name, const std::string& what) const;
  template <class T>
  void write_block(const std::string& name, const T* data, std::vector<hsize_t> shape);
  template <class T>
  void read_block(const std::string& name, T* data, const std::vector<hsize_t>& shape) const;
  Handle find(const std::string& name) const;

  Handle handle_;
  std::string name_;  ///< file and path inside it, for messages
};

/// An HDF5 file being made.  Nothing is on disk before save(); a writer that is destroyed before leaves no trace.
class Hdf5Writer {
public:
  explicit Hdf5Writer(const Path& path);
  /// The file's root group; one at a time is enough, groups below stay valid on their own.
  Group root();
  /// Writes the file atomically.
  void save();

private:
  Path path_;
  Handle file_;
};

/// An HDF5 file being read.
class Hdf5Reader {
public:
  explicit Hdf5Reader(const Path& path);
  Group root() const;

private:
  Path path_;
  Handle file_;
};

}  // namespace livebed::io
