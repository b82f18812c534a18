#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "base/fault.hpp"
#include "case/case.hpp"

namespace livebed::run {

/// How a run is to be done; nothing of it changes its numbers.
struct Options {
  std::filesystem::path bed_cache;                    ///< folder of packed beds (BedCache); empty: none
  double wall_limit = 0;                              ///< stop with a checkpoint after this wall time [s]; 0 = none
  std::function<void(const std::string& line)> say;   ///< one line to the user and the log
  std::function<void(const std::string& line)> note;  ///< one line to the log alone; may be empty
  std::function<void(double t, double end, double S_over_D, double speed, double left)> progress;  ///< every few steps
  std::function<void(double t, double mean_speed, double settled_speed)> packing;  ///< now and then while grains settle
};

/// Tells running runs to stop after the present step, with a checkpoint; safe in a signal handler.
void request_stop(int signal);

/// From now on the first SIGINT or SIGTERM asks for a stop, a second one ends the program at once.
void obey_signals();

/// Runs a case from the packing to its end in a new folder.  Throws Fault: input/output when the folder holds something
/// already or cannot be written, diverged with place, time and the last good checkpoint, signal when it is stopped
/// while grains settle, of which nothing is kept.  Returns ok, stopped_by_limit, or signal (the signal's number is in
/// stop_signal()).
base::Exit execute(const casefile::Case& given, const std::filesystem::path& folder, const Options& options);

/// Continues the newest readable checkpoint of a run folder, bit for bit as if never stopped; until: a new end [s].
/// Newer ones that cannot be read are told and renamed to *.damaged.  Throws Fault: input/output when there is none to
/// read, command line when the new end lies before it.
base::Exit resume(const std::filesystem::path& folder, std::optional<double> until, const Options& options);

/// A line that tells of idle cores from which a case of this size would gain, or nothing.
std::string thread_advice(double cells_and_grains, int threads, int cores);

/// Signal that stopped the last run; 0 when none did.
int stop_signal();

}  // namespace livebed::run
