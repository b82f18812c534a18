#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "case/case.hpp"

/// Options that several verbs share.
namespace livebed::app {

/// A case as the command line names it: CASE and any number of --set table.key=value.
struct CaseOptions {
  std::string path;
  std::vector<std::string> overrides;

  void add_to(CLI::App& verb, bool required = true);
  casefile::Case read() const;
};

}  // namespace livebed::app
