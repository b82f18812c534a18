#include <cmath>
#include <gtest/gtest.h>

#include "bodies.hpp"
#include "grains/measures.hpp"
#include "oscillator.hpp"

/// Balls dropped on a plane: cases DEM01 and DEM02 of MFIX (Garg et al. 2012, Powder Technology 220, 122), a ball of
/// 0.2 m and 2600 kg/m3 let go with its centre at 0.5 m.
using namespace livebed;
using namespace livebed::grains;
using namespace livebed::grains::bodies;

namespace {

constexpr double radius = 0.1, drop = 0.5;

Params ball(double stiffness, double restitution, double steps) {
  Params p = above_plane(dry(2 * radius, 2600, 1), stiffness, restitution, 0, Tension::spring);
  p.steps_per_contact = steps;
  return p;
}

Oscillator on_plane(const Params& p, double stiffness, double restitution) {
  return {mass(p, p.diameter), stiffness, damping_ratio(restitution), p.gravity};
}

/// Free fall, contact, rebound.
struct Fall {
  double y, v;
};
Fall three_stages(const Oscillator& contact, double t) {
  const double g = contact.gravity, fall = std::sqrt(2 * (drop - radius) / g), v = g * fall;
  if (t < fall) return {drop - 0.5 * g * t * t, -g * t};
  t -= fall;
  const double time = contact.contact_time(v);
  if (t < time) return {radius - contact.overlap(t, v), -contact.rate(t, v)};
  t -= time;
  const double up = contact.rebound(v);
  return {radius + up * t - 0.5 * g * t * t, up - g * t};
}

/// Heights of the centre over the plane at the top of each rebound [m].
std::vector<double> simulated_tops(const Params& p, int bounces) {
  Bed bed = bed_of(p, {{1, drop}});
  std::vector<double> tops;
  double before = drop, top = 0;
  bool rising = false;
  while (static_cast<int>(tops.size()) < bounces) {
    advance(bed, 10);
    const double y = body(bed, 0).y;
    if (y > before) rising = true, top = y;
    if (y < before && rising) rising = false, tops.push_back(top);
    before = y;
  }
  return tops;
}

}  // namespace

TEST(bouncing, ball_passes_the_three_stages_of_mfix_dem01) {
  double worst_y = 0, worst_v = 0;
  for (const double stiffness : {1e4, 2.5e4, 5e4, 1e5}) {
    for (const double e : {0.6, 0.7, 0.8, 0.9, 1.0}) {
      Bed bed = bed_of(ball(stiffness, e, 4000), {{1, drop}});
      const Oscillator contact = on_plane(bed.params, stiffness, e);
      for (int look = 0; look < 60; ++look) {
        const double t_next = 0.01 * (look + 1);
        advance(bed, static_cast<int>(std::lround(t_next / bed.params.step) - bed.steps));
        // The velocity belongs to the middle of the last step.
        const double t = static_cast<double>(bed.steps) * bed.params.step;
        worst_y = std::max(worst_y, std::abs(body(bed, 0).y - three_stages(contact, t).y));
        worst_v = std::max(worst_v, std::abs(body(bed, 0).v - three_stages(contact, t - 0.5 * bed.params.step).v));
      }
    }
  }
  std::printf("largest difference: %.2g m, %.2g m/s\n", worst_y, worst_v);
  EXPECT_LT(worst_y, 3e-4);  // of a fall of 0.4 m
  EXPECT_LT(worst_v, 3e-3);  // of 2.8 m/s
}

TEST(bouncing, ball_follows_the_table_of_mfix_dem01) {
  Bed bed = bed_of(ball(1e4, 0.9, 6000), {{1, drop}});
  double worst_y = 0, worst_v = 0;
  const auto rows = read_csv("dem_mfix01_freefall_bounce.csv");
  for (const auto& row : rows) {
    advance(bed, static_cast<int>(std::lround(row[0] / bed.params.step) - bed.steps));
    const double late = row[0] - static_cast<double>(bed.steps) * bed.params.step;
    worst_y = std::max(worst_y, std::abs(body(bed, 0).y + late * body(bed, 0).v - row[2]));
    worst_v = std::max(worst_v, std::abs(body(bed, 0).v - row[3]));
  }
  EXPECT_GT(rows.size(), 100u);
  EXPECT_LT(worst_y, 2e-4);
  EXPECT_LT(worst_v, 0.01);
}

TEST(bouncing, heights_fall_with_the_square_of_the_restitution_as_in_mfix_dem02) {
  for (const double e : {0.5, 0.7, 0.9, 1.0}) {
    double softer = 1;
    for (const double stiffness : {5e4, 5e5, 5e6}) {
      const Params p = ball(stiffness, e, 4000);
      const Oscillator contact = on_plane(p, stiffness, e);
      const auto hard = [&](int bounce) { return (drop - radius) * std::pow(e, 2 * bounce); };
      int bounces = 1;  // while they are high against what the ball sinks in at rest
      while (bounces < 6 && hard(bounces + 1) > 25 * contact.sunk()) ++bounces;
      const std::vector<double> tops = simulated_tops(p, bounces);
      double v = std::sqrt(2 * p.gravity * (drop - radius));
      for (int k = 1; k <= bounces; ++k) {
        v = contact.rebound(v);
        const double rise = 0.5 * v * v / p.gravity;
        EXPECT_NEAR((tops[k - 1] - radius) / rise, 1, 5e-3) << "e " << e << ", " << stiffness << " N/m, bounce " << k;
      }
      // The stiffer, the closer to the hard sphere: its distance falls with the contact time.
      const double off = std::abs((tops[0] - radius) / hard(1) - 1);
      EXPECT_LT(off, e == 1 ? 1e-3 : 0.5 * softer) << "e " << e << ", " << stiffness << " N/m";
      softer = off;
    }
  }
}

TEST(bouncing, soft_ball_stays_as_far_below_the_hard_one_as_in_mfix_dem02) {
  const std::vector<double> tops = simulated_tops(ball(5e4, 0.9, 2000), 11);
  const auto low = [&](int bounce) {
    const double hard = (drop - radius) * std::pow(0.9, 2 * bounce) + radius;
    return 1 - tops[bounce - 1] / hard;
  };
  EXPECT_NEAR(low(1), 0.011, 1e-3);
  EXPECT_NEAR(low(11), 0.083, 2e-3);
}
