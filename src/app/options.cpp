#include "app/options.hpp"

#include "case/read.hpp"

namespace livebed::app {

void CaseOptions::add_to(CLI::App& verb, bool required) {
  verb.add_option("CASE", path, "case file, or a folder that holds case.toml")->required(required);
  verb.add_option("--set", overrides, "override a key: --set grains.diameter=\"1 mm\" (repeatable)")
      ->type_name("TABLE.KEY=VALUE")
      ->allow_extra_args(false);
}

casefile::Case CaseOptions::read() const { return casefile::read_case(path, overrides); }

}  // namespace livebed::app
