#include <fmt/core.h>
#include <memory>
#include <string>
#include <vector>

#include "app/verbs.hpp"
#include "report/report.hpp"

namespace livebed::app {

void add_compare(CLI::App& app, Action& chosen) {
  struct Options {
    std::vector<std::string> folders;
    std::string out = "compare.html";
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("compare", "lay the curves of runs on top of each other, in one page");
  verb->add_option("DIR", options->folders, "folders of two or more runs")->required()->expected(2, 12);
  verb->add_option("--out", options->out, "the page to write")->capture_default_str();
  verb->callback([options, &chosen] {
    chosen = [options] {
      report::write_comparison({options->folders.begin(), options->folders.end()}, options->out);
      fmt::print("{}\n", options->out);
      return base::Exit::ok;
    };
  });
}

}  // namespace livebed::app
