#include <fmt/core.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/verbs.hpp"
#include "case/faults.hpp"
#include "case/manual.hpp"
#include "case/schema.hpp"

namespace livebed::app {
namespace {

using nlohmann::ordered_json;

std::string type_name(casefile::Type type) {
  switch (type) {
    case casefile::Type::flag:
      return "flag";
    case casefile::Type::integer:
      return "integer";
    case casefile::Type::real:
      return "real";
    case casefile::Type::word:
      return "word";
    case casefile::Type::text:
      break;
  }
  return "text";
}

ordered_json as_json(const std::string& preset) {
  ordered_json all = ordered_json::array();
  for (const casefile::Row& row : casefile::schema()) {
    all.push_back({{"name", row.name},
                   {"type", type_name(row.type)},
                   {"unit", row.unit},
                   {"allowed", casefile::allowed(row)},
                   {"default", casefile::default_of(row, preset)},
                   {"meaning", row.meaning},
                   {"source", row.source}});
  }
  return all;
}

}  // namespace

void add_keys(CLI::App& app, Action& chosen) {
  struct Options {
    std::string preset = "livebed";
    bool json = false, markdown = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("keys", "list every key of a case file with its default, range and meaning");
  verb->add_option("--preset", options->preset, "whose defaults")->check(CLI::IsMember(casefile::presets()));
  CLI::Option* json = verb->add_flag("--json", options->json, "as JSON");
  verb->add_flag("--markdown", options->markdown, "as docs/keys.md, both presets")->excludes(json);
  verb->callback([options, &chosen] {
    chosen = [options] {
      if (options->json)
        fmt::print("{}\n", as_json(options->preset).dump(2));
      else
        fmt::print("{}", options->markdown ? casefile::manual_markdown() : casefile::manual_text(options->preset));
      return base::Exit::ok;
    };
  });
}

}  // namespace livebed::app
