#pragma once
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "base/math.hpp"
#include "io/table.hpp"
#include "io/vtk.hpp"

namespace livebed {

/// A run folder as `livebed run` leaves it, of a hole that grows as S = 0.6 D (1 - exp(-t/T)): made of formulas.
struct SyntheticRun {
  double D = 0.05, T = 0.88, level = 0.048, pipe_x = 0.2, length = 0.5, height = 0.2;
  double d = 0.002;
  double last_time = 7.1;
  bool finished = true, with_pipe = true;
  int snapshots = 29;
  int cells = 1;  ///< times 200 x 80 cells of water, in each direction

  double pipe_y() const { return level + D / 2; }
  double depth(double t) const { return 0.6 * D * (1 - std::exp(-t / T)); }
  double bed(double x, double t) const {
    const double S = depth(t), hole = (x - pipe_x - 0.2 * S) / (1.2 * D + S),
                 mound = (x - pipe_x - 3.2 * D) / (1.5 * D);
    double y = level;
    if (std::abs(hole) < 1) y -= 0.5 * S * (1 + std::cos(base::pi * hole));
    if (std::abs(mound) < 1) y += 0.2 * S * (1 + std::cos(base::pi * mound)) * std::exp(-t / (2 * T));
    return y;
  }

  void write(const io::Path& folder) const {
    io::make_folder(folder / "fields");
    io::make_folder(folder / "grains");
    io::write_atomically(folder / "case.resolved.toml",
                         "[case]\ntitle = \"A hole made of <formulas>\"\n\n[current]\ntheta = 0.33\n\n[bed]\nlevel = "
                         "0.048\n\n[grains]\ndiameter = " +
                             std::to_string(d) +
                             "\n\n"
                             "[derived]\ncurrent.mean_speed = 1.4\ntime.scale = " +
                             std::to_string(with_pipe ? T : 0.0) + "  # s\n");
    io::write_atomically(folder / "log.txt", "started\ngrains released\n");
    if (with_pipe) io::write_vtp(folder / "pipe.vtp", io::circle_line(pipe_x, pipe_y(), D));
    write_tables(folder);
    io::TimeSeries fields(folder / "flow.pvd"), grains(folder / "grains.pvd");
    for (int n = 0; n < snapshots; ++n) {
      const double t = snapshots > 1 ? last_time * n / (snapshots - 1) : 0;
      const std::string number = std::to_string(n);
      io::write_vtr(folder / ("fields/" + number + ".vtr"), water(t));
      io::write_vtp(folder / ("grains/" + number + ".vtp"), sand(t));
      fields.add(t, "fields/" + number + ".vtr");
      grains.add(t, "grains/" + number + ".vtp");
    }
    if (finished)
      io::write_atomically(
          folder / "summary.json",
          R"({"scour_depth_over_D": 0.5994, "depth_under_pipe_over_D": 0.589, "S_eq_over_D": 0.6, "T_s": 0.88,
                               "fit": {"S_eq_over_D": 0.6, "T_s": 0.88, "error_S_eq": 0.011, "error_T_s": 0.02, "rms": 0.01},
                               "theta_measured": 0.31, "wall_s": 421.5, "grain_steps_per_second": 5.1e7, "flow_ms_per_step": 11.25,
                               "walls": {"flow_s": 190, "grains_s": 200, "exchange_s": 25, "output_s": 6.5}, "cells": 16000,
                               "grains": 6240, "peak_memory_MB": 212, "case_hash": "0123456789abcdef", "seed": 1,
                               "commit": "cafe", "versions": {"livebed": "0.1.0"}})");
  }

private:
  void write_tables(const io::Path& folder) const {
    io::TableWriter series(folder / "series.csv", {"time_s",
                                                   "t_over_T",
                                                   "S_over_D",
                                                   "depth_under_pipe_over_D",
                                                   "hole_width_over_D",
                                                   "mound_height_over_D",
                                                   "mound_x_over_D",
                                                   "grain_flux_m2_s",
                                                   "drag_N_m",
                                                   "lift_N_m",
                                                   "theta_measured",
                                                   "mass_residual",
                                                   "fluid_momentum_x_N_s",
                                                   "grain_momentum_x_N_s",
                                                   "impulse_error_N_s",
                                                   "flow_step_s",
                                                   "courant",
                                                   "pressure_iterations",
                                                   "grain_mean_speed_m_s",
                                                   "grain_max_speed_m_s",
                                                   "contacts_per_grain",
                                                   "overlap_max_over_d"});
    for (int n = 0; n * 0.01 <= last_time; ++n) {
      const double t = 0.01 * n, S = depth(t) / D, wave = std::sin(9 * t);
      series.row(std::vector<double>{t,
                                     t / T,
                                     S,
                                     0.98 * S,
                                     2.4 + 2 * S,
                                     0.4 * S,
                                     3.2,
                                     1e-3 * (1 + 0.3 * wave),
                                     20 + wave,
                                     3 * wave,
                                     0.31 + 0.01 * wave,
                                     1e-7 * (1.1 + wave),
                                     50 + wave,
                                     2 - wave,
                                     1e-12 * wave,
                                     8e-4,
                                     0.8,
                                     4,
                                     0.01,
                                     0.6,
                                     3.4,
                                     0.004});
    }
    std::vector<std::string> columns{"time_s"};
    std::vector<double> x;
    for (int i = 0; i < 500; ++i) {
      x.push_back((i + 0.5) * length / 500);
      columns.push_back(fmt::format("y_at_{}_m", x.back()));
    }
    io::TableWriter lines(folder / "bed.csv", columns);
    for (int n = 0; n * 0.05 <= last_time; ++n) {
      std::vector<double> row{0.05 * n};
      for (double at : x) row.push_back(bed(at, 0.05 * n));
      lines.row(row);
    }
  }

  /// A current above the bed that goes round the pipe (potential flow) and a slow wake.
  io::Grid water(double t) const {
    io::Grid grid;
    grid.time = t;
    const int nx = 200 * cells, ny = 80 * cells;
    for (int i = 0; i <= nx; ++i) grid.x.push_back(length * i / nx);
    for (int j = 0; j <= ny; ++j) grid.y.push_back(height * j / ny);
    io::DataArray velocity{"velocity", 3, io::Store::float32, {}};
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const double x = (i + 0.5) * length / nx, y = (j + 0.5) * height / ny, above = std::max(0.0, y - bed(x, t));
        const double speed = 1.4 * std::min(1.0, std::log(1 + above / 0.0005) / 6), dx = x - pipe_x, dy = y - pipe_y();
        const double r2 = dx * dx + dy * dy, a2 = base::square(D / 2);
        double u = speed, v = 0;
        if (with_pipe && r2 > a2) {
          u = speed * (1 - a2 * (dx * dx - dy * dy) / (r2 * r2));
          v = -speed * 2 * a2 * dx * dy / (r2 * r2);
          if (dx > 0) u *= 1 - 0.8 * std::exp(-base::square(dy / (0.5 * D))) * std::exp(-dx / (4 * D));
        } else if (with_pipe) {
          u = 0;
        }
        velocity.values.insert(velocity.values.end(), {u, v, 0.0});
      }
    grid.cells.push_back(std::move(velocity));
    return grid;
  }

  io::Points sand(double t) const {
    const double row = d * std::sqrt(3.0) / 2;
    io::Points points;
    points.time = t;
    points.data = {{"diameter", 1, io::Store::float32, {}}, {"velocity", 3, io::Store::float32, {}}};
    for (int j = 0; j * row < 1.5 * level; ++j)
      for (int i = 0; i < length / d - 0.5; ++i) {
        const double x = (i + 0.25 + 0.5 * (j % 2)) * d, y = (j + 0.5) * row, below = bed(x, t) - y;
        if (below < 0) continue;
        points.x.push_back(x);
        points.y.push_back(y);
        points.data[0].values.push_back(d);
        points.data[1].values.insert(points.data[1].values.end(), {0.5 * std::exp(-below / d), 0.0, 0.0});
      }
    return points;
  }
};

}  // namespace livebed
