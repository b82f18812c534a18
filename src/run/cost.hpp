#pragma once
#include <string>
#include <vector>

#include "case/case.hpp"

/// What a run will cost, before it runs.
namespace livebed::run {

/// What a case asks for.
struct Work {
  double grains = 0, cells = 0;
  double packed = 0;                               ///< grains to pack one by one; the rest are copies of them
  double flow_step = 0;                            ///< estimate from the Courant number [s]
  double held_steps = 0;                           ///< of the flow over the fixed bed
  double flow_steps = 0;                           ///< of the flow after the release
  double grain_steps = 0;                          ///< of every grain
  double series = 0, frames = 0, checkpoints = 0;  ///< rows and files to write

  /// Grains, cells, steps of the flow and of the grains each times a factor: grains of 1/sqrt(factor) the size in the
  /// same scene at the same theta, to the same t/T.
  Work scaled(double factor) const;
};
Work work_of(const casefile::Case& c);

/// Seconds that the parts of a run take on this machine with the threads in use.
struct Speeds {
  double packing = 0;                          ///< a grain, until the bed has come to rest
  double held_flow = 0, flow = 0;              ///< a cell and step of the flow, before and after the release
  double held_exchange = 0, exchange = 0;      ///< a grain and step of the flow
  double grain = 0;                            ///< a grain and its step
  double series = 0;                           ///< a row of series.csv
  double frame = 0, checkpoint = 0;            ///< a file, for each of its grains and cells
  double held_step_ratio = 1, step_ratio = 1;  ///< steps of the flow as they came over Work::flow_step
  double cpu = 1;                              ///< processor time over wall time
  double memory_base = 0, memory = 0;          ///< of the program alone [B]; of a grain or cell [B]
  // the model that was timed
  double grains = 0, cells = 0, seconds = 0;
};

/// Times a model of the case in its own box for about `budget` seconds of each thread's processor time: a stretch of
/// its bed is packed and laid side by side, the pipe stands just clear of it, the flow starts, the grains are let go.
/// Files go to a temporary folder and are removed.  The case should be small enough for a handful of steps: enlarge its
/// grains before (casefile::enlarging) and predict the other case with the same speeds.  Throws Fault as a run of the
/// case would.
Speeds time_model(const casefile::Case& c, double budget);

/// Wall time by part [s].
struct Prediction {
  double packing = 0, spin_up = 0, flow = 0, exchange = 0, grains = 0, output = 0;
  double cpu = 0;         ///< processor time of all threads [s]
  double memory = 0;      ///< [B]
  double flow_steps = 0;  ///< spin-up included
  double wall() const { return packing + spin_up + flow + exchange + grains + output; }
};
Prediction predict(const Work& work, const Speeds& speeds);

}  // namespace livebed::run
