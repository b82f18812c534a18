#include <csignal>
#include <memory>
#include <string>
#include <vector>

#include "app/run_options.hpp"
#include "app/verbs.hpp"
#include "case/read.hpp"
#include "run/bed_cache.hpp"
#include "run/execute.hpp"

namespace livebed::app {

void add_run(CLI::App& app, Action& chosen) {
  auto* verb = app.add_subcommand("run", "Run a case: pack the bed, start the flow, let the grains go.");
  struct Arguments {
    std::string path, out;
    std::vector<std::string> set;
    std::string bed_cache = run::default_bed_cache().string();
    bool no_bed_cache = false;
    RunArguments common;
  };
  auto a = std::make_shared<Arguments>();
  verb->add_option("case", a->path, "case file, or a folder with a case.toml")->required();
  verb->add_option("--out", a->out, "new folder of the run")->required();
  verb->add_option("--set", a->set, "overrides a key: --set table.key=value; may be repeated")->allow_extra_args(false);
  verb->add_option("--bed-cache", a->bed_cache, "folder of packed beds: the second run of a bed starts at once")
      ->capture_default_str();
  verb->add_flag("--no-bed-cache", a->no_bed_cache, "pack the bed whatever has been kept, and keep nothing");
  add_run_arguments(*verb, a->common);
  verb->callback([a, &chosen] {
    chosen = [a] {
      const casefile::Case given = casefile::read_case(a->path, a->set);
      return run_with(a->out, a->common, [&](run::Options options) {
        if (!a->no_bed_cache) options.bed_cache = a->bed_cache;
        return run::execute(given, a->out, options);
      });
    };
  });
}

void add_resume(CLI::App& app, Action& chosen) {
  auto* verb =
      app.add_subcommand("resume", "Continue a run from its last checkpoint, bit for bit as if never stopped.");
  struct Arguments {
    std::string folder;
    double until = -1;
    RunArguments common;
  };
  auto a = std::make_shared<Arguments>();
  verb->add_option("folder", a->folder, "folder of the run")->required();
  verb->add_option("--until", a->until, "new last time [s]")->check(CLI::PositiveNumber);
  add_run_arguments(*verb, a->common);
  verb->callback([a, &chosen] {
    chosen = [a] {
      const std::optional<double> until = a->until > 0 ? std::optional(a->until) : std::nullopt;
      return run_with(a->folder, a->common,
                      [&](const run::Options& options) { return run::resume(a->folder, until, options); });
    };
  });
}

}  // namespace livebed::app
