#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "flow/mesh.hpp"
#include "flow/state.hpp"
#include "grains/state.hpp"
#include "io/file.hpp"

/// ParaView files: .vtr (the flow's grid), .vtp (grains, pipe), .pvd (time series).  VTK XML with zlib-compressed data
/// in base64; single precision for results, double for coordinates and times.  Faults (input/output) name
/// the file.
namespace livebed::io {

/// How the numbers of an array are stored; in memory they are doubles.
enum class Store { float32, float64, int32 };

/// A named array of tuples, component fastest.
struct DataArray {
  std::string name;
  int components = 1;
  Store store = Store::float32;
  std::vector<double> values;
};

/// A rectilinear grid in the plane with data in its cells, x fastest.
struct Grid {
  double time = 0;           ///< [s]
  std::vector<double> x, y;  ///< faces [m]
  std::vector<DataArray> cells;

  int nx() const { return static_cast<int>(x.size()) - 1; }
  int ny() const { return static_cast<int>(y.size()) - 1; }
};

enum class Shape { points, closed_line, pairs };

/// Points in the plane, each drawn as a vertex, or joined to one closed line, or to a line from each even one to the
/// next.
struct Points {
  double time = 0;  ///< [s]
  Shape shape = Shape::points;
  std::vector<double> x, y;  ///< [m]
  std::vector<DataArray> data;
  std::vector<DataArray> lines = {};  ///< of the lines of Shape::pairs
};

/// The array of this name; Fault (input/output) listing the names when there is none.
const DataArray& array(const std::vector<DataArray>& arrays, std::string_view name);
bool has_array(const std::vector<DataArray>& arrays, std::string_view name);

/// The flow in cells: velocity (from the staggered faces), p, k, epsilon, nut, open (volume fraction outside the pipe)
/// and, when given, solid (volume fraction of grains; null without grains).
Grid flow_fields(const flow::Mesh& mesh, const flow::State& state, const base::Field* solid, double time);
/// Grains in the order of their id: id, diameter, velocity, omega, drag (the drag force on it, beta (U - u_p) [N]).
Points grain_points(const grains::State& grains, double time);
/// The pipe as a polygon of 180 corners.
Points circle_line(double x, double y, double diameter);

void write_vtr(const Path& path, const Grid& grid);
void write_vtp(const Path& path, const Points& points);
/// Read what the functions above wrote (not every VTK file there is).
Grid read_vtr(const Path& path);
Points read_vtp(const Path& path);

/// One file of a time series.
struct TimedFile {
  double time = 0;   ///< [s]
  std::string file;  ///< relative to the .pvd's folder
};

/// A .pvd that grows with the run; rewritten atomically at each addition, so it is valid at any moment.
class TimeSeries {
public:
  /// Continues the series on disk up to and including `keep_until` (drops later entries), or starts an empty one.
  explicit TimeSeries(const Path& path, double keep_until = -1);
  void add(double time, const std::string& file);
  const std::vector<TimedFile>& files() const { return files_; }

private:
  Path path_;
  std::vector<TimedFile> files_;
};

/// The entries of a .pvd.
std::vector<TimedFile> read_pvd(const Path& path);

}  // namespace livebed::io
