#include <fmt/core.h>
#include <memory>
#include <string>

#include "app/server.hpp"
#include "app/verbs.hpp"
#include "report/run_folder.hpp"
#include "run/control.hpp"

namespace livebed::app {

void add_watch(CLI::App& app, Action& chosen) {
  struct Options {
    std::string folder;
    int port = 0;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb =
      app.add_subcommand("watch", "serve the page of a run that is going on or has ended, to this machine alone");
  verb->add_option("DIR", options->folder, "folder of the run")->required();
  verb->add_option("--port", options->port,
                   fmt::format("port on 127.0.0.1; without it the first free one from {} on", default_port))
      ->check(CLI::Range(1, 65535));
  verb->callback([options, &chosen] {
    chosen = [options] {
      if (!run::is_running(options->folder)) report::read_outline(options->folder);  // tells what is wrong with it
      serve(options->folder, {.port = options->port, .linger = 0, .ready = [&](const std::string& address) {
                                fmt::print("{} shows {}; Ctrl-C ends it\n", address, options->folder);
                                std::fflush(stdout);
                                return true;
                              }});
      return base::Exit::ok;
    };
  });
}

}  // namespace livebed::app
