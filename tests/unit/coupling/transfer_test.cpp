#include "coupling/transfer.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

#include "base/loops.hpp"
#include "base/math.hpp"

namespace livebed::coupling {
namespace {

constexpr double length = 0.12, height = 0.08, diameter = 2e-3, half_width = 2 * diameter;

/// A box with a pipe that no cell edge touches, in cells of a size (their numbers must be even).
flow::Mesh box(double cell) {
  flow::MeshParams grid;
  grid.length = length, grid.height = height, grid.cell_x = grid.cell_y = cell;
  flow::PipeParams pipe;
  pipe.diameter = 0.0213, pipe.x = 0.0507, pipe.y = 0.0231;
  return flow::make_mesh(grid, pipe);
}

/// The same box and pipe in cells that grow away from the pipe, in numbers as they come.
flow::Mesh stretched_box() {
  flow::MeshParams grid;
  grid.length = length, grid.height = height, grid.cell_x = grid.cell_y = 1e-3, grid.growth = 1.3;
  grid.fine_x_from = 0.04, grid.fine_x_to = 0.06, grid.fine_y_from = 0.012, grid.fine_y_to = 0.034;
  return flow::make_mesh(grid, box(2e-3).pipe);
}

/// Places of grains: everywhere in the box but the pipe, many of them against pipe, floor, lid and ends.
grains::State sand(int count) {
  const flow::PipeParams pipe = box(2e-3).pipe;
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> unit(0, 1);
  grains::State g;
  const auto add = [&](double x, double y) {
    if (std::hypot(x - pipe.x, y - pipe.y) < 0.5 * pipe.diameter) return;
    g.x.push_back(x), g.y.push_back(y), g.diameter.push_back(diameter);
  };
  for (int k = 0; k < count; ++k) add(length * unit(generator), height * unit(generator));
  for (int k = 0; k < count / 4; ++k) {
    const double angle = 2 * base::pi * unit(generator), r = 0.5 * (pipe.diameter + diameter);
    add(pipe.x + r * std::cos(angle), pipe.y + r * std::sin(angle));
    add(length * unit(generator), 0.5 * diameter);
    add(length * unit(generator), height - 1e-9);
  }
  for (double x : {0.0, 1e-12, length - 1e-12})
    for (double y : {1e-12, 0.5 * diameter, height}) add(x, y);
  return g;
}

std::vector<int> all_of(const grains::State& g) {
  std::vector<int> all(g.x.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// The three kinds of transfer on one mesh.
struct Kind {
  const char* name;
  flow::Staggering at;
  base::Field aperture;
  Transfer transfer;
};

std::vector<Kind> kinds(const flow::Mesh& m) {
  using flow::Staggering;
  const auto make = [&](const char* name, const Staggering& at, const base::Field& aperture, int first) {
    return Kind{name, at, aperture, Transfer(at, aperture, first, m.nx - 1, half_width)};
  };
  return {make("u", Staggering::west_faces(m), m.aperture_x, 1), make("v", Staggering::south_faces(m), m.aperture_y, 0),
          make("cells", Staggering::centres(m), m.volume, 0)};
}

grains::Array random_values(std::size_t n) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> value(-1, 2);
  grains::Array values(n);
  for (double& v : values) v = value(generator);
  return values;
}

double sum(const grains::Array& values) {
  double total = 0;
  for (double v : values) total += v;
  return total;
}

/// Everything in the storage: what landed in ghosts would count, too.
double sum(const base::Field& field) {
  double total = 0;
  for (double v : field.storage()) total += v;
  return total;
}

TEST(transfer, scatters_every_grain_whole) {
  const grains::State g = sand(400);
  const grains::Array values = random_values(g.x.size());
  for (const flow::Mesh& mesh : {box(2e-3), stretched_box()})
    for (Kind& kind : kinds(mesh)) {
      base::Field field(mesh.nx, mesh.ny);
      kind.transfer.locate(g.x, g.y, all_of(g));
      kind.transfer.scatter(std::array{&field}, [&](int n) { return std::array{values[n]}; });
      EXPECT_NEAR(sum(field), sum(values), 1e-12 * sum(values)) << kind.name;
    }
}

TEST(transfer, gives_each_single_grain_weights_that_sum_to_one_and_are_not_negative) {
  const flow::Mesh mesh = box(2e-3);
  const grains::State g = sand(100);
  for (Kind& kind : kinds(mesh)) {
    kind.transfer.locate(g.x, g.y, all_of(g));
    for (int n = 0; n < g.count(); ++n) {
      base::Field field(mesh.nx, mesh.ny);
      kind.transfer.scatter(std::array{&field}, [&](int k) { return std::array{k == n ? 1.0 : 0.0}; });
      EXPECT_NEAR(sum(field), 1.0, 1e-14) << kind.name << ", grain at " << g.x[n] << ", " << g.y[n];
      for (double weight : field.storage()) ASSERT_GE(weight, 0.0) << kind.name;
    }
  }
}

TEST(transfer, puts_nothing_where_the_pipe_leaves_no_water) {
  const flow::Mesh mesh = box(2e-3);
  const grains::State g = sand(2000);
  for (Kind& kind : kinds(mesh)) {
    base::Field field(mesh.nx, mesh.ny);
    kind.transfer.locate(g.x, g.y, all_of(g));
    kind.transfer.scatter(std::array{&field}, [](int) { return std::array{1.0}; });
    int closed = 0, behind = 0;
    for (int j = kind.at.j0; j < kind.at.j1; ++j)
      for (int i = kind.at.i0; i < kind.at.i1; ++i) {
        if (kind.aperture(i, j) > 0) continue;
        ++closed;
        if (kind.at.volume(i, j) > 0) ++behind;
        EXPECT_EQ(field(i, j), 0.0) << kind.name << ' ' << i << ' ' << j;
      }
    EXPECT_GT(closed, 40) << kind.name;
    if (kind.at.shift_x + kind.at.shift_y > 0) {
      EXPECT_GT(behind, 4) << "no closed face with water beside it: nothing tested";
    }
  }
}

TEST(transfer, gathers_a_constant_as_that_constant) {
  const flow::Mesh mesh = box(2e-3);
  const grains::State g = sand(400);
  for (Kind& kind : kinds(mesh)) {
    const base::Field field(mesh.nx, mesh.ny, 2, 0.37);
    grains::Array values(g.x.size());
    kind.transfer.locate(g.x, g.y, all_of(g));
    kind.transfer.gather(field, values);
    for (double v : values) EXPECT_NEAR(v, 0.37, 1e-15);
  }
}

TEST(transfer, gathers_what_it_would_scatter) {
  const flow::Mesh mesh = box(2e-3);
  const grains::State g = sand(400);
  const grains::Array values = random_values(g.x.size());
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (Kind& kind : kinds(mesh)) {
    base::Field field(mesh.nx, mesh.ny), spread(mesh.nx, mesh.ny);
    for (double& v : field.storage()) v = any(generator);
    grains::Array gathered(g.x.size());
    kind.transfer.locate(g.x, g.y, all_of(g));
    kind.transfer.gather(field, gathered);
    kind.transfer.scatter(std::array{&spread}, [&](int n) { return std::array{values[n]}; });
    double at_grains = 0, in_cells = 0, size = 0;
    for (int n = 0; n < g.count(); ++n) at_grains += values[n] * gathered[n], size += std::abs(values[n] * gathered[n]);
    for (std::size_t k = 0; k < field.storage().size(); ++k) in_cells += field.storage()[k] * spread.storage()[k];
    EXPECT_NEAR(at_grains, in_cells, 1e-13 * size) << kind.name;
    EXPECT_GT(size, 1.0);
  }
}

/// Integral of 15/16 (1 - s^2)^2 over [a, b] within [-1, 1].
double kernel_between(double a, double b) {
  const auto primitive = [](double s) { return 15.0 / 16.0 * (s - 2 * s * s * s / 3 + std::pow(s, 5) / 5); };
  return primitive(std::min(1.0, b)) - primitive(std::max(-1.0, a));
}

TEST(transfer, does_not_depend_on_the_size_of_the_cells) {
  grains::State g;
  g.x = {0.0911}, g.y = {0.0334}, g.diameter = {diameter};  // away from pipe and walls
  const double west = 0.088, east = 0.092, south = 0.032, north = 0.036;
  const double expected = kernel_between((west - g.x[0]) / half_width, (east - g.x[0]) / half_width) *
                          kernel_between((south - g.y[0]) / half_width, (north - g.y[0]) / half_width);
  EXPECT_GT(expected, 0.3);
  EXPECT_LT(expected, 0.9);
  for (double cell : {4e-3, 2e-3, 1e-3, 0.5e-3}) {
    const flow::Mesh mesh = box(cell);
    base::Field field(mesh.nx, mesh.ny);
    Transfer transfer(flow::Staggering::centres(mesh), mesh.volume, 0, mesh.nx - 1, half_width);
    transfer.locate(g.x, g.y, all_of(g));
    transfer.scatter(std::array{&field}, [](int) { return std::array{1.0}; });
    double inside = 0;
    for (int j = 0; j < mesh.ny; ++j)
      for (int i = 0; i < mesh.nx; ++i)
        if (mesh.centre_x(i) > west && mesh.centre_x(i) < east && mesh.centre_y(j) > south && mesh.centre_y(j) < north)
          inside += field(i, j);
    EXPECT_NEAR(inside, expected, 1e-12) << "cells of " << cell << " m";
  }
}

TEST(transfer, finds_a_volume_for_a_grain_in_the_corner_of_coarse_cells) {
  // Half a cell at the ends is wider than the kernel here; u and v begin only behind it.
  flow::MeshParams grid;
  grid.length = 0.4, grid.height = 0.2, grid.cell_x = grid.cell_y = 2e-3, grid.growth = 1.2;
  grid.fine_x_from = 0.15, grid.fine_x_to = 0.25, grid.fine_y_from = 0.08, grid.fine_y_to = 0.12;
  const flow::Mesh mesh = flow::make_mesh(grid, {.present = false});
  ASSERT_GT(0.5 * mesh.dx(0), 1.1 * half_width);
  grains::State g;
  g.x = {0.0, 1e-4, 0.4 - 1e-9}, g.y = {1e-4, 1e-4, 1e-4}, g.diameter = {diameter, diameter, diameter};
  for (Kind& kind : kinds(mesh)) {
    base::Field field(mesh.nx, mesh.ny);
    kind.transfer.locate(g.x, g.y, all_of(g));
    kind.transfer.scatter(std::array{&field}, [](int) { return std::array{1.0}; });
    EXPECT_NEAR(sum(field), 3.0, 1e-14) << kind.name;
  }
}

TEST(transfer, finds_water_for_a_grain_at_the_pipe_in_cells_larger_than_itself) {
  // Small grains touch the pipe all around, in flat cells: the kernel of some lies in closed volumes alone.
  flow::MeshParams grid;
  grid.length = length, grid.height = height, grid.cell_x = 5e-3, grid.cell_y = 1e-3;
  const flow::Mesh m = flow::make_mesh(grid, box(2e-3).pipe);
  const double d = 5e-4;
  grains::State g;
  for (int k = 0; k < 720; ++k) {
    const double angle = base::pi * k / 360, r = 0.5 * (m.pipe.diameter + d);
    g.x.push_back(m.pipe.x + r * std::cos(angle)), g.y.push_back(m.pipe.y + r * std::sin(angle));
  }
  Transfer transfer(flow::Staggering::west_faces(m), m.aperture_x, 1, m.nx - 1, 0.6 * d);
  transfer.locate(g.x, g.y, all_of(g));
  base::Field one(m.nx, m.ny, 2, 1.0);
  grains::Array mean(g.x.size());
  transfer.gather(one, mean);
  for (std::size_t k = 0; k < mean.size(); ++k) ASSERT_NEAR(mean[k], 1.0, 1e-12) << k;
}

TEST(transfer, gives_the_same_bits_on_any_number_of_threads) {
  const grains::State g = sand(3000);
  const grains::Array values = random_values(g.x.size());
  for (const flow::Mesh& mesh : {box(1e-3), stretched_box()})
    for (Kind& kind : kinds(mesh)) {
      base::Field first;
      grains::Array gathered_first;
      for (int threads : {1, 2, 3}) {
        base::set_threads(threads);
        base::Field field(mesh.nx, mesh.ny);
        grains::Array gathered(g.x.size());
        kind.transfer.locate(g.x, g.y, all_of(g));
        kind.transfer.scatter(std::array{&field}, [&](int n) { return std::array{values[n]}; });
        kind.transfer.gather(field, gathered);
        if (threads == 1) first = field, gathered_first = gathered;
        EXPECT_TRUE(field.storage() == first.storage()) << kind.name << " on " << threads << " threads";
        EXPECT_TRUE(gathered == gathered_first) << kind.name << " on " << threads << " threads";
      }
      base::set_threads(1);
    }
}

}  // namespace
}  // namespace livebed::coupling
