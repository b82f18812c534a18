#include "report/report.hpp"

#include <fmt/core.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/verbs.hpp"

namespace livebed::app {

void add_report(CLI::App& app, Action& chosen) {
  struct Options {
    std::string folder, png;
    double at = 0;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("report", "make DIR/report.html from the files of a run, finished or not");
  verb->add_option("DIR", options->folder, "folder of the run")->required();
  CLI::Option* png =
      verb->add_option("--png", options->png, "write only the snapshot nearest to --at, as this PNG file");
  verb->add_option("--at", options->at, "time of that snapshot [s]")->needs(png);
  verb->add_flag("--json", options->json, "tell what was written as JSON");
  verb->callback([options, &chosen] {
    chosen = [options] {
      nlohmann::ordered_json told;
      if (!options->png.empty()) {
        told = {{"picture", options->png},
                {"time_s", report::write_picture(options->folder, options->at, options->png)}};
        if (!options->json) fmt::print("{} (t = {} s)\n", options->png, told["time_s"].get<double>());
      } else {
        const report::Written written = report::write_report(options->folder);
        told = {{"report", written.path.string()}, {"frames", written.frames}, {"missing", written.missing}};
        if (!options->json) {
          for (const std::string& sentence : written.missing) fmt::print("note: {}\n", sentence);
          fmt::print("{}\n", written.path.string());
        }
      }
      if (options->json) fmt::print("{}\n", told.dump(2));
      return base::Exit::ok;
    };
  });
}

}  // namespace livebed::app
