#pragma once
#include "flow/advance.hpp"
#include "validate/result.hpp"

namespace livebed::validate {

/// Steady laminar flow past a cylinder in a channel: case 2D-1 of Schaefer and Turek (1996), Re 20.  Lengths in
/// diameters (0.1 m), speeds in the mean inlet speed (0.2 m/s).
struct DuctRun {
  double cd = 0, cl = 0;
  double flux_below = 0;  ///< share of the water that passes below the cylinder [-]
  double seconds = 0;
};
DuctRun run_duct(double cells);

/// Impulsive start of a stream without friction past a cylinder in a channel: what the cut cells do to a potential.
struct ImpulseRun {
  double impulse = 0;     ///< on the cylinder along the stream [density speed D^2]
  double flux_below = 0;  ///< share of the water that passes below the cylinder [-]
};
/// shift: of the centre, in cells.
ImpulseRun run_impulse(int cells, double shift_x, double shift_y);

Result duct(const Tell& tell);

}  // namespace livebed::validate
