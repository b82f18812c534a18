#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// The program's own command line as data: what shell completion and the man page are made from, so that neither can
/// say anything else than the parser does.
namespace livebed::app {

/// An option, or a positional argument when it has no names.
struct Argument {
  std::vector<std::string> names;    ///< "--out", "-h"
  std::string value;                 ///< what it takes, "FILE", "INT"; empty for a flag
  std::vector<std::string> choices;  ///< the only words it takes; empty when anything goes
  std::string says;
  std::string start;        ///< its default; empty when there is none
  std::string environment;  ///< the variable that sets it, too
  bool required = false, many = false;
};

struct Verb {
  std::string path;  ///< "run", "bench flow"; empty for the program itself
  std::string says;
  std::vector<Argument> options, positionals;
  std::vector<Verb> verbs;
};

Verb describe(const CLI::App& program);

/// The verb and all below it, depth first.
std::vector<const Verb*> flattened(const Verb& verb);

}  // namespace livebed::app
