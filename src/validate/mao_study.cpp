#include "validate/mao_study.hpp"

#include <fmt/format.h>

#include "validate/references.hpp"

namespace livebed::validate {

namespace {

struct Variant {
  const char* name;
  std::vector<std::string> keys;
};

/// The first is the case itself.  Numbers are kept: new ones come last.
const std::vector<Variant>& variants() {
  static const std::vector<Variant> all = {
      {"as it is", {}},
      {"cells two thirds as large", {"mesh.cell_x=0.833 mm", "mesh.cell_y=0.28 mm"}},
      {"steps of the grains half as long", {"time.grain_step=0.7e-5"}},
      {"steps of the flow half as long", {"flow.courant=0.4", "flow.courant_y=1"}},
      {"k-epsilon, realizable", {"flow.closure=k_epsilon_realizable"}},
      {"grains feel no eddies", {"coupling.dispersion=none"}},
      {"grains feel the eddies of their own place alone", {"coupling.dispersion=random_walk"}},
      {"eddies not bounded among grains", {"coupling.turbulence=untouched"}},
      {"no lift", {"coupling.lift=none"}},
      {"added mass relative to the water", {"coupling.added_mass=relative"}},
      {"drag of Gidaspow", {"coupling.drag=gidaspow"}},
      {"the paper's exchange: no void fraction",
       {"coupling.voidage=off", "coupling.drag=paper", "coupling.turbulence=untouched"}},
      {"no resistance to rolling", {"contact.rolling_friction=0"}},
      {"turbulent layer on the pipe", {"pipe.boundary_layer=turbulent"}},
      {"nothing fed", {"bed.supply=none"}},
      {"sand goes round", {"bed.supply=periodic"}},
      {"grains asleep below a fifth of the speed", {"grains.sleep_speed=0.01"}},
  };
  return all;
}

/// Adds "table.key=value", or puts it in the place of an earlier value of that key.
void set(std::vector<std::string>& keys, const std::string& key) {
  const std::string name = key.substr(0, key.find('=') + 1);
  std::erase_if(keys, [&](const std::string& earlier) { return earlier.starts_with(name); });
  keys.push_back(key);
}

}  // namespace

Experiment study_of_mao() {
  Experiment e{"mao-study", mao_case, "variant", {}, true};
  for (const Variant& variant : variants()) {
    const auto number = static_cast<unsigned>(e.runs.size()) + 1;
    MaoRun run{number, fmt::format("{}, {}", e.name, variant.name), variant.name, keys_of_07mm()};
    set(run.keys, "time.end=9.45");
    for (const std::string& key : variant.keys) set(run.keys, key);
    run.says = variant.name;
    e.runs.push_back(run);
  }
  return e;
}

Result mao_study(const Only& only, const Tell& tell) { return hold_against_mao(study_of_mao(), only, tell); }

}  // namespace livebed::validate
