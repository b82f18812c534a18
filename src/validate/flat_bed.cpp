#include "validate/flat_bed.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/math.hpp"
#include "base/sediment.hpp"
#include "base/version.hpp"
#include "case/read.hpp"
#include "case/resolved.hpp"
#include "grains/measures.hpp"
#include "io/file.hpp"
#include "run/shear.hpp"
#include "run/simulation.hpp"

namespace livebed::validate {

namespace {

constexpr double water_density = 1000, gravity = 9.81;
constexpr double fine_above = 8;  ///< rows are fine up to this far above the bed [d]
/// Of contact.steps = 20 the grain step of 0.36 mm sand at 5e-6 s and of 2 mm sand at 1e-5 s: hits at 0.5 m/s overlap
/// by 4 and 2 %.
double grain_step(double d) { return d < 1e-3 ? 5e-6 : 1e-5; }

casefile::Case case_of(const FlatBedSetup& s) {
  const double d = s.diameter;
  const std::string text =
      fmt::format(R"(preset = "livebed"
[mesh]
length = {}
height = {}
cell_x = {}
cell_y = {}
growth = 1.1
fine_x_from = 0
fine_x_to = {}
fine_y_from = 0
fine_y_to = {}
[pipe]
present = false
[current]
profile = "recycled"
theta = {}
[bed]
thickness = {}
seed = {}
[grains]
diameter = {}
density = {}
[contact]
steps = 20
[time]
grain_step = {}
spin_up = {}
end = {}
)",
                  s.length * d, (s.bed + s.depth) * d, s.cell_x * d, s.cell_y * d, s.length * d,
                  (s.bed + fine_above) * d, s.theta, s.bed * d, s.seed, d, s.density, grain_step(d), s.spin_up, s.end);
  return casefile::read_text(text, "flat bed", s.keys);
}

/// Sums that become means.
class Means {
public:
  explicit Means(const run::Simulation& sim) : rows_(sim.flow().mesh().ny) {
    for (std::vector<double>* sum : {&solid_, &u_, &grain_u_, &grain_volume_}) sum->assign(rows_, 0.0);
  }
  void add(run::Simulation& sim, double dt) {
    const casefile::Case& c = sim.resolved();
    const grains::State& g = sim.bed().state;
    time_ += dt;
    flux_ += dt * grains::solids_flux(c.grains, g);
    theta_ += dt * run::measured_shields(c, sim.flow(), c.bed_thickness);
    const flow::Mesh& m = sim.flow().mesh();
    const base::Field& solid = sim.solid_fraction();
    for (int j = 0; j < rows_; ++j)
      for (int i = 0; i < m.nx; ++i) {
        solid_[j] += dt * solid(i, j) / m.nx;
        u_[j] += dt * 0.5 * (sim.flow().state.u(i, j) + sim.flow().state.u(i + 1, j)) / m.nx;
      }
    for (int k = 0; k < g.count(); ++k) {
      const auto above = std::upper_bound(m.y.begin(), m.y.end(), g.y[k]);
      const int j = std::clamp(static_cast<int>(above - m.y.begin()) - 1, 0, rows_ - 1);
      const double volume = base::sphere_volume(g.diameter[k]);
      grain_u_[j] += dt * volume * g.u[k], grain_volume_[j] += dt * volume;
    }
  }
  void finish(const run::Simulation& sim, FlatBedRun& run) const {
    run.flux = flux_ / time_, run.theta = theta_ / time_;
    for (int j = 0; j < rows_; ++j) {
      run.y.push_back(sim.flow().mesh().centre_y(j));
      run.solid.push_back(solid_[j] / time_), run.u.push_back(u_[j] / time_);
      run.grain_u.push_back(grain_volume_[j] > 0 ? grain_u_[j] / grain_volume_[j] : 0.0);
    }
  }

private:
  int rows_;
  double time_ = 0, flux_ = 0, theta_ = 0;
  std::vector<double> solid_, u_, grain_u_, grain_volume_;
};

}  // namespace

std::string FlatBedSetup::name() const {
  // The case as resolved: a preset whose constants have changed makes another run.
  std::size_t others = std::hash<std::string>{}(text() + casefile::hash(case_of(*this)));
  return fmt::format("d{:.3g}mm-theta{:.3g}-seed{}-{:08x}", 1e3 * diameter, theta, seed, others & 0xffffffff);
}

std::string FlatBedSetup::text() const {
  return fmt::format(
      "d = {} m, {} kg/m3, theta = {}, seed {}, box {} d x ({} + {}) d, cells {} x {} d, averaged from {} to {} s "
      "after {} "
      "s over the fixed bed{}{}",
      diameter, density, theta, seed, length, bed, depth, cell_x, cell_y, begin, end, spin_up, keys.empty() ? "" : ", ",
      fmt::join(keys, ", "));
}

double FlatBedRun::einstein(const FlatBedSetup& s) const {
  return flux / std::sqrt((s.density / water_density - 1) * gravity * base::cube(s.diameter));
}

FlatBedRun run_flat_bed(const FlatBedSetup& setup) {
  const auto begin = std::chrono::steady_clock::now();
  run::Simulation::Start start = run::Simulation::prepare(case_of(setup));
  run::Simulation sim(start.resolved, std::move(start.bed));
  while (sim.time() < 0) sim.spin_up_step();
  sim.release();
  Means means(sim);
  constexpr double look_every = 0.01;  // [s]
  double looked = setup.begin;
  while (sim.time() < setup.end) {
    sim.step();
    if (sim.time() < looked + look_every) continue;
    means.add(sim, sim.time() - looked);
    looked = sim.time();
  }
  FlatBedRun run;
  means.finish(sim, run);
  run.level = sim.resolved().bed_thickness;
  run.commit = base::commit();
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return run;
}

FlatBedRun kept_flat_bed(const FlatBedSetup& setup, const std::string& folder, const Tell& tell) {
  const io::Path file = io::Path(folder) / (setup.name() + ".json");
  FlatBedRun run;
  const auto pass = [&run](auto&& visit) {
    visit("flux_m2_s", run.flux), visit("theta", run.theta), visit("level_m", run.level), visit("wall_s", run.seconds);
    visit("commit", run.commit), visit("y_m", run.y), visit("solid", run.solid), visit("u_m_s", run.u);
    visit("grain_u_m_s", run.grain_u);
  };
  if (std::filesystem::exists(file)) {
    const nlohmann::json kept = nlohmann::json::parse(io::read_file(file));
    if (kept.at("setup") == setup.text()) {
      pass([&](const char* name, auto& value) { kept.at(name).get_to(value); });
      tell(fmt::format("{}: kept from {}", setup.name(), run.commit));
      return run;
    }
  }
  run = run_flat_bed(setup);
  tell(fmt::format("{}: theta {:.3f}, Phi {:.3f}, {:.2f} of Meyer-Peter and Mueller, {:.0f} s", setup.name(), run.theta,
                   run.einstein(setup), run.einstein(setup) / std::max(1e-9, base::meyer_peter_mueller(run.theta)),
                   run.seconds));
  nlohmann::ordered_json kept = {{"setup", setup.text()}};
  pass([&](const char* name, auto& value) { kept[name] = value; });
  io::make_folder(folder);
  io::write_atomically(file, kept.dump(1) + "\n");
  return run;
}

}  // namespace livebed::validate
