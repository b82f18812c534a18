#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/file.hpp"
#include "io/vtk.hpp"
#include "report/picture.hpp"

/// One moment of a run as a picture: speed of the water behind, grains coloured by their speed, the pipe, lines on top.
namespace livebed::report {

/// The pipe as a file tells it.
struct Pipe {
  double x = 0, y = 0, diameter = 0;  ///< [m]
};

/// Circle through the points of a pipe's .vtp.
Pipe read_pipe(const io::Path& path);

/// A line or a row of dots drawn on top, in metres.
struct Overlay {
  std::vector<double> x, y;
  Colour colour;
  bool dots = false;
};

struct SnapshotOptions {
  int width = 1200;             ///< [pixels]; the height follows from the window
  double x_from = 0, x_to = 0;  ///< window [m]; both 0 = from 3 D before to 6 D behind the pipe, or the whole length
  double water_speed = 0;       ///< end of its colour scale [m/s]; 0 = the largest of this snapshot
  double grain_speed = 0;       ///< the same for the grains
  double level =
      std::numeric_limits<double>::quiet_NaN();  ///< original bed [m], where y/D = 0; NaN = the pipe's lowest point
  bool arrows = true;                            ///< direction of the water
  std::string title;
  std::vector<Overlay> overlays;
};

/// What there is of a moment; grains and pipe may be missing.
struct Snapshot {
  io::Grid water;
  std::optional<io::Points> grains;
  std::optional<Pipe> pipe;
};

Picture draw(const Snapshot& snapshot, const SnapshotOptions& options);

/// Largest speed of the water [m/s], and a speed that 99.8 % of the grains stay below: shared scales for several
/// pictures.
double largest_water_speed(const Snapshot& snapshot);
double largest_grain_speed(const Snapshot& snapshot);

/// Reads the files and writes the picture; pass empty paths for what there is not.  Faults (input/output) name the
/// file.
void render_snapshot(const io::Path& vtr, const io::Path& grains_vtp, const io::Path& pipe_vtp, const io::Path& out_png,
                     const SnapshotOptions& options);

}  // namespace livebed::report
