#pragma once
#include <functional>
#include <optional>
#include <string>

#include "app/options.hpp"
#include "case/question.hpp"
#include "run/cost.hpp"

/// Which size of grain fits into a given budget of hours.
namespace livebed::app {

/// A case that can be had with grains of any size, at the same theta.
struct Sizable {
  double sand = 0;      ///< d of the case or the question itself [m]
  double finest = 0;    ///< finest that can be made a case of [m]: sand, or coarser
  double coarsest = 0;  ///< coarsest that still means something [m]
  std::function<casefile::Case(double d)> at;
  run::Work work;  ///< with the sand itself
};
Sizable sizable(const casefile::Question& question);
Sizable sizable(const CaseOptions& which);

/// Speeds of this machine for it: its own case when that is small, or else one with larger grains.
run::Speeds time_on_this_machine(const Sizable& what, double budget);

struct Size {
  double d = 0;  ///< [m]
  run::Prediction prediction;
  bool fits = false;  ///< into the hours; false: the coarsest there is does not
};
/// The finest that fits, of rounded sizes from the sand's own on.  Where the speeds are those of a much larger or
/// smaller model than the one that fits, that one is timed, too.
Size finest_within(double hours, const Sizable& what, run::Speeds speeds, double budget);

/// Processor time of the look at the machine unless --seconds says otherwise [s]; packing comes on top.
inline constexpr double seconds_to_time = 6;

/// "3 min", "2.5 h", "12 days", "40 years".
std::string spoken(double seconds);

}  // namespace livebed::app
