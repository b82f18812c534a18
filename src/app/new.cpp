#include <cerrno>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <memory>
#include <system_error>

#include "app/templates.hpp"
#include "app/verbs.hpp"
#include "case/faults.hpp"

namespace livebed::app {
namespace {

using base::Exit;
using base::fail;

const Template& find_template(const std::string& name) {
  std::vector<std::string> names;
  for (const Template& shipped : templates()) {
    if (shipped.name == name) return shipped;
    names.push_back(shipped.name);
  }
  const std::string meant = casefile::nearest(name, names);
  fail(Exit::command_line, "there is no case {} to start from{}; there are {}", name,
       meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant), casefile::listed(names));
}

/// Writes a new file; never over an old one.
void write_new(const std::filesystem::path& path, const std::string& text) {
  if (std::filesystem::exists(path)) fail(Exit::input_output, "{} exists; name another file", path.string());
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) fail(Exit::input_output, "cannot write {}: {}", path.string(), std::generic_category().message(errno));
}

}  // namespace

void add_new(CLI::App& app, Action& chosen) {
  struct Options {
    std::string name, out;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("new", "print a commented case file to start from");
  verb->add_option("NAME", options->name, "which: mao-mbs2d, quick, flat-bed, mao-mbs2d/deep, ...")->required();
  verb->add_option("--out", options->out, "write it to this new file instead")->type_name("FILE");
  verb->callback([options, &chosen] {
    chosen = [options] {
      const Template& start = find_template(options->name);
      if (options->out.empty())
        fmt::print("{}", start.text);
      else
        write_new(options->out, start.text);
      return Exit::ok;
    };
  });
}

}  // namespace livebed::app
