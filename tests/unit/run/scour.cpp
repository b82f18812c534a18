#include "run/scour.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

#include "base/fault.hpp"
#include "base/math.hpp"

namespace livebed::run {
namespace {

using base::pi;

constexpr double d = 0.002, D = 0.05, length = 0.5;
const double spacing = d * std::sqrt(3.0) / 2;  // of the rows of a hexagonal packing
const double level = 35 * spacing;              // the bed ends with a whole row
const PipeCircle pipe{0.2, level + D / 2, D};

struct Discs {
  std::vector<double> x, y, diameter;
  void add(double at_x, double at_y) {
    x.push_back(at_x);
    y.push_back(at_y);
    diameter.push_back(d);
  }
};

/// Hexagonal packing up to the given surface: a row counts as bed when half of its spacing fits below.
Discs bed_below(const std::function<double(double)>& surface) {
  Discs discs;
  for (int row = 0; row * spacing < 0.2; ++row)
    for (int k = 0; k < 250; ++k) {
      const double x = (k + 0.25 + 0.5 * (row % 2)) * d, y = (row + 0.5) * spacing;
      if (y < surface(x)) discs.add(x, y);
    }
  return discs;
}

/// A hole of cosine shape under the pipe, one D deep and 4 D wide, with a mound downstream.
double cosine_hole(double x) {
  const double in_hole = (x - pipe.x) / (2 * D), in_mound = (x - 0.4) / D;
  double y = level;
  if (std::abs(in_hole) < 1) y -= 0.8 * D * 0.5 * (1 + std::cos(pi * in_hole));
  if (std::abs(in_mound) < 1) y += 0.3 * D * 0.5 * (1 + std::cos(pi * in_mound));
  return y;
}

SolidFraction sampled(const Discs& discs, const PipeCircle& circle) {
  SolidFraction solid(sampling_grid(length, 0.2, d / 2), circle, d);
  solid.sample(discs.x, discs.y, discs.diameter);
  return solid;
}

std::vector<double> columns(const SamplingGrid& grid) {
  std::vector<double> x;
  for (int i = 0; i < grid.nx; ++i) x.push_back(grid.x(i));
  return x;
}

TEST(scour, the_fraction_keeps_the_area_of_the_grains_and_that_of_the_packing) {
  const Discs discs = bed_below([](double) { return level; });
  const SolidFraction solid = sampled(discs, {});
  double area = 0;
  const SamplingGrid& grid = solid.grid();
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) area += solid.values()(i, j) * grid.hx * grid.hy;
  EXPECT_NEAR(area, static_cast<double>(discs.x.size()) * pi / 4 * d * d, 1e-12);
  EXPECT_NEAR(solid.packed(3 * d, level / 2), pi / std::sqrt(12.0), 0.005);  // hexagonal
  EXPECT_NEAR(solid.packed(0, d), pi / std::sqrt(12.0), 0.03);               // folded back at the floor
}

TEST(scour, a_flat_bed_has_a_flat_line_at_its_surface) {
  const SolidFraction solid = sampled(bed_below([](double) { return level; }), {});
  const auto line = bed_line(solid, solid.packed(3 * d, level / 2));
  for (double y : line) EXPECT_NEAR(y, level, 0.1 * d);
}

TEST(scour, a_cosine_hole_is_found_to_a_fraction_of_a_grain) {
  const SolidFraction solid = sampled(bed_below(cosine_hole), pipe);
  const auto line = bed_line(solid, solid.packed(2 * d, level / 4));
  const auto x = columns(solid.grid());
  double worst = 0, mean = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    worst = std::max(worst, std::abs(line[i] - cosine_hole(x[i])));
    mean += (line[i] - cosine_hole(x[i])) / static_cast<double>(x.size());
  }
  EXPECT_LT(worst, 0.8 * d);  // steps of one row
  EXPECT_NEAR(mean, 0, 0.1 * d);

  const Hole hole = measure_hole(x, line, level, pipe);
  EXPECT_NEAR(hole.depth / D, 0.8, 0.02);
  EXPECT_NEAR(hole.depth_under_pipe / D, 0.8, 0.02);
  EXPECT_NEAR(hole.depth_x, pipe.x, 0.25 * D);  // the lowest row is wide
  EXPECT_NEAR(hole.width / D, 4, 0.35);         // the rim is tangent to the bed
  EXPECT_NEAR(hole.mound_height / D, 0.3, 0.02);
  EXPECT_NEAR(hole.mound_x, 0.4, 0.15 * D);
  EXPECT_NEAR(hole.eroded / (D * D), 0.8 * 2, 0.05);
  EXPECT_NEAR(hole.deposited / (D * D), 0.3, 0.05);
}

TEST(scour, the_measures_of_an_exact_line_are_exact) {
  std::vector<double> x, line;
  for (int i = 0; i < 1000; ++i) {
    x.push_back((i + 0.5) * 5e-4);
    line.push_back(cosine_hole(x.back()));
  }
  const Hole hole = measure_hole(x, line, level, pipe);
  EXPECT_NEAR(hole.depth, 0.8 * D, 1e-5);
  EXPECT_NEAR(hole.depth_x, pipe.x, 3e-4);
  EXPECT_NEAR(hole.depth_under_pipe, 0.8 * D, 1e-5);
  EXPECT_NEAR(hole.width, 4 * D, 1.1e-3);
  EXPECT_NEAR(hole.mound_height, 0.3 * D, 1e-5);
  EXPECT_NEAR(hole.mound_x, 0.4, 3e-4);
  EXPECT_NEAR(hole.eroded, 1.6 * D * D, 1e-7);
  EXPECT_NEAR(hole.deposited, 0.3 * D * D, 1e-7);
  EXPECT_NEAR(mean_level(x, std::vector<double>(1000, 0.07), pipe), 0.07, 1e-15);
}

TEST(scour, a_straight_sided_hole_has_its_interpolated_width_and_a_risen_bed_no_hole) {
  std::vector<double> x, vee, flat_up;
  for (int i = 0; i < 500; ++i) {
    x.push_back((i + 0.5) * 1e-3);
    vee.push_back(level + std::min(0.01, 0.5 * std::abs(x.back() - 0.2203) - 0.02));
    flat_up.push_back(level + 0.001);
  }
  EXPECT_NEAR(measure_hole(x, vee, level, pipe).width, 0.08, 1e-9);
  const Hole none = measure_hole(x, flat_up, level, pipe);
  EXPECT_EQ(none.width, 0);
  EXPECT_NEAR(none.depth, -0.001, 1e-12);
  EXPECT_EQ(none.eroded, 0);
}

TEST(scour, without_a_pipe_only_the_areas_are_measured) {
  const std::vector<double> x{0.5, 1.5, 2.5, 3.5}, line{0.9, 1.2, 1.0, 1.0};
  const Hole hole = measure_hole(x, line, 1, {});
  EXPECT_NEAR(hole.eroded, 0.1, 1e-14);
  EXPECT_NEAR(hole.deposited, 0.2, 1e-14);
  EXPECT_EQ(hole.depth, 0);
  EXPECT_EQ(hole.width, 0);
}

TEST(scour, the_deepest_point_is_looked_for_within_one_diameter_only) {
  std::vector<double> x, line;
  for (int i = 0; i < 500; ++i) {
    x.push_back((i + 0.5) * 1e-3);
    line.push_back(std::abs(x.back() - 0.35) < 0.02 ? 0.01 : std::abs(x.back() - 0.23) < 0.01 ? level - 0.01 : level);
  }
  const Hole hole = measure_hole(x, line, level, pipe);
  EXPECT_NEAR(hole.depth, 0.01, 1e-12);
  EXPECT_NEAR(hole.depth_x, 0.23, 0.011);
}

TEST(scour, grains_in_suspension_do_not_lift_the_line) {
  Discs discs = bed_below(cosine_hole);
  const SolidFraction calm = sampled(discs, pipe);
  const double packed = calm.packed(2 * d, level / 4);
  const auto before = bed_line(calm, packed);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(0, 1);
  for (int k = 0; k < 400; ++k) {  // a thin cloud over the whole bed
    const double x = length * anywhere(random), y = cosine_hole(x) + 0.012 + 0.05 * anywhere(random);
    if (std::hypot(x - pipe.x, y - pipe.y) > D / 2 + d) discs.add(x, y);
  }
  for (int row = 0; row < 6; ++row)  // and a clump as dense as the bed, well above it
    for (int k = 0; k < 12; ++k) discs.add(0.35 + k * d, 0.1 + row * d);
  const auto after = bed_line(sampled(discs, pipe), packed);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i], before[i], 0.25 * d) << i;
}

TEST(scour, a_pocket_of_water_in_the_bed_is_part_of_it_and_a_cave_is_not) {
  const Discs full = bed_below([](double) { return level; });
  const auto with_hollow = [&](double height) {
    Discs discs;
    for (std::size_t n = 0; n < full.x.size(); ++n)
      if (std::abs(full.x[n] - 0.35) > 2 * d || std::abs(full.y[n] - level / 2) > height / 2)
        discs.add(full.x[n], full.y[n]);
    return sampled(discs, {});
  };
  const double packed = sampled(full, {}).packed(2 * d, level / 4);
  const SolidFraction pocket = with_hollow(3 * d), cave = with_hollow(8 * d);
  const int middle = static_cast<int>(0.35 / pocket.grid().hx);
  const int at = static_cast<int>(level / 2 / pocket.grid().hy);
  ASSERT_LT(pocket.values()(middle, at), packed / 2);
  EXPECT_NEAR(bed_line(pocket, packed)[middle], level, 0.3 * d);
  EXPECT_NEAR(bed_line(cave, packed)[middle], level / 2 - 4 * d, d);
}

TEST(scour, the_pipe_is_neither_bed_nor_water) {
  // A pipe on the bed: the line passes below it at the level of the bed.
  const Discs flat = bed_below([](double) { return level; });
  const SolidFraction resting = sampled(flat, {pipe.x, level + D / 2, D});
  const auto x = columns(resting.grid());
  const auto line = bed_line(resting, resting.packed(3 * d, level / 2));
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(line[i], level, d) << x[i];  // sand fills the wedge beside the contact by less than a grain

  // A pipe sunk by half of its diameter: the bed ends at its underside.
  const PipeCircle sunk{0.2, level, D};
  Discs around;
  for (std::size_t n = 0; n < flat.x.size(); ++n)
    if (std::hypot(flat.x[n] - sunk.x, flat.y[n] - sunk.y) > (D + d) / 2) around.add(flat.x[n], flat.y[n]);
  const SolidFraction half = sampled(around, sunk);
  const auto under = bed_line(half, half.packed(2 * d, level / 4));
  EXPECT_NEAR(under[200], level - D / 2, 0.1 * d);
  EXPECT_NEAR(under[170], level, 0.3 * d);

  // A buried pipe: the bed goes on above it.
  const PipeCircle buried{0.2, 0.035, 0.03};
  Discs over;
  for (std::size_t n = 0; n < flat.x.size(); ++n)
    if (std::hypot(flat.x[n] - buried.x, flat.y[n] - buried.y) > (buried.diameter + d) / 2)
      over.add(flat.x[n], flat.y[n]);
  const SolidFraction whole = sampled(over, buried);
  for (double y : bed_line(whole, whole.packed(0, d))) EXPECT_NEAR(y, level, 0.3 * d);
}

TEST(scour, the_bed_line_is_periodic_and_an_empty_floor_is_the_bed) {
  Discs discs = bed_below([](double) { return level; });
  const auto line = bed_line(sampled(discs, {}), 0.9);
  for (double& x : discs.x) x += 3 * length;  // any period
  const auto shifted = bed_line(sampled(discs, {}), 0.9);
  for (std::size_t i = 0; i < line.size(); ++i) EXPECT_NEAR(shifted[i], line[i], 1e-9);
  for (double y : bed_line(sampled({}, {}), 0.9)) EXPECT_EQ(y, 0);
}

TEST(scour, bad_sampling_is_refused) {
  EXPECT_THROW(sampling_grid(0, 1, 0.1), base::Fault);
  EXPECT_THROW(SolidFraction(sampling_grid(1, 1, 0.1), {}, 0.02), base::Fault);
  EXPECT_THROW(SolidFraction(sampling_grid(1, 1, 0.001), {}, 0.2), base::Fault);
  EXPECT_THROW(sampled({}, {}).packed(0.19999, 0.2), base::Fault);
}

}  // namespace
}  // namespace livebed::run
