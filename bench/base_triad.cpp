#include <benchmark/benchmark.h>

#include "base/aligned.hpp"
#include "base/loops.hpp"

/// The machine's limit: bytes a second that the triad a = b + s c of STREAM (McCalpin 1995) moves, three arrays
/// counted, for sizes from the first cache to the memory.  The flow solver is held against it in docs/performance.md.
namespace {

void triad(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0) / (3 * sizeof(double)));
  livebed::base::AlignedVector<double> a(n), b(n, 1.0), c(n, 2.0);
  for (auto _ : state) {
    livebed::base::vector_loop(0, n, [&](int i) { a[i] = b[i] + 3.0 * c[i]; });
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * n * 3 *
                          static_cast<std::int64_t>(sizeof(double)));
}
BENCHMARK(triad)->RangeMultiplier(4)->Range(1 << 14, 1 << 28);

}  // namespace
