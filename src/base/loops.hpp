#pragma once
#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

/// The only file that knows threads.  Loops hand out whole items (rows, slices, blocks) and sums are made of partial
/// sums per item, added in the order of the items: the bits do not depend on the number of threads.
namespace livebed::base {

/// Number of threads that parallel loops use; set once at start-up.  Throws Fault (command line) for n < 1.
void set_threads(int n);
int threads();

/// Those of this machine that the program may use.
int cores();

/// Which of them calls: 0 .. threads()-1.  For scratch that each thread has of its own.
int thread_index();

/// One item, always by the same machine code: inlined into a loop over a share, the compiler may treat the last items
/// of a share differently from the others, and shares depend on the number of threads.
template <class Body>
#ifdef __clang__
[[gnu::noinline]]
#else
[[gnu::noipa]]
#endif
void do_item(Body& body, int k) {
  body(k);
}

/// Calls work(data, share, shares) once for each share of 0 .. shares-1, one share a thread, and returns when all are
/// done. Inside of a share, and with alone, there is one share.  Every loop goes through this call, whatever the number
/// of threads: the compiler then makes one version of its body, and one version has one rounding.
void on_all_threads(void (*work)(void* data, int share, int shares), void* data, bool alone);

/// Calls body(k) once for every k in [begin, end), on all threads unless alone (loops too small to be worth it).  body
/// must not throw and writes only what belongs to item k.
template <class Body>
void for_each_item(int begin, int end, Body&& body, bool alone = false) {
  struct Range {
    int begin, count;
    std::remove_reference_t<Body>& body;
  } range{begin, end - begin, body};
  on_all_threads(
      [](void* data, int share, int shares) {
        const Range& r = *static_cast<Range*>(data);
        const auto first = [&](int s) {
          return r.begin + static_cast<int>(static_cast<long long>(r.count) * s / shares);
        };
        for (int k = first(share); k < first(share + 1); ++k) do_item(r.body, k);
      },
      &range, alone || end - begin < 2);
}

/// Sum of item(k) over [begin, end) in the order of k.  Scratch holds the partial sums (grown once, then reused).
template <class Item>
double ordered_sum(int begin, int end, std::vector<double>& scratch, Item&& item) {
  if (scratch.size() < static_cast<std::size_t>(std::max(0, end - begin))) scratch.resize(end - begin);
  for_each_item(begin, end, [&](int k) { scratch[k - begin] = item(k); });
  double sum = 0;
  for (int k = begin; k < end; ++k) sum += scratch[k - begin];
  return sum;
}

/// Asks for values [begin, end) of a row that will soon be read or, with for_writing, written.  For walks down short
/// pieces of rows, which the processor does not foresee.
template <bool for_writing = false, class T>
inline void fetch_ahead(const T* row, int begin, int end) {
  constexpr int line = 64 / sizeof(T);
  for (int k = begin; k < end; k += line) __builtin_prefetch(row + k, for_writing ? 1 : 0, 2);
}

/// Inner loop that the compiler may turn into vector instructions: calls of body(k) must not depend on one another.
template <class Body>
inline void vector_loop(int begin, int end, Body&& body) {
#pragma omp simd
  for (int k = begin; k < end; ++k) body(k);
}

/// Sum of term(k) with vector instructions.  The order of additions is fixed by the binary, not by the data or threads.
template <class Term>
inline double vector_sum(int begin, int end, Term&& term) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (int k = begin; k < end; ++k) sum += term(k);
  return sum;
}

/// The same in single precision: for sums of which six digits are enough.
template <class Term>
inline double vector_sum_f(int begin, int end, Term&& term) {
  float sum = 0;
#pragma omp simd reduction(+ : sum)
  for (int k = begin; k < end; ++k) sum += term(k);
  return static_cast<double>(sum);
}

/// Largest term(k) with vector instructions, at least `lowest`.
template <class Term>
inline double vector_largest(int begin, int end, double lowest, Term&& term) {
  double result = lowest;
#pragma omp simd reduction(max : result)
  for (int k = begin; k < end; ++k) result = term(k) > result ? term(k) : result;
  return result;
}

/// Largest item(k) over [begin, end); lowest when the range is empty.
template <class Item>
double largest(int begin, int end, std::vector<double>& scratch, double lowest, Item&& item) {
  if (scratch.size() < static_cast<std::size_t>(std::max(0, end - begin))) scratch.resize(end - begin);
  for_each_item(begin, end, [&](int k) { scratch[k - begin] = item(k); });
  double result = lowest;
  for (int k = begin; k < end; ++k) result = std::max(result, scratch[k - begin]);
  return result;
}

}  // namespace livebed::base
