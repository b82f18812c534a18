#include <fmt/core.h>
#include <memory>

#include "app/verbs.hpp"
#include "case/faults.hpp"
#include "io/file.hpp"
#include "run/execute.hpp"
#include "validate/result.hpp"

namespace livebed::app {

namespace {

base::Exit validate_one(const validate::Case& which, const std::string& folder, const std::vector<unsigned>& runs,
                        bool json) {
  if (!runs.empty() && which.run_some == nullptr)
    base::fail(base::Exit::command_line, "{} has no runs to choose from; leave --only out", which.name);
  const validate::Tell tell = [json](const std::string& line) {
    std::FILE* to = json ? stderr : stdout;
    fmt::print(to, "{}\n", line);
    std::fflush(to);
  };
  const validate::Result result = runs.empty() ? which.run(tell) : which.run_some({runs, folder}, tell);
  const std::string text = validate::to_json(result);
  io::make_folder(folder);
  io::write_atomically(io::Path(folder) / fmt::format("{}.json", which.name), text);
  for (const validate::Picture& picture : result.pictures)
    io::write_atomically(io::Path(folder) / picture.name, picture.svg);
  if (json) fmt::print("{}", text);
  for (const validate::Row& row : result.rows)
    if (!row.pass())
      fmt::print(stderr, "outside its target: {} = {:.5g} {}, wanted {:.5g} to {:.5g} ({})\n", row.name, row.value,
                 row.unit, row.low, row.high, row.reference);
  if (run::stop_signal() != 0)
    return static_cast<base::Exit>(static_cast<int>(base::Exit::signal) + run::stop_signal());
  return result.pass() ? base::Exit::ok : base::Exit::comparison;
}

}  // namespace

void add_validate(CLI::App& app, Action& chosen) {
  struct Options {
    std::string name, folder = "docs/validation", grain;
    std::vector<unsigned> runs;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand(
      "validate", "hold whole flows and beds against the literature; without NAME, list what there is");
  verb->add_option("NAME", options->name, "what to validate");
  verb->add_option("--out", options->folder, "folder for NAME.json and its figures")->capture_default_str();
  verb->add_option("--grain", options->grain,
                   "of mao: 0.7mm, 1mm or 2mm (the paper's) instead of the experiment's 0.36 mm");
  verb->add_option(
      "--only", options->runs,
      "of mao, mao-study and design-chart: make the run of this number (its seed, its variant) alone and keep what the "
      "files in the folder tell of others; may be repeated");
  verb->add_flag("--json", options->json, "print the numbers as JSON");
  verb->callback([options, &chosen] {
    chosen = [options] {
      if (!options->grain.empty() && options->grain != "0.36mm") options->name += "-" + options->grain;
      std::vector<std::string> names;
      for (const validate::Case& c : validate::cases()) {
        if (options->name == c.name) return validate_one(c, options->folder, options->runs, options->json);
        names.emplace_back(c.name);
      }
      if (!options->name.empty())
        base::fail(base::Exit::command_line, "{} is nothing to validate; there are {}", options->name,
                   casefile::listed(names));
      for (const validate::Case& c : validate::cases()) fmt::print("{:24} {}\n", c.name, c.says);
      return base::Exit::ok;
    };
  });
}

}  // namespace livebed::app
