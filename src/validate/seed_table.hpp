#pragma once
#include <map>
#include <string>
#include <string_view>

namespace livebed::validate {

/// A CSV file that several runs share, each with a seed of its own: a comment on what it holds, one on each seed's run,
/// the header (`seed` first), each seed's rows.
class SeedTable {
public:
  SeedTable(std::string says, std::string header) : says_(std::move(says)), header_(std::move(header)) {}

  /// run: who made it, in one line; rows: whole lines.
  void add(unsigned seed, std::string run, std::string rows) { seeds_[seed] = {std::move(run), std::move(rows)}; }
  /// Takes over the seeds of a file that are not here yet.  Fault (input/output) when it is not a file of this kind.
  void keep(std::string_view file, const std::string& source);
  bool has(unsigned seed) const { return seeds_.contains(seed); }

  std::string text() const;

private:
  struct Lines {
    std::string run, rows;
  };
  std::string says_, header_;
  std::map<unsigned, Lines> seeds_;
};

}  // namespace livebed::validate
