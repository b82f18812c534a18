#include "validate/mao.hpp"

#include <fmt/format.h>

#include "validate/mao_runs.hpp"
#include "validate/references.hpp"

namespace livebed::validate {

namespace {

constexpr unsigned seeds = 3;

/// The same case three times, with other seeds.
Experiment seeds_of(const std::string& name, std::string_view text, const std::vector<std::string>& keys) {
  Experiment e{name, text, "seed", {}, true};
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    MaoRun run{seed, fmt::format("{} seed {}", name, seed), fmt::format("Livebed, seed {}", seed), keys};
    run.keys.push_back(fmt::format("bed.seed={}", seed));
    e.runs.push_back(run);
  }
  return e;
}

}  // namespace

Result mao(const Only& only, const Tell& tell) {
  Experiment e = seeds_of("mao", mao_case, {});
  e.scaled = false;
  // The others tell how far seeds spread.  Mixed precision differs from double less than seeds do and takes a quarter
  // less time.
  for (MaoRun& run : e.runs)
    if (run.number > 1) run.keys.insert(run.keys.end(), {"time.end=12", "grains.precision=mixed"});
  return hold_against_mao(e, only, tell);
}
Result mao_07mm(const Only& only, const Tell& tell) {
  return hold_against_mao(seeds_of("mao-0.7mm", mao_case, keys_of_07mm()), only, tell);
}
Result mao_1mm(const Only& only, const Tell& tell) {
  return hold_against_mao(seeds_of("mao-1mm", mao_case,
                                   {"grains.diameter=1 mm", "mesh.cell_y=0.6 mm", "bed.pieces=1",
                                    "time.grain_step=2e-5", "time.spin_up=1.5", "time.end=8.1", "current.rise=0.86"}),
                          only, tell);
}
Result mao_2mm(const Only& only, const Tell& tell) {
  return hold_against_mao(seeds_of("mao-2mm-livebed", mao_case,
                                   {"grains.diameter=2 mm", "mesh.cell_y=1.2 mm", "bed.pieces=1",
                                    "time.grain_step=4e-5", "time.spin_up=1.5", "time.end=2.85", "current.rise=0.307"}),
                          only, tell);
}
Result mao_paper(const Only& only, const Tell& tell) {
  return hold_against_mao(seeds_of("mao-2mm", mao_paper_case, {}), only, tell);
}

}  // namespace livebed::validate
