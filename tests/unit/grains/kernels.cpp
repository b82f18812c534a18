#include "grains/kernels.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "../../verification/grains/bodies.hpp"
#include "base/loops.hpp"
#include "grains/packing.hpp"

using namespace livebed;
using namespace livebed::grains;

namespace {

/// Puts the widest kernels back at the end of a test.
struct Kernel_choice {
  ~Kernel_choice() { use_kernels(kernel_names().front()); }
};

/// A bed between side walls with a ramp and a pipe in it, blown along: every kind of contact is in play.
Bed bed_with_everything(Law law, double rolling_friction, Precision precision = Precision::all_double) {
  Params p;
  p.precision = precision;
  p.law = law;
  p.rolling_friction = rolling_friction;
  p.stiffness = 5500, p.restitution = 0.3;
  p.length = 0.053, p.count = 203;
  p.floor = Floor::grains;
  p.side_walls = true;
  p.walls = {{{0.0, 0.012}, {0.012, 0.004}, {0.014, 0.0}}};
  Bed bed = lattice(p);
  bed.pipe = {.present = true, .x = 0.03, .y = 0.1, .diameter = 0.01};
  for (int i = 0; i < bed.state.count(); ++i) {
    bed.state.y[i] += 0.015;
    bed.state.u[i] = 0.5;
    bed.state.omega[i] = 20;
  }
  return bed;
}

double worst_distance(const Bed& a, const Bed& b) {
  double worst = 0;
  for (int id = 0; id < a.params.count; ++id) {
    const bodies::Body p = bodies::body(a, id), q = bodies::body(b, id);
    worst = std::max({worst, std::abs(p.x - q.x), std::abs(p.y - q.y)});
  }
  return worst;
}

}  // namespace

TEST(kernels, of_every_instruction_set_move_the_grains_alike) {
  const Kernel_choice back;
  ASSERT_EQ(kernel_names().back(), "plain");
  for (const Law law : {Law::paper, Law::hooke}) {
    for (const double rolling : {0.0, 0.2}) {
      use_kernels("plain");
      Bed plain = bed_with_everything(law, rolling);
      const Bed start = plain;
      // Some collisions for most grains; rounding grows with each of them.
      const int steps = static_cast<int>(0.012 / plain.params.step);
      advance(plain, steps);
      EXPECT_GT(worst_distance(start, plain), plain.params.diameter);
      for (const std::string_view name : kernel_names()) {
        use_kernels(name);
        Bed bed = start;
        advance(bed, steps);
        EXPECT_LT(worst_distance(bed, plain), 1e-7 * bed.params.diameter) << name << ", rolling friction " << rolling;
      }
    }
  }
}

TEST(kernels, of_every_instruction_set_move_the_grains_in_mixed_precision_as_in_double) {
  const Kernel_choice back;
  for (const Law law : {Law::paper, Law::hooke}) {
    for (const double rolling : {0.0, 0.2}) {
      use_kernels("plain");
      Bed start = bed_with_everything(law, rolling);
      advance(start, static_cast<int>(0.012 / start.params.step));
      Bed in_double = start;
      const int steps = 200;  // four contacts, one after the other
      advance(in_double, steps);
      EXPECT_GT(worst_distance(start, in_double), 0.1 * start.params.diameter);
      for (const std::string_view name : kernel_names()) {
        use_kernels(name);
        Bed bed = start;
        bed.params.precision = Precision::mixed;
        advance(bed, steps);
        const double worst = worst_distance(bed, in_double);
        EXPECT_LT(worst, 1e-4 * bed.params.diameter) << name << ", rolling friction " << rolling;
        EXPECT_GT(worst, 0) << name;  // it is another precision
      }
    }
  }
}

TEST(kernels, give_the_same_bits_on_any_number_of_threads) {
  const Kernel_choice back;
  for (const std::string_view name : kernel_names())
    for (const Precision precision : {Precision::all_double, Precision::mixed}) {
      use_kernels(name);
      Bed one = bed_with_everything(Law::hooke, 0.2, precision), three = one;
      advance(one, 2000);
      base::set_threads(3);
      advance(three, 2000);
      base::set_threads(1);
      EXPECT_EQ(worst_distance(one, three), 0) << name;
      EXPECT_TRUE(one.contacts.rolling == three.contacts.rolling) << name;
    }
}

TEST(kernels, of_unknown_sets_are_refused) { EXPECT_THROW(use_kernels("sse9"), base::Fault); }
