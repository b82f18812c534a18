#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/file.hpp"
#include "io/table.hpp"
#include "validate/pipe_current.hpp"

/// Files of a finished run of a current past a pipe.
namespace livebed::validate {

namespace {

/// A table of a run and the columns that it holds.
struct Sheet {
  std::string file;
  std::vector<std::pair<std::string, std::vector<double>*>> columns;
};

/// The one list of what is written and read again; `x` and `y` of the window belong to `nodes`.
std::vector<Sheet> sheets(PipeRun& run) {
  Sheet profiles{"profiles.csv", {{"y [D]", &run.section_y}}},
      window{"window.csv", {{"psi mean [U0 D]", &run.psi_mean}}};
  for (std::size_t k = 0; k < sections.size(); ++k)
    profiles.columns.emplace_back(fmt::format("U at {} D [U0]", sections[k]), &run.section_u[k]);
  for (int k = 0; k < snapshots; ++k) window.columns.emplace_back(fmt::format("psi {} [U0 D]", k + 1), &run.psi[k]);
  return {{"series.csv",
           {{"t [D/U0]", &run.t},
            {"Cd [-]", &run.drag},
            {"Cl [-]", &run.lift},
            {"u above [U0]", &run.u_above},
            {"u below [U0]", &run.u_below},
            {"u wake [U0]", &run.u_wake},
            {"v wake [U0]", &run.v_wake}}},
          {"floor.csv",
           {{"x [D]", &run.floor_x},
            {"shear [inlet shear]", &run.shear},
            {"mu dU/dy [inlet shear]", &run.shear_viscous},
            {"U on the axis [U0]", &run.axis_u}}},
          profiles,
          {"window_x.csv", {{"x [D]", &run.window_x}}},
          {"window_y.csv", {{"y [D]", &run.window_y}}},
          window};
}

std::string table_text(const Sheet& sheet) {
  std::string text;
  for (const auto& [name, column] : sheet.columns) text += (text.empty() ? "" : ",") + name;
  text += "\n";
  for (std::size_t row = 0; row < sheet.columns.front().second->size(); ++row)
    for (std::size_t k = 0; k < sheet.columns.size(); ++k)
      text += fmt::format("{:.7g}{}", (*sheet.columns[k].second)[row], k + 1 < sheet.columns.size() ? "," : "\n");
  return text;
}

}  // namespace

PipeRun kept_run(const PipeSetup& setup, const std::string& folder, const Tell& tell) {
  const io::Path here = io::Path(folder) / setup.name(), record = here / "run.json";
  if (std::filesystem::exists(record)) {
    const nlohmann::json kept = nlohmann::json::parse(io::read_file(record));
    if (kept.at("setup") == setup.text()) {
      PipeRun run;
      run.nx = kept.at("nx"), run.ny = kept.at("ny");
      run.seconds = kept.at("wall_s"), run.steps = kept.at("steps");
      run.commit = kept.at("commit");
      run.axis_speed = kept.at("axis_speed"), run.inlet_shear = kept.at("inlet_shear"), run.cd_box = kept.at("cd_box");
      for (const Sheet& sheet : sheets(run)) {
        const io::Table table = io::read_table(here / sheet.file);
        for (const auto& [name, column] : sheet.columns) *column = table.column(name);
      }
      tell(fmt::format("{}: kept from {}", setup.name(), run.commit));
      return run;
    }
  }
  PipeRun run = run_pipe(setup, tell);
  io::make_folder(here);
  for (const Sheet& sheet : sheets(run)) io::write_atomically(here / sheet.file, table_text(sheet));
  const nlohmann::ordered_json kept = {{"setup", setup.text()},
                                       {"commit", run.commit},
                                       {"nx", run.nx},
                                       {"ny", run.ny},
                                       {"wall_s", run.seconds},
                                       {"steps", run.steps},
                                       {"axis_speed", run.axis_speed},
                                       {"inlet_shear", run.inlet_shear},
                                       {"cd_box", run.cd_box}};
  io::write_atomically(record, kept.dump(1) + "\n");
  return run;
}

}  // namespace livebed::validate
