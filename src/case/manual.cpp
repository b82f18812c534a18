#include "case/manual.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "case/faults.hpp"
#include "case/read.hpp"
#include "case/schema.hpp"

namespace livebed::casefile {
namespace {

std::string table_of(const Row& row) {
  const std::size_t dot = row.name.find('.');
  return dot == std::string::npos ? "" : row.name.substr(0, dot);
}

std::string meaning_of(const Row& row) {
  return row.source.empty() ? row.meaning : fmt::format("{} [{}]", row.meaning, row.source);
}

const Alternatives* group_of(const Row& row) {
  for (const Alternatives& group : alternatives())
    if (std::find(group.keys.begin(), group.keys.end(), row.name) != group.keys.end()) return &group;
  return nullptr;
}

bool chosen_by(const std::string& preset, const std::string& key) {
  for (const Choice& choice : choices())
    if (choice.key == key) return !(preset == "mbs2d" ? choice.mbs2d : choice.livebed).empty();
  return false;
}

/// The key of a group that counts when the case gives none: the preset's, or the one with a default.
std::string fallback_of(const Alternatives& group, const std::string& preset) {
  for (const std::string& key : group.keys)
    if (chosen_by(preset, key)) return key;
  return group.otherwise;
}

}  // namespace

std::string allowed(const Row& row) {
  if (row.type == Type::word) return listed(row.words);
  if (row.type == Type::flag) return "true, false";
  if (row.derived || row.type == Type::text) return "";
  return row.range.text();
}

std::string default_of(const Row& row, const std::string& preset) {
  if (row.derived) return "computed";
  if (const Alternatives* group = group_of(row)) {
    const std::string fallback = fallback_of(*group, preset);
    if (fallback.empty()) return "required, or its like";
    if (fallback != row.name) return "from " + fallback;
  }
  return written(row.get(preset_case(preset)));
}

std::string manual_markdown() {
  std::string text =
      "# The keys of a case file\n\n"
      "Made from the schema by `livebed keys --markdown`; a test keeps it up to date. A case file is TOML. Numbers are "
      "bare in the unit given here, or strings with a unit of their own: `\"0.36 mm\"`, `\"5.5 kN/m\"`, `\"20 %\"`. "
      "The two default columns are those of `preset = \"livebed\"`, which counts when no preset is named, and `preset "
      "= "
      "\"mbs2d\"`, the choices of Yeganeh-Bakhtiary et al. (2013), whose equations and sections are in brackets.\n\n"
      "Of these keys a case gives one and the others follow; where more than one is given, the case is refused:\n\n";
  for (const Alternatives& group : alternatives())
    text += fmt::format("- `{}`{}\n", fmt::join(group.keys, "` or `"),
                        group.otherwise.empty() ? " (one of them is required)" : "");
  std::string table = "?";
  for (const Row& row : schema()) {
    if (table_of(row) != table) {
      table = table_of(row);
      text += table.empty() ? "\n## At the top\n\n" : fmt::format("\n## [{}]\n\n", table);
      text += "| Key | Unit | Allowed | livebed | mbs2d | Meaning |\n|---|---|---|---|---|---|\n";
    }
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", row.name, row.unit, allowed(row),
                        default_of(row, "livebed"), default_of(row, "mbs2d"), meaning_of(row));
  }
  return text;
}

std::string manual_text(const std::string& preset) {
  std::string text;
  for (const Row& row : schema()) {
    const std::string unit = row.unit == "-" ? "" : " " + row.unit;
    const std::string range = allowed(row);
    text += fmt::format("{} = {}{}{}\n    {}\n", row.name, default_of(row, preset), unit,
                        range.empty() ? "" : fmt::format("   {{{}}}", range), meaning_of(row));
  }
  return text;
}

}  // namespace livebed::casefile
