#include "run/summary.hpp"

#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "base/approach.hpp"
#include "base/loops.hpp"
#include "base/version.hpp"
#include "case/resolved.hpp"
#include "io/file.hpp"
#include "io/table.hpp"

namespace livebed::run {

namespace {

double peak_memory_MB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

template <class Optional, class Take>
nlohmann::json or_null(const Optional& value, Take&& take) {
  return value ? nlohmann::json(take(*value)) : nlohmann::json(nullptr);
}

}  // namespace

void write_summary(const std::filesystem::path& folder, const Simulation& sim, const Progress& progress,
                   const char* ended) {
  const casefile::Case& c = sim.resolved();
  const io::Table series = io::read_table(folder / "series.csv");
  const std::vector<double>&t = series.column("time_s"), &S = series.column("S_over_D");
  const auto last = [&](const char* name) {
    const std::vector<double>& column = series.column(name);
    return column.empty() ? 0.0 : column.back();
  };
  const auto fit = base::fit_approach(t, S);
  const auto steady = c.time_scale > 0
                          ? base::equilibrium(t, S, c.time.equilibrium_window * c.time_scale, c.time.equilibrium_change)
                          : std::optional<double>{};
  const WallTimes& wall = sim.wall();
  const Clock& clock = sim.clock();
  const flow::Mesh& mesh = sim.flow().mesh();
  const double grain_steps = static_cast<double>(clock.grain_steps) * c.grains.count;

  nlohmann::ordered_json j;
  j["title"] = c.title;
  j["ended"] = ended;
  j["time_s"] = sim.time();
  j["t_over_T"] = c.time_scale > 0 ? sim.time() / c.time_scale : 0.0;
  j["time_scale_s"] = c.time_scale;
  j["scour_depth_over_D"] = last("S_over_D");
  j["depth_under_pipe_over_D"] = last("depth_under_pipe_over_D");
  j["S_eq_over_D"] = or_null(steady, [](double v) { return v; });
  j["T_s"] = steady && fit ? nlohmann::json(fit->T) : nlohmann::json(nullptr);
  j["fit"] = or_null(fit, [](const base::Approach& a) {
    return nlohmann::json{
        {"S_eq_over_D", a.S_eq}, {"T_s", a.T}, {"error_S_eq", a.error_S_eq}, {"error_T_s", a.error_T}, {"rms", a.rms}};
  });
  j["theta"] = c.theta;
  j["theta_measured"] = progress.theta_time > 0 ? progress.theta_sum / progress.theta_time : 0.0;
  j["bed_level_m"] = progress.original.level;
  j["largest_overlap_over_d"] = progress.largest_overlap;
  j["impulse_error_N_s"] = last("impulse_error_N_s");
  j["wall_s"] = wall.total() + progress.start_wall;
  j["walls"] = {{"flow_s", wall.flow},
                {"grains_s", wall.grains},
                {"exchange_s", wall.exchange},
                {"output_s", wall.output},
                {"packing_s", progress.start_wall}};
  j["grain_steps_per_second"] = wall.grains > 0 ? grain_steps / wall.grains : 0.0;
  j["flow_ms_per_step"] = clock.flow_steps > 0 ? 1e3 * wall.flow / static_cast<double>(clock.flow_steps) : 0.0;
  j["flow_steps"] = clock.flow_steps;
  j["grain_steps"] = clock.grain_steps;
  j["cells"] = mesh.nx * mesh.ny;
  j["grains"] = c.grains.count;
  if (!sim.supply().goes_round()) {
    const SupplyState& ends = sim.supply().state();
    j["supply"] = {
        {"left", ends.left}, {"entered", ends.entered}, {"waiting", ends.waiting.size()}, {"owed", ends.owed}};
  }
  if (c.grains.sleep) j["share_asleep"] = progress.theta_time > 0 ? progress.asleep_sum / progress.theta_time : 0.0;
  j["threads"] = base::threads();
  j["peak_memory_MB"] = peak_memory_MB();
  j["case_hash"] = casefile::hash(c);
  j["seed"] = c.grains.seed;
  j["commit"] = base::commit();
  j["versions"] = {{"livebed", base::version()}, {"compiler", base::compiler()}};
  io::write_atomically(folder / "summary.json", j.dump(2) + "\n");
}

}  // namespace livebed::run
