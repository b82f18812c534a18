#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fmt/core.h>

#include "app/verbs.hpp"
#include "base/fault.hpp"
#include "base/loops.hpp"
#include "base/version.hpp"

namespace {

using livebed::base::Exit;

int run(int argc, char** argv) {
  using namespace livebed;
  CLI::App program{"Scour of a sand bed under a pipeline: a turbulent current on a grid, the bed grain by grain."};
  program.name("livebed");
  program.set_version_flag("--version",
                           fmt::format("livebed {} ({}, {})", base::version(), base::commit(), base::compiler()));
  program.require_subcommand(1);
  program.fallthrough();
  int threads = 1;
  program.add_option("--threads", threads, "threads to compute on; the results do not depend on it")
      ->envname("LIVEBED_THREADS");

  app::Action chosen;
  app::add_new(program, chosen);
  app::add_check(program, chosen);
  app::add_keys(program, chosen);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return static_cast<int>(program.exit(error) == 0 ? Exit::ok : Exit::command_line);
  }
  base::set_threads(threads);
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
