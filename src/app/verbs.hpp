#pragma once
#include <CLI/CLI.hpp>
#include <functional>

#include "base/fault.hpp"

/// The verbs of the program, one file each.  add_<verb> declares its options; when the command line names the verb, it
/// leaves in `chosen` what is to be done, and main does it once everything is parsed.
namespace livebed::app {

/// Does the verb's work and returns the exit code; throws base::Fault for everything a user can get wrong.
using Action = std::function<base::Exit()>;

void add_new(CLI::App& app, Action& chosen);
void add_plan(CLI::App& app, Action& chosen);
void add_run(CLI::App& app, Action& chosen);
void add_resume(CLI::App& app, Action& chosen);
void add_check(CLI::App& app, Action& chosen);
void add_keys(CLI::App& app, Action& chosen);
void add_watch(CLI::App& app, Action& chosen);
void add_report(CLI::App& app, Action& chosen);
void add_compare(CLI::App& app, Action& chosen);
void add_sweep(CLI::App& app, Action& chosen);
void add_bed(CLI::App& app, Action& chosen);
void add_bench(CLI::App& app, Action& chosen);
void add_validate(CLI::App& app, Action& chosen);
void add_completion(CLI::App& app, Action& chosen);
void add_man(CLI::App& app, Action& chosen);

}  // namespace livebed::app
