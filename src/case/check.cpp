#include "case/check.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "base/fault.hpp"
#include "base/math.hpp"
#include "base/sediment.hpp"
#include "case/ids.hpp"
#include "case/units.hpp"
#include "case/walls.hpp"
#include "flow/profiles.hpp"
#include "grains/laws.hpp"
#include "grains/sizes.hpp"

namespace livebed::casefile {
namespace {

double specific_density(const Case& c) { return c.grains.density / c.flow.density; }

/// The log law that turns the depth mean of the current into its shear velocity: smooth when asked for, else rough.
flow::Profile log_law_of(flow::Profile profile) {
  return profile == flow::Profile::smooth ? flow::Profile::smooth : flow::Profile::rough;
}

/// Some other key than grains.diameter and grains.spread gives the sizes.
bool is_graded(const Case& c) { return c.is_given("grains.d50") || c.is_given("grains.grading"); }

grains::Grading grading_of(const Case& c) {
  if (c.is_given("grains.d50")) return {{c.d10, 0.1}, {c.d50, 0.5}, {c.d90, 0.9}};
  return parse_grading(c.grading);
}

/// What is wrong with the grading of a case that has one; empty when nothing is.
std::string fault_of_grading(const Case& c) {
  if (!is_graded(c)) return "";
  if (c.is_given("grains.d50") && (c.d10 <= 0 || c.d90 <= 0))
    return "grains.d50 needs grains.d10 and grains.d90 beside it";
  try {
    grains::check_grading(grading_of(c));
  } catch (const base::Fault& fault) {
    return fault.what();
  }
  return "";
}

void derive_sizes(Case& c) {
  if (is_graded(c)) {
    const std::string wrong = fault_of_grading(c);
    if (!wrong.empty()) base::fail(base::Exit::invalid_case, "{}", wrong);
    c.grains.grading = grading_of(c);
    c.grains.diameter = grains::diameter_at(c.grains.grading, 0.5);
  }
  c.d50 = c.grains.diameter;
}

/// Turns the nominal thickness of a bed into a number of grains or the other way.
void derive_bed(Case& c) {
  const grains::Params& g = c.grains;
  const double thickness_of_one = base::sphere_area(1) * grains::mean_power(g, 2) / (g.packing_fraction * g.length);
  if (c.is_given("bed.count"))
    c.bed_thickness = c.measured_level > 0 ? c.measured_level : g.count * thickness_of_one;
  else
    c.grains.count = static_cast<int>(std::lround(std::min(2.0 * most_grains, c.bed_thickness / thickness_of_one)));
  c.grains.thickness = c.is_given("bed.thickness") ? c.bed_thickness : c.cut;
}

void derive_current(Case& c) {
  flow::CurrentParams& current = c.flow.current;
  const double ks = roughness_over_diameter * c.grains.diameter;
  current.bed_level = c.bed_thickness;
  if (current.roughness == 0 && current.profile != flow::Profile::smooth) current.roughness = ks;
  if (c.flow.floor_roughness == 0 && c.flow.floor == flow::Wall::rough) c.flow.floor_roughness = ks;

  const flow::Profile law = log_law_of(current.profile);
  const double depth = c.flow.mesh.height - current.bed_level;
  const double s = specific_density(c), g = c.grains.gravity, d = c.grains.diameter, nu = c.flow.viscosity;
  if (c.is_given("current.theta")) current.shear_velocity = flow::shear_velocity_from_shields(c.theta, s, g, d);
  if (c.is_given("current.mean_speed"))
    current.shear_velocity = flow::shear_velocity_from_mean(law, current.mean_speed, depth, current.roughness, nu);
  else
    current.mean_speed = flow::depth_mean(depth, current.shear_velocity,
                                          flow::zero_level(law, current.roughness, current.shear_velocity, nu));
  if (!c.is_given("current.theta")) c.theta = flow::shields(current.shear_velocity, s, g, d);
}

void derive_times(Case& c) {
  const bool scours = c.flow.pipe.present && c.grains.count > 0;
  c.time_scale = scours ? base::scour_time_scale(c.flow.pipe.diameter, c.grains.diameter, specific_density(c),
                                                 c.grains.gravity, c.theta)
                        : 0;
  if (c.is_given("time.end_over_T"))
    c.time.end = c.time.end_over_T * c.time_scale;
  else
    c.time.end_over_T = scours ? c.time.end / c.time_scale : 0;
}

/// One combination of keys under test: its faults are told at the first of the keys that was given.
class Combination {
public:
  Combination(const Sources& sources, Faults& faults, std::initializer_list<std::string_view> keys)
      : sources_(sources), faults_(faults), keys_(keys) {}

  /// Notes a fault when it holds and none of the keys is bad already.
  template <class... Args>
  void fault_if(bool wrong, fmt::format_string<Args...> text, Args&&... args) const {
    if (!wrong) return;
    for (const std::string_view key : keys_)
      if (sources_.bad.contains(key)) return;
    faults_.add(place(), text, std::forward<Args>(args)...);
  }

private:
  Origin place() const {
    for (const std::string_view key : keys_) {
      const auto found = sources_.origin.find(key);
      if (found != sources_.origin.end() && found->second.kind != Origin::Kind::preset) return found->second;
    }
    return {};
  }
  const Sources& sources_;
  Faults& faults_;
  std::vector<std::string_view> keys_;
};

/// Window of fine cells along one direction.
void check_window(const Combination& keys, const char* from_name, const char* to_name, const char* across_name,
                  double from, double to, double across) {
  keys.fault_if(from != 0 && to <= from, "{} = {} m must be smaller than {} = {} m", from_name, from, to_name, to);
  keys.fault_if(to > across, "{} = {} m is outside the box, {} = {} m", to_name, to, across_name, across);
}

}  // namespace

grains::Grading parse_grading(std::string_view text) {
  const auto number = [&](std::string_view part, const char* unit, const char* example) {
    const auto quantity = parse_quantity(part);
    const auto given = quantity ? parse_unit(quantity->unit) : std::nullopt;
    if (!given || !given->same_dimension(*parse_unit(unit)) || (quantity->unit.empty() && *unit == 'm'))
      base::fail(base::Exit::invalid_case, "grains.grading: \"{}\" is not {}, as in \"0.2 mm: 10 %, 0.36 mm: 50 %\"",
                 part, example);
    return in_si(*quantity, *given);
  };
  grains::Grading points;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view point = text.substr(begin, end - begin);
    const std::size_t colon = std::min(point.find(':'), point.size());
    const std::string_view share = colon < point.size() ? point.substr(colon + 1) : std::string_view();
    points.push_back({number(point.substr(0, colon), "m", "a diameter with its unit"),
                      number(share, "-", "a share of the mass that passes")});
    begin = end + 1;
  }
  return points;
}

void derive(Case& c) {
  c.grains.fluid_density = c.flow.density;
  c.grains.length = c.flow.mesh.length;
  derive_sizes(c);
  c.grains.walls = read_walls(c.walls).lines;
  derive_bed(c);
  derive_current(c);
  flow::PipeParams& pipe = c.flow.pipe;
  pipe.y = c.bed_thickness + (pipe.gap_ratio + 0.5) * pipe.diameter;
  const bool voids_change = c.grains.count > 0 && c.coupling.voidage == coupling::Voidage::on;
  pipe.least_open = voids_change ? flow::volume_least_among_grains : flow::volume_least;
  derive_times(c);
  if (c.is_given("contact.damping") && c.grains.damping == 0) c.grains.restitution = 1;
  c.grains = grains::derive(c.grains);
}

void derive_at_level(Case& c, int count, double level) {
  // From here on the grains are what they are: their number is given, the thickness follows.
  std::replace(c.given.begin(), c.given.end(), std::string("bed.thickness"), std::string("bed.count"));
  c.grains.count = count;
  c.cut = c.grains.thickness;
  c.measured_level = level;
  derive(c);
}

void check(const Case& c, const Sources& sources, Faults& faults) {
  const auto keys = [&](std::initializer_list<std::string_view> names) { return Combination(sources, faults, names); };
  const flow::MeshParams& mesh = c.flow.mesh;
  const flow::PipeParams& pipe = c.flow.pipe;
  const flow::CurrentParams& current = c.flow.current;
  const double D = pipe.diameter, d = c.grains.diameter, bed = c.bed_thickness;

  const std::string wrong = fault_of_grading(c);
  keys({"grains.d50", "grains.d10", "grains.d90", "grains.grading"}).fault_if(!wrong.empty(), "{}", wrong);
  if (!wrong.empty()) return;  // nothing could be derived from it

  // the box and its cells
  keys({"mesh.cell_x", "mesh.length"})
      .fault_if(mesh.cell_x > mesh.length / 4, "mesh.cell_x = {} m leaves fewer than 4 cells in mesh.length = {} m",
                mesh.cell_x, mesh.length);
  keys({"mesh.cell_y", "mesh.height"})
      .fault_if(mesh.cell_y > mesh.height / 4, "mesh.cell_y = {} m leaves fewer than 4 cells in mesh.height = {} m",
                mesh.cell_y, mesh.height);
  check_window(keys({"mesh.fine_x_to", "mesh.fine_x_from", "mesh.length"}), "mesh.fine_x_from", "mesh.fine_x_to",
               "mesh.length", mesh.fine_x_from, mesh.fine_x_to, mesh.length);
  check_window(keys({"mesh.fine_y_to", "mesh.fine_y_from", "mesh.height"}), "mesh.fine_y_from", "mesh.fine_y_to",
               "mesh.height", mesh.fine_y_from, mesh.fine_y_to, mesh.height);

  // grains and bed
  const bool graded = is_graded(c);
  keys({"grains.d50", "grains.d10", "grains.d90"})
      .fault_if(!c.is_given("grains.d50") && (c.d10 > 0 || c.d90 > 0),
                "grains.d10 and grains.d90 belong to grains.d50, which is not given");
  keys({"grains.spread", "grains.diameter", "grains.d50", "grains.grading"})
      .fault_if(
          graded && (c.is_given("grains.spread") || c.is_given("grains.diameter")),
          "grains.spread and grains.diameter contradict a grading, grains.d50 or grains.grading: remove one of them");
  keys({"grains.density", "flow.density"})
      .fault_if(c.grains.density <= c.flow.density,
                "grains.density = {} kg/m3 does not sink in water of flow.density = {} kg/m3", c.grains.density,
                c.flow.density);
  const std::string walls_fault = read_walls(c.walls).fault;
  keys({"bed.walls"}).fault_if(!walls_fault.empty(), "bed.walls: {}", walls_fault);
  keys({"grains.diameter", "mesh.length"})
      .fault_if(d > mesh.length / 10, "grains.diameter = {} m leaves fewer than 10 grains in mesh.length = {} m", d,
                mesh.length);
  keys({"bed.supply", "bed.walls", "bed.side_walls"})
      .fault_if(c.supply != Supply::periodic && (c.grains.side_walls || !c.grains.walls.empty()),
                "bed.supply other than \"periodic\" needs ends without walls: remove bed.walls and bed.side_walls");
  keys({"bed.supply", "current.profile"})
      .fault_if(c.supply != Supply::periodic && c.flow.current.profile == flow::Profile::recycled,
                "current.profile = \"recycled\" is a channel without ends: bed.supply must be \"periodic\"");
  keys({"current.rise", "current.profile"})
      .fault_if(c.flow.current.rise > 0 && c.flow.current.profile == flow::Profile::recycled,
                "current.rise = {} s needs an inlet; current.profile = \"recycled\" makes its own",
                c.flow.current.rise);
  const double feed_begins = feed_from * (c.flow.pipe.present ? c.flow.pipe.x : mesh.length);
  keys({"bed.supply", "pipe.x", "mesh.length", "grains.diameter"})
      .fault_if(
          c.supply == Supply::equilibrium && feed_begins < feed_behind_inlet * d,
          "bed.supply = \"equilibrium\" takes its measure {:.3g} grains behind the inlet, a quarter of the way to "
          "the pipe; at least {} are needed: move the pipe or the outlet downstream",
          feed_begins / d, feed_behind_inlet);
  const int pieces = c.grains.pieces;
  keys({"bed.pieces", "grains.diameter", "mesh.length"})
      .fault_if(pieces > 1 && mesh.length / pieces < least_piece * d,
                "bed.pieces = {} are {:.3g} grains long each; {} are needed, so at most {} pieces", pieces,
                mesh.length / pieces / d, least_piece, std::max(1, static_cast<int>(mesh.length / (least_piece * d))));
  keys({"bed.pieces", "bed.walls", "bed.side_walls"})
      .fault_if(pieces > 1 && (c.grains.side_walls || !c.grains.walls.empty()),
                "bed.pieces = {} fit together only without walls: remove bed.walls and bed.side_walls", pieces);
  keys({"bed.pieces", "bed.file"})
      .fault_if(pieces > 1 && !c.bed_file.empty(), "bed.pieces = {} are for a bed that is packed; bed.file gives one",
                pieces);
  keys({"bed.pieces", "bed.count"})
      .fault_if(pieces > 1 && c.measured_level == 0 && c.is_given("bed.count") && c.grains.count % pieces != 0,
                "bed.count = {} cannot be divided into bed.pieces = {} alike", c.grains.count, pieces);
  keys({"bed.thickness", "bed.count", "mesh.height", "grains.diameter", "grains.spread", "mesh.length"})
      .fault_if(bed >= mesh.height, "the bed is {:.4g} m thick and leaves no water in mesh.height = {} m", bed,
                mesh.height);
  keys({"bed.thickness", "grains.diameter"})
      .fault_if(c.is_given("bed.thickness") && bed > 0 && bed < d,
                "bed.thickness = {} m is less than one grain, grains.diameter = {} m; 0 is a case without grains", bed,
                d);
  keys({"bed.cut", "bed.thickness"})
      .fault_if(c.cut > 0 && c.is_given("bed.thickness"),
                "bed.cut = {} m contradicts bed.thickness = {} m, to which the bed is cut: it goes with bed.count",
                c.cut, bed);
  keys({"bed.level", "bed.thickness"})
      .fault_if(c.measured_level > 0 && c.is_given("bed.thickness"),
                "bed.level = {} m contradicts bed.thickness = {} m: it goes with bed.count", c.measured_level, bed);
  keys({"bed.thickness", "grains.diameter", "mesh.length"})
      .fault_if(c.grains.count > most_grains, "bed.thickness = {} m needs more than {} grains of {} m", bed,
                most_grains, d);
  keys({"current.roughness", "mesh.height", "bed.thickness", "bed.count", "grains.diameter"})
      .fault_if(bed < mesh.height && current.roughness > mesh.height - bed,
                "current.roughness = {} m is larger than the water is deep, {:.4g} m", current.roughness,
                mesh.height - bed);
  keys({"coupling.kernel", "grains.diameter", "mesh.cell_x", "mesh.cell_y"})
      .fault_if(c.coupling.mode != coupling::Mode::none &&
                    c.coupling.kernel * d < least_kernel_in_cells * std::max(mesh.cell_x, mesh.cell_y),
                "coupling.kernel = {} reaches {:.4g} m, less than {} of a cell of {} m: give at least {:.3g}",
                c.coupling.kernel, c.coupling.kernel * d, least_kernel_in_cells, std::max(mesh.cell_x, mesh.cell_y),
                least_kernel_in_cells * std::max(mesh.cell_x, mesh.cell_y) / d);

  keys({"coupling.kernel", "grains.diameter", "mesh.cell_x", "mesh.cell_y"})
      .fault_if(c.coupling.mode != coupling::Mode::none &&
                    c.coupling.kernel * d > most_cells_in_kernel * std::min(mesh.cell_x, mesh.cell_y),
                "coupling.kernel = {} reaches {:.4g} m, more than {} cells of {} m: give at most {:.3g}",
                c.coupling.kernel, c.coupling.kernel * d, most_cells_in_kernel, std::min(mesh.cell_x, mesh.cell_y),
                most_cells_in_kernel * std::min(mesh.cell_x, mesh.cell_y) / d);

  keys({"coupling.turbulence", "coupling.dispersion", "flow.closure"})
      .fault_if(c.flow.closure == flow::Closure::laminar && (c.coupling.turbulence != coupling::Turbulence::untouched ||
                                                             c.coupling.dispersion != coupling::Dispersion::none),
                "coupling.turbulence and coupling.dispersion need the turbulence that flow.closure = \"laminar\" has "
                "not: give \"untouched\" and \"none\"");
  keys({"coupling.added_mass", "flow.algorithm"})
      .fault_if(c.coupling.added_mass == coupling::AddedMass::relative && c.flow.algorithm == flow::Algorithm::simple,
                "coupling.added_mass = \"relative\" needs the acceleration of the water, which flow.algorithm = "
                "\"simple\" does not keep: give \"grain\"");

  // the pipe
  if (pipe.present) {
    keys({"pipe.x", "pipe.diameter", "mesh.length"})
        .fault_if(pipe.x - D / 2 <= 0 || pipe.x + D / 2 >= mesh.length,
                  "pipe.x = {} m with pipe.diameter = {} m reaches through {}", pipe.x, D,
                  pipe.x - D / 2 <= 0 ? "the inlet, x = 0" : fmt::format("the outlet, x = {} m", mesh.length));
    const auto height = keys({"pipe.gap_ratio", "pipe.diameter", "mesh.height", "bed.thickness", "bed.count",
                              "grains.diameter", "grains.spread", "mesh.length"});
    height.fault_if(bed < mesh.height && pipe.y + D / 2 >= mesh.height,
                    "pipe.gap_ratio = {} lifts the top of the pipe to {:.4g} m, above mesh.height = {} m",
                    pipe.gap_ratio, pipe.y + D / 2, mesh.height);
    height.fault_if(pipe.y - D / 2 < -1e-9 * D,
                    "pipe.gap_ratio = {} sinks the pipe {:.4g} m below the floor of the box; the bed is {:.4g} m thick",
                    pipe.gap_ratio, D / 2 - pipe.y, bed);
    keys({"mesh.cell_x", "pipe.diameter"})
        .fault_if(D < least_cells_across_pipe * mesh.cell_x * (1 - 1e-9),
                  "mesh.cell_x = {} m gives {:.3g} cells across the pipe; {} are needed: at most {:.4g} m", mesh.cell_x,
                  D / mesh.cell_x, least_cells_across_pipe, D / least_cells_across_pipe);
    keys({"mesh.cell_y", "pipe.diameter"})
        .fault_if(D < least_cells_across_pipe * mesh.cell_y * (1 - 1e-9),
                  "mesh.cell_y = {} m gives {:.3g} cells across the pipe; {} are needed: at most {:.4g} m", mesh.cell_y,
                  D / mesh.cell_y, least_cells_across_pipe, D / least_cells_across_pipe);
    keys({"mesh.fine_x_to", "mesh.fine_x_from", "pipe.x", "pipe.diameter", "mesh.growth"})
        .fault_if(mesh.growth > 1 && mesh.fine_x_to > mesh.fine_x_from &&
                      (pipe.x - D / 2 < mesh.fine_x_from || pipe.x + D / 2 > mesh.fine_x_to),
                  "the pipe, {:.4g} m to {:.4g} m, leaves the fine window mesh.fine_x_from = {} m to mesh.fine_x_to = "
                  "{} m",
                  pipe.x - D / 2, pipe.x + D / 2, mesh.fine_x_from, mesh.fine_x_to);
    keys({"mesh.fine_y_to", "mesh.fine_y_from", "pipe.gap_ratio", "pipe.diameter", "mesh.growth", "bed.thickness",
          "bed.count"})
        .fault_if(mesh.growth > 1 && mesh.fine_y_to > mesh.fine_y_from &&
                      (pipe.y - D / 2 < mesh.fine_y_from || pipe.y + D / 2 > mesh.fine_y_to),
                  "the pipe, {:.4g} m to {:.4g} m, leaves the fine window mesh.fine_y_from = {} m to mesh.fine_y_to = "
                  "{} m",
                  pipe.y - D / 2, pipe.y + D / 2, mesh.fine_y_from, mesh.fine_y_to);
    keys({"pipe.wall", "pipe.roughness"})
        .fault_if(pipe.wall == flow::Wall::rough && pipe.roughness == 0,
                  "pipe.wall = \"rough\" needs pipe.roughness, the ks of the pipe");
    keys({"pipe.roughness", "pipe.wall"})
        .fault_if(pipe.wall != flow::Wall::rough && pipe.roughness > 0,
                  "pipe.roughness = {} m contradicts pipe.wall, which is not \"rough\"", pipe.roughness);
  }

  // water
  keys({"flow.steady", "flow.algorithm"})
      .fault_if(c.flow.steady && c.flow.algorithm != flow::Algorithm::simple,
                "flow.steady = true needs flow.algorithm = \"simple\": the projection has no steady mode");
  keys({"flow.floor_roughness", "flow.floor"})
      .fault_if(c.flow.floor != flow::Wall::rough && c.flow.floor_roughness > 0,
                "flow.floor_roughness = {} m contradicts flow.floor, which is not \"rough\"", c.flow.floor_roughness);
  keys({"current.roughness", "current.profile"})
      .fault_if(current.profile == flow::Profile::smooth && current.roughness > 0,
                "current.roughness = {} m contradicts current.profile = \"smooth\"", current.roughness);

  keys({"current.profile", "pipe.present"})
      .fault_if(
          current.profile == flow::Profile::recycled && pipe.present,
          "current.profile = \"recycled\" is for a channel without beginning or end, and this one has a pipe in it: "
          "give pipe.present = false or another profile");
  keys({"current.theta", "current.mean_speed", "current.shear_velocity", "current.profile", "current.roughness",
        "mesh.height", "bed.thickness", "bed.count", "grains.diameter", "grains.density", "flow.density",
        "flow.viscosity"})
      .fault_if(bed < mesh.height && c.grains.density > c.flow.density &&
                    !(c.theta > 0 && std::isfinite(c.theta) && current.mean_speed > 0),
                "the current is too weak for its log law: theta = {:.3g}, u* = {:.3g} m/s, mean speed {:.3g} m/s",
                c.theta, current.shear_velocity, current.mean_speed);

  // time
  keys({"flow.max_step", "time.grain_step"})
      .fault_if(c.flow.max_step < c.grains.step, "flow.max_step = {} s is shorter than the grains' step, {:.4g} s",
                c.flow.max_step, c.grains.step);
  keys({"time.end_over_T", "pipe.present", "bed.count", "bed.thickness"})
      .fault_if(
          c.is_given("time.end_over_T") && c.time_scale == 0,
          "time.end_over_T = {} needs a pipe and grains: without them there is no scour time scale; give time.end",
          c.time.end_over_T);
  keys({"time.stop_at_equilibrium", "pipe.present", "bed.count", "bed.thickness"})
      .fault_if(c.time.stop_at_equilibrium && c.time_scale == 0,
                "time.stop_at_equilibrium needs a pipe and grains: without them nothing is scoured");

  // output
  check_window(keys({"output.profiles_x_to", "output.profiles_x_from", "mesh.length"}), "output.profiles_x_from",
               "output.profiles_x_to", "mesh.length", c.output.profiles_x_from,
               c.output.profiles_x_to > 0 ? c.output.profiles_x_to : mesh.length, mesh.length);
  const std::string ids_fault = read_ids(c.output.track_ids).fault;
  keys({"output.track_ids"}).fault_if(!ids_fault.empty(), "output.track_ids: {}", ids_fault);
  keys({"output.tracks_every", "output.contacts_every", "bed.thickness", "bed.count"})
      .fault_if((c.output.tracks_every > 0 || c.output.contacts_every > 0) && c.grains.count == 0,
                "output.tracks_every and output.contacts_every need grains; the bed has none");
}

double least_rise(const Case& c) {
  if (c.grains.count == 0) return 0;
  const double solid = 2.0 / 3.0 * c.grains.packing_fraction;  // spheres in the slab, of circles in the plane
  const double weight = (c.grains.density - c.flow.density) * c.grains.gravity * solid;  // of the bed [N/m3]
  return c.flow.density * c.flow.current.mean_speed / (push_to_note * weight);
}

std::vector<std::string> notes(const Case& c) {
  std::vector<std::string> all;
  if (c.grains.count > 0 && c.grains.stiffness > 0 &&
      grains::static_overlap(c.grains, c.bed_thickness) > overlap_to_note)
    all.push_back(
        fmt::format("the lowest grains overlap by {:.2g} d under the weight of the bed: raise "
                    "contact.stiffness or lower time.grain_step",
                    grains::static_overlap(c.grains, c.bed_thickness)));
  if (c.is_given("contact.damping") && c.grains.damping > 0.5 && c.grains.steps_per_contact < 40)
    all.push_back(
        fmt::format("contact.damping = {} with contact.steps = {} may never come to rest in a dense bed: "
                    "give 40 steps or more",
                    c.grains.damping, c.grains.steps_per_contact));
  if (const double rise = c.flow.current.rise, least = least_rise(c); rise > 0 && rise < least)
    all.push_back(fmt::format(
        "while the current comes up, the pressure that speeds up the water pushes the bed along with {:.2g} of "
        "its weight in water: give current.rise {:.2g} s or more",
        push_to_note * least / rise, least));
  if (c.flow.pipe.present && c.grains.count > 0 && c.bed_thickness < 1.5 * c.flow.pipe.diameter)
    all.push_back(fmt::format("the bed is {:.2g} D thick: a hole of 0.9 D comes near the floor of the box",
                              c.bed_thickness / c.flow.pipe.diameter));
  return all;
}

}  // namespace livebed::casefile
