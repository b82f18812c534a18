#include "validate/run_table.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

#include "base/fault.hpp"
#include "io/file.hpp"

namespace livebed::validate {

std::string RunTable::begins_run() const { return fmt::format("# {} ", header_.substr(0, header_.find(','))); }

void RunTable::keep(std::string_view file, const std::string& source) {
  std::map<unsigned, Lines> read;
  const auto refuse = [&](int number, const std::string& why) {
    base::fail(base::Exit::input_output, "{}, line {}: {}; move the file away to begin it anew", source, number, why);
  };
  const auto run_of = [&](std::string_view text, int number) {
    unsigned run = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), run).ec != std::errc{})
      refuse(number, fmt::format("'{}' does not begin with the number of a run", text));
    return run;
  };
  const std::string begins = begins_run();
  bool headed = false;
  for (int number = 1; !file.empty(); ++number) {
    const std::string_view line = file.substr(0, file.find('\n'));
    file.remove_prefix(std::min(file.size(), line.size() + 1));
    if (line.starts_with(begins)) {
      const std::string_view rest = line.substr(begins.size());
      const std::size_t colon = rest.find(": ");
      if (colon == rest.npos) refuse(number, fmt::format("'{}N: who made it' is expected", begins));
      read[run_of(rest, number)].made = rest.substr(colon + 2);
    } else if (line.starts_with('#')) {
      continue;
    } else if (!headed) {
      if (line != header_) refuse(number, fmt::format("the columns are '{}' and should be '{}'", line, header_));
      headed = true;
    } else {
      const unsigned run = run_of(line, number);
      if (!read.contains(run)) refuse(number, fmt::format("no comment tells who made run {}", run));
      read[run].rows += fmt::format("{}\n", line);
    }
  }
  for (auto& [run, lines] : read) runs_.try_emplace(run, std::move(lines));
}

void RunTable::keep(const std::filesystem::path& file) {
  if (std::filesystem::exists(file)) keep(io::read_file(file), file.string());
}

std::string RunTable::text() const {
  std::string all = fmt::format("# {}\n", says_);
  for (const auto& [run, lines] : runs_) all += fmt::format("{}{}: {}\n", begins_run(), run, lines.made);
  all += header_ + "\n";
  for (const auto& [run, lines] : runs_) all += lines.rows;
  return all;
}

}  // namespace livebed::validate
