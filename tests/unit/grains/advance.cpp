#include "grains/advance.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "../../verification/grains/bodies.hpp"
#include "base/loops.hpp"
#include "grains/measures.hpp"
#include "grains/packing.hpp"

using namespace livebed;
using namespace livebed::grains;

namespace {

Params small_bed() {
  Params p;
  p.stiffness = 5500;
  p.restitution = 0.3;
  p.length = 0.053;
  p.count = 301;  // not a multiple of the lanes
  return p;
}

/// A settled bed with a pipe in it, set in motion by a shear flow: everything is in play.
Bed bed_in_motion() {
  Bed bed = pack(small_bed()).bed;
  place_pipe(bed, {.present = true, .x = 0.02, .y = 0.03, .diameter = 0.015}, 0.2);
  for (int i = 0; i < bed.state.count(); ++i) {
    bed.state.fluid.beta[i] = 2e-4;
    bed.state.fluid.u[i] = 60 * bed.state.y[i];
    bed.state.fluid.v[i] = 0.1 * std::sin(100 * bed.state.x[i]);
    bed.state.fluid.fx[i] = 1e-6;
  }
  return bed;
}

void expect_same_bits(const Bed& a, const Bed& b) {
  std::vector<std::vector<double>> arrays;
  each_array(a, [&](const char*, const auto& array) { arrays.emplace_back(array.begin(), array.end()); });
  std::size_t k = 0;
  each_array(b, [&](const char* name, const auto& array) {
    EXPECT_EQ(arrays[k++], std::vector<double>(array.begin(), array.end())) << name;
  });
  EXPECT_EQ(a.pipe_impulse.x, b.pipe_impulse.x);
  EXPECT_EQ(a.pipe_impulse.y, b.pipe_impulse.y);
  EXPECT_EQ(a.contacts.rebuilds, b.contacts.rebuilds);
  EXPECT_EQ(a.steps, b.steps);
}

std::string fault_of(Bed bed, int steps, base::Exit code) {
  try {
    advance(bed, steps);
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), code);
    return fault.what();
  }
  return "none";
}

}  // namespace

TEST(advance, any_number_of_threads_gives_the_same_bits) {
  const Bed start = bed_in_motion();
  Bed one = start;
  for (int call = 0; call < 20; ++call) advance(one, 100);
  EXPECT_GT(one.contacts.rebuilds, start.contacts.rebuilds + 3);
  for (const int threads : {2, 3, 7}) {
    Bed many = start;
    base::set_threads(threads);
    for (int call = 0; call < 20; ++call) advance(many, 100);
    base::set_threads(1);
    expect_same_bits(one, many);
  }
}

TEST(advance, saved_and_restored_bed_goes_on_with_the_same_bits) {
  for (const Precision precision : {Precision::all_double, Precision::mixed}) {
    Bed unbroken = bed_in_motion();
    unbroken.params.precision = precision;
    advance(unbroken, 777);
    // What a checkpoint holds and nothing else.
    Bed restored;
    restored.params = unbroken.params;
    restored.pipe = unbroken.pipe;
    restored.pipe_impulse = unbroken.pipe_impulse;
    restored.steps = unbroken.steps;
    restored.contacts.set_single(precision == Precision::mixed);
    restored.contacts.pipe_built = unbroken.contacts.pipe_built;
    restored.contacts.rebuilds = unbroken.contacts.rebuilds;
    restored.contacts.refreshed = unbroken.contacts.refreshed;
    std::vector<std::vector<double>> saved;
    each_array(unbroken, [&](const char*, const auto& array) { saved.emplace_back(array.begin(), array.end()); });
    std::size_t k = 0;
    each_array(restored, [&](const char*, auto& array) {
      array.assign(saved[k].begin(), saved[k].end());
      ++k;
    });
    advance(unbroken, 1234);
    advance(restored, 1234);
    expect_same_bits(unbroken, restored);
  }
}

TEST(advance, two_calls_move_the_grains_as_one_call_does) {
  Bed once = bed_in_motion(), twice = once;
  advance(once, 500);
  advance(twice, 123);
  advance(twice, 377);
  EXPECT_NEAR(once.pipe_impulse.y, twice.pipe_impulse.y, 1e-12 * std::abs(once.pipe_impulse.y));
  twice.pipe_impulse = once.pipe_impulse;         // summed in another order
  for (int i = 0; i < once.state.count(); ++i) {  // likewise
    EXPECT_NEAR(once.state.impulse_x[i], twice.state.impulse_x[i], 1e-12 * std::abs(once.state.impulse_x[i]));
    EXPECT_NEAR(once.state.impulse_y[i], twice.state.impulse_y[i], 1e-12 * std::abs(once.state.impulse_x[i]));
  }
  twice.state.impulse_x = once.state.impulse_x;
  twice.state.impulse_y = once.state.impulse_y;
  expect_same_bits(once, twice);
}

TEST(advance, histories_survive_rebuilt_lists) {
  Bed rare = bed_in_motion(), often = rare;
  for (int step = 0; step < 300; ++step) {
    advance(rare, 1);
    often.contacts.x_built.assign(often.contacts.x_built.size(), -1);  // forces new lists
    advance(often, 1);
  }
  EXPECT_GT(often.contacts.rebuilds, rare.contacts.rebuilds + 250);
  double worst = 0, moved = 0;
  for (int id = 0; id < rare.params.count; ++id) {
    const bodies::Body a = bodies::body(rare, id), b = bodies::body(often, id);
    worst = std::max({worst, std::abs(nearest_image(a.x - b.x, rare.params.length)), std::abs(a.y - b.y)});
    moved = std::max(moved, std::abs(a.u));
  }
  EXPECT_GT(moved, 0.01);
  EXPECT_LT(worst, 1e-12);  // [m]; only the order of sums differs

  // The test can fail: a lost history shows.
  Bed forgetful = bed_in_motion();
  forgetful.contacts.spring.assign(Array(forgetful.contacts.spring.size(), 0.0));
  advance(forgetful, 300);
  worst = 0;
  for (int id = 0; id < rare.params.count; ++id) {
    worst = std::max(worst, std::abs(bodies::body(rare, id).y - bodies::body(forgetful, id).y));
  }
  EXPECT_GT(worst, 1e-9);
}

TEST(advance, grains_re_enter_through_the_other_end) {
  Params p = bodies::quartz();
  p.gravity = 0;
  p.length = 0.02;
  Bed bed = bodies::bed_of(p, {{0.0199, 0.5, 0.5}, {0.0001, 0.6, -0.5}, {0.01, 0.7, 3}});
  const double dt = bed.params.step;
  for (int look = 1; look <= 100; ++look) {
    advance(bed, 100);
    for (const double x : bed.state.x) {
      EXPECT_GE(x, 0);
      EXPECT_LE(x, p.length);
    }
    const double t = 100 * look * dt;
    EXPECT_NEAR(std::remainder(bodies::body(bed, 0).x - (0.0199 + 0.5 * t), p.length), 0, 1e-12);
    EXPECT_NEAR(std::remainder(bodies::body(bed, 1).x - (0.0001 - 0.5 * t), p.length), 0, 1e-12);
    EXPECT_NEAR(std::remainder(bodies::body(bed, 2).x - (0.01 + 3 * t), p.length), 0, 1e-12);
  }
  check_count(bed);
}

TEST(advance, a_number_that_is_not_finite_stops_with_grain_place_and_step) {
  Bed bed = bed_in_motion();
  advance(bed, 10);
  const std::int64_t before = bed.steps;
  const int grain = 40, id = bed.state.id[grain];
  bed.state.fluid.u[grain] = std::numeric_limits<double>::quiet_NaN();
  const std::string text = fault_of(bed, 10, base::Exit::diverged);
  EXPECT_NE(text.find(fmt::format("grain {} ", id)), std::string::npos) << text;
  EXPECT_NE(text.find(fmt::format("grain step {}", before + 1)), std::string::npos) << text;
  EXPECT_NE(text.find("x = nan"), std::string::npos) << text;
}

TEST(advance, a_lost_or_doubled_grain_is_noticed) {
  const Bed bed = bed_in_motion();
  EXPECT_EQ(fault_of(bed, 1, base::Exit::internal), "none");
  Bed doubled = bed;
  doubled.state.id[3] = doubled.state.id[4];
  doubled.contacts.x_built.assign(doubled.contacts.x_built.size(), -1);  // noticed when lists are made
  EXPECT_NE(fault_of(doubled, 1, base::Exit::internal).find("doubled"), std::string::npos);
  Bed lost = bed;
  lost.state.x.pop_back();
  EXPECT_NE(fault_of(lost, 1, base::Exit::internal).find("300 entries for 301"), std::string::npos);
}

TEST(packing, same_seed_same_bits_and_another_seed_another_bed) {
  Params p = small_bed();
  const Packing first = pack(p), second = pack(p);
  expect_same_bits(first.bed, second.bed);
  p.seed = 2;
  EXPECT_NE(pack(p).bed.state.x, first.bed.state.x);
}

TEST(packing, lattice_fills_the_length_without_overlap) {
  for (const double spread : {0.0, 0.1}) {
    Params p = small_bed();
    p.spread = spread;
    Bed bed = lattice(p);
    advance(bed, 0);
    EXPECT_EQ(measure_contacts(bed).per_grain, 0);
    int columns = 0;
    double smallest = 1, largest = 0;
    for (int i = 0; i < p.count; ++i) {
      columns += bed.state.y[i] < p.diameter;
      smallest = std::min(smallest, bed.state.diameter[i]);
      largest = std::max(largest, bed.state.diameter[i]);
    }
    EXPECT_EQ(columns, static_cast<int>(p.length / (p.diameter * (1 + spread + p.lattice_gap))));
    EXPECT_NEAR(smallest, p.diameter * (1 - spread), 0.01 * p.diameter);
    EXPECT_NEAR(largest, p.diameter * (1 + spread), 0.01 * p.diameter);
  }
}

TEST(packing, a_bed_without_time_to_settle_says_so) {
  Params p = small_bed();
  p.settle_time = 0.02;
  try {
    pack(p);
    FAIL() << "settled within 0.02 s";
  } catch (const base::Fault& fault) {
    EXPECT_EQ(fault.code(), base::Exit::stopped_by_limit);
    EXPECT_NE(std::string(fault.what()).find("bed.settle_time = 0.02 s"), std::string::npos) << fault.what();
  }
}

TEST(packing, beds_side_by_side_fit_at_the_seams) {
  const Bed tile = pack(small_bed()).bed;
  Bed three = side_by_side(tile, 3);
  EXPECT_EQ(three.params.count, 3 * tile.params.count);
  check_count(three);
  advance(three, 0);
  const ContactMeasures one = measure_contacts(tile), all = measure_contacts(three);
  EXPECT_NEAR(all.per_grain, one.per_grain, 1e-12);
  EXPECT_NEAR(all.largest_overlap, one.largest_overlap, 1e-9);
  EXPECT_NEAR(bed_height(three.state), bed_height(tile.state), 1e-12);
}

TEST(packing, a_bed_of_pieces_repeats_one_of_them_at_rest) {
  Params p = small_bed();
  p.floor = Floor::grains;
  const Params one = p;
  p.length *= 3, p.count *= 3, p.pieces = 3;
  int looks = 0;
  const Packing packing = pack(p, [&](const SettleRow&) { ++looks; });
  const Bed& bed = packing.bed;
  check_count(bed);
  EXPECT_EQ(bed.params.count, p.count);
  EXPECT_DOUBLE_EQ(bed.params.length, p.length);
  EXPECT_EQ(bed.params.pieces, 3);
  EXPECT_EQ(looks, static_cast<int>(packing.convergence.size()));
  EXPECT_LT(packing.convergence.back().mean_speed, p.settled_speed);
  // The contacts remember their friction, so that nothing moves.
  const Packing alone = pack(one);
  EXPECT_NEAR(bed_height(bed.state), bed_height(alone.bed.state), 1e-4 * p.diameter);
  EXPECT_NEAR(measure_contacts(bed).per_grain, measure_contacts(alone.bed).per_grain, 0.01);
  EXPECT_NEAR(measure_contacts(bed).largest_overlap, measure_contacts(alone.bed).largest_overlap, 1e-4);
  EXPECT_LT(packing.convergence.size(), alone.convergence.size() + 50);
  p.count += 1;
  EXPECT_THROW(pack(p), base::Fault);
}

TEST(packing, whoever_looks_can_end_it) {
  int looks = 0;
  const auto third = [&](const SettleRow&) {
    if (++looks == 3) throw base::Fault(base::Exit::signal, "enough");
  };
  EXPECT_THROW(pack(small_bed(), third), base::Fault);
  EXPECT_EQ(looks, 3);
}

TEST(packing, a_pipe_through_the_floor_is_refused) {
  Bed bed = lattice(small_bed());
  EXPECT_THROW(place_pipe(bed, {.present = true, .x = 0.02, .y = 0.004, .diameter = 0.01}), base::Fault);
}

TEST(advance, lanes_without_a_grain_do_not_push_the_pipe) {
  // A slice of one grain and seven idle lanes, in the pipe's reach: with a restitution of 1 the pipe takes twice its
  // momentum.
  Params p = bodies::quartz();
  p.gravity = 0;
  Bed bed = bodies::bed_of(p, {{.x = 0.05, .y = 0.0431, .v = -0.1}});
  bed.pipe = {.present = true, .x = 0.05, .y = 0.03, .diameter = 0.024};
  advance(bed, static_cast<int>(2e-3 / bed.params.step));
  EXPECT_GT(bed.state.v[0], 0.09);
  const double taken = -mass(bed.params, bed.state.diameter[0]) * (bed.state.v[0] + 0.1);
  EXPECT_NEAR(bed.pipe_impulse.y, taken, 1e-9 * std::abs(taken));
  EXPECT_NEAR(bed.pipe_impulse.x, 0, 1e-12 * std::abs(taken));
}
