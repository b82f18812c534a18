#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/descriptor.hpp"
#include "io/file.hpp"

/// Comma-separated tables: one header line with the unit in each column's name, then rows of numbers.
namespace livebed::io {

/// Appends rows to a table.  Each row reaches the file at once and whole; numbers are the shortest that read back to
/// the same bits.  Faults (input/output) name the file.
class TableWriter {
public:
  /// Starts a new file (replacing one of that name) with the header.
  TableWriter(const Path& path, const std::vector<std::string>& columns);
  /// Continues a file: checks that its header is this one and cuts it at the byte offset, so that a resumed run writes
  /// the same bytes as an unbroken one.
  TableWriter(const Path& path, const std::vector<std::string>& columns, std::uint64_t offset);

  /// Appends a row; as many values as columns.
  void row(std::span<const double> values);
  /// Bytes written so far: what a checkpoint remembers.
  std::uint64_t offset() const { return offset_; }
  /// Forces the rows to the disk (before a checkpoint refers to them).
  void sync() const { file_.sync(); }

private:
  Path path_;
  std::size_t columns_;
  Descriptor file_;
  std::uint64_t offset_ = 0;
  std::string line_;
};

/// A table in memory.
struct Table {
  std::string source;                        ///< where it came from, for messages
  std::vector<std::string> comments;         ///< lines that began with '#', without it
  std::vector<std::string> names;            ///< header
  std::vector<std::vector<double>> columns;  ///< [names.size()][rows]

  std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
  bool has(std::string_view name) const;
  /// The column of this name; Fault (input/output) listing the names when there is none.
  const std::vector<double>& column(std::string_view name) const;
};

/// Reads a table; '#' starts a comment line.  A shorter last line without an end belongs to a row that is still being
/// written and is left out.  Anything else that is not a number or has another number of columns is a Fault with its
/// line.
Table read_table(const Path& path);
Table parse_table(std::string_view text, const std::string& source);

}  // namespace livebed::io
