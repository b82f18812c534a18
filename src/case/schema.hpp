#pragma once
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "case/case.hpp"

/// Every key of a case file, one row a key: the row is parser, check, listing and manual at once.  The default of a key
/// is the value its struct starts with, or that of the preset.
namespace livebed::casefile {

using Value = std::variant<bool, long long, double, std::string>;

enum class Type { flag, integer, real, word, text };

/// Interval of allowed numbers; open ends exclude their bound.
struct Range {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool least_open = true, most_open = true;

  bool contains(double a) const { return (least_open ? a > least : a >= least) && (most_open ? a < most : a <= most); }
  std::string text() const;  ///< "(0, 1]"
};

struct Row {
  std::string name;  ///< table.key
  Type type = Type::real;
  std::string unit = "-";  ///< in SI
  Range range;
  std::vector<std::string> words;  ///< allowed words of a Type::word
  std::string meaning, source;
  bool derived = false;  ///< computed, cannot be given
  std::function<Value(const Case&)> get;
  std::function<void(Case&, const Value&)> set;

  // What a row is made of, in the schema's own words.
  Row& within(double least, double most) { return between({least, most, false, false}); }
  Row& above(double least) { return between({least, std::numeric_limits<double>::infinity(), true, true}); }
  Row& above(double least, double most) { return between({least, most, true, false}); }
  Row& at_least(double least) { return between({least, std::numeric_limits<double>::infinity(), false, true}); }
  Row& says(std::string text) {
    meaning = std::move(text);
    return *this;
  }
  Row& from(std::string text) {
    source = std::move(text);
    return *this;
  }

private:
  Row& between(Range allowed) {
    range = allowed;
    return *this;
  }
};

/// All rows, table by table.
const std::vector<Row>& schema();

/// The row of a key; null when there is none.
const Row* find_row(std::string_view name);

/// Keys that stand for one another: a case gives one of them and the others follow from it.
struct Alternatives {
  std::vector<std::string> keys;
  std::string otherwise;  ///< the one whose default counts when none is given; empty: one must be given
};
const std::vector<Alternatives>& alternatives();

/// The two readings of an open question: what the paper chose and what we choose.
struct Choice {
  std::string key;
  std::string mbs2d, livebed;  ///< values as written in a case file
};
const std::vector<Choice>& choices();
const std::vector<std::string>& presets();

/// A value as it is written in a case file; reading it gives the same bits again.
std::string written(const Value& value);

}  // namespace livebed::casefile
