#include "grains/laws.hpp"

#include <functional>
#include <gtest/gtest.h>

#include "../../verification/grains/bodies.hpp"

using namespace livebed;
using namespace livebed::grains;

namespace {

std::string refusal(const Params& p) {
  try {
    derive(p);
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), base::Exit::invalid_case);
    return fault.what();
  }
  return "accepted";
}

}  // namespace

TEST(laws, mass_and_weight_of_two_millimetre_quartz) {
  const Params p = bodies::quartz();
  EXPECT_NEAR(mass(p, 2e-3), (2650 + 500) * 4.18879e-9, 1e-10);
  EXPECT_NEAR(submerged_gravity(p), 9.81 * 1650 / 3150, 1e-12);
  EXPECT_NEAR(mass(p, 2e-3) * submerged_gravity(p), 1650 * 9.81 * 4.18879e-9, 1e-9);
}

TEST(laws, stiffness_and_step_of_eq_25_are_each_others_inverse) {
  Params p = bodies::quartz();
  p.stiffness = 0;
  p.step = 1e-5;
  p.steps_per_contact = 20;
  const Params from_step = derive(p);
  EXPECT_NEAR(from_step.stiffness, 0.5 * 1.31947e-5 * base::square(2 * base::pi / 2e-4), 0.5);  // 6.5 kN/m
  p.stiffness = from_step.stiffness;
  p.step = 0;
  EXPECT_NEAR(derive(p).step, 1e-5, 1e-17);
  EXPECT_NEAR(critical_time(1e-5, stiffness_of(1e-5, 3e-4)), 3e-4, 1e-16);
}

TEST(laws, deriving_twice_changes_nothing) {
  for (const Tension tension : {Tension::spring, Tension::none}) {
    for (const double e : {0.05, 0.3, 0.9, 1.0}) {
      Params p = bodies::quartz();
      p.tension = tension;
      p.restitution = e;
      const Params once = derive(p), twice = derive(once);
      EXPECT_EQ(once.damping, twice.damping);
      EXPECT_EQ(once.restitution, twice.restitution);
      EXPECT_EQ(once.step, twice.step);
      EXPECT_EQ(once.stiffness, twice.stiffness);
    }
    Params p = bodies::quartz();
    p.tension = tension;
    p.restitution = 0;
    p.damping = 1;
    EXPECT_EQ(derive(derive(p)).damping, 1);
  }
}

TEST(laws, restitution_and_damping_are_each_others_inverse) {
  for (const Tension tension : {Tension::spring, Tension::none}) {
    for (const double e : {0.01, 0.1, 0.5, 0.8, 0.99}) {
      EXPECT_NEAR(restitution_of(damping_of(e, tension), tension), e, 1e-12);
    }
    EXPECT_EQ(damping_of(1, tension), 0);
  }
}

TEST(laws, restitution_meets_known_values) {
  // The oscillator: zeta = -ln e / sqrt(pi^2 + ln^2 e) with zeta = sqrt(2) alpha.
  const double L = std::log(0.5);
  EXPECT_NEAR(damping_of(0.5, Tension::spring), -L / std::sqrt(base::pi * base::pi + L * L) / std::sqrt(2.0), 1e-14);
  EXPECT_EQ(restitution_of(1, Tension::spring), 0);
  // Without tension: exp(-2) at critical damping, continuous around it, the oscillator's for weak damping.
  const double critical = 1 / std::sqrt(2.0);
  EXPECT_NEAR(restitution_of(critical, Tension::none), std::exp(-2.0), 1e-6);
  EXPECT_NEAR(restitution_of(critical * (1 + 1e-6), Tension::none), std::exp(-2.0), 1e-5);
  EXPECT_NEAR(restitution_of(critical * (1 - 1e-6), Tension::none), std::exp(-2.0), 1e-5);
  EXPECT_NEAR(restitution_of(1e-4, Tension::none), restitution_of(1e-4, Tension::spring), 1e-7);
  EXPECT_GT(restitution_of(0.3, Tension::none), restitution_of(0.3, Tension::spring) + 0.01);
}

TEST(laws, contradicting_missing_and_impossible_values_are_refused_by_name) {
  using Change = std::function<void(Params&)>;
  const std::vector<std::pair<Change, std::string>> cases = {
      {[](Params& p) { p.stiffness = 0; }, "time.grain_step"},
      {[](Params& p) { p.step = 1e-5; }, "contradicts"},
      {[](Params& p) { p.restitution = 0; }, "contact.restitution"},
      {[](Params& p) { p.restitution = 1.4; }, "contact.restitution"},
      {[](Params& p) { p.damping = 0.5; }, "contact.damping"},
      {[](Params& p) { p.diameter = -1; }, "grains.diameter"},
      {[](Params& p) { p.density = 900; }, "grains.density"},
      {[](Params& p) { p.spread = 0.7; }, "grains.spread"},
      {[](Params& p) { p.skin = 0; }, "contact.skin"},
      {[](Params& p) { p.steps_per_contact = 2; }, "contact.steps"},
  };
  EXPECT_EQ(refusal(bodies::quartz()), "accepted");
  for (const auto& [change, key] : cases) {
    Params p = bodies::quartz();
    p.restitution = 0.5;
    change(p);
    EXPECT_NE(refusal(p).find(key), std::string::npos) << refusal(p);
  }
}

TEST(laws, walls_are_stiffer_by_the_factor_of_eq_28) {
  Params p = bodies::quartz();
  p.restitution = 0.5;
  p.friction = 0.4;
  p = derive(p);
  const Contact pair = pair_contact(p), wall = wall_contact(p, {2, 2, 2, 2});
  EXPECT_DOUBLE_EQ(wall.k_n, 2 * pair.k_n);
  EXPECT_DOUBLE_EQ(wall.k_s, 2 * pair.k_s);
  EXPECT_DOUBLE_EQ(wall.eta_n, 2 * pair.eta_n);
  EXPECT_DOUBLE_EQ(wall.shear, pair.shear);
  EXPECT_DOUBLE_EQ(wall.mu, 2 * pair.mu);
  EXPECT_DOUBLE_EQ(pair.k_s, pair.k_n / 2.6);
  EXPECT_DOUBLE_EQ(pair.eta_n, p.damping * 2 * std::sqrt(mass(p, p.diameter) * p.stiffness));
}

TEST(laws, tension_and_sliding_bound_the_forces) {
  Params p = bodies::quartz();
  p.restitution = 0.3;
  p.friction = 0.5;
  const auto force = [&](Tension tension, FrictionLimit limit, double closing, double slip, double spring) {
    p.tension = tension;
    p.friction_limit = limit;
    p.damping = 0;
    return contact_force<double>(pair_contact(derive(p)), pair_contact(derive(p)).eta_n, 1e-6, closing, slip, spring);
  };
  const double e_n = p.stiffness * 1e-6;
  EXPECT_EQ(force(Tension::none, FrictionLimit::total_force, -1, 0, 0).normal, 0);
  EXPECT_LT(force(Tension::spring, FrictionLimit::total_force, -1, 0, 0).normal, 0);
  // No friction without pressure, in either reading of the limit; the spring's own force bounds it in the paper's.
  EXPECT_EQ(force(Tension::none, FrictionLimit::total_force, -1, 1, 1).tangential, 0);
  EXPECT_EQ(force(Tension::spring, FrictionLimit::total_force, -1, 1, 1).spring, 0);
  EXPECT_DOUBLE_EQ(force(Tension::none, FrictionLimit::spring_force, -1, 1, 1).tangential, 0.5 * e_n);
  const auto pressed = force(Tension::none, FrictionLimit::total_force, 0.01, -1, -1);
  EXPECT_GT(pressed.normal, e_n);
  EXPECT_DOUBLE_EQ(pressed.tangential, -0.5 * pressed.normal);
  EXPECT_DOUBLE_EQ(pressed.spring, -0.5 * pressed.normal);  // the stored spring does not grow beyond the limit
  // Sticking: spring and dashpot add up.
  const auto sticking = force(Tension::none, FrictionLimit::total_force, 0, 1e-6, 1e-4);
  const Contact c = pair_contact(derive(p));
  EXPECT_DOUBLE_EQ(sticking.spring, 1e-4 + c.k_s * c.dt * 1e-6);
  EXPECT_DOUBLE_EQ(sticking.tangential, sticking.spring + c.shear * c.eta_n * 1e-6);
}

TEST(laws, a_vector_and_one_number_give_the_same_force) {
  Params p = bodies::quartz();
  p.restitution = 0.4;
  p.friction = 0.5;
  const Contact c = pair_contact(derive(p));
  double values[4][lanes];  // overlap, closing, slip, spring
  for (int l = 0; l < lanes; ++l) {
    values[0][l] = 1e-6 * (l + 1);
    values[1][l] = 0.01 * std::sin(3.0 * l);
    values[2][l] = 0.01 * std::cos(5.0 * l);
    values[3][l] = 2e-3 * std::sin(7.0 * l);
  }
  for (int part = 0; part < lanes; part += width) {
    const auto of = [&](int what) { return load(values[what] + part); };
    const ContactForce<Lanes> many = contact_force<Lanes>(c, c.eta_n, of(0), of(1), of(2), of(3));
    for (int l = 0; l < width; ++l) {
      const int n = part + l;
      const auto one = contact_force<double>(c, c.eta_n, values[0][n], values[1][n], values[2][n], values[3][n]);
      EXPECT_NEAR(many.normal[l], one.normal, 1e-17);
      EXPECT_NEAR(many.tangential[l], one.tangential, 1e-17);
      EXPECT_NEAR(many.spring[l], one.spring, 1e-17);
    }
  }
}

TEST(laws, records_survive_being_turned_into_lanes_and_back) {
  alignas(64) double fours[lanes * 4], twos[lanes * 2], back[lanes * 4];
  for (int k = 0; k < lanes * 4; ++k) fours[k] = k;
  for (int k = 0; k < lanes * 2; ++k) twos[k] = 100 + k;
  const std::int32_t at[lanes] = {3, 0, 7, 1, 6, 2, 5, 4};
  Lanes a[4], b[2];
  load_fours(fours, at, a);
  load_twos(twos, at, b);
  for (int l = 0; l < width; ++l) {
    for (int f = 0; f < 4; ++f) EXPECT_EQ(a[f][l], 4 * at[l] + f);
    for (int f = 0; f < 2; ++f) EXPECT_EQ(b[f][l], 100 + 2 * at[l] + f);
  }
  store_fours(back, a[0], a[1], a[2], a[3]);
  for (int l = 0; l < width; ++l) {
    for (int f = 0; f < 4; ++f) EXPECT_EQ(back[4 * l + f], 4 * at[l] + f);
  }
  store_twos(back, b[0], b[1]);
  for (int l = 0; l < width; ++l) {
    for (int f = 0; f < 2; ++f) EXPECT_EQ(back[2 * l + f], 100 + 2 * at[l] + f);
  }
}

TEST(laws, reciprocal_root_to_the_last_places) {
  for (double a : {1e-12, 3.7e-9, 1e-7, 0.25, 2.0, 1e4}) {
    const Lanes got = reciprocal_root(all_lanes(a));
    EXPECT_NEAR(got[0] * std::sqrt(a), 1, 5e-16) << a;
    EXPECT_EQ(got[width - 1], got[0]);
  }
}
