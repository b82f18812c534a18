#pragma once
#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

/// Comparisons of whole flows and beds with the literature: `livebed validate NAME`.
namespace livebed::validate {

/// One number that came out and what it is held against.
struct Row {
  std::string name;
  double value = 0;
  std::string unit{};
  double low = std::numeric_limits<double>::quiet_NaN();  ///< target, both ends included; NaN = told, not judged
  double high = low;
  std::string reference{};  ///< where the target is from
  std::string setup{};      ///< what was run, in one line; its hash goes into the file
  double seconds = 0;       ///< wall time of that run
  std::string commit{};     ///< of the program that made the run; empty = of this one

  bool judged() const { return low == low; }
  bool pass() const { return !judged() || (value >= low && value <= high); }
};

struct Picture {
  std::string name;  ///< file name without folder
  std::string svg;
};

struct Result {
  std::vector<Row> rows;
  std::vector<Picture> pictures;
  bool pass() const;
};

/// Called with a line about progress now and then.
using Tell = std::function<void(const std::string&)>;

/// Which of a case's numbered runs to make; none: all.  What the case's files in `folder` tell of others is kept.
struct Only {
  std::vector<unsigned> runs{};
  std::filesystem::path folder{};

  bool makes(unsigned run) const { return runs.empty() || std::count(runs.begin(), runs.end(), run) > 0; }
};

struct Case {
  std::string_view name, says;
  Result (*run)(const Tell& tell);
  Result (*run_some)(const Only& only, const Tell& tell) = nullptr;  ///< null where there is nothing to choose from
};

/// Everything that can be validated, in the order in which a list shows it.
const std::vector<Case>& cases();

/// The rows as a JSON list, each with the commit of the program and the hash of its setup.
std::string to_json(const Result& result);
/// The rows of such a list.  Fault (input/output) with the source's name when it is none.
std::vector<Row> rows_of_json(const std::string& text, const std::string& source);
/// Adds the rows of such a file, if there is one, but for those of runs with these labels ("LABEL: ...").
void keep_rows(const std::filesystem::path& file, const std::vector<std::string>& but, Result& result);

}  // namespace livebed::validate
