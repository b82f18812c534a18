#include "report/sweep.hpp"

#include <algorithm>
#include <chrono>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include "app/run_options.hpp"
#include "app/side_by_side.hpp"
#include "app/verbs.hpp"
#include "base/loops.hpp"
#include "case/read.hpp"
#include "case/resolved.hpp"
#include "case/sweep.hpp"
#include "io/descriptor.hpp"
#include "run/bed_cache.hpp"
#include "run/checkpoint.hpp"
#include "run/control.hpp"
#include "run/execute.hpp"

namespace livebed::app {

namespace {

namespace fs = std::filesystem;
using base::Exit;

struct Arguments {
  std::string path, out;
  std::vector<std::string> set;
  std::vector<long long> seeds;
  int jobs = 0;
  std::string bed_cache = run::default_bed_cache().string();
  bool no_bed_cache = false, json = false, quiet = false;
};

/// The folder of a sweep: cases/NAME.toml is what the run in runs/NAME was asked to do.  One program at a time.
class SweepFolder {
public:
  explicit SweepFolder(const fs::path& folder) : folder_(made(folder)), lock_(folder / "lock", O_RDWR | O_CREAT) {
    if (::flock(lock_.number(), LOCK_EX | LOCK_NB) != 0)
      base::fail(Exit::input_output,
                 "another sweep is at work in {}, or runs of one that was killed are about to stop; "
                 "wait for it, or give another folder with --out",
                 folder.string());
  }

  fs::path case_of(const std::string& name) const { return folder_ / "cases" / (name + ".toml"); }
  fs::path run_of(const std::string& name) const { return folder_ / "runs" / name; }

  /// Refuses cases other than those the runs in this folder were begun with; keeps those that are new.
  void keep(const std::vector<casefile::SweptCase>& cases) const {
    std::string faults;
    for (const casefile::SweptCase& one : cases) {
      const fs::path file = case_of(one.name);
      if (!fs::exists(file)) {
        if (fs::exists(run_of(one.name)))
          faults += fmt::format("{} holds a run, but {} does not tell of which case\n", run_of(one.name).string(),
                                file.string());
        continue;
      }
      const casefile::Case then = casefile::read_text(io::read_file(file), file.string());
      const std::vector<std::string> changed = casefile::differences(one.given, then);
      if (!changed.empty()) faults += fmt::format("{} has changed: {}\n", one.name, fmt::join(changed, "; "));
    }
    if (!faults.empty())
      base::fail(Exit::input_output,
                 "{}the runs in {} belong to another case; give another folder with --out, or the case they were begun "
                 "with ({})",
                 faults, folder_.string(), (folder_ / "cases").string());
    io::make_folder(folder_ / "cases");
    io::make_folder(folder_ / "runs");
    for (const casefile::SweptCase& one : cases)
      if (!fs::exists(case_of(one.name))) io::write_atomically(case_of(one.name), casefile::resolved_text(one.given));
  }

private:
  static const fs::path& made(const fs::path& folder) {
    const bool used = fs::exists(folder) && !(fs::is_directory(folder) && fs::is_empty(folder));
    if (used && !fs::exists(folder / "cases"))
      base::fail(Exit::input_output, "{} exists already and is not the folder of a sweep; give another one with --out",
                 folder.string());
    io::make_folder(folder);
    return folder;
  }

  fs::path folder_;
  io::Descriptor lock_;
};

/// Begins a run, or goes on with it.
Exit do_run(const casefile::Case& given, const fs::path& folder, const fs::path& bed_cache) {
  RunArguments arguments;
  arguments.quiet = true;
  const bool resume = !run::list_checkpoints(folder).empty();
  if (!resume && fs::exists(folder)) {
    // It was stopped before its grains were released: there is nothing to go on with.
    if (run::is_running(folder)) base::fail(Exit::input_output, "{} is being run by another program", folder.string());
    fs::remove_all(folder);
  }
  return run_with(folder, arguments, [&](run::Options options) {
    options.bed_cache = bed_cache;
    return resume ? run::resume(folder, {}, options) : run::execute(given, folder, options);
  });
}

report::SweepPlan plan_of(const std::vector<casefile::SweptCase>& cases, const std::vector<casefile::SweptKey>& keys,
                          const SweepFolder& folder) {
  report::SweepPlan plan;
  plan.title = cases.front().given.title;
  std::vector<std::string> varied;
  for (const casefile::SweptKey& swept : keys)
    if (swept.values.size() > 1) varied.push_back(swept.key);
  for (const std::string& key : varied) plan.columns.push_back(casefile::column_of(key));
  plan.combinations.resize(cases.back().combination + 1);
  for (const casefile::SweptCase& one : cases) {
    std::vector<std::string>& values = plan.combinations[one.combination];
    values.clear();
    for (const std::string& key : varied) values.push_back(casefile::plain_value(one.given, key));
    plan.runs.push_back({one.name, folder.run_of(one.name), one.combination, one.given.grains.seed, ""});
  }
  return plan;
}

/// Lines about the course of a sweep: a status redrawn on a terminal, a line a minute elsewhere.
class Course {
public:
  explicit Course(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {}
  void say(const std::string& line) {
    if (quiet_) return;
    fmt::print(stderr, "{}{}\n", drawn_ ? "\r\033[K" : "", line);
    drawn_ = false;
  }
  void show(const report::SweepPlan& plan, const std::vector<std::size_t>& running) {
    const auto now = std::chrono::steady_clock::now();
    if (quiet_ || now < next_) return;
    next_ = now + std::chrono::seconds(terminal_ ? 1 : 60);
    std::vector<std::string> parts;
    for (std::size_t r : running) {
      const auto status = nlohmann::json::parse(text_of(plan.runs[r].folder / "status.json"), nullptr, false);
      if (!status.is_object()) continue;
      parts.push_back(fmt::format("{}: {} t = {:.3g} of {:.3g} s", plan.runs[r].name, status.value("phase", ""),
                                  status.value("t_s", 0.0), status.value("end_s", 0.0)));
    }
    const std::string line = fmt::format("{}", fmt::join(parts, "; "));
    if (terminal_) {
      fmt::print(stderr, "\r\033[K{:.150}", line);
      drawn_ = true;
    } else {
      fmt::print(stderr, "{}\n", line);
    }
    std::fflush(stderr);
  }

private:
  /// The file is replaced twice a second and may be gone.
  static std::string text_of(const fs::path& file) {
    try {
      return fs::exists(file) ? io::read_file(file) : "";
    } catch (const base::Fault&) {
      return "";
    }
  }

  bool quiet_, terminal_, drawn_ = false;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + std::chrono::seconds(2);
};

std::string result_of(const fs::path& folder) {
  const report::RunNumbers run = report::read_numbers(folder);
  return fmt::format("{}{}", run.ended.empty() ? "no summary" : run.ended,
                     run.S_over_D.empty() ? "" : fmt::format(", S/D = {:.3g}", run.S_over_D.back()));
}

Exit sweep(const Arguments& a) {
  const std::vector<casefile::SweptKey> keys = casefile::swept_keys(a.set);
  const std::vector<casefile::SweptCase> cases = casefile::sweep(a.path, keys, a.seeds);
  const SweepFolder folder(a.out);
  folder.keep(cases);
  report::SweepPlan plan = plan_of(cases, keys, folder);

  const int threads = base::threads();
  base::set_threads(1);  // children are made from a program of one thread, and make their own
  std::vector<Task> tasks;
  std::vector<std::size_t> run_of_task;
  for (std::size_t r = 0; r < cases.size(); ++r) {
    const fs::path run_folder = plan.runs[r].folder;
    if (report::state_of(run_folder) == report::RunState::ended) continue;
    run_of_task.push_back(r);
    tasks.push_back({cases[r].name, [&, r, run_folder] {
                       base::set_threads(threads);
                       return do_run(cases[r].given, run_folder, a.no_bed_cache ? fs::path() : fs::path(a.bed_cache));
                     }});
  }
  const int jobs = a.jobs > 0 ? a.jobs : std::max(1, base::cores() / threads);
  Course course(a.quiet);
  course.say(fmt::format("{} combinations, {} runs: {} have ended before, {} to do, {} at a time",
                         plan.combinations.size(), cases.size(), cases.size() - tasks.size(), tasks.size(), jobs));
  std::size_t done = cases.size() - tasks.size();
  const SideBySide processes{.begun = [&](std::size_t task) { course.say(fmt::format("begun: {}", tasks[task].name)); },
                             .ended =
                                 [&](std::size_t task, const Outcome& outcome) {
                                   const std::size_t r = run_of_task[task];
                                   done += outcome.code == Exit::ok;
                                   course.say(outcome.fault.empty()
                                                  ? fmt::format("{} of {}: {}: {}", done, cases.size(),
                                                                tasks[task].name, result_of(plan.runs[r].folder))
                                                  : fmt::format("{}: {}", tasks[task].name, outcome.fault));
                                   report::write_sweep(report::gather(plan), a.out);
                                 },
                             .meanwhile =
                                 [&](const std::vector<std::size_t>& running) {
                                   std::vector<std::size_t> runs;
                                   for (std::size_t task : running) runs.push_back(run_of_task[task]);
                                   course.show(plan, runs);
                                 }};
  std::vector<Outcome> outcomes;
  const int signal = processes.run(tasks, jobs, outcomes);

  Exit code = Exit::ok;
  for (std::size_t task = 0; task < tasks.size() && signal == 0; ++task) {
    if (outcomes[task].code == Exit::ok) continue;
    if (code == Exit::ok) code = outcomes[task].code;
    if (!outcomes[task].fault.empty()) plan.runs[run_of_task[task]].fault = outcomes[task].fault;
  }
  const report::Sweep result = report::gather(plan);
  report::write_sweep(result, a.out);
  if (a.json) {
    fmt::print("{}\n", report::sweep_json(result).dump(2));
  } else {
    for (const char* name : {"sweep.csv", "sweep.json", "sweep.html"})
      fmt::print("{}\n", (fs::path(a.out) / name).string());
  }
  std::fflush(stdout);
  for (const report::SweepRun& run : plan.runs)
    if (!run.fault.empty()) fmt::print(stderr, "failed: {}: {}\n", run.name, run.fault);
  for (std::size_t r = 0; r < result.runs.size(); ++r)
    if (plan.runs[r].fault.empty() && result.runs[r].state == report::RunState::unfinished)
      fmt::print(stderr, "not finished: {}\n", plan.runs[r].name);
  if (signal == 0 && code == Exit::ok) return code;
  fmt::print(stderr, "the same command goes on with what has not ended\n");
  return signal != 0 ? static_cast<Exit>(static_cast<int>(Exit::signal) + signal) : code;
}

}  // namespace

void add_sweep(CLI::App& app, Action& chosen) {
  auto* verb = app.add_subcommand(
      "sweep",
      "Run every combination of keys with every seed; mean and band of what they give.  Given again, it goes on.");
  auto a = std::make_shared<Arguments>();
  verb->add_option("case", a->path, "case file, or a folder with a case.toml")->required();
  verb->add_option("--out", a->out, "folder of the sweep")->required();
  verb->add_option("--seeds", a->seeds, "values of bed.seed: --seeds 1,2,3; without it that of the case")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb->add_option("--set", a->set, "values of a key: --set table.key=v1,v2; may be repeated for other keys")
      ->type_name("TABLE.KEY=V1,V2,...")
      ->allow_extra_args(false);
  verb->add_option("--jobs", a->jobs, "runs at a time; without it one for each core, or for each --threads cores")
      ->check(CLI::PositiveNumber);
  verb->add_option("--bed-cache", a->bed_cache, "folder of packed beds: the second run of a bed starts at once")
      ->capture_default_str();
  verb->add_flag("--no-bed-cache", a->no_bed_cache, "pack each bed whatever has been kept, and keep nothing");
  verb->add_flag("--json", a->json, "print sweep.json");
  verb->add_flag("--quiet", a->quiet, "no progress");
  verb->callback([a, &chosen] { chosen = [a] { return sweep(*a); }; });
}

}  // namespace livebed::app
