#pragma once
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

/// All that is wrong with a case file, collected and told in one go.
namespace livebed::casefile {

/// Where a value comes from: a line of the file, the command line, or nobody (a default).
struct Origin {
  enum class Kind { none, preset, file, command_line };
  Kind kind = Kind::none;
  int line = 0;  ///< of the file, from 1
};

class Faults {
public:
  explicit Faults(std::string file) : file_(std::move(file)) {}

  /// Notes one fault: add(origin, "{} = {} is outside {}", ...).
  template <class... Args>
  void add(const Origin& at, fmt::format_string<Args...> text, Args&&... args) {
    lines_.push_back({at, fmt::format(text, std::forward<Args>(args)...)});
  }

  bool empty() const { return lines_.empty(); }

  /// Throws base::Fault (invalid case) that lists every fault in the order of the file's lines; nothing when there is
  /// none.
  void report() const;

private:
  struct Line {
    Origin at;
    std::string text;
  };
  std::string file_;
  std::vector<Line> lines_;
};

/// The candidate nearest to a mistyped word by edit distance; empty when none is near enough to be meant.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b, c"
std::string listed(const std::vector<std::string>& words);

}  // namespace livebed::casefile
