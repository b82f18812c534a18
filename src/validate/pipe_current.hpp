#pragma once
#include <array>
#include <string>
#include <vector>

#include "flow/advance.hpp"
#include "validate/result.hpp"

/// A current past a pipe above a smooth floor: Section 3 of Yeganeh-Bakhtiary et al. (2013) after the experiment of
/// Oner, Kirkgoz and Akoz (2008), Ocean Eng. 35, 1492.
namespace livebed::validate {

inline constexpr double pipe_diameter = 0.05;                                    ///< D [m]
inline constexpr double depth_mean_speed = 0.197;                                ///< U0 [m/s]
inline constexpr double reynolds_D = 9500;                                       ///< U0 D / nu: nu = 1.037e-6 m2/s
inline constexpr double water_density = 1000;                                    ///< [kg/m3]
inline constexpr double box_length = 30, box_depth = 3.5, pipe_from_inlet = 10;  ///< of the paper [D]
inline constexpr int work_nx = 540, work_ny = 94;                                ///< the grid of most runs
inline constexpr std::array<double, 6> sections = {-2, 0, 1, 2, 4, 8};           ///< x from the pipe's centre [D]
inline constexpr int snapshots = 6;                                              ///< at the end of the record
inline constexpr double snapshot_distance = 0.8;                                 ///< [D/U0]
inline constexpr double window_from = -2, window_to = 8, window_height = 3;      ///< part that is drawn [D]

struct PipeSetup {
  flow::Closure closure = flow::Closure::k_epsilon;
  double gap_ratio = 0.3;          ///< e/D
  double depth = box_depth;        ///< of the water [D]
  int nx = work_nx, ny = work_ny;  ///< equal cells over 30 D x 3.5 D; growing by 1.05 above
  flow::Profile profile = flow::Profile::smooth;
  flow::PipeLayer layer = flow::PipeLayer::turbulent;
  double profile_depth = 0;  ///< over which the inlet's mean is U0 [D]; 0 = the whole depth
  flow::Convection convection = flow::Convection::bounded;
  double spin_up = 60, record = 130;  ///< [D/U0]; a finer grid than the usual one starts from a flow on that one

  std::string name() const;  ///< of its folder
  std::string text() const;
};

/// What is kept of a run.  Lengths from the pipe's centre (x) and the floor (y) in D; speeds in U0; times in D/U0;
/// shear in rho u*^2 of the inlet; force coefficients with U0 and D.
struct PipeRun {
  int nx = 0, ny = 0;
  double seconds = 0;  ///< wall time
  std::string commit;  ///< of the program that made it
  double steps = 0;
  double axis_speed = 0;   ///< of the inlet at the height of the pipe's axis
  double inlet_shear = 0;  ///< rho u*^2 of the inlet's profile [Pa]
  double cd_box = 0;       ///< mean drag by the momentum of a box; 0 where no box fits round the pipe

  std::vector<double> t, drag, lift;
  std::vector<double> u_above, u_below;  ///< beside the rear of the pipe: 0.15 D above it and half way to the floor
  std::vector<double> u_wake, v_wake;    ///< 2 D behind the centre: u at the height of the top, v at that of the axis

  std::vector<double> floor_x, shear;  ///< mean shear on the floor, with sign, of the wall function
  std::vector<double> shear_viscous;   ///< Eq. 13: mu dU/dy in the first cells
  std::vector<double> axis_u;          ///< mean u at floor_x on the height of the axis

  std::vector<double> section_y;
  std::array<std::vector<double>, sections.size()> section_u;  ///< mean u

  std::vector<double> window_x, window_y;          ///< nodes of the part that is drawn
  std::vector<double> psi_mean;                    ///< stream function [U0 D], 0 on the floor
  std::array<std::vector<double>, snapshots> psi;  ///< the same at the instants
};

/// Numbers of a run.
struct PipeNumbers {
  double cd = 0, cl = 0, cl_rms = 0;
  double strouhal = 0, strouhal_wake = 0;   ///< of lift and v_wake, with U0; 0 when the flow is steady
  double periods = 0;                       ///< in the record
  double slowest = 0, fastest = 0;          ///< Strouhal numbers of stretches of five periods
  double far_shear = 0;                     ///< mean over x = -8 to -5 D
  double peak_shear = 0, peak_at = 0;       ///< largest within 1 D of the centre
  double eddy_before = 0;                   ///< length of the floor with backward shear upstream [D]
  double separation = 0, reattachment = 0;  ///< first, last change of sign of the floor's shear behind x = 0; 0 if none
  double wake_end = 0;                      ///< where mean u on the axis turns forward, from the centre; 0 if nowhere
  bool steady() const { return strouhal == 0; }
};

PipeRun run_pipe(const PipeSetup& setup, const Tell& tell);
PipeNumbers measure(const PipeRun& run);

/// The run kept in a folder for its setup, or made and kept there now: `folder`/NAME/{series,floor,...}.csv and
/// run.json, which is written last.
PipeRun kept_run(const PipeSetup& setup, const std::string& folder, const Tell& tell);

}  // namespace livebed::validate
