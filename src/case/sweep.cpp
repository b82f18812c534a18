#include "case/sweep.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <sstream>

#include "base/fault.hpp"
#include "case/read.hpp"
#include "case/schema.hpp"

namespace livebed::casefile {

using base::Exit;

namespace {

constexpr const char* seed_key = "bed.seed";
constexpr std::size_t longest_name = 160;  ///< of a folder; file systems allow 255

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> values(1);
  char quote = 0;
  int depth = 0;
  for (const char c : list) {
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth == 0) {
      values.emplace_back();
      continue;
    }
    values.back() += c;
  }
  for (std::string& value : values) {
    const auto first = value.find_first_not_of(' '), last = value.find_last_not_of(' ');
    value = first == value.npos ? "" : value.substr(first, last - first + 1);
  }
  return values;
}

template <class T>
void expect_each_once(const std::vector<T>& values, const std::string& what) {
  std::set<T> seen;
  for (const T& value : values)
    if (!seen.insert(value).second)
      base::fail(Exit::command_line, "{} names {} twice; a sweep runs each value once", what, value);
}

/// A name in which nothing surprises a shell or a file system.
std::string tame(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool kept =
        std::isalnum(static_cast<unsigned char>(c)) || std::string_view("._-+=").find(c) != std::string_view::npos;
    if (kept)
      name += c;
    else if (c != '"' && c != '\'')
      name += '_';
  }
  return name;
}

/// Of the keys that vary: the others belong to the case.
std::string name_of(const std::vector<SweptKey>& keys, const std::vector<std::string>& overrides,
                    std::size_t combination) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (keys[k].values.size() > 1) parts.push_back(tame(overrides[k]));
  const std::string name = fmt::format("{}", fmt::join(parts, ","));
  return name.size() <= longest_name ? name : fmt::format("combination-{}", combination + 1);
}

/// Adds the lines of a message that are not known yet, without the count of faults at its end.
void note_lines(const std::string& message, std::vector<std::string>& lines) {
  std::istringstream text(message);
  for (std::string line; std::getline(text, line);)
    if (!line.ends_with("nothing was run") && std::find(lines.begin(), lines.end(), line) == lines.end())
      lines.push_back(line);
}

}  // namespace

std::vector<SweptKey> swept_keys(const std::vector<std::string>& settings) {
  std::vector<SweptKey> keys;
  for (const std::string& text : settings) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos || equals == 0)
      base::fail(Exit::command_line, "--set {} is not table.key=value1,value2,...", text);
    SweptKey swept{text.substr(0, equals), split(text.substr(equals + 1))};
    if (swept.key == seed_key)
      base::fail(Exit::command_line, "{} is not for --set: give the seeds with --seeds {}", seed_key,
                 fmt::join(swept.values, ","));
    if (std::any_of(keys.begin(), keys.end(), [&](const SweptKey& other) { return other.key == swept.key; }))
      base::fail(Exit::command_line, "--set {} is given twice; list all its values in one: --set {}=v1,v2", swept.key,
                 swept.key);
    if (std::find(swept.values.begin(), swept.values.end(), "") != swept.values.end())
      base::fail(Exit::command_line, "--set {} has an empty value", text);
    expect_each_once(swept.values, "--set " + swept.key);
    keys.push_back(std::move(swept));
  }
  return keys;
}

std::vector<SweptCase> sweep(const std::filesystem::path& path, const std::vector<SweptKey>& keys,
                             const std::vector<long long>& seeds) {
  expect_each_once(seeds, "--seeds");
  std::size_t combinations = 1;
  for (const SweptKey& swept : keys) combinations *= swept.values.size();
  std::vector<SweptCase> cases;
  std::vector<std::string> faults;
  std::set<std::string> names;
  Exit code = Exit::ok;
  for (std::size_t n = 0; n < combinations; ++n) {
    std::vector<std::string> overrides;
    std::size_t rest = n;
    for (auto swept = keys.rbegin(); swept != keys.rend(); ++swept) {
      overrides.insert(overrides.begin(), swept->key + "=" + swept->values[rest % swept->values.size()]);
      rest /= swept->values.size();
    }
    std::string combination = name_of(keys, overrides, n);
    if (!names.insert(combination).second) combination += fmt::format(",combination-{}", n + 1);
    for (std::size_t s = 0; s < std::max<std::size_t>(seeds.size(), 1); ++s) {
      SweptCase one{n, "", overrides, {}};
      if (!seeds.empty()) one.overrides.push_back(fmt::format("{}={}", seed_key, seeds[s]));
      try {
        one.given = read_case(path, one.overrides);
      } catch (const base::Fault& fault) {
        if (code == Exit::ok) code = fault.code();
        note_lines(fault.what(), faults);
        continue;
      }
      one.name = fmt::format("{}{}seed={}", combination, combination.empty() ? "" : ",", one.given.grains.seed);
      cases.push_back(std::move(one));
    }
  }
  if (!faults.empty()) base::fail(code, "{}\nnothing was run", fmt::join(faults, "\n"));
  return cases;
}

std::string column_of(const std::string& key) {
  const Row* row = find_row(key);
  if (!row || row->unit == "-") return key;
  std::string unit = row->unit;
  std::replace(unit.begin(), unit.end(), '/', '_');
  return key + "_" + unit;
}

std::string plain_value(const Case& c, const std::string& key) {
  const Value value = find_row(key)->get(c);
  const std::string* text = std::get_if<std::string>(&value);
  return text ? *text : written(value);
}

}  // namespace livebed::casefile
