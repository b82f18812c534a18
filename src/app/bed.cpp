#include <filesystem>
#include <fmt/core.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/options.hpp"
#include "app/verbs.hpp"
#include "io/lammps.hpp"
#include "run/bed_cache.hpp"
#include "run/checkpoint.hpp"
#include "run/simulation.hpp"

namespace livebed::app {

namespace {

struct Written {
  grains::Bed bed;
  double height = 0;  ///< of the box [m]
};

/// Of a case: packed, the pipe in its place.  Of a run: as its last checkpoint has it.
Written bed_of(const CaseOptions& source, const std::filesystem::path& bed_cache) {
  const auto saved = run::list_checkpoints(source.path);
  if (!saved.empty()) {
    if (!source.overrides.empty())
      base::fail(base::Exit::command_line, "--set is for a case; {} is the folder of a run, whose bed is as it is",
                 source.path);
    run::Restored run = run::load_checkpoint(saved.back());
    return {run.sim.bed(), run.sim.resolved().flow.mesh.height};
  }
  const casefile::Case given = source.read();
  return {run::Simulation::prepare(given, run::BedCache(bed_cache, [](const std::string&) {})).bed,
          given.flow.mesh.height};
}

}  // namespace

void add_bed(CLI::App& app, Action& chosen) {
  struct Options {
    CaseOptions source;
    std::string out;
    std::string bed_cache = run::default_bed_cache().string();
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand(
      "bed", "Write the bed of a case, or of a run as its last checkpoint has it, as a LAMMPS data file.");
  options->source.add_to(*verb);
  verb->add_option("--out", options->out, "the data file (atom_style sphere); the key bed.file reads it")->required();
  verb->add_option("--bed-cache", options->bed_cache, "folder of packed beds")->capture_default_str();
  verb->add_flag("--json", options->json, "tell what was written as JSON");
  verb->callback([options, &chosen] {
    chosen = [options] {
      const Written written = bed_of(options->source, options->bed_cache);
      io::write_lammps(options->out, written.bed.params, written.bed.state, written.height);
      const nlohmann::ordered_json told = {
          {"file", options->out}, {"grains", written.bed.state.count()}, {"length_m", written.bed.params.length}};
      if (options->json)
        fmt::print("{}\n", told.dump(2));
      else
        fmt::print("{}: {} grains\n", options->out, written.bed.state.count());
      return base::Exit::ok;
    };
  });
}

}  // namespace livebed::app
