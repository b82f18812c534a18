#include "case/faults.hpp"

#include <algorithm>
#include <numeric>

#include "base/fault.hpp"

namespace livebed::casefile {
namespace {

/// Number of insertions, deletions, replacements and swaps of neighbours that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> two_ago(b.size() + 1), one_ago(b.size() + 1), row(b.size() + 1);
  std::iota(one_ago.begin(), one_ago.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({one_ago[j] + 1, row[j - 1] + 1, one_ago[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], two_ago[j - 2] + 1);
    }
    std::swap(two_ago, one_ago);
    std::swap(one_ago, row);
  }
  return one_ago[b.size()];
}

}  // namespace

void Faults::report() const {
  if (lines_.empty()) return;
  std::vector<Line> lines = lines_;
  std::stable_sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) {
    const auto order = [](const Line& l) { return l.at.kind == Origin::Kind::command_line ? 1 << 30 : l.at.line; };
    return order(a) < order(b);
  });
  std::string text;
  for (const Line& line : lines) {
    if (line.at.kind == Origin::Kind::command_line)
      text += "--set: ";
    else if (line.at.kind == Origin::Kind::file)
      text += fmt::format("{}:{}: ", file_, line.at.line);
    else
      text += fmt::format("{}: ", file_);
    text += line.text + "\n";
  }
  text += fmt::format("{} fault{}, nothing was run", lines.size(), lines.size() == 1 ? "" : "s");
  throw base::Fault(base::Exit::invalid_case, text);
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least && distance < candidate.size()) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string listed(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

}  // namespace livebed::casefile
