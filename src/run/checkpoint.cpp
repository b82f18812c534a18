#include "run/checkpoint.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "base/fault.hpp"
#include "base/version.hpp"
#include "case/check.hpp"
#include "case/read.hpp"
#include "case/resolved.hpp"
#include "io/hdf5.hpp"
#include "run/bed_file.hpp"

namespace livebed::run {

namespace {

constexpr std::int64_t format_version = 8;

/// Calls visit(name, field) for every field of the flow that the next step reads.
template <class FlowState, class Visit>
void each_field(FlowState& s, Visit&& visit) {
  visit("u", s.u), visit("v", s.v), visit("p", s.p), visit("p_change", s.p_change), visit("k", s.k),
      visit("epsilon", s.epsilon), visit("nut", s.nut);
  visit("u_old", s.u_old), visit("v_old", s.v_old), visit("k_old", s.k_old), visit("epsilon_old", s.epsilon_old);
  visit("convection_u", s.convection_u), visit("convection_v", s.convection_v);
  visit("convection_k", s.convection_k), visit("convection_e", s.convection_e);
  visit("beta_u", s.load.beta_u), visit("beta_v", s.load.beta_v);
  visit("force_u", s.load.force_u), visit("force_v", s.load.force_v);
  visit("damping", s.load.damping), visit("room", s.load.room), visit("voidage", s.voidage);
}

template <class GroupLike, class ClockLike, class WallLike, class ProgressLike>
void pass_scalars(GroupLike& g, ClockLike& clock, WallLike& wall, ProgressLike& p) {
  pass(g, "flow_steps", clock.flow_steps), pass(g, "grain_steps", clock.grain_steps),
      pass(g, "released", clock.released);
  pass(g, "wall_flow", wall.flow), pass(g, "wall_grains", wall.grains);
  pass(g, "wall_exchange", wall.exchange), pass(g, "wall_output", wall.output);
  pass(g, "series_rows", p.series_rows), pass(g, "bed_rows", p.bed_rows), pass(g, "frames", p.frames);
  pass(g, "checkpoints", p.checkpoints), pass(g, "series_offset", p.series_offset), pass(g, "bed_offset", p.bed_offset);
  pass(g, "original_level", p.original.level), pass(g, "original_packed", p.original.packed);
  pass(g, "theta_sum", p.theta_sum), pass(g, "theta_time", p.theta_time), pass(g, "largest_overlap", p.largest_overlap);
  pass(g, "asleep_sum", p.asleep_sum), pass(g, "start_wall", p.start_wall);
}

template <class GroupLike, class SeparationLike>
void pass_separation(GroupLike& g, SeparationLike& s) {
  pass(g, "stagnation", s.stagnation), pass(g, "separation_above", s.above), pass(g, "separation_below", s.below);
}

/// Outputs that only some cases ask for: without them a checkpoint holds nothing of them.
bool asks_for_more(const casefile::OutputParams& p) {
  return p.profiles_every > 0 || p.tracks_every > 0 || p.contacts_every > 0;
}

template <class GroupLike, class ProgressLike>
void pass_more(GroupLike& g, ProgressLike& p) {
  pass(g, "track_times", p.track_times), pass(g, "contact_frames", p.contact_frames);
  pass(g, "profiles_offset", p.profiles_offset), pass(g, "tracks_offset", p.tracks_offset);
  pass(g, "tracked", p.tracked);
  pass(g, "profile_layers", p.profiles.layers), pass(g, "profile_rows", p.profiles.rows);
  pass(g, "profile_from", p.profiles.from), pass(g, "profile_seen", p.profiles.seen);
  pass(g, "profile_windows", p.profiles.windows);
}

}  // namespace

void save_checkpoint(const std::filesystem::path& file, Simulation& sim, const Progress& progress) {
  io::Hdf5Writer writer(file);
  io::Group root = writer.root();
  root.write("format", format_version);
  root.write("version", std::string(base::version()));
  root.write("commit", std::string(base::commit()));
  root.write("compiler", std::string(base::compiler()));
  root.write("case", casefile::resolved_text(sim.resolved()));
  root.write("bed_level", sim.resolved().bed_thickness);
  Simulation::each_part(sim, [&](flow::Solver& solver, grains::Bed& bed, coupling::Coupler& coupler, Supply& supply,
                                 Clock& clock, WallTimes& wall) {
    const flow::State& s = solver.state;
    io::Group flow = root.make("flow");
    each_field(s, [&](const char* name, const base::Field& f) {
      if (f.nx() > 0) flow.write(name, f);
    });
    pass(flow, "step", s.step), pass(flow, "time", s.time), pass(flow, "load_top", s.load.top);
    pass_separation(flow, s.separation);
    pass(flow, "has_voids", s.voidage.nx() > 0);
    const flow::Boundary& sides = solver.boundary();
    flow.write("inlet_u", sides.inlet_u), flow.write("inlet_k", sides.inlet_k);
    flow.write("inlet_epsilon", sides.inlet_epsilon);
    io::Group grains = root.make("grains");
    if (bed.state.count() > 0) write_bed(grains, bed);
    io::Group exchange = root.make("exchange");
    coupling::Coupler::each_part(std::as_const(coupler),
                                 [&](const char* name, const auto& part) { exchange.write(name, part); });
    const coupling::ImpulseLedger& l = coupler.ledger();
    exchange.write("ledger", std::vector<double>{l.to_grains.x, l.to_grains.y, l.to_flow.x, l.to_flow.y, l.carried.x,
                                                 l.carried.y});
    if (!supply.goes_round()) {
      io::Group ends = root.make("supply");
      SupplyState::each_part(std::as_const(supply.state()),
                             [&](const char* name, const auto& part) { pass(ends, name, part); });
    }
    io::Group run = root.make("run");
    pass_scalars(run, std::as_const(clock), std::as_const(wall), progress);
    if (asks_for_more(sim.resolved().output)) {
      io::Group more = root.make("more_output");
      pass_more(more, progress);
    }
  });
  writer.save();
}

Restored load_checkpoint(const std::filesystem::path& file) {
  const io::Hdf5Reader reader(file);
  const io::Group root = reader.root();
  std::int64_t format = 0;
  root.read("format", format);
  if (format != format_version)
    base::fail(base::Exit::input_output,
               "{}: checkpoint format {}, this program reads {}; resume with the program that wrote it", file.string(),
               format, format_version);
  std::string text, version, commit, compiler;
  root.read("case", text);
  root.read("version", version), root.read("commit", commit), root.read("compiler", compiler);
  casefile::Case resolved = casefile::read_text(text, file.string() + ":case");
  double level = 0;
  root.read("bed_level", level);
  if (resolved.grains.count > 0) casefile::derive_at_level(resolved, resolved.grains.count, level);

  grains::Bed bed;
  if (resolved.grains.count > 0) bed = read_bed(root.open("grains"), resolved.grains);
  Restored result{Simulation(resolved, std::move(bed)), {}, {}};
  Simulation::each_part(result.sim, [&](flow::Solver& solver, grains::Bed&, coupling::Coupler& coupler, Supply& supply,
                                        Clock& clock, WallTimes& wall) {
    flow::State& s = solver.state;
    const io::Group flow = root.open("flow");
    bool voids = false;
    pass(flow, "has_voids", voids);
    if (voids) s.voidage = s.u;
    each_field(s, [&](const char* name, base::Field& f) {
      if (f.nx() > 0) flow.read(name, f);
    });
    pass(flow, "step", s.step), pass(flow, "time", s.time), pass(flow, "load_top", s.load.top);
    pass_separation(flow, s.separation);
    if (voids) solver.set_voidage(base::Field(s.voidage), 0);
    const io::Group exchange = root.open("exchange");
    coupling::Coupler::each_part(coupler, [&](const char* name, auto& part) { exchange.read(name, part); });
    std::vector<double> l;
    exchange.read("ledger", l);
    coupler.restore_ledger({{l.at(0), l.at(1)}, {l.at(2), l.at(3)}, {l.at(4), l.at(5)}});
    if (!supply.goes_round()) {
      const io::Group ends = root.open("supply");
      SupplyState::each_part(supply.state(), [&](const char* name, auto& part) { pass(ends, name, part); });
    }
    const io::Group run = root.open("run");
    pass_scalars(run, clock, wall, result.progress);
    if (asks_for_more(resolved.output)) {
      const io::Group more = root.open("more_output");
      pass_more(more, result.progress);
    }
  });
  const auto differs = [&](const char* what, const std::string& then, std::string_view now) {
    if (then != now)
      result.note += fmt::format("{}the checkpoint was written by {} {}, this is {}", result.note.empty() ? "" : "; ",
                                 what, then, now);
  };
  differs("version", version, base::version());
  differs("commit", commit, base::commit());
  differs("compiler", compiler, base::compiler());
  return result;
}

std::filesystem::path checkpoint_path(const std::filesystem::path& run_folder, std::int64_t flow_step) {
  return run_folder / "checkpoints" / fmt::format("step_{:09d}.h5", flow_step);
}

std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& run_folder) {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path folder = run_folder / "checkpoints";
  if (!std::filesystem::is_directory(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".h5") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace livebed::run
