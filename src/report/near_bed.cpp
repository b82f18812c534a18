#include "report/near_bed.hpp"

#include <algorithm>
#include <cmath>

#include "base/curves.hpp"
#include "base/math.hpp"

namespace livebed::report {

namespace {

constexpr double surface_depth = 3;  ///< [d]
constexpr int most_cells = 250;

/// Cells of a grid whose centres lie at c: the one that holds s.
int cell_of(const std::vector<double>& faces, double s) {
  const auto next = std::upper_bound(faces.begin(), faces.end(), s);
  return std::clamp(static_cast<int>(next - faces.begin()) - 1, 0, static_cast<int>(faces.size()) - 2);
}

/// The stress above the bed line at x; NaN where there is no open water.
double stress_above(const io::Grid& water, double x, double bed, const RunFolder& run) {
  const std::vector<double>& u = io::array(water.cells, "velocity").values;
  const std::vector<double>& nut = io::array(water.cells, "nut").values;
  const int i = cell_of(water.x, x), j = std::min(cell_of(water.y, bed) + 1, water.ny() - 2);
  const auto cell = [&](int row) { return static_cast<std::size_t>(row) * water.nx() + i; };
  if (io::has_array(water.cells, "open")) {
    const std::vector<double>& open = io::array(water.cells, "open").values;
    if (open[cell(j)] < 0.5 || open[cell(j + 1)] < 0.5) return std::nan("");
  }
  const double distance = 0.5 * (water.y[j + 2] - water.y[j]);
  const double mean_nut = 0.5 * (nut[cell(j)] + nut[cell(j + 1)]);
  return run.water_density * (run.viscosity + mean_nut) * (u[3 * cell(j + 1)] - u[3 * cell(j)]) / distance;
}

void add_to(std::vector<double>& sum, const std::vector<double>& values) {
  sum.resize(values.size());
  for (std::size_t n = 0; n < values.size(); ++n) sum[n] += values[n];
}

/// Mean of the values at from <= x <= to that are numbers; 0 when there are none.
double mean_between(const std::vector<double>& x, const std::vector<double>& values, double from, double to) {
  double sum = 0;
  int count = 0;
  for (std::size_t n = 0; n < values.size(); ++n)
    if (x[n] >= from && x[n] <= to && std::isfinite(values[n])) sum += values[n], ++count;
  return count > 0 ? sum / count : 0;
}

}  // namespace

FrameMeasures measure_frame(const io::Grid& water, const io::Points& grains, const RunFolder& run) {
  const double d = run.grain_diameter, length = water.x.back(), height = water.y.back();
  FrameMeasures m;
  m.time = water.time;
  const double width = std::max(2 * d, run.pipe ? run.pipe->diameter / 10 : 0.0);
  const int columns = std::max(1, static_cast<int>(length / width));
  for (int i = 0; i < columns; ++i) m.x.push_back((i + 0.5) * length / columns);
  m.nx = std::clamp(static_cast<int>(length / (2 * d)), 1, most_cells);
  m.dx = length / m.nx;
  m.ny = std::max(1, static_cast<int>(std::lround(height / m.dx)));
  m.dy = height / m.ny;
  m.flux.assign(static_cast<std::size_t>(m.nx) * m.ny, 0.0);

  const BedLine bed = run.bed->nearest(water.time);
  const bool with_drag = io::has_array(grains.data, "drag");
  const std::vector<double> none;
  const std::vector<double>&velocity = io::array(grains.data, "velocity").values,
        &diameter = io::array(grains.data, "diameter").values,
        &drag = with_drag ? io::array(grains.data, "drag").values : none;
  if (with_drag) m.on_sand.assign(m.x.size(), 0.0);
  for (std::size_t n = 0; n < grains.x.size(); ++n) {
    const double x = grains.x[n], y = grains.y[n];
    const int i = std::clamp(static_cast<int>(x / m.dx), 0, m.nx - 1),
              j = std::clamp(static_cast<int>(y / m.dy), 0, m.ny - 1);
    m.flux[static_cast<std::size_t>(j) * m.nx + i] +=
        std::hypot(velocity[3 * n], velocity[3 * n + 1]) * base::sphere_volume(diameter[n]) / (m.dx * m.dy * d);
    if (!with_drag || y < base::interpolate(bed.x, bed.y, x) - surface_depth * d) continue;
    const int column = std::clamp(static_cast<int>(x / length * columns), 0, columns - 1);
    m.on_sand[column] += drag[3 * n] / (length / columns * d);
  }
  if (io::has_array(water.cells, "nut"))
    for (double x : m.x) m.in_water.push_back(stress_above(water, x, base::interpolate(bed.x, bed.y, x), run));
  return m;
}

void NearBed::update(const RunFolder& run) {
  if (!run.bed || run.grain_diameter <= 0) return;
  // A run that was resumed has written its last frames anew.
  std::erase_if(frames_, [&](const FrameMeasures& m) { return run.fields.empty() || m.time > run.fields.back().time; });
  for (const io::TimedFile& file : run.fields) {
    if (file.time <= 0 || (!frames_.empty() && file.time <= frames_.back().time)) continue;
    const auto grains = std::find_if(run.grains.begin(), run.grains.end(),
                                     [&](const io::TimedFile& other) { return other.time == file.time; });
    if (grains == run.grains.end()) continue;
    frames_.push_back(measure_frame(io::read_vtr(run.path / file.file), io::read_vtp(run.path / grains->file), run));
    frames_.back().time = file.time;
  }
}

NearBed::Shear NearBed::shear(const RunFolder& run) const {
  Shear mean;
  if (frames_.empty()) return mean;
  mean.from = 0.75 * frames_.back().time;
  mean.to = frames_.back().time;
  mean.x = frames_.back().x;
  for (const FrameMeasures& m : frames_) {
    if (m.time < mean.from) continue;
    ++mean.frames;
    add_to(mean.on_sand, m.on_sand);
    add_to(mean.in_water, m.in_water);
  }
  for (std::vector<double>* values : {&mean.on_sand, &mean.in_water})
    for (double& v : *values) v /= mean.frames;
  const double from = run.pipe ? 0.25 * run.pipe->x : 0, to = run.pipe ? run.pipe->x - 1.5 * run.pipe->diameter : 1e99;
  mean.upstream_on_sand = mean_between(mean.x, mean.on_sand, from, to);
  mean.upstream_in_water = mean_between(mean.x, mean.in_water, from, to);
  return mean;
}

FrameMeasures NearBed::mean_flux() const {
  FrameMeasures mean = frames_.back();
  mean.flux.clear();
  for (const FrameMeasures& m : frames_) add_to(mean.flux, m.flux);
  for (double& v : mean.flux) v /= static_cast<double>(frames_.size());
  return mean;
}

}  // namespace livebed::report
