#include "grains/packing.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "grains/measures.hpp"
#include "grains/sizes.hpp"

using namespace livebed;
using namespace livebed::grains;

namespace {

Params bed_of(int count, double length_over_d) {
  Params p;
  p.stiffness = 5500;
  p.restitution = 0.3;
  p.steps_per_contact = 30;
  p.floor = Floor::grains;
  p.start = Placing::scattered;
  p.count = count;
  p.length = length_over_d * p.diameter;
  return p;
}

struct Surface {
  double mean = 0, rms = 0;  ///< of the upper edges of the highest grains, along the bed [m]
};
Surface surface(const Bed& bed) {
  const Params& p = bed.params;
  const int places = 200;
  Surface result;
  double squares = 0;
  for (int k = 0; k < places; ++k) {
    const double top = highest_grain(bed.state, p.length, (k + 0.5) * p.length / places, 0.5 * p.diameter);
    result.mean += top / places;
    squares += top * top / places;
  }
  result.rms = std::sqrt(squares - result.mean * result.mean);
  return result;
}

}  // namespace

TEST(packing, scattered_grains_lie_densely_in_no_order_and_hardly_overlap) {
  const Bed bed = scattered(bed_of(900, 30)), again = scattered(bed_of(900, 30));
  EXPECT_TRUE(bed.state.x == again.state.x && bed.state.y == again.state.y);
  Params other = bed_of(900, 30);
  other.seed = 2;
  EXPECT_FALSE(bed.state.x == scattered(other).state.x);
  Bed moved = bed;
  moved.params.gravity = 0;
  advance(moved, 1);
  EXPECT_LT(measure_contacts(moved).largest_overlap, 0.02);
  EXPECT_NEAR(solid_thickness(bed.params, bed.state) / bed_height(bed.state), bed.params.packing_fraction, 0.02);
  // No order: the six-fold order of the directions to neighbours cancels over the bed.  It is 1 in a crystal.
  double cosine = 0, sine = 0;
  int pairs = 0;
  for (int i = 0; i < moved.state.count(); ++i) {
    for (const int j : neighbours_of(moved.state, moved.contacts, i)) {
      const double angle = 6 * std::atan2(moved.state.y[j] - moved.state.y[i],
                                          nearest_image(moved.state.x[j] - moved.state.x[i], moved.params.length));
      cosine += std::cos(angle), sine += std::sin(angle), ++pairs;
    }
  }
  EXPECT_LT(std::hypot(cosine, sine) / pairs, 0.15);
}

TEST(packing, of_scattered_grains_fills_what_was_asked_for_and_rests) {
  const Packing packing = pack(bed_of(900, 30));
  const Bed& bed = packing.bed;
  EXPECT_LT(mean_speed(bed.state), 1e-5);
  const double height = bed_height(bed.state);
  const Fractions filled = packing_fractions(bed.params, bed.state, 0.25 * height, 0.75 * height);
  EXPECT_NEAR(filled.area, bed.params.packing_fraction, 0.015);
  EXPECT_NEAR(filled.volume, 2.0 / 3.0 * filled.area, 0.01);  // spheres in a slab one diameter thick
  const double contacts = measure_contacts(bed).per_grain;
  EXPECT_GT(contacts, 3.0);
  EXPECT_LT(contacts, 3.6);
}

TEST(packing, fractions_cut_circles_and_spheres_exactly) {
  Params p = bed_of(1, 10);
  p.spread = 0;
  Bed bed = make_bed(derive(p));
  const double d = p.diameter, plane = p.length * d;
  bed.state.y[0] = 3 * d;
  const Fractions all = packing_fractions(p, bed.state, 2.5 * d, 3.5 * d);
  EXPECT_NEAR(all.area, base::sphere_area(d) / plane, 1e-12);
  EXPECT_NEAR(all.volume, base::sphere_volume(d) / (plane * d), 1e-12);
  const Fractions half = packing_fractions(p, bed.state, 3 * d, 4 * d);
  EXPECT_NEAR(half.area, all.area / 2, 1e-12);
  EXPECT_NEAR(half.volume, all.volume / 2, 1e-12);
  // A cap half a radius high: r^2 (pi/3 - sqrt(3)/4) of the circle, 5/32 of the sphere.
  const Fractions cap = packing_fractions(p, bed.state, 3.25 * d, 4.25 * d);
  EXPECT_NEAR(cap.area, 0.25 * d * d * (base::pi / 3 - std::sqrt(3.0) / 4) / plane, 1e-12);
  EXPECT_NEAR(cap.volume, 5.0 / 32.0 * all.volume, 1e-12);
  EXPECT_EQ(packing_fractions(p, bed.state, 4 * d, 5 * d).area, 0);
}

TEST(packing, is_cut_flat_at_the_thickness_asked_for) {
  for (const bool graded : {false, true}) {
    Params p = bed_of(0, 40);
    p.thickness = 12 * p.diameter;
    if (graded) p.grading = {{0.7 * p.diameter, 0.1}, {p.diameter, 0.5}, {1.4 * p.diameter, 0.9}};
    const Packing packing = pack(p);
    const Bed& bed = packing.bed;
    check_count(bed);
    EXPECT_LT(mean_speed(bed.state), 1e-5);
    EXPECT_NEAR(bed_height(bed.state), p.thickness, 0.5 * p.diameter);
    const Surface top = surface(bed);
    EXPECT_NEAR(top.mean, p.thickness, 0.5 * p.diameter);
    EXPECT_LT(top.rms, 0.5 * p.diameter);
    EXPECT_GT(top.rms, 0.02 * p.diameter);
    for (std::size_t k = 1; k < packing.convergence.size(); ++k) {
      EXPECT_GT(packing.convergence[k].time, packing.convergence[k - 1].time);
    }
  }
}

TEST(packing, that_is_too_low_gets_more_grains_before_it_is_cut) {
  Bed bed = pack(bed_of(300, 30)).bed;
  const int before = bed.params.count;
  const double wanted = bed_height(bed.state) + 2 * bed.params.diameter;
  level(bed, wanted);
  check_count(bed);
  EXPECT_GT(bed.params.count, before + 40);
  EXPECT_LT(bed.params.count, before + 90);
  EXPECT_NEAR(bed_height(bed.state), wanted, 0.5 * bed.params.diameter);
}
