#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>

#include "base/fault.hpp"
#include "run/execute.hpp"

namespace livebed::app {

/// What `run` and `resume` have in common on the command line.
struct RunArguments {
  double wall_limit = 0;
  bool quiet = false;
  bool watch = false;
  int port = 0;
};
void add_run_arguments(CLI::App& verb, RunArguments& arguments);

/// Does the work with signals caught, progress shown (a bar on a terminal, a line now and then elsewhere) and every
/// line kept in log.txt of the folder; with `watch` the page is served by a process of its own.  Exits through 128 + n
/// when a signal stopped it.
base::Exit run_with(const std::filesystem::path& folder, const RunArguments& arguments,
                    const std::function<base::Exit(const run::Options&)>& work);

}  // namespace livebed::app
