#include "app/run_options.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <unistd.h>

#include "app/watch_beside.hpp"
#include "base/version.hpp"

namespace livebed::app {

namespace {

std::string clock_time() {
  const std::time_t now = std::time(nullptr);
  char text[32];
  std::tm local{};
  localtime_r(&now, &local);
  std::strftime(text, sizeof text, "%H:%M:%S", &local);
  return text;
}

std::string duration(double seconds) {
  const int s = static_cast<int>(seconds + 0.5);
  return s >= 3600 ? fmt::format("{} h {:02d} min", s / 3600, s / 60 % 60) : fmt::format("{}:{:02d}", s / 60, s % 60);
}

/// Progress as a bar that is redrawn, or as a line every ten seconds.
class Progress {
public:
  explicit Progress(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO)) {}

  void operator()(double t, double end, double S_over_D, double speed, double left) {
    show(t <= 0 ? 0 : t / end, t < 0 ? fmt::format("spin-up, t = {:.3f} s", t)
                                     : fmt::format("t = {:.3f} of {:.3f} s, S/D = {:.3f}, {:.3g} s/s, {} left", t, end,
                                                   S_over_D, speed, duration(left)));
  }
  /// Nobody knows when a bed will rest.
  void packing(double t, double mean_speed, double settled_speed) {
    show(0, fmt::format("packing, {:.3f} s: mean grain speed {:.2g} m/s, at rest below {:.2g}", t, mean_speed,
                        settled_speed));
  }
  void clear() {
    if (drawn_) fmt::print(stderr, "\r\033[K");
    drawn_ = false;
  }

private:
  void show(double share, const std::string& numbers) {
    if (quiet_) return;
    if (terminal_) {
      const int filled = static_cast<int>(30 * share);
      fmt::print(stderr, "\r[{:=<{}}{:>{}}] {}\033[K", "", filled, "", 30 - filled, numbers);
      drawn_ = true;
    } else if (std::chrono::steady_clock::now() >= next_) {
      next_ = std::chrono::steady_clock::now() + std::chrono::seconds(10);
      fmt::print(stderr, "{}\n", numbers);
    }
    std::fflush(stderr);
  }

  bool quiet_, terminal_, drawn_ = false;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace

void add_run_arguments(CLI::App& verb, RunArguments& arguments) {
  verb.add_option("--wall-limit", arguments.wall_limit,
                  "stop with a checkpoint after this many seconds of wall time (exit 6)")
      ->check(CLI::PositiveNumber);
  verb.add_flag("--quiet", arguments.quiet, "no progress");
  CLI::Option* watch =
      verb.add_flag("--watch", arguments.watch, "serve the run's page to this machine (livebed watch)");
  verb.add_option("--port", arguments.port, "port of that page; without it the first free one from 7333 on")
      ->check(CLI::Range(1, 65535))
      ->needs(watch);
}

base::Exit run_with(const std::filesystem::path& folder, const RunArguments& arguments,
                    const std::function<base::Exit(const run::Options&)>& work) {
  run::obey_signals();
  if (arguments.watch) fmt::print(stderr, "{}\n", watch_from_beside(folder, arguments.port));
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is told as a failed write
  Progress progress(arguments.quiet);
  std::ofstream log;
  const auto note = [&](const std::string& line) {
    // The folder appears only when the run has found it free.
    if (!log.is_open() && std::filesystem::is_directory(folder)) {
      log.open(folder / "log.txt", std::ios::app);
      log << clock_time() << " livebed " << base::version() << " (" << base::commit() << ", " << base::compiler()
          << ")\n";
    }
    if (log.is_open()) log << clock_time() << ' ' << line << std::endl;
  };
  run::Options options;
  options.note = note;
  options.wall_limit = arguments.wall_limit;
  options.say = [&](const std::string& line) {
    progress.clear();
    if (!arguments.quiet) fmt::print(stderr, "{}\n", line);
    note(line);
  };
  options.progress = [&](double t, double end, double S, double speed, double left) {
    progress(t, end, S, speed, left);
  };
  options.packing = [&](double t, double speed, double settled) { progress.packing(t, speed, settled); };
  base::Exit code{};
  try {
    code = work(options);
  } catch (const base::Fault& fault) {
    progress.clear();
    if (log.is_open()) note(fault.what());  // never into a folder that the run was refused
    if (fault.code() != base::Exit::signal) throw;
    fmt::print(stderr, "{}\n", fault.what());
    code = fault.code();
  }
  progress.clear();
  if (code == base::Exit::signal)
    return static_cast<base::Exit>(static_cast<int>(base::Exit::signal) + run::stop_signal());
  fmt::print("{}\n", (folder / "summary.json").string());
  return code;
}

}  // namespace livebed::app
