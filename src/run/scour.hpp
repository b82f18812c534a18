#pragma once
#include <optional>
#include <span>
#include <vector>

#include "base/field.hpp"

/// From grains to the numbers of the hole: solid fraction -> bed line -> depth, width, mound -> S_eq and T.
/// Pure functions on plain arrays; nothing here knows files, the clock or the flow.
namespace livebed::run {

/// Where the bed is sampled: cells of about half a grain over [0, length) (periodic) x [0, height).
struct SamplingGrid {
  int nx = 0, ny = 0;
  double hx = 0, hy = 0;  ///< cell size [m]
  double x(int i) const { return (i + 0.5) * hx; }
  double y(int j) const { return (j + 0.5) * hy; }
  double length() const { return nx * hx; }
};

/// Cells no larger than `cell` that fill the length exactly and cover the height.  Fault (internal) unless all are > 0.
SamplingGrid sampling_grid(double length, double height, double cell);

/// The circle that is neither bed nor water; diameter 0 = no pipe.
struct PipeCircle {
  double x = 0, y = 0, diameter = 0;  ///< centre, D [m]
};

/// Area fraction of the grain discs, smoothed over a few diameters.
///
/// Each disc hands its area to the cells within reach = 2.5 d of its centre with the weights (1 + cos(pi r/reach)) in x
/// times the same in y, scaled to sum 1; what would fall below the floor is folded back.  Cells beside the pipe are
/// divided by the part of their surroundings that is open, so the fraction of a bed does not fade where it leans on the
/// pipe.
class SolidFraction {
public:
  /// diameter: of a typical grain, d [m].  Fault (internal) when the cells are wider than the kernel or absurdly fine.
  SolidFraction(const SamplingGrid& grid, const PipeCircle& pipe, double diameter);

  /// x, y, diameter: one entry a grain [m]; x may lie outside [0, length) and is wrapped.
  void sample(std::span<const double> x, std::span<const double> y, std::span<const double> diameter);

  const SamplingGrid& grid() const { return grid_; }
  const PipeCircle& pipe() const { return pipe_; }
  /// Half-width of the kernel [m].
  double reach() const { return reach_; }
  /// Is (x, y) inside the pipe or closer to it than a grain's centre can come?
  bool barred(double x, double y) const;
  /// Smoothed fraction [-], nx x ny, without ghosts.
  const base::Field& values() const { return fraction_; }

  /// Median fraction of the cells with centres in [y_from, y_to): the packed value of a settled bed.  Fault (internal)
  /// when no cell lies there.
  double packed(double y_from, double y_to) const;

private:
  void spread(double x, double y, double area, base::Field& onto) const;

  SamplingGrid grid_;
  PipeCircle pipe_;
  double diameter_, reach_;
  base::Field fraction_;
  base::Field open_;  ///< smoothed part of the surroundings outside the pipe [-]
};

/// Height y_b [m] of the bed in each sampling column: the first place, going up from the floor, where the fraction
/// falls below half of the packed value (linear between cells), so grains in suspension above do not count.  A pocket
/// of water no higher than the kernel's half-width, with bed above it, is part of the bed.  Cells inside the pipe are
/// skipped: sand below and none above ends at the pipe's underside, sand on both sides goes on through it.
std::vector<double> bed_line(const SolidFraction& solid, double packed);

/// Mean level of a line [m] outside the pipe's span: the original bed when the line is that of t = 0.
double mean_level(std::span<const double> x, std::span<const double> line, const PipeCircle& pipe);

/// The hole and its mound, all relative to the original level.  [m], areas [m2].
struct Hole {
  double depth_under_pipe = 0;  ///< below the pipe's centre; negative = the bed has risen
  double depth = 0;             ///< largest within one D of the pipe's centre: S
  double depth_x = 0;           ///< where that is
  double width = 0;             ///< of the stretch round depth_x that lies below the original level
  double mound_height = 0;      ///< highest point downstream of the pipe's centre, 0 when nothing rises
  double mound_x = 0;           ///< where that is
  double eroded = 0;            ///< area below the original level
  double deposited = 0;         ///< area of the bed above it
};

/// x ascending and evenly spaced, line(x) the bed, original the level of t = 0 [m].  Without a pipe (diameter 0) only
/// the areas are measured.
Hole measure_hole(std::span<const double> x, std::span<const double> line, double original, const PipeCircle& pipe);

}  // namespace livebed::run
