#include "run/scour.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/curves.hpp"
#include "base/fault.hpp"
#include "base/math.hpp"

namespace livebed::run {

using base::Exit;
using base::fail;
using base::interpolate;
using base::pi;
using base::square;

namespace {

bool inside(const PipeCircle& pipe, double diameter, double x, double y) {
  return 4 * (square(x - pipe.x) + square(y - pipe.y)) < square(diameter);
}

constexpr double reach_over_diameter = 2.5;

/// Least part of a cell's surroundings that must be open for its fraction to mean something.
constexpr double open_floor = 0.05;
/// Room for the kernel's weights in one direction.
constexpr int most_weights = 64;

}  // namespace

SamplingGrid sampling_grid(double length, double height, double cell) {
  if (!(length > 0 && height > 0 && cell > 0))
    fail(Exit::internal, "sampling grid of {} m x {} m with cells of {} m: all must be > 0", length, height, cell);
  SamplingGrid grid;
  grid.nx = static_cast<int>(std::ceil(length / cell * (1 - 1e-12)));
  grid.ny = static_cast<int>(std::ceil(height / cell * (1 - 1e-12)));
  grid.hx = length / grid.nx;
  grid.hy = height / grid.ny;
  return grid;
}

SolidFraction::SolidFraction(const SamplingGrid& grid, const PipeCircle& pipe, double diameter)
    : grid_(grid),
      pipe_(pipe),
      diameter_(diameter),
      reach_(reach_over_diameter * diameter),
      fraction_(grid.nx, grid.ny, 0),
      open_(grid.nx, grid.ny, 0, 1.0) {
  if (reach_ < std::max(grid.hx, grid.hy))
    fail(Exit::internal, "smoothing over {} m on sampling cells of {} m x {} m: refine them", reach_, grid.hx, grid.hy);
  if (2 * reach_ / std::min(grid.hx, grid.hy) + 1 > most_weights)
    fail(Exit::internal, "smoothing over {} m needs more than {} sampling cells of {} m x {} m: coarsen them", reach_,
         most_weights, grid.hx, grid.hy);
  if (pipe.diameter <= 0) return;
  base::Field blocked(grid.nx, grid.ny, 0);
  constexpr int parts = 4;  // sub-cells per direction that tell how much of a cell the pipe covers
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      int covered = 0;
      for (int b = 0; b < parts; ++b)
        for (int a = 0; a < parts; ++a)
          covered += inside(pipe, pipe.diameter, (i + (a + 0.5) / parts) * grid.hx, (j + (b + 0.5) / parts) * grid.hy);
      const double part = static_cast<double>(covered) / (parts * parts);
      if (covered > 0) spread(grid.x(i), grid.y(j), part * grid.hx * grid.hy, blocked);
    }
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) open_(i, j) = 1 - blocked(i, j);
}

void SolidFraction::spread(double x, double y, double area, base::Field& onto) const {
  // Weights per direction; the product kernel is the same for every grain up to its place between the cells.
  const auto weigh = [&](double at, double h, double* weight, int& first) {
    first = static_cast<int>(std::ceil((at - reach_) / h - 0.5));
    const int last = std::min(static_cast<int>(std::floor((at + reach_) / h - 0.5)), first + most_weights - 1);
    // The cosines of equal steps, each from the one before.
    const double step = pi * h / reach_, begin = pi * ((first + 0.5) * h - at) / reach_;
    const double turn_cos = std::cos(step), turn_sin = std::sin(step);
    double c = std::cos(begin), s = std::sin(begin), sum = 0;
    for (int i = first; i <= last; ++i) {
      sum += weight[i - first] = 1 + c;
      const double next = c * turn_cos - s * turn_sin;
      s = s * turn_cos + c * turn_sin, c = next;
    }
    for (int i = first; i <= last; ++i) weight[i - first] /= sum;
    return last - first + 1;
  };
  double wx[most_weights], wy[most_weights];
  int i0 = 0, j0 = 0;
  const int ni = weigh(x, grid_.hx, wx, i0), nj = weigh(y, grid_.hy, wy, j0);
  const double density = area / (grid_.hx * grid_.hy);
  i0 = ((i0 % grid_.nx) + grid_.nx) % grid_.nx;
  for (int b = 0; b < nj; ++b) {
    const int j = j0 + b < 0 ? -1 - (j0 + b) : j0 + b;  // folded back at the floor
    if (j >= grid_.ny) continue;                        // above the sampled height
    double* row = onto.row(j);
    const double part = density * wy[b];
    for (int a = 0, i = i0; a < ni; ++a) {
      row[i] += part * wx[a];
      if (++i == grid_.nx) i = 0;
    }
  }
}

void SolidFraction::sample(std::span<const double> x, std::span<const double> y, std::span<const double> diameter) {
  fraction_.fill(0);
  for (std::size_t n = 0; n < x.size(); ++n) spread(x[n], y[n], pi / 4 * square(diameter[n]), fraction_);
  if (pipe_.diameter <= 0) return;
  for (int j = 0; j < grid_.ny; ++j)
    for (int i = 0; i < grid_.nx; ++i) fraction_(i, j) /= std::max(open_(i, j), open_floor);
}

bool SolidFraction::barred(double x, double y) const {
  return pipe_.diameter > 0 && inside(pipe_, pipe_.diameter + diameter_, x, y);
}

double SolidFraction::packed(double y_from, double y_to) const {
  std::vector<double> sample;
  for (int j = 0; j < grid_.ny; ++j) {
    if (grid_.y(j) < y_from || grid_.y(j) >= y_to) continue;
    for (int i = 0; i < grid_.nx; ++i)
      if (!barred(grid_.x(i), grid_.y(j))) sample.push_back(fraction_(i, j));
  }
  if (sample.empty()) fail(Exit::internal, "no sampling cell between y = {} m and {} m", y_from, y_to);
  std::nth_element(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2), sample.end());
  return sample[sample.size() / 2];
}

std::vector<double> bed_line(const SolidFraction& solid, double packed) {
  const SamplingGrid& grid = solid.grid();
  const PipeCircle& pipe = solid.pipe();
  const double half = packed / 2;
  const int pocket = static_cast<int>(solid.reach() / grid.hy);  // cells, highest
  const auto goes_on_above = [&](int i, int j) {
    for (int above = j + 1; above <= std::min(grid.ny - 1, j + pocket); ++above) {
      if (solid.barred(grid.x(i), grid.y(above))) return false;
      if (solid.values()(i, above) >= half) return true;
    }
    return false;
  };
  std::vector<double> line(static_cast<std::size_t>(grid.nx));
  for (int i = 0; i < grid.nx; ++i) {
    double level = 0;  // the floor, unless sand lies on it
    int below = -1;    // the highest cell so far that is bed
    bool through_pipe = false;
    for (int j = 0; j < grid.ny; ++j) {
      if (solid.barred(grid.x(i), grid.y(j))) {
        through_pipe = true;
        continue;
      }
      const double here = solid.values()(i, j);
      if (here >= half) {
        below = j;
        level = grid.y(j);
        through_pipe = false;
        continue;
      }
      if (below >= 0 && !through_pipe && goes_on_above(i, j)) continue;
      if (below >= 0 && through_pipe) {
        // Beside the pipe's flank, where no grain fits either, the underside is taken at its outermost point.
        level = pipe.y - std::sqrt(std::max(0.0, square(pipe.diameter / 2) - square(grid.x(i) - pipe.x)));
      } else if (below >= 0) {
        const double under = solid.values()(i, below);
        level = grid.y(below) + grid.hy * (under - half) / (under - here);
      }
      break;
    }
    line[static_cast<std::size_t>(i)] = level;
  }
  return line;
}

double mean_level(std::span<const double> x, std::span<const double> line, const PipeCircle& pipe) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (2 * std::abs(x[i] - pipe.x) < pipe.diameter) continue;
    sum += line[i];
    ++count;
  }
  if (count == 0) fail(Exit::internal, "the pipe spans all {} columns of the bed line", x.size());
  return sum / count;
}

Hole measure_hole(std::span<const double> x, std::span<const double> line, double original, const PipeCircle& pipe) {
  const std::size_t n = x.size();
  if (n < 2) fail(Exit::internal, "a bed line of {} points cannot be measured", n);
  const double h = x[1] - x[0];
  Hole hole;
  hole.depth_under_pipe = original - interpolate(x, line, pipe.x);
  std::size_t deepest = n;
  for (std::size_t i = 0; i < n; ++i) {
    const double fall = original - line[i];
    hole.eroded += h * std::max(0.0, fall);
    hole.deposited += h * std::max(0.0, -fall);
    if (std::abs(x[i] - pipe.x) <= pipe.diameter && (deepest == n || line[i] < line[deepest])) deepest = i;
    if (x[i] >= pipe.x && -fall > hole.mound_height) {
      hole.mound_height = -fall;
      hole.mound_x = x[i];
    }
  }
  if (pipe.diameter <= 0) return {.eroded = hole.eroded, .deposited = hole.deposited};
  if (hole.mound_height == 0) hole.mound_x = pipe.x;
  if (deepest == n)
    fail(Exit::internal, "no point of the bed line within D = {} m of the pipe at {} m", pipe.diameter, pipe.x);
  hole.depth = original - line[deepest];
  hole.depth_x = x[deepest];
  if (hole.depth <= 0) return hole;
  std::size_t left = deepest, right = deepest;
  while (left > 0 && line[left - 1] < original) --left;
  while (right + 1 < n && line[right + 1] < original) ++right;
  // From the outermost points below the level on to where the line crosses it.
  const double from = left == 0 ? x[0] : x[left] - h * (original - line[left]) / (line[left - 1] - line[left]);
  const double to =
      right + 1 == n ? x[right] : x[right] + h * (original - line[right]) / (line[right + 1] - line[right]);
  hole.width = to - from;
  return hole;
}

}  // namespace livebed::run
