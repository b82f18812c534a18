#include <cmath>
#include <gtest/gtest.h>

#include "bodies.hpp"
#include "oscillator.hpp"

using namespace livebed;
using namespace livebed::grains;
using namespace livebed::grains::bodies;

namespace {

constexpr double speed = 0.1;  ///< of approach [m/s]
constexpr double steps_a_period = 1e4;

struct Touch {
  double time = 0;         ///< that a force acts [s]
  double restitution = 0;  ///< [-]
  double overlap = 0;      ///< the largest [m]
};

/// Two equal grains head on.  The ends of the contact are found between two steps: where the overlap begins, and where
/// it ends or, before, the force.
Touch touch(Params p) {
  p.gravity = 0;
  p.steps_per_contact = steps_a_period;
  const double half = 0.5 * p.diameter + 2e-8;
  Bed bed = bed_of(p, {{0.05 - half, 0.05, 0.5 * speed}, {0.05 + half, 0.05, -0.5 * speed}});
  Touch result;
  double begin = -1, end = -1, before = -4e-8, closing = speed;
  for (int step = 1; end < 0; ++step) {
    advance(bed, 1);
    const double overlap = p.diameter - (body(bed, 1).x - body(bed, 0).x);
    const double closing_now = body(bed, 0).u - body(bed, 1).u;
    const double crossing = (step - overlap / (overlap - before)) * bed.params.step;
    if (begin < 0 && overlap > 0) begin = crossing;
    const bool forceless = begin >= 0 && closing < 0 && closing_now == closing;
    if (begin >= 0 && (overlap <= 0 || forceless)) end = overlap <= 0 ? crossing : (step - 1) * bed.params.step;
    result.overlap = std::max(result.overlap, overlap);
    before = overlap, closing = closing_now;
  }
  result.time = end - begin;
  result.restitution = -closing / speed;
  return result;
}

}  // namespace

TEST(contact_time, and_restitution_and_overlap_follow_the_closed_forms_for_five_dampings) {
  for (const double zeta : {0.0, 0.1, 0.2, 0.4, 0.7}) {
    Params p = quartz();
    p.tension = Tension::spring;
    p.restitution = std::exp(-base::pi * zeta / std::sqrt(1 - zeta * zeta));
    const Oscillator pair{0.5 * mass(p, p.diameter), p.stiffness, zeta};
    const Touch found = touch(p);
    EXPECT_NEAR(found.time, base::pi / pair.omega(), 1e-3 * found.time) << "damping ratio " << zeta;
    EXPECT_NEAR(found.restitution, p.restitution, 1e-3) << "damping ratio " << zeta;
    // The overlap is largest where its rate vanishes.
    const double turn = std::atan2(std::sqrt(1 - zeta * zeta), zeta) / pair.omega();
    EXPECT_NEAR(found.overlap, pair.overlap(turn, speed), 1e-3 * found.overlap) << "damping ratio " << zeta;
  }
}

TEST(contact_time, ends_with_the_force_where_the_dashpot_may_not_pull) {
  for (const double zeta : {0.0, 0.1, 0.2, 0.4, 0.7}) {
    Params p = quartz();
    const Oscillator pair{0.5 * mass(p, p.diameter), p.stiffness, zeta};
    const double time = pair.contact_time_without_tension();
    p.tension = Tension::none;
    p.restitution = -pair.rate(time, 1);
    const Touch found = touch(p);
    EXPECT_NEAR(found.time, time, 1e-3 * time) << "damping ratio " << zeta;
    EXPECT_NEAR(found.restitution, p.restitution, 1e-3) << "damping ratio " << zeta;
  }
}
