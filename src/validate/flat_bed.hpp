#pragma once
#include <string>
#include <vector>

#include "validate/result.hpp"

/// Sand that a steady current moves along a flat bed without end: the water is uniform along x, its stress on the bed
/// is known from the balance of momentum.
namespace livebed::validate {

struct FlatBedSetup {
  double diameter = 2e-3;                  ///< d [m]
  double density = 2650;                   ///< of the grains [kg/m3]
  double theta = 0.33;                     ///< nominal Shields parameter [-]
  unsigned seed = 1;                       ///< of sizes, packing and eddies
  double length = 150, bed = 12;           ///< of the box, thickness of the bed [d]
  double depth = 50;                       ///< of the water [d]
  double cell_x = 2, cell_y = 0.5;         ///< near the bed; growing above [d]
  double spin_up = 2, begin = 2, end = 6;  ///< flow over the fixed bed; what is averaged after the release [s]
  std::vector<std::string> keys = {};      ///< further "table.key=value" over the preset's

  std::string name() const;  ///< of its file
  std::string text() const;
};

/// Means over time; heights from the floor.
struct FlatBedRun {
  double flux = 0;               ///< of solids without pores [m2/s]
  double theta = 0;              ///< measured
  double level = 0;              ///< of the bed before it moved [m]
  double seconds = 0;            ///< wall time
  std::string commit;            ///< of the program that made it
  std::vector<double> y;         ///< of the rows of cells [m]
  std::vector<double> solid, u;  ///< volume fraction, speed of the water [m/s]
  std::vector<double> grain_u;  ///< mean speed of the grains whose centres are in the row [m/s]; 0 where there are none

  /// q / sqrt((s-1) g d^3) [-]
  double einstein(const FlatBedSetup& setup) const;
};

FlatBedRun run_flat_bed(const FlatBedSetup& setup);

/// The run kept in a folder for its setup, or made and kept there now: `folder`/NAME.json.
FlatBedRun kept_flat_bed(const FlatBedSetup& setup, const std::string& folder, const Tell& tell);

}  // namespace livebed::validate
