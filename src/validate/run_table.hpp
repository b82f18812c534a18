#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace livebed::validate {

/// A CSV file that several numbered runs share: a comment on what it holds, one on each run, the header, whose first
/// column is the number, each run's rows.
class RunTable {
public:
  RunTable(std::string says, std::string header) : says_(std::move(says)), header_(std::move(header)) {}

  /// made: what it is and who made it, in one line; rows: whole lines.
  void add(unsigned run, std::string made, std::string rows) { runs_[run] = {std::move(made), std::move(rows)}; }
  /// Takes over the runs of a file that are not here yet.  Fault (input/output) when it is not a file of this kind.
  void keep(std::string_view file, const std::string& source);
  /// The same where there is such a file.
  void keep(const std::filesystem::path& file);
  bool has(unsigned run) const { return runs_.contains(run); }

  std::string text() const;

private:
  struct Lines {
    std::string made, rows;
  };
  std::string begins_run() const;  ///< of the comment on a run

  std::string says_, header_;
  std::map<unsigned, Lines> runs_;
};

}  // namespace livebed::validate
