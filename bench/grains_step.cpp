#include <benchmark/benchmark.h>
#include <map>
#include <utility>

#include "base/loops.hpp"
#include "grains/kernels.hpp"
#include "grains/measures.hpp"
#include "grains/packing.hpp"

/// Speed of a grain step on a settled bed: friction, history and dashpots on, 5 % size spread, nothing asleep.
namespace {

using namespace livebed;
using namespace livebed::grains;

/// A settled bed of 1560 grains, packed once for each law.
const Bed& short_bed(Law law, double rolling_friction) {
  static std::map<std::pair<Law, double>, Bed> beds;
  const auto [place, is_new] = beds.try_emplace({law, rolling_friction});
  if (is_new) {
    Params p;
    p.law = law, p.rolling_friction = rolling_friction;
    p.stiffness = 5500;
    p.restitution = 0.3;
    p.count = 1560;
    p.length = 0.126;
    place->second = pack(p).bed;
  }
  return place->second;
}

/// The short bed side by side until it holds `count` grains, at rest again.
Bed bed_of(int count, Law law = Law::paper, double rolling_friction = 0) {
  const Bed& part = short_bed(law, rolling_friction);
  Bed bed = side_by_side(part, std::max(1, count / part.params.count));
  advance(bed, 2000);
  return bed;
}

void report(benchmark::State& state, const Bed& bed, double steps) {
  state.counters["grains"] = bed.params.count;
  state.counters["contacts_per_grain"] = measure_contacts(bed).per_grain;
  state.counters["grain_steps_per_second"] = benchmark::Counter(steps * bed.params.count, benchmark::Counter::kIsRate);
}

void step(benchmark::State& state) {
  base::set_threads(static_cast<int>(state.range(1)));
  Bed bed = bed_of(static_cast<int>(state.range(0)));
  const int steps = 50;  // a call of advance, as between two flow steps
  for ([[maybe_unused]] auto pass : state) advance(bed, steps);
  report(state, bed, static_cast<double>(steps * state.iterations()));
  base::set_threads(1);
}
BENCHMARK(step)
    ->ArgNames({"grains", "threads"})
    ->ArgsProduct({{6240, 199680}, {1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// The same with the kernels of other instruction sets: 0 is the widest this machine has.
void kernels(benchmark::State& state) {
  const auto names = kernel_names();
  const auto which = static_cast<std::size_t>(state.range(1));
  if (which >= names.size()) return state.SkipWithError("this machine has no such set");
  use_kernels(names[which]);
  Bed bed = bed_of(static_cast<int>(state.range(0)));
  const int steps = 50;
  for ([[maybe_unused]] auto pass : state) advance(bed, steps);
  report(state, bed, static_cast<double>(steps * state.iterations()));
  state.SetLabel(std::string(names[which]));
  use_kernels(names.front());
}
BENCHMARK(kernels)
    ->ArgNames({"grains", "set"})
    ->ArgsProduct({{6240, 199680}, {0, 1, 2}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// The same with the other contact law, with rolling resistance and in mixed precision: 0 the paper's, 1 Hooke's.
void laws(benchmark::State& state) {
  Bed bed = bed_of(static_cast<int>(state.range(0)), state.range(1) == 0 ? Law::paper : Law::hooke,
                   state.range(2) == 0 ? 0.0 : 0.3);
  if (state.range(3) != 0) bed.params.precision = Precision::mixed;
  advance(bed, 2000);
  const int steps = 50;
  for ([[maybe_unused]] auto pass : state) advance(bed, steps);
  report(state, bed, static_cast<double>(steps * state.iterations()));
}
BENCHMARK(laws)
    ->ArgNames({"grains", "hooke", "rolling", "mixed"})
    ->ArgsProduct({{6240, 199680}, {0, 1}, {0, 1}, {0, 1}})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// The lists alone: sort, search, histories.
void lists(benchmark::State& state) {
  Bed bed = bed_of(static_cast<int>(state.range(0)));
  const Reach reach = reach_of(bed.params);
  for ([[maybe_unused]] auto pass : state) rebuild(bed.state, bed.contacts, bed.scratch, reach, bed.pipe);
  report(state, bed, static_cast<double>(state.iterations()));
}
BENCHMARK(lists)->ArgName("grains")->Arg(6240)->Arg(199680)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
