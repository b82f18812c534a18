#include "validate/seed_table.hpp"

#include <charconv>
#include <fmt/format.h>

#include "base/fault.hpp"

namespace livebed::validate {

namespace {

constexpr std::string_view begins_run = "# seed ";

}  // namespace

void SeedTable::keep(std::string_view file, const std::string& source) {
  std::map<unsigned, Lines> read;
  const auto refuse = [&](int number, const std::string& why) {
    base::fail(base::Exit::input_output, "{}, line {}: {}; move the file away to begin it anew", source, number, why);
  };
  const auto seed_of = [&](std::string_view text, int number) {
    unsigned seed = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), seed).ec != std::errc{})
      refuse(number, fmt::format("'{}' does not begin with the number of a seed", text));
    return seed;
  };
  bool headed = false;
  for (int number = 1; !file.empty(); ++number) {
    const std::string_view line = file.substr(0, file.find('\n'));
    file.remove_prefix(std::min(file.size(), line.size() + 1));
    if (line.starts_with(begins_run)) {
      const std::string_view rest = line.substr(begins_run.size());
      if (rest.find(": ") == rest.npos) refuse(number, "'# seed N: who made it' is expected");
      read[seed_of(rest, number)].run = rest.substr(rest.find(": ") + 2);
    } else if (line.starts_with('#')) {
      continue;
    } else if (!headed) {
      if (line != header_) refuse(number, fmt::format("the columns are '{}' and should be '{}'", line, header_));
      headed = true;
    } else {
      const unsigned seed = seed_of(line, number);
      if (!read.contains(seed)) refuse(number, fmt::format("no comment tells who made seed {}", seed));
      read[seed].rows += fmt::format("{}\n", line);
    }
  }
  for (auto& [seed, lines] : read) seeds_.try_emplace(seed, std::move(lines));
}

std::string SeedTable::text() const {
  std::string all = fmt::format("# {}\n", says_);
  for (const auto& [seed, lines] : seeds_) all += fmt::format("{}{}: {}\n", begins_run, seed, lines.run);
  all += header_ + "\n";
  for (const auto& [seed, lines] : seeds_) all += lines.rows;
  return all;
}

}  // namespace livebed::validate
