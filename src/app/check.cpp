#include "case/check.hpp"

#include <fmt/core.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/options.hpp"
#include "app/verbs.hpp"
#include "case/resolved.hpp"
#include "grains/sizes.hpp"
#include "run/cost.hpp"

namespace livebed::app {
namespace {

struct Number {
  const char* name;  ///< in JSON
  double value;
  const char* unit;
  const char* meaning;
};

/// What follows from a case, in the order of the listing.
std::vector<Number> derived_numbers(const casefile::Case& c) {
  const flow::Params& f = c.flow;
  const grains::Params& g = c.grains;
  const run::Work work = run::work_of(c);
  return {{"theta", c.theta, "-", "Shields parameter"},
          {"shear_velocity", f.current.shear_velocity, "m/s", "u*"},
          {"mean_speed", f.current.mean_speed, "m/s", "depth mean of the current"},
          {"water_depth", f.mesh.height - c.bed_thickness, "m", "above the nominal bed"},
          {"bed_thickness", c.bed_thickness, "m", "nominal level of the bed"},
          {"grains", static_cast<double>(g.count), "-", "number of grains"},
          {"grain_diameter", g.diameter, "m", "d, mean or d50"},
          {"smallest_grain", grains::smallest_diameter(g), "m", "diameter of the smallest grain"},
          {"largest_grain", grains::largest_diameter(g), "m", "diameter of the largest grain"},
          {"pipe_y", f.pipe.present ? f.pipe.y : 0, "m", "centre of the pipe above the floor; 0 without a pipe"},
          {"time_scale", c.time_scale, "s", "T of the scour; 0 without a pipe or grains"},
          {"end", c.time.end, "s", "last time"},
          {"end_over_T", c.time.end_over_T, "-", "last time over T"},
          {"stiffness", g.stiffness, "N/m", "k_n"},
          {"grain_step", g.step, "s", "step of the grains"},
          {"contact_steps", g.steps_per_contact, "-", "grain steps in the critical time of a contact"},
          {"damping", g.damping, "-", "alpha_cn"},
          {"restitution", g.restitution, "-", "of a head-on pair"},
          {"static_overlap", g.count > 0 ? grains::static_overlap(g, c.bed_thickness) : 0, "d", "of the lowest grains"},
          {"cells", work.cells, "-", "cells of the grid"},
          {"flow_step", work.flow_step, "s", "estimate from the Courant number"},
          {"flow_steps", work.held_steps + work.flow_steps, "-", "estimate, spin-up included"},
          {"grain_steps", work.grain_steps, "-", "steps of every grain; livebed plan predicts the wall time"}};
}

void print_json(const casefile::Case& c) {
  nlohmann::ordered_json all{{"title", c.title}, {"preset", c.preset}, {"hash", casefile::hash(c)}};
  for (const Number& number : derived_numbers(c)) all[number.name] = number.value;
  all["notes"] = casefile::notes(c);
  fmt::print("{}\n", all.dump(2));
}

void print_text(const casefile::Case& c) {
  fmt::print("{}\npreset {}, case {}\n\n", c.title, c.preset, casefile::hash(c));
  for (const Number& number : derived_numbers(c))
    fmt::print("{:<15} {:>12.6g} {:<5} {}\n", number.name, number.value, number.unit, number.meaning);
  for (const std::string& note : casefile::notes(c)) fmt::print("note: {}\n", note);
}

}  // namespace

void add_check(CLI::App& app, Action& chosen) {
  struct Options {
    CaseOptions which;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand("check", "read a case, tell every fault or what follows from it; write nothing");
  options->which.add_to(*verb);
  verb->add_flag("--json", options->json, "as JSON");
  verb->callback([options, &chosen] {
    chosen = [options] {
      const casefile::Case c = options->which.read();
      options->json ? print_json(c) : print_text(c);
      return base::Exit::ok;
    };
  });
}

}  // namespace livebed::app
