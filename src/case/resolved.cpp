#include "case/resolved.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fmt/format.h>
#include <fstream>
#include <system_error>

#include "base/fault.hpp"
#include "case/schema.hpp"

namespace livebed::casefile {
namespace {

/// Does the key follow from another one in this case?
bool follows(const Case& c, const Row& row) {
  if (row.derived) return true;
  for (const Alternatives& group : alternatives())
    if (std::find(group.keys.begin(), group.keys.end(), row.name) != group.keys.end()) return !c.is_given(row.name);
  return false;
}

std::string unit_comment(const Row& row) { return row.unit == "-" ? "" : "  # " + row.unit; }

}  // namespace

std::string resolved_text(const Case& c) {
  std::string keys, derived, table;
  for (const Row& row : schema()) {
    const std::size_t dot = row.name.find('.');
    const std::string value = written(row.get(c));
    if (follows(c, row)) {
      if (row.type == Type::text) continue;  // a list that was not given: nothing follows but the empty one
      derived += fmt::format("{} = {}{}\n", row.name, value, unit_comment(row));
      continue;
    }
    if (dot != std::string::npos && row.name.substr(0, dot) != table) {
      table = row.name.substr(0, dot);
      keys += fmt::format("\n[{}]\n", table);
    }
    const std::string leaf = dot == std::string::npos ? row.name : row.name.substr(dot + 1);
    keys += fmt::format("{} = {}{}\n", leaf, value, unit_comment(row));
  }
  return keys + "\n[derived]\n" + derived;
}

void write_resolved(const Case& c, const std::filesystem::path& path) {
  std::ofstream file(path);
  file << "# Every key of the case with its value in SI units; the table [derived] follows from the others.\n"
       << resolved_text(c);
  file.close();
  if (!file)
    base::fail(base::Exit::input_output, "cannot write the resolved case {}: {}", path.string(),
               std::generic_category().message(errno));
}

std::string hash(const Case& c) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const char letter : resolved_text(c)) {
    h ^= static_cast<unsigned char>(letter);
    h *= 0x100000001b3u;
  }
  return fmt::format("{:016x}", h);
}

std::vector<std::string> differences(const Case& a, const Case& b) {
  const auto given = [](const Case& c, const Row& row) { return follows(c, row) ? "not given" : written(row.get(c)); };
  std::vector<std::string> told;
  for (const Row& row : schema()) {
    if (row.derived) continue;
    const std::string in_a = given(a, row), in_b = given(b, row);
    if (in_a != in_b) told.push_back(fmt::format("{} = {}, not {}", row.name, in_a, in_b));
  }
  return told;
}

}  // namespace livebed::casefile
