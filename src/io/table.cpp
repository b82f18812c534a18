#include "io/table.hpp"

#include <algorithm>
#include <charconv>
#include <fcntl.h>
#include <fmt/format.h>
#include <iterator>
#include <unistd.h>

#include "base/fault.hpp"

namespace livebed::io {

using base::Exit;
using base::fail;

namespace {

std::string header(const std::vector<std::string>& columns) { return fmt::format("{}\n", fmt::join(columns, ",")); }

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == text.npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const auto comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == line.npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

TableWriter::TableWriter(const Path& path, const std::vector<std::string>& columns)
    : path_(path), columns_(columns.size()), file_(path, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND) {
  const std::string first = header(columns);
  file_.write_all(first);
  offset_ = first.size();
}

TableWriter::TableWriter(const Path& path, const std::vector<std::string>& columns, std::uint64_t offset)
    : path_(path), columns_(columns.size()), offset_(offset) {
  const std::string text = read_file(path);
  if (!text.starts_with(header(columns)))
    fail(Exit::input_output, "{} has other columns than this program writes; it cannot be continued", path.string());
  if (text.size() < offset || offset == 0 || text[offset - 1] != '\n')
    fail(Exit::input_output, "{} has {} bytes and no row that ends at byte {}: it is not the file the checkpoint saw",
         path.string(), text.size(), offset);
  file_ = Descriptor(path, O_WRONLY | O_APPEND);
  if (::ftruncate(file_.number(), static_cast<off_t>(offset)) != 0) fail_with_errno("cut", path);
}

void TableWriter::row(std::span<const double> values) {
  if (values.size() != columns_)
    fail(Exit::internal, "{}: a row of {} values for {} columns", path_.string(), values.size(), columns_);
  line_.clear();
  fmt::format_to(std::back_inserter(line_), "{}\n", fmt::join(values, ","));
  file_.write_all(line_);
  offset_ += line_.size();
}

bool Table::has(std::string_view name) const { return std::find(names.begin(), names.end(), name) != names.end(); }

const std::vector<double>& Table::column(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    fail(Exit::input_output, "{} has no column {}; it has {}", source, name, fmt::join(names, ", "));
  return columns[static_cast<std::size_t>(found - names.begin())];
}

Table read_table(const Path& path) { return parse_table(read_file(path), path.string()); }

Table parse_table(std::string_view text, const std::string& source) {
  Table table;
  table.source = source;
  std::vector<double> row;
  for (int number = 1; !text.empty(); ++number) {
    const auto end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    if (line.empty()) continue;
    if (line.front() == '#') {
      table.comments.emplace_back(trimmed(line.substr(1)));
      continue;
    }
    const auto cells = split(line);
    if (table.names.empty()) {
      table.names.assign(cells.begin(), cells.end());
      table.columns.resize(cells.size());
      continue;
    }
    if (cells.size() < table.names.size() && end == text.npos) break;
    if (cells.size() != table.names.size())
      fail(Exit::input_output, "{}:{}: {} values for {} columns", source, number, cells.size(), table.names.size());
    row.clear();
    for (std::size_t c = 0; c < cells.size(); ++c) {
      double value = 0;
      const auto [stop, error] = std::from_chars(cells[c].data(), cells[c].data() + cells[c].size(), value);
      if (error != std::errc{} || stop != cells[c].data() + cells[c].size())
        fail(Exit::input_output, "{}:{}: {} = \"{}\" is not a number", source, number, table.names[c], cells[c]);
      row.push_back(value);
    }
    for (std::size_t c = 0; c < row.size(); ++c) table.columns[c].push_back(row[c]);
  }
  if (table.names.empty()) fail(Exit::input_output, "{}: a table needs a header line; the file has none", source);
  return table;
}

}  // namespace livebed::io
