#pragma once
#include <optional>
#include <vector>

#include "io/vtk.hpp"
#include "report/run_folder.hpp"

/// What water and grains do near the bed, measured in the frames of a run.
namespace livebed::report {

/// One frame's measures on columns and cells of equal size.
struct FrameMeasures {
  double time = 0;               ///< [s]
  std::vector<double> x;         ///< middles of the columns [m]
  std::vector<double> on_sand;   ///< force of the water on the sand per area of bed [Pa]; empty when not in the file
  std::vector<double> in_water;  ///< rho (nu + nu_t) du/dy just above the bed line [Pa]; NaN inside the pipe
  int nx = 0, ny = 0;
  double dx = 0, dy = 0;     ///< cells of the map [m]
  std::vector<double> flux;  ///< sum |u_p| V_p / (dx dy b) [m/s], nx x ny, x fastest
};

/// Sand counts as surface down to three grains below the bed line; the slab is one grain thick (b = d).  Columns are as
/// wide as a tenth of the pipe, or two grains; cells of the map are two grains wide, at most 250 along the box.
FrameMeasures measure_frame(const io::Grid& water, const io::Points& grains, const RunFolder& run);

/// The measures of all frames of a run with t > 0; files that were measured before are taken from `known`.
class NearBed {
public:
  void update(const RunFolder& run);
  bool empty() const { return frames_.empty(); }

  /// Mean over the frames of the last quarter of the time so far.
  struct Shear {
    double from = 0, to = 0;  ///< [s]
    int frames = 0;
    std::vector<double> x, on_sand, in_water;
    double upstream_on_sand = 0, upstream_in_water = 0;  ///< means over the stretch before the pipe [Pa]
  };
  Shear shear(const RunFolder& run) const;
  /// Mean flux over all frames.
  FrameMeasures mean_flux() const;

private:
  std::vector<FrameMeasures> frames_;
};

}  // namespace livebed::report
