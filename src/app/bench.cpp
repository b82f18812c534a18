#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "app/verbs.hpp"
#include "base/loops.hpp"
#include "base/version.hpp"
#include "flow/mapping.hpp"
#include "flow/profiles.hpp"
#include "grains/kernels.hpp"
#include "grains/measures.hpp"
#include "grains/packing.hpp"
#include "io/file.hpp"

/// Speeds on the jobs that docs/performance.md compares with other codes.
namespace livebed::app {

namespace {

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Largest memory of the process so far [B].
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// Flow past a pipe at e/D 0.3 in a box of 30 D x 3.5 D, after Oner et al. (2008): Re_D 9500, mean current 0.197 m/s.
flow::Params pipe_in_channel(double cells) {
  constexpr double D = 0.05, mean_speed = 0.197, aspect = 1500.0 / 260.0;
  flow::Params p;
  p.viscosity = mean_speed * D / 9500.0;
  p.mesh.length = 30 * D;
  p.mesh.height = 3.5 * D;
  p.mesh.cell_y = p.mesh.height / std::sqrt(cells / aspect);
  p.mesh.cell_x = p.mesh.length / std::sqrt(cells * aspect);
  p.pipe.diameter = D;
  p.pipe.x = 10 * D;
  p.pipe.y = 0.8 * D;
  p.pipe.gap_ratio = 0.3;
  p.floor = flow::Wall::smooth;
  p.current.profile = flow::Profile::smooth;
  p.current.mean_speed = mean_speed;
  p.current.shear_velocity =
      flow::shear_velocity_from_mean(flow::Profile::smooth, mean_speed, p.mesh.height, 0.0, p.viscosity);
  p.courant = 0.85;
  p.max_step = 0.1;
  p.pressure_tolerance = 1e-4;
  return p;
}

flow::Solver make_solver(const flow::Params& p) {
  const flow::Mesh mesh = flow::make_mesh(p.mesh, p.pipe);
  return {p, mesh, flow::make_boundary(mesh, p)};
}

nlohmann::ordered_json bench_flow(double cells) {
  constexpr double coarse_cells = 6000, developed = 6.0;  // 6 s: six shedding periods
  const flow::Params coarse_params = pipe_in_channel(std::min(cells, coarse_cells));
  flow::Solver coarse = make_solver(coarse_params);
  coarse.start();
  while (coarse.state.time < developed) coarse.advance(coarse.step_limit());

  const flow::Params p = pipe_in_channel(cells);
  flow::Solver fine = make_solver(p);
  flow::map_flow(coarse, fine);
  const int warm_up = 40;  // the jolt of the mapping dies away
  for (int k = 0; k < warm_up; ++k) fine.advance(fine.step_limit());

  // As many steps as fit into eight seconds, 10 at least; the median of their times is not led astray by a busy
  // machine.
  std::vector<double> times;
  long iterations = 0;
  double mass_residual = 0, courant = 0, drag = 0, simulated = 0;
  const auto start = Clock::now();
  while (times.size() < 10 || (since(start) < 8.0 && times.size() < 1000)) {
    const auto begin = Clock::now();
    const double dt = fine.step_limit();
    const flow::StepReport report = fine.advance(dt);
    times.push_back(since(begin));
    iterations += report.pressure.iterations;
    mass_residual = std::max(mass_residual, report.mass_residual);
    courant = std::max(courant, report.courant);
    drag += report.pipe_force.x;
    simulated += dt;
  }
  const auto n = static_cast<double>(times.size());
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  const double pressure = 0.5 * p.density * p.current.mean_speed * p.current.mean_speed * p.pipe.diameter;
  nlohmann::ordered_json j;
  j["cells"] = fine.mesh().nx * fine.mesh().ny;
  j["threads"] = base::threads();
  j["seconds_per_step"] = times[times.size() / 2];
  j["step"] = simulated / n;
  j["pressure_iterations"] = static_cast<double>(iterations) / n;
  j["mass_residual"] = mass_residual;
  j["courant"] = courant;
  j["drag_coefficient"] = drag / n / pressure;
  j["steps"] = times.size();
  return j;
}

/// The bed and the constants of its contacts, for other codes to be timed on the same (bench/grains).
void write_bed(const grains::Bed& bed, const std::string& path) {
  const grains::Params& p = bed.params;
  const auto told = [](const grains::Contact& c) -> nlohmann::ordered_json {
    return {{"k_n", c.k_n}, {"k_s", c.k_s}, {"eta_n", c.eta_n}, {"eta_s", c.shear * c.eta_n}, {"mu", c.mu}};
  };
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  const grains::State& s = bed.state;
  for (int i = 0; i < s.count(); ++i) rows.push_back({s.diameter[i], s.x[i], s.y[i], s.u[i], s.v[i], s.omega[i]});
  nlohmann::ordered_json j;
  j["density"] = p.density + p.added_mass * p.fluid_density;
  j["mass"] = grains::mass(p, p.diameter);
  j["gravity"] = grains::submerged_gravity(p);
  j["step"] = p.step;
  j["length"] = p.length;
  j["diameter"] = p.diameter;
  j["pair"] = told(grains::pair_contact(p));
  j["wall"] = told(grains::wall_contact(p, p.bottom));
  j["grains"] = std::move(rows);
  io::write_atomically(path, j.dump());
}

nlohmann::ordered_json bench_grains(int count, bool mixed, const std::string& bed_file) {
  // A bed of 26 layers packed once over a short length, then laid side by side.  At rest its lists would live for ever:
  // they are rebuilt as often as those of a bed under scour.
  constexpr int steps_a_list = 100;
  grains::Params params;
  params.stiffness = 5500;
  params.restitution = 0.3;
  params.count = 1560;
  params.length = 0.126;
  const grains::Packing packing = grains::pack(params);
  const double memory_before = peak_memory();
  grains::Bed bed = grains::side_by_side(packing.bed, std::max(1, static_cast<int>(std::lround(count / 1560.0))));
  if (mixed) bed.params.precision = grains::Precision::mixed;
  const grains::Reach reach = grains::reach_of(bed.params);
  // The histories build up; a large bed gets fewer steps, or the measurement would take minutes.
  grains::advance(bed, static_cast<int>(std::clamp(4e8 / bed.state.count(), 100.0, 2000.0)));
  if (!bed_file.empty()) write_bed(bed, bed_file);
  std::vector<double> times;
  const auto start = Clock::now();
  while (times.size() < 3 || since(start) < 6.0) {
    const auto begin = Clock::now();
    grains::rebuild(bed.state, bed.contacts, bed.scratch, reach, bed.pipe);
    grains::advance(bed, steps_a_list);
    times.push_back(since(begin));
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  nlohmann::ordered_json j;
  j["grains"] = bed.state.count();
  j["threads"] = base::threads();
  j["kernels"] = grains::kernels().name;
  j["precision"] = mixed ? "mixed" : "double";
  j["grain_steps_per_second"] = steps_a_list * static_cast<double>(bed.state.count()) / times[times.size() / 2];
  j["bytes_per_grain"] = (peak_memory() - memory_before) / bed.state.count();
  j["contacts_per_grain"] = grains::measure_contacts(bed).per_grain;
  j["bed_height"] = grains::bed_height(bed.state);
  j["steps_between_rebuilds"] = steps_a_list;
  return j;
}

void tell(nlohmann::ordered_json j, bool json) {
  j["commit"] = base::commit();
  j["compiler"] = base::compiler();
  if (json) {
    fmt::print("{}\n", j.dump(2));
    return;
  }
  for (const auto& [key, value] : j.items()) fmt::print("{:<28} {}\n", key, value.dump());
}

}  // namespace

void add_bench(CLI::App& app, Action& chosen) {
  CLI::App* verb = app.add_subcommand("bench", "Measure the speed of the flow or of the grains.");
  verb->require_subcommand(1);
  struct Arguments {
    double cells = 390000;
    int grains = 6240;
    std::string bed;
    bool mixed = false, json = false;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* flow = verb->add_subcommand("flow", "k-epsilon flow past a cut pipe, e/D 0.3, in a box of 30 D x 3.5 D");
  flow->add_option("--cells", a->cells, "number of cells, about")->check(CLI::Range(1000.0, 1e7));
  flow->add_flag("--json", a->json, "tell it as JSON");
  flow->callback([a, &chosen] { chosen = [a] { return tell(bench_flow(a->cells), a->json), base::Exit::ok; }; });
  CLI::App* grains = verb->add_subcommand("grains", "a settled bed, its lists rebuilt as in a moving one");
  grains->add_option("--grains", a->grains, "number of grains, about")->check(CLI::Range(1560, 10000000));
  grains->add_option("--bed", a->bed, "file to write the settled bed and its constants to, for other codes");
  grains->add_flag("--mixed", a->mixed, "velocities and forces in single precision (grains.precision = mixed)");
  grains->add_flag("--json", a->json, "tell it as JSON");
  grains->callback([a, &chosen] {
    chosen = [a] { return tell(bench_grains(a->grains, a->mixed, a->bed), a->json), base::Exit::ok; };
  });
}

}  // namespace livebed::app
