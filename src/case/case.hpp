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
  double series_every = 0.01;                     ///< [s], rows of series.csv
  double bed_every = 0.05;                        ///< [s], lines of bed.csv
  double fields_every = 0.25;                     ///< [s], ParaView files
  double checkpoint_every = 1;                    ///< [s] of simulated time
  double profiles_every = 0;                      ///< length of a window of profiles.csv [s]; 0: none
  double profiles_from = 0;                       ///< begin of the first one [s]
  double profiles_x_from = 0, profiles_x_to = 0;  ///< stretch they are taken over [m]; to 0: to the end of the box
  double profiles_cell = 0;                       ///< height of their layers [m]; 0: d/4
  double tracks_every = 0;                        ///< [s], rows of tracks.csv; 0: none
  int tracks = 10;                                ///< grains followed: those nearest to the bed under the pipe
  std::string track_ids;                          ///< or these, as written: "12, 40"; empty: not chosen so
  double contacts_every = 0;                      ///< [s], files of contact forces for ParaView; 0: none
};

/// The sand at the ends of the box.  periodic: what leaves through one end comes in at the other (the paper);
/// equilibrium: what leaves is gone, and what the approach has lost of its sand comes in; none: nothing does.
enum class Supply { periodic, equilibrium, none };
/// The approach goes from the inlet to feed_to; what comes in is like what moves there from feed_from on: of the way
/// from the inlet to the pipe or, without one, of the box.
inline constexpr double feed_from = 0.25, feed_to = 0.5;
/// It begins at least so far behind the inlet [d].
inline constexpr double feed_behind_inlet = 16;

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
  std::string bed_file;              ///< LAMMPS data file the grains start from; empty: they are packed
  Supply supply = Supply::periodic;
  double cut = 0;             ///< [m], level to which a bed of a given count was cut; 0: not cut
  double measured_level = 0;  ///< [m], that true one; 0 before the packing

  /// Where one key can stand for another (current.theta or current.mean_speed, ...): the ones the case was given by.
  std::vector<std::string> given;
  bool is_given(std::string_view key) const { return std::find(given.begin(), given.end(), key) != given.end(); }

  // derived
  double theta = 0;       ///< nominal Shields parameter of the approaching current [-]
  double time_scale = 0;  ///< T = D^2 / sqrt(g (s-1) d^3) theta^(-5/3) / 50 [s]; 0 without pipe or grains
};

}  // namespace livebed::casefile
