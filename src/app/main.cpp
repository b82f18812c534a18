#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "app/verbs.hpp"
#include "app/version_text.hpp"
#include "base/fault.hpp"
#include "base/loops.hpp"
#include "case/faults.hpp"
#include "grains/kernels.hpp"

namespace {

using livebed::base::Exit;

/// Ends with a better sentence than the parser's when the first word is not a verb.
void tell_unknown_verb(const CLI::App& program, int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "-";
  std::vector<std::string> verbs;
  for (const CLI::App* verb : program.get_subcommands(nullptr)) verbs.push_back(verb->get_name());
  if (word.starts_with('-') || std::find(verbs.begin(), verbs.end(), word) != verbs.end()) return;
  const std::string meant = livebed::casefile::nearest(word, verbs);
  livebed::base::fail(Exit::command_line, "{} is not a verb{}; there are {}", word,
                      meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant), livebed::casefile::listed(verbs));
}

int run(int argc, char** argv) {
  using namespace livebed;
  CLI::App program{"Scour of a sand bed under a pipeline: a turbulent current on a grid, the bed grain by grain."};
  program.name("livebed");
  program.set_version_flag("--version", app::version_text);
  program.require_subcommand(1);
  program.fallthrough();
  int threads = 1;  // small cases are faster on one: docs/performance.md
  program
      .add_option(
          "--threads", threads,
          "threads to compute on (1); more pay from some 100,000 cells or grains on; results do not depend on it")
      ->envname("LIVEBED_THREADS");
  std::string kernels{grains::kernels().name};
  program
      .add_option(
          "--kernels", kernels,
          "instruction set of the grain loop: avx512, avx2 or plain; without it the widest that this machine has")
      ->envname("LIVEBED_KERNELS");
  bool parse_only = false;
  program.add_flag("--parse-only", parse_only, "read the command line, tell what is wrong with it and do nothing else");

  app::Action chosen;
  app::add_new(program, chosen);
  app::add_check(program, chosen);
  app::add_plan(program, chosen);
  app::add_run(program, chosen);
  app::add_resume(program, chosen);
  app::add_keys(program, chosen);
  app::add_watch(program, chosen);
  app::add_report(program, chosen);
  app::add_compare(program, chosen);
  app::add_sweep(program, chosen);
  app::add_bed(program, chosen);
  app::add_bench(program, chosen);
  app::add_validate(program, chosen);
  app::add_completion(program, chosen);
  app::add_man(program, chosen);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    tell_unknown_verb(program, argc, argv);
    return static_cast<int>(program.exit(error) == 0 ? Exit::ok : Exit::command_line);
  }
  if (parse_only) return static_cast<int>(Exit::ok);
  base::set_threads(threads);
  grains::use_kernels(kernels);
  return static_cast<int>(chosen());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const livebed::base::Fault& fault) {
    fmt::print(stderr, "{}\n", fault.what());
    return static_cast<int>(fault.code());
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
    return static_cast<int>(Exit::internal);
  }
}
