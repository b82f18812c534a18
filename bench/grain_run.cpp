#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/fault.hpp"
#include "grains/advance.hpp"
#include "grains/measures.hpp"

/// Moves grains from given places by given steps, to compare with other codes (bench/grains).
///
///   grain_run JOB.json     prints the constants of the contacts and where the grains went as one JSON object
///
/// JOB: {"params": {name: number or word}, "grains": [[d, x, y, u, v, omega], ...] in SI units,
///       "stages": [{"steps": n, "drag": beta [N s/m]}, ...], "every": steps between looks; 0 = a look at the end}
namespace {

using namespace livebed;
using nlohmann::json;

grains::Params read_params(const json& job) {
  grains::Params p;
  for (const auto& [key, value] : job.at("params").items()) {
    if (key == "diameter")
      p.diameter = value;
    else if (key == "length")
      p.length = value;
    else if (key == "stiffness")
      p.stiffness = value;
    else if (key == "steps_per_contact")
      p.steps_per_contact = value;
    else if (key == "restitution")
      p.restitution = value;
    else if (key == "friction")
      p.friction = value;
    else if (key == "gravity")
      p.gravity = value;
    else if (key == "law")
      p.law = value == "hooke" ? grains::Law::hooke : grains::Law::paper;
    else if (key == "tension")
      p.tension = value == "spring" ? grains::Tension::spring : grains::Tension::none;
    else
      base::fail(base::Exit::command_line, "grain_run does not know the parameter {}", key);
  }
  p.count = static_cast<int>(job.at("grains").size());
  return grains::derive(p);
}

/// Constants of a contact; dashpots [N s/m] for this reduced mass [kg].
json told(const grains::Contact& c, grains::Law law, double reduced) {
  const double eta_n = c.eta_n * (law == grains::Law::hooke ? std::sqrt(reduced) : 1.0);
  return {{"k_n", c.k_n}, {"k_s", c.k_s}, {"eta_n", eta_n}, {"eta_s", c.shear * eta_n}, {"mu", c.mu}};
}

/// Rows of id, d, x, y, u, v, omega in the order of the ids.
json look(const grains::Bed& bed) {
  std::vector<json> rows(bed.state.id.size());
  for (int i = 0; i < bed.state.count(); ++i) {
    const grains::State& s = bed.state;
    rows[s.id[i]] = {s.id[i], s.diameter[i], s.x[i], s.y[i], s.u[i], s.v[i], s.omega[i]};
  }
  return {{"step", bed.steps}, {"grains", rows}};
}

json run(const json& job) {
  const grains::Params p = read_params(job);
  grains::Bed bed = grains::make_bed(p);
  for (int i = 0; i < p.count; ++i) {
    const json& g = job["grains"][i];
    bed.state.diameter[i] = g[0], bed.state.x[i] = g[1], bed.state.y[i] = g[2];
    bed.state.u[i] = g[3], bed.state.v[i] = g[4], bed.state.omega[i] = g[5];
  }
  json looks = json::array();
  const int every = job.at("every");
  for (const json& stage : job.at("stages")) {
    const double drag = stage.at("drag");
    bed.state.fluid.beta.assign(p.count, drag);
    for (int left = stage.at("steps"); left > 0;) {
      const int steps = every > 0 ? std::min(every, left) : left;
      grains::advance(bed, steps);
      left -= steps;
      if (every > 0) looks.push_back(look(bed));
    }
  }
  if (every == 0) looks.push_back(look(bed));
  const double m = grains::mass(p, p.diameter);
  return {{"density", p.density + p.added_mass * p.fluid_density},
          {"mass", m},
          {"gravity", grains::submerged_gravity(p)},
          {"step", p.step},
          {"pair", told(grains::pair_contact(p), p.law, 0.5 * m)},
          {"wall", told(grains::wall_contact(p, p.bottom), p.law, m)},
          {"looks", looks}};
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 2) base::fail(base::Exit::command_line, "usage: grain_run JOB.json");
    std::ifstream file(argv[1]);
    if (!file) base::fail(base::Exit::input_output, "{} cannot be read", argv[1]);
    fmt::print("{}\n", run(json::parse(file)).dump());
    return 0;
  } catch (const base::Fault& fault) {
    fmt::print(stderr, "{}\n", fault.what());
    return static_cast<int>(fault.code());
  } catch (const json::exception& fault) {
    fmt::print(stderr, "the job is not as described at the top of bench/grain_run.cpp: {}\n", fault.what());
    return static_cast<int>(base::Exit::command_line);
  }
}
