#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "coupling/params.hpp"
#include "flow/params.hpp"
#include "grains/params.hpp"

namespace livebed::casefile {

struct TimeParams {
  double end = 7;                    ///< last time [s]; t = 0 is the release of the grains
  double end_over_T = 0;             ///< the same over the scour time scale T [-]; 0 without a time scale
  double spin_up = 2;                ///< flow on the fixed bed before that [s]
  bool stop_at_equilibrium = false;  ///< end as soon as S/D is steady
  double equilibrium_change = 0.02;  ///< S/D steady: its means over the two halves of the window differ by less [-]
  double equilibrium_window = 2;     ///< [T], T the scour time scale
};

struct OutputParams {
  double series_every = 0.01;   ///< [s], rows of series.csv
  double bed_every = 0.05;      ///< [s], lines of bed.csv
  double fields_every = 0.25;   ///< [s], ParaView files
  double checkpoint_every = 1;  ///< [s] of simulated time
};

/// One resolved case: everything a run needs, in SI units, derived numbers filled in (check.hpp).
struct Case {
  std::string title;
  std::string preset = "livebed";
  flow::Params flow;
  grains::Params grains;
  coupling::Params coupling;
  TimeParams time;
  OutputParams output;
  double d10 = 0, d50 = 0, d90 = 0;  ///< 10, 50 and 90 % of the mass of the sand are finer [m]; 0: not given by these
  std::string grading;               ///< sieve curve as written: "0.2 mm: 10 %, 0.36 mm: 50 %"; empty: none
  double bed_thickness = 0.05;       ///< [m], level of the bed: nominal until the packing has shown the true one
  std::string walls;                 ///< for the grains, as written (walls.hpp)
  double cut = 0;                    ///< [m], level to which a bed of a given count was cut; 0: not cut
  double measured_level = 0;         ///< [m], that true one; 0 before the packing

  /// Where one key can stand for another (current.theta or current.mean_speed, ...): the ones the case was given by.
  std::vector<std::string> given;
  bool is_given(std::string_view key) const { return std::find(given.begin(), given.end(), key) != given.end(); }

  // derived
  double theta = 0;       ///< nominal Shields parameter of the approaching current [-]
  double time_scale = 0;  ///< T = D^2 / sqrt(g (s-1) d^3) theta^(-5/3) / 50 [s]; 0 without pipe or grains
};

}  // namespace livebed::casefile
