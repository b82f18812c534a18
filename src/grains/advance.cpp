#include "grains/advance.hpp"

#include <algorithm>
#include <numeric>

#include "base/fault.hpp"
#include "grains/refresh.hpp"
#include "grains/slabs.hpp"
#include "grains/sleep.hpp"

namespace livebed::grains {

using base::Exit;
using base::fail;

namespace {

void check_sizes(const Bed& bed) {
  const State& s = bed.state;
  const std::size_t n = static_cast<std::size_t>(bed.params.count - bed.outside);
  for (const Array* a : {&s.x, &s.y, &s.u, &s.v, &s.omega, &s.diameter, &s.fluid.u, &s.fluid.v, &s.fluid.beta,
                         &s.fluid.fx, &s.fluid.fy, &s.impulse_x, &s.impulse_y}) {
    if (a->size() != n) fail(Exit::internal, "an array of the grains has {} entries for {} grains", a->size(), n);
  }
  for (const auto* a : {&s.id, &s.laps})
    if (a->size() != n) fail(Exit::internal, "the grains have {} ids or laps for {} grains", a->size(), n);
}

/// Only new lists reorder the grains.
void check_ids(const Bed& bed) {
  const State& s = bed.state;
  const std::size_t n = static_cast<std::size_t>(bed.params.count);
  std::vector<char> seen(n, 0);
  for (const std::int32_t id : s.id) {
    if (id < 0 || static_cast<std::size_t>(id) >= n || seen[id]) {
      fail(Exit::internal, "grain id {} is doubled or outside 0 to {}: a grain was lost", id, n - 1);
    }
    seen[id] = 1;
  }
}

/// Sorts, lists, and copies the grains into the force loop's records; collects what the old records hold first.
void renew(Bed& bed, const Sweep& constants) {
  bed.pipe_impulse = bed.pipe_impulse + collect_pipe_impulse(bed.records);
  count_impulses(bed, true);
  check_ids(bed);
  try {
    rebuild(bed.state, bed.contacts, bed.scratch, constants.reach, bed.pipe, constants.walls);
  } catch (const base::Fault& fault) {
    fail(fault.code(), "grain step {} (t = {} s of grain time): {}", bed.steps,
         static_cast<double>(bed.steps) * bed.params.step, fault.what());
  }
  spread_sleep(bed);
  fill_records(bed.state, bed.contacts, bed.steps, bed.records, bed.scratch.memory);
}

}  // namespace

Bed make_bed(const Params& complete) {
  Bed bed;
  bed.params = complete;
  const int n = complete.count;
  State& s = bed.state;
  for (Array* a : {&s.x, &s.y, &s.u, &s.v, &s.omega, &s.fluid.u, &s.fluid.v, &s.fluid.beta, &s.fluid.fx, &s.fluid.fy,
                   &s.impulse_x, &s.impulse_y}) {
    a->assign(n, 0.0);
  }
  s.diameter.assign(n, complete.diameter);
  s.laps.assign(n, 0);
  s.id.resize(n);
  std::iota(s.id.begin(), s.id.end(), 0);
  return bed;
}

void check_count(const Bed& bed) {
  check_sizes(bed);
  check_ids(bed);
}

void advance(Bed& bed, int steps) {
  check_sizes(bed);
  bed.records.call_began = bed.steps;
  const Sweep constants = make_sweep(bed.params, bed.pipe, bed.state.count());
  const int between_looks = steps_between_looks(bed.params);
  prepare_sleep(bed);
  if (!lists_hold(bed.state, bed.contacts, constants.reach, bed.pipe)) {
    renew(bed, constants);
  } else {
    if (!bed.records.hold(bed.contacts) || bed.records.asleep.empty()) spread_sleep(bed);
    fill_records(bed.state, bed.contacts, bed.steps, bed.records, bed.scratch.memory);
  }
  if (bed.params.sleep) wake_by_fluid(bed);
  for (int left = steps; left > 0;) {
    const int to_look = bed.params.sleep ? between_looks - static_cast<int>(bed.steps % between_looks) : left;
    const int at_once =
        plan_steps(constants, bed.contacts, bed.records, bed.steps, left == steps, std::min(left, to_look));
    const bool held = sweep(constants, bed.contacts, bed.records, at_once);
    bed.steps += at_once, left -= at_once;
    if (!held) {
      bed.records.border_known = false;
      if (!refresh(constants, bed.state, bed.contacts, bed.records, bed.scratch)) {
        read_records(constants, bed.steps, bed.records, bed.state);
        renew(bed, constants);
      }
    }
    if (bed.params.sleep && bed.steps % between_looks == 0) look(bed, constants);
  }
  count_impulses(bed, false);
  read_records(constants, bed.steps, bed.records, bed.state);
  bed.pipe_impulse = bed.pipe_impulse + collect_pipe_impulse(bed.records);
}

}  // namespace livebed::grains
