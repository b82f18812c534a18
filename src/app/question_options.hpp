#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "case/question.hpp"

namespace livebed::app {

/// A question on the command line: --pipe 0.5m --current 0.8 --sand 0.2mm [--gap 0] [--theta] [--depth].
class QuestionOptions {
public:
  void add_to(CLI::App& verb);

  /// Is any of them given?
  bool given() const;
  bool sand_alone() const;  ///< --sand and nothing else

  /// Throws Fault (command line) with every flag that is missing, contradictory, no quantity or out of range.
  casefile::Question read() const;
  /// The diameter that --sand gives [m]; throws as above.
  double sand() const;

private:
  std::string pipe_, current_, theta_, sand_, gap_, depth_;
};

}  // namespace livebed::app
