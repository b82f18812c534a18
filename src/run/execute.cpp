#include "run/execute.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <ctime>
#include <nlohmann/json.hpp>

#include "base/loops.hpp"
#include "case/resolved.hpp"
#include "grains/measures.hpp"
#include "io/file.hpp"
#include "run/control.hpp"
#include "run/cost.hpp"
#include "run/observers.hpp"
#include "run/summary.hpp"

namespace livebed::run {

namespace {

std::atomic<int> stop_requested{0};

using WallClock = std::chrono::steady_clock;
double seconds_since(WallClock::time_point start) {
  return std::chrono::duration<double>(WallClock::now() - start).count();
}

/// From so many cells and grains together on a second thread pays (docs/performance.md).
constexpr double threads_pay_from = 150'000;

void advise(const casefile::Case& c, const Options& options) {
  const Work work = work_of(c);
  const std::string line = thread_advice(work.cells + work.grains, base::threads(), base::cores());
  if (!line.empty()) options.say(line);
}

/// Steps until the end, a signal or a limit; writes what is due and the summary.  begun: when the program's work began,
/// which is what the wall-time limit counts from.
base::Exit advance_to_end(Simulation& sim, Observers& observers, const std::filesystem::path& folder, Control& control,
                          WallClock::time_point begun, const Options& options) {
  const casefile::Case& c = sim.resolved();
  auto start = WallClock::now();  // of the steps, less the pauses
  const double time_start = sim.time();
  auto last_word = start;
  const auto finish = [&](const char* why, base::Exit code) {
    observers.checkpoint(sim);
    write_summary(folder, sim, observers.progress(), why);
    options.say(fmt::format("ended at t = {:.4g} s: {}", sim.time(), why));
    return code;
  };
  const auto status = [&] {
    const double speed = (sim.time() - time_start) / seconds_since(start);
    return Status{
        sim.clock().released ? "digging" : "spin-up",     sim.time(), c.time.end, observers.scour_depth(), speed,
        speed > 0 ? (c.time.end - sim.time()) / speed : 0};
  };
  const auto show = [&] {
    if (seconds_since(last_word) < 0.2) return;
    last_word = WallClock::now();
    const Status s = status();
    control.tell(s);
    if (options.progress) options.progress(s.time, s.end, s.S_over_D, s.speed, s.left);
  };
  // Does what the command file says; paused, it waits there for the next word.
  const auto listen = [&] {
    std::optional<WallClock::time_point> paused;
    do {
      if (const auto word = control.take()) {
        const auto command = command_of(*word);
        if (!command) {
          options.say(fmt::format("the command file says \"{}\"; there are {}", *word, command_words));
        } else if (*command == Command::checkpoint) {
          observers.checkpoint(sim);
          options.say(fmt::format("checkpoint at t = {:.4g} s, as asked", sim.time()));
        } else if (*command == Command::pause && !paused) {
          paused = WallClock::now();
          options.say(fmt::format("paused at t = {:.4g} s", sim.time()));
        } else if (*command == Command::go && paused) {
          start += WallClock::now() - *paused;
          paused.reset();
          options.say("going on");
        } else if (*command == Command::stop) {
          request_stop(SIGTERM);
        }
      }
      if (!paused) return;
      Status waiting = status();
      waiting.phase = "paused";
      control.tell(waiting);
      const timespec moment{0, 20'000'000};
      ::nanosleep(&moment, nullptr);
    } while (!stop_requested);
  };
  const auto limit_reached = [&] { return options.wall_limit > 0 && seconds_since(begun) > options.wall_limit; };
  control.tell(status(), true);
  while (sim.time() < c.time.end || !sim.clock().released) {
    try {
      if (sim.clock().released) {
        sim.step();
      } else if (sim.time() < 0) {
        sim.spin_up_step();
      }
      // In the same round as the last step before it: the row of t = 0 tells of that step.
      if (!sim.clock().released && sim.time() >= 0) {
        sim.release();
        control.tell(status(), true);
        options.say(fmt::format(
            "grains released; end at t = {:.4g} s{}", c.time.end,
            c.time_scale > 0 ? fmt::format(" = {:.3g} T, T = {:.3g} s", c.time.end / c.time_scale, c.time_scale) : ""));
      }
    } catch (const base::Fault& fault) {
      const auto saved = list_checkpoints(folder);
      const std::string good = saved.empty() ? "none was written yet" : saved.back().string();
      base::fail(fault.code(), "{}; last good checkpoint: {}", fault.what(), good);
    }
    const flow::StepReport& flow_step = sim.last_report();
    if (options.note && flow_step.outer_iterations > 0)
      options.note(fmt::format("t = {:.5g} s: {} outer iterations, residuals {}", sim.time(),
                               flow_step.outer_iterations, flow_step.residuals.text()));
    if (sim.clock().released) observers.observe(sim);
    listen();
    if (stop_requested) return finish("stopped by a signal", base::Exit::signal);
    if (limit_reached()) return finish("stopped by the wall-time limit", base::Exit::stopped_by_limit);
    if (c.time.stop_at_equilibrium && observers.at_equilibrium(c)) return finish("equilibrium", base::Exit::ok);
    show();
  }
  return finish("end of time", base::Exit::ok);
}

}  // namespace

std::string thread_advice(double cells_and_grains, int threads, int cores) {
  if (threads > 1 || cores < 2 || cells_and_grains < threads_pay_from) return "";
  return fmt::format(
      "note: on one of {} cores; if others are idle, livebed --threads {} is faster with a case of this size and gives "
      "the same bits",
      cores, cores);
}

void request_stop(int signal) { stop_requested = signal; }
void obey_signals() {
  const auto once = [](int signal) {
    request_stop(signal);
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, once);
  std::signal(SIGTERM, once);
}
int stop_signal() { return stop_requested; }

base::Exit execute(const casefile::Case& given, const std::filesystem::path& folder, const Options& options) {
  if (std::filesystem::exists(folder) && !(std::filesystem::is_directory(folder) && std::filesystem::is_empty(folder)))
    base::fail(base::Exit::input_output,
               "{} exists already; give another folder with --out, or continue it with: livebed resume {}",
               folder.string(), folder.string());
  io::make_folder(folder);
  Control control(folder);
  control.tell({.phase = "packing"}, true);
  const auto start = WallClock::now();
  advise(given, options);
  options.say(fmt::format("packing {} grains", given.grains.count));
  WallClock::time_point last_word = start;
  const auto look = [&](const grains::SettleRow& row) {
    if (stop_requested)
      base::fail(base::Exit::signal,
                 "stopped while the grains settled, of which nothing is kept; remove {} and run the case again",
                 folder.string());
    if (!options.packing || seconds_since(last_word) < 0.2) return;
    last_word = WallClock::now();
    options.packing(row.time, row.mean_speed, given.grains.settled_speed);
  };
  Simulation::Start ready = Simulation::prepare(given, BedCache(options.bed_cache, options.say), look);
  io::write_atomically(folder / "case.resolved.toml", casefile::resolved_text(ready.resolved));
  if (!ready.convergence.empty()) {
    io::TableWriter table(folder / "packing.csv", {"time_s", "mean_speed_m_s", "max_speed_m_s", "height_m"});
    for (const grains::SettleRow& row : ready.convergence)
      table.row(std::vector<double>{row.time, row.mean_speed, row.max_speed, row.height});
    const grains::ContactMeasures m = grains::measure_contacts(ready.bed);
    const double level = ready.resolved.bed_thickness;
    const grains::Fractions filled =
        grains::packing_fractions(ready.resolved.grains, ready.bed.state, packed_from * level, packed_to * level);
    options.say(fmt::format(
        "bed at rest after {:.2f} s: {} grains, level {:.4g} m, {:.2f} contacts a grain, largest overlap {:.2g} d",
        ready.convergence.back().time, ready.bed.params.count, level, m.per_grain, m.largest_overlap));
    options.say(
        fmt::format("inside it grains fill {:.3f} of the plane (bed.packing_fraction = {}) and {:.3f} of the slab",
                    filled.area, ready.resolved.grains.packing_fraction, filled.volume));
    const nlohmann::ordered_json packing = {{"grains", ready.bed.params.count},
                                            {"level_m", level},
                                            {"area_fraction", filled.area},
                                            {"area_fraction_aimed_at", ready.resolved.grains.packing_fraction},
                                            {"volume_fraction", filled.volume},
                                            {"contacts_per_grain", m.per_grain},
                                            {"mean_overlap_over_d", m.mean_overlap},
                                            {"largest_overlap_over_d", m.largest_overlap},
                                            {"mean_speed_m_s", ready.convergence.back().mean_speed},
                                            {"grain_time_s", ready.convergence.back().time}};
    io::write_atomically(folder / "packing.json", packing.dump(2) + "\n");
  }
  Simulation sim(ready.resolved, std::move(ready.bed));
  Progress progress;
  progress.start_wall = seconds_since(start);
  const casefile::Case& c = sim.resolved();
  options.say(fmt::format("flow on the fixed bed for {:.4g} s: {} x {} cells, u* = {:.4g} m/s, theta = {:.3g}",
                          c.time.spin_up, sim.flow().mesh().nx, sim.flow().mesh().ny, c.flow.current.shear_velocity,
                          c.theta));
  Observers observers(folder, sim, progress);
  return advance_to_end(sim, observers, folder, control, start, options);
}

base::Exit resume(const std::filesystem::path& folder, std::optional<double> until, const Options& options) {
  const auto start = WallClock::now();
  std::optional<Control> control;
  if (std::filesystem::is_directory(folder)) control.emplace(folder);
  std::vector<std::filesystem::path> files = list_checkpoints(folder), damaged;
  if (files.empty())
    base::fail(base::Exit::input_output, "{} holds no checkpoint to resume (looked in {})", folder.string(),
               (folder / "checkpoints").string());
  std::optional<Restored> restored;
  while (!restored) {
    try {
      restored.emplace(load_checkpoint(files.back()));
    } catch (const base::Fault& fault) {
      if (fault.code() != base::Exit::input_output || files.size() == 1) throw;
      options.say(fmt::format("{}; trying the checkpoint before", fault.what()));
      damaged.push_back(files.back());
      files.pop_back();
    }
  }
  // Out of the way: what is newest in the folder must be something that can be resumed.
  for (const std::filesystem::path& file : damaged) std::filesystem::rename(file, file.string() + ".damaged");
  if (until) {
    if (*until < restored->sim.time())
      base::fail(base::Exit::command_line, "--until {} s lies before the checkpoint at t = {:.6g} s", *until,
                 restored->sim.time());
    restored->sim.set_end(*until);
    io::write_atomically(folder / "case.resolved.toml", casefile::resolved_text(restored->sim.resolved()));
  }
  options.say(fmt::format("resuming at t = {:.4g} s from {}", restored->sim.time(), files.back().string()));
  if (!restored->note.empty()) options.say("note: " + restored->note + "; results may differ in the last bits");
  advise(restored->sim.resolved(), options);
  Observers observers(folder, restored->sim, restored->progress);
  return advance_to_end(restored->sim, observers, folder, *control, start, options);
}

}  // namespace livebed::run
