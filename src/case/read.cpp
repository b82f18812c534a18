#include "case/read.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <toml++/toml.h>

#include "base/fault.hpp"
#include "case/check.hpp"
#include "case/faults.hpp"
#include "case/schema.hpp"
#include "case/units.hpp"

namespace livebed::casefile {
namespace {

/// A value of a row, or the sentence that says why there is none.
struct Converted {
  Value value;
  std::string fault;
};

std::string as_written(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& n) {
    using Node = std::decay_t<decltype(n)>;
    if constexpr (toml::is_string<Node>)
      text << written(Value(n.get()));
    else if constexpr (toml::is_floating_point<Node>)
      text << fmt::format("{}", n.get());
    else if constexpr (toml::is_array<Node>)
      text << "[...]";
    else if constexpr (toml::is_table<Node>)
      text << "{...}";
    else
      text << n;
  });
  return text.str();
}

/// The value of a key that is not given because another one stands for it.
Value nothing(const Row& row) {
  if (row.type == Type::text) return std::string();
  return row.type == Type::integer ? Value(0LL) : Value(0.0);
}

std::string kind_of(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array()) return "an array";
  if (node.is_boolean()) return "a boolean";
  if (node.is_string()) return "a string";
  if (node.is_number()) return "a number";
  return "a date or time";
}

Converted wrong_type(const Row& row, const toml::node& node, const std::string& expected) {
  return {{}, fmt::format("{} = {} is {}; {} is expected", row.name, as_written(node), kind_of(node), expected)};
}

/// A real number: bare in SI or a string with its unit.
Converted convert_real(const Row& row, const toml::node& node) {
  double value = 0;
  if (const std::optional<double> bare = node.is_number() ? node.value<double>() : std::nullopt) {
    value = *bare;
  } else if (const toml::value<std::string>* string = node.as_string()) {
    const Measured with_unit = measured(row.name, as_written(node), string->get(), row.unit);
    if (!with_unit.fault.empty()) return {{}, with_unit.fault};
    value = with_unit.value;
  } else {
    return wrong_type(row, node, describe(row.unit));
  }
  if (!std::isfinite(value)) return {{}, fmt::format("{} = {} is not a finite number", row.name, as_written(node))};
  if (!row.range.contains(value))
    return {{},
            fmt::format("{} = {} is outside {}{}", row.name, as_written(node), row.range.text(),
                        row.unit == "-" ? "" : " " + row.unit)};
  return {value, ""};
}

Converted convert_integer(const Row& row, const toml::node& node) {
  const toml::value<int64_t>* integer = node.as_integer();
  if (!integer && node.is_number())
    return {{}, fmt::format("{} = {} is not a whole number", row.name, as_written(node))};
  if (!integer) return wrong_type(row, node, "a whole number");
  if (!row.range.contains(static_cast<double>(integer->get())))
    return {{}, fmt::format("{} = {} is outside {}", row.name, as_written(node), row.range.text())};
  return {static_cast<long long>(integer->get()), ""};
}

Converted convert_word(const Row& row, const toml::node& node) {
  const toml::value<std::string>* string = node.as_string();
  if (!string) return wrong_type(row, node, "one of " + listed(row.words));
  for (const std::string& allowed : row.words)
    if (allowed == string->get()) return {allowed, ""};
  const std::string meant = nearest(string->get(), row.words);
  return {{},
          fmt::format("{} = {} is not one of {}{}", row.name, as_written(node), listed(row.words),
                      meant.empty() ? "" : fmt::format("; did you mean {}?", meant))};
}

Converted convert(const Row& row, const toml::node& node) {
  switch (row.type) {
    case Type::real:
      return convert_real(row, node);
    case Type::integer:
      return convert_integer(row, node);
    case Type::word:
      return convert_word(row, node);
    case Type::flag:
      if (!node.is_boolean()) return wrong_type(row, node, "true or false");
      return {node.as_boolean()->get(), ""};
    case Type::text:
      break;
  }
  if (!node.is_string()) return wrong_type(row, node, "a string");
  return {node.as_string()->get(), ""};
}

/// The TOML node of a value given outside a file: TOML as it stands, or else a string without its quotes.  Throws
/// toml::parse_error when it is not even text.
toml::table loose_value(const Row& row, const std::string& text) {
  const bool wants_string = row.type == Type::word || row.type == Type::text;
  if (!wants_string || text.starts_with('"')) {
    try {
      return toml::parse("v = " + text);
    } catch (const toml::parse_error&) {
      // not TOML: a bare string such as 0.36 mm
    }
  }
  return toml::parse("v = " + written(Value(text)));
}

/// "; did you mean coupling.drag (paper)?" or nothing.
std::string suggestion(const std::string& name) {
  std::vector<std::string> candidates;
  std::string meant;
  const std::string leaf = name.substr(name.find('.') + 1);
  for (const Row& row : schema()) {
    if (row.derived) continue;
    candidates.push_back(row.name);
    if (row.name.substr(row.name.find('.') + 1) == leaf) meant = row.name;  // right key, wrong table
  }
  if (meant.empty()) meant = nearest(name, candidates);
  if (meant.empty()) return "";
  const Row* row = find_row(meant);
  return fmt::format("; did you mean {}{}?", meant, row->words.empty() ? "" : fmt::format(" ({})", listed(row->words)));
}

std::vector<std::string> table_names() {
  std::vector<std::string> names;
  for (const Row& row : schema()) {
    const std::size_t dot = row.name.find('.');
    if (dot == std::string::npos) continue;
    if (names.empty() || names.back() != row.name.substr(0, dot)) names.push_back(row.name.substr(0, dot));
  }
  return names;
}

std::string meant_table(const std::string& meant) {
  return meant.empty() ? "" : fmt::format("; did you mean [{}]?", meant);
}

/// The TOML parser's complaint in our words.
std::string syntax_fault(const std::string& description) {
  const std::size_t quote = description.find('\'');
  if (description.find("cannot redefine") != std::string::npos && quote != std::string::npos)
    return fmt::format("{} is given twice", description.substr(quote + 1, description.rfind('\'') - quote - 1));
  return "not TOML: " + description;
}

Origin line_of(const toml::node& node) { return {Origin::Kind::file, static_cast<int>(node.source().begin.line)}; }

class Reader {
public:
  explicit Reader(std::string file) : file_(std::move(file)), faults_(file_) {}

  Case read(std::string_view text, const std::vector<std::string>& overrides) {
    const toml::table root = parse(text);
    std::vector<std::pair<std::string, std::string>> settings = split(overrides);
    set_preset(root, settings);
    add_file(root);
    for (const auto& [name, value] : settings) add_override(name, value);
    for (const Alternatives& group : alternatives()) choose(group);
    const std::string underivable = derive_safely();
    check(case_, sources_, faults_);
    if (faults_.empty() && !underivable.empty()) faults_.add({}, "{}", underivable);
    const toml::table* derived = root["derived"].as_table();
    if (derived && overrides.empty()) compare_derived("", *derived);
    faults_.report();
    return case_;
  }

  /// Sets the keys on which the presets differ.
  void add_preset(std::string_view preset) {
    case_.preset = preset;
    for (const Choice& choice : choices()) {
      const std::string& text = preset == "mbs2d" ? choice.mbs2d : choice.livebed;
      const Row& row = *find_row(choice.key);
      if (!text.empty()) set(row, convert(row, *loose_value(row, text).get("v")), {Origin::Kind::preset, 0});
    }
  }
  const Case& result() const { return case_; }

private:
  toml::table parse(std::string_view text) {
    try {
      return toml::parse(text);
    } catch (const toml::parse_error& error) {
      faults_.add({Origin::Kind::file, static_cast<int>(error.source().begin.line)}, "{}",
                  syntax_fault(std::string(error.description())));
      faults_.report();
      throw;  // not reached: report throws
    }
  }

  std::vector<std::pair<std::string, std::string>> split(const std::vector<std::string>& overrides) {
    std::vector<std::pair<std::string, std::string>> settings;
    std::set<std::string> seen;
    for (const std::string& text : overrides) {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos || equals == 0) {
        faults_.add({Origin::Kind::command_line, 0}, "\"{}\" is not table.key=value", text);
      } else if (!seen.insert(text.substr(0, equals)).second) {
        faults_.add({Origin::Kind::command_line, 0}, "{} is given twice", text.substr(0, equals));
      } else {
        settings.emplace_back(text.substr(0, equals), text.substr(equals + 1));
      }
    }
    return settings;
  }

  void set(const Row& row, const Converted& converted, const Origin& origin) {
    sources_.origin[row.name] = origin;
    if (converted.fault.empty()) {
      row.set(case_, converted.value);
      sources_.bad.erase(row.name);
    } else {
      faults_.add(origin, "{}", converted.fault);
      sources_.bad.insert(row.name);
    }
  }

  /// The preset counts first, wherever it is written: the keys given replace its choices.
  void set_preset(const toml::table& root, std::vector<std::pair<std::string, std::string>>& settings) {
    const Row& row = *find_row("preset");
    add_preset(case_.preset);
    toml::table loose;
    const toml::node* node = root.get("preset");
    Origin origin = node ? line_of(*node) : Origin{};
    for (const auto& [name, value] : settings) {
      if (name != "preset") continue;
      loose = loose_value(row, value);
      node = loose.get("v");
      origin = {Origin::Kind::command_line, 0};
    }
    std::erase_if(settings, [](const auto& setting) { return setting.first == "preset"; });
    if (!node) return;
    const Converted converted = convert(row, *node);
    set(row, converted, origin);
    if (!converted.fault.empty()) return;
    const std::string chosen = case_.preset;
    case_ = Case{};
    sources_.origin.clear();
    add_preset(chosen);
  }

  void add_file(const toml::table& root) {
    for (const auto& [key, node] : root) {
      const std::string name(key.str());
      if (name == "preset" || (name == "derived" && node.is_table())) continue;
      const std::vector<std::string> tables = table_names();
      const bool known = std::find(tables.begin(), tables.end(), name) != tables.end();
      if (known && node.is_table()) {
        for (const auto& [leaf, value] : *node.as_table()) add_key(name + "." + std::string(leaf.str()), value);
      } else if (known) {
        faults_.add(line_of(node), "{} = {} is {}; {} is a table of keys", name, as_written(node), kind_of(node), name);
      } else if (node.is_table()) {
        const std::string meant = nearest(name, tables);
        faults_.add(line_of(node), "unknown table [{}]{}", name, meant_table(meant));
      } else {
        faults_.add(line_of(node), "unknown key {}{}", name, suggestion(name));
      }
    }
  }

  /// The row of a key that may be given; notes a fault and returns null for any other.
  const Row* row_to_set(const std::string& name, const Origin& origin) {
    const Row* row = find_row(name);
    if (!row) faults_.add(origin, "unknown key {}{}", name, suggestion(name));
    if (row && row->derived) faults_.add(origin, "{} cannot be given: it is computed ({})", name, row->meaning);
    return row && !row->derived ? row : nullptr;
  }

  void add_key(const std::string& name, const toml::node& node) {
    if (node.is_table() && !find_row(name)) {
      const std::string meant = nearest(name.substr(name.find('.') + 1), table_names());
      faults_.add(line_of(node), "unknown table [{}]{}", name, meant_table(meant));
    } else if (const Row* row = row_to_set(name, line_of(node))) {
      set(*row, convert(*row, node), line_of(node));
    }
  }

  void add_override(const std::string& name, const std::string& text) {
    const Origin origin{Origin::Kind::command_line, 0};
    const Row* row = row_to_set(name, origin);
    if (!row) return;
    try {
      set(*row, convert(*row, *loose_value(*row, text).get("v")), origin);
    } catch (const toml::parse_error&) {
      set(*row, {{}, fmt::format("{} is not UTF-8 text", name)}, origin);
    }
  }

  /// Of keys that stand for one another the uppermost layer decides: --set before the file before the preset.  Two of
  /// one layer contradict each other.
  void choose(const Alternatives& group) {
    using Kind = Origin::Kind;
    std::vector<std::string> chosen;
    for (const Kind layer : {Kind::command_line, Kind::file, Kind::preset}) {
      for (const std::string& key : group.keys) {
        const auto found = sources_.origin.find(key);
        if (found != sources_.origin.end() && found->second.kind == layer) chosen.push_back(key);
      }
      if (!chosen.empty()) break;
    }
    if (chosen.empty() && !group.otherwise.empty()) chosen.push_back(group.otherwise);
    if (chosen.size() > 1)
      faults_.add(later(chosen), "{} contradict each other: give one of them", fmt::join(chosen, " and "));
    if (chosen.empty()) faults_.add({}, "missing: give one of {}", listed(group.keys));
    if (chosen.size() != 1) {
      sources_.bad.insert(group.keys.begin(), group.keys.end());
      return;
    }
    case_.given.push_back(chosen[0]);
    for (const std::string& key : group.keys) {
      const Row& row = *find_row(key);
      if (key != chosen[0]) row.set(case_, nothing(row));
      if (sources_.bad.contains(chosen[0])) sources_.bad.insert(key);
    }
  }

  Origin later(const std::vector<std::string>& names) {
    return sources_.origin[*std::max_element(names.begin(), names.end(), [&](const auto& a, const auto& b) {
      return sources_.origin[a].line < sources_.origin[b].line;
    })];
  }

  /// Why a number could not be derived; empty when all could.  Usually the consequence of a fault told otherwise.
  std::string derive_safely() {
    try {
      derive(case_);
    } catch (const base::Fault& fault) {
      return fault.what();
    }
    return "";
  }

  /// A resolved case carries its derived numbers; one whose keys were edited since then contradicts them.
  void compare_derived(const std::string& prefix, const toml::table& table) {
    for (const auto& [key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      if (const toml::table* inner = node.as_table()) {
        compare_derived(name + ".", *inner);
        continue;
      }
      const Row* row = find_row(name);
      const std::optional<double> told = node.value<double>();
      if (!row || !told) {
        faults_.add(line_of(node), "unknown derived number {}{}", name, suggestion(name));
        continue;
      }
      const Value value = row->get(case_);
      const double found =
          row->type == Type::integer ? static_cast<double>(std::get<long long>(value)) : std::get<double>(value);
      constexpr double tolerance = 1e-9;  // compilers may round a derivation differently
      if (faults_.empty() && std::abs(found - *told) > tolerance * std::abs(found))
        faults_.add(line_of(node), "derived.{} = {} contradicts the keys, which give {}; remove the table [derived]",
                    name, *told, found);
    }
  }

  std::string file_;
  Faults faults_;
  Case case_;
  Sources sources_;
};

}  // namespace

std::filesystem::path case_file(const std::filesystem::path& path) {
  return std::filesystem::is_directory(path) ? path / "case.toml" : path;
}

Case read_case(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  const std::filesystem::path file = case_file(path);
  std::ifstream stream(file);
  std::string text;
  if (stream) text.assign(std::istreambuf_iterator<char>(stream), {});
  if (!stream)
    base::fail(base::Exit::input_output, "cannot read the case file {}: {}", file.string(),
               std::generic_category().message(errno));
  return read_text(text, file.string(), overrides);
}

Case read_text(std::string_view toml, const std::string& name, const std::vector<std::string>& overrides) {
  return Reader(name).read(toml, overrides);
}

Case preset_case(std::string_view preset) {
  Reader reader{std::string(preset)};
  reader.add_preset(preset);
  return reader.result();
}

}  // namespace livebed::casefile
