#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "bodies.hpp"
#include "grains/measures.hpp"
#include "oscillator.hpp"

using namespace livebed;
using namespace livebed::grains;
using namespace livebed::grains::bodies;

namespace {

/// Two grains fly at each other with v each, without gravity; returns the ratio of the relative speeds.
double rebound(Params p, double v) {
  p.gravity = 0;
  Bed bed = bed_of(p, {{0.05 - 0.6 * p.diameter, 0.05, v}, {0.05 + 0.6 * p.diameter, 0.05, -v}});
  advance(bed, static_cast<int>(0.6 * p.diameter / v / bed.params.step));
  return (body(bed, 1).u - body(bed, 0).u) / (2 * v);
}

Params rebounding(double restitution, Tension tension, double steps) {
  Params p = quartz();
  p.restitution = restitution;
  p.tension = tension;
  p.steps_per_contact = steps;
  return p;
}

/// MFIX DEM03: two grains of 1 mm pressed between walls 1.8 mm apart, the lower one twice as heavy.  Ours have one
/// density, so it is larger by 2^(1/3), and what lies above it moves up with its surface: the equations of motion are
/// the same.  The upper wall is a pipe so large that it is flat.
struct Stack {
  static constexpr double diameter = 1e-3, stiffness = 1000;
  const double grown = diameter * (std::cbrt(2.0) - 1);
  double lower_mass, upper_mass;
  Bed bed;

  explicit Stack(double restitution) {
    Params p = dry(diameter, 10000, stiffness);
    p.steps_per_contact = 4000;
    p.law = Law::hooke;
    p.tension = Tension::spring;
    p.restitution = restitution;
    bed = bed_of(p, {{0.01, 0.45e-3 + 0.5 * grown}, {0.01, 1.35e-3 + grown}});
    bed.state.diameter[0] += grown;
    bed.pipe = {.present = true, .x = 0.01, .y = 1.8e-3 + grown + 1, .diameter = 2};
    lower_mass = mass(p, diameter + grown), upper_mass = mass(p, diameter);
  }
  /// Heights of both in the time of the case [s], as if they were equally large [m].
  std::pair<double, double> at(double time) {
    advance(bed, static_cast<int>(std::lround(time / bed.params.step) - bed.steps));
    return {body(bed, 0).y - 0.5 * grown, body(bed, 1).y - grown};
  }
};

}  // namespace

TEST(collision, head_on_pair_rebounds_with_the_restitution_asked_for) {
  for (const Tension tension : {Tension::spring, Tension::none}) {
    for (const double e : {0.1, 0.3, 0.6, 0.9, 1.0}) {
      EXPECT_NEAR(rebound(rebounding(e, tension, 2000), 0.05), e, 2e-3) << "e " << e;
    }
  }
}

TEST(collision, restitution_holds_roughly_at_the_default_steps_a_contact) {
  for (const double e : {0.3, 0.6, 0.9}) EXPECT_NEAR(rebound(rebounding(e, Tension::none, 20), 0.05), e, 0.06);
}

TEST(collision, restitution_does_not_depend_on_speed) {
  const Params p = rebounding(0.5, Tension::none, 1000);
  EXPECT_NEAR(rebound(p, 0.02), rebound(p, 0.2), 2e-3);
}

TEST(collision, a_wall_of_any_factor_rebounds_like_a_grain) {
  // A wall has twice the spring and dashpot (Eq. 28) and twice the mass in play: the damping ratio is that of a pair.
  for (const Tension tension : {Tension::spring, Tension::none}) {
    Params p = rebounding(0.6, tension, 1000);
    p.wall_factor = 2;
    EXPECT_NEAR(thrown_at_floor(p, 0, 0.1).v, 0.06, 3e-4);
  }
}

TEST(collision, sliding_rebound_loses_mu_times_the_normal_impulse) {
  for (const Inertia inertia : {Inertia::sphere, Inertia::disk}) {
    Params p = rebounding(0.7, Tension::none, 500);
    p.inertia = inertia;
    p.friction = 0.1;
    p.wall_factor = 1;
    const double u = 0.5, v = 0.1;
    const Body after = thrown_at_floor(p, u, v);
    const double lost = p.friction * (v + after.v);  // mu (1 + e) v
    EXPECT_NEAR(after.u, u - lost, 1e-9);
    EXPECT_NEAR(after.omega * 0.5 * p.diameter, -lost / inertia_factor(inertia), 1e-9);
  }
}

TEST(collision, sticking_rebound_follows_the_tangential_spring) {
  // Undamped, no sliding: the slip swings with k_s and m/(1 + 1/q) while the contact lasts half a period of k_n and m.
  for (const Inertia inertia : {Inertia::sphere, Inertia::disk}) {
    Params p = rebounding(1, Tension::none, 2000);
    p.inertia = inertia;
    p.friction = 1e3;
    const double u = 0.01, gain = 1 + 1 / inertia_factor(inertia);
    const Body after = thrown_at_floor(p, u, 0.1);
    const double slip = u * std::cos(base::pi * std::sqrt(gain / (2 * (1 + p.poisson))));
    EXPECT_NEAR(after.u, u + (slip - u) / gain, 2e-3 * u);
    EXPECT_NEAR(after.u + after.omega * 0.5 * p.diameter, slip, 5e-3 * u);
  }
}

TEST(collision, no_force_where_the_contact_distance_is_not_reached) {
  Params p = quartz();
  p.gravity = 0;
  for (const double gamma : {0.95, 1.0, 1.05}) {
    p.gamma = gamma;
    Bed apart = bed_of(p, {{0.05, 0.05}, {0.05 + 1.0001 * gamma * p.diameter, 0.05}});
    Bed touching = bed_of(p, {{0.05, 0.05}, {0.05 + 0.9999 * gamma * p.diameter, 0.05}});
    advance(apart, 10);
    advance(touching, 10);
    EXPECT_EQ(kinetic_energy(apart.params, apart.state), 0);
    EXPECT_GT(kinetic_energy(touching.params, touching.state), 0);
  }
}

TEST(collision, two_compressed_grains_swing_as_in_mfix_dem03) {
  Stack stack(1);
  double worst = 0;
  const auto rows = read_csv("dem_mfix03_two_stacked.csv");
  for (const auto& row : rows) {
    const auto [lower, upper] = stack.at(row[0]);
    worst = std::max({worst, std::abs(lower - row[1]), std::abs(upper - row[2])});
  }
  EXPECT_GT(rows.size(), 100u);
  EXPECT_LT(worst, 3e-7);  // of swings of 1e-5 and 5e-5 m
}

TEST(collision, two_compressed_grains_come_to_rest_as_in_mfix_dem03_with_damping) {
  for (const double e : {1.0, 0.9, 0.7, 0.5}) {
    Stack stack(e);
    // The same two masses between three springs and dashpots, by Runge and Kutta; y, v of the lower and the upper one.
    using Four = std::array<double, 4>;
    const double m1 = stack.lower_mass, m2 = stack.upper_mass, k = stack.stiffness, d = stack.diameter;
    const auto push = [&](double overlap, double closing, double reduced) {
      return overlap > 0 ? k * overlap + 2 * damping_ratio(e) * std::sqrt(reduced * k) * closing : 0.0;
    };
    const auto rate = [&](const Four& s) -> Four {
      const double floor = push(0.5 * d - s[0], -s[2], m1), top = push(s[1] + 0.5 * d - 1.8e-3, s[3], m2);
      const double pair = push(d - (s[1] - s[0]), s[2] - s[3], m1 * m2 / (m1 + m2));
      return {s[2], s[3], (floor - pair) / m1 - 9.81, (pair - top) / m2 - 9.81};
    };
    const auto moved = [](Four s, const Four& r, double t) {
      for (int n = 0; n < 4; ++n) s[n] += t * r[n];
      return s;
    };
    Four s{0.45e-3, 1.35e-3, 0, 0};
    constexpr double t = 1e-7;
    double worst = 0;
    for (int step = 1; step <= 10000; ++step) {
      const Four a = rate(s), b = rate(moved(s, a, 0.5 * t)), c = rate(moved(s, b, 0.5 * t)), f = rate(moved(s, c, t));
      for (int n = 0; n < 4; ++n) s[n] += t / 6 * (a[n] + 2 * b[n] + 2 * c[n] + f[n]);
      if (step % 100 != 0) continue;
      const auto [lower, upper] = stack.at(step * t);
      worst = std::max({worst, std::abs(lower - s[0]), std::abs(upper - s[1])});
    }
    EXPECT_LT(worst, 2e-7) << "restitution " << e;
  }
}

TEST(collision, slipping_grain_starts_to_roll_as_in_mfix_dem04) {
  for (const auto& row : read_csv("dem_mfix04_slip_to_roll.csv")) {
    for (const Inertia inertia : {Inertia::sphere, Inertia::disk}) {
      Params p = dry(1e-3, 10000, 1e4);
      p.inertia = inertia;
      p.friction = row[0];
      p.restitution = 0.8;
      const double u0 = 0.1, r = 0.5 * p.diameter;
      const double sunk = mass(p, p.diameter) * p.gravity / p.stiffness;
      Bed bed = bed_of(p, {{0.001, r - sunk, u0}});
      while (body(bed, 0).u + r * body(bed, 0).omega > 1e-4 * u0) advance(bed, 1);
      const double slip_time = row[0] * p.gravity * static_cast<double>(bed.steps) * bed.params.step / u0;
      const bool sphere = inertia == Inertia::sphere;
      EXPECT_NEAR(slip_time, sphere ? row[1] : 1.0 / 3, 3e-3);
      EXPECT_NEAR(body(bed, 0).u / u0, sphere ? row[2] : 2.0 / 3, 2e-3);
      EXPECT_NEAR(-body(bed, 0).omega * r / u0, sphere ? row[3] : 2.0 / 3, 2e-3);
      const double rolling = body(bed, 0).u;
      advance(bed, 20000);
      EXPECT_NEAR(body(bed, 0).u, rolling, 2e-3 * u0);  // rolling costs nothing
    }
  }
}
