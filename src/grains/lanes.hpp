#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

/// Several grains at a time.  The grain loop goes through slices of eight grains; one vector holds a part of a slice,
/// as many as the instruction set has lanes.  The laws are written once for `double` and for `Lanes`; this file is the
/// only one that knows vector instructions, and each of them has a plain form beside it.

// The kernels are compiled once for each instruction set.  What they share as templates and inline functions must not
// be mixed up by the linker, so it lives in a namespace of its own for each set.
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define LIVEBED_SET avx512
#define LIVEBED_WIDTH 8
#elif defined(__AVX2__) && defined(__FMA__)
#define LIVEBED_SET avx2
#define LIVEBED_WIDTH 4
#else
#define LIVEBED_SET plain
#define LIVEBED_WIDTH 2
#endif

namespace livebed::grains {

/// Grains in a slice, whatever the instruction set: the layout of lists and records does not depend on it.
inline constexpr int lanes = 8;

inline namespace LIVEBED_SET {

/// Grains in a vector: a part of a slice.
inline constexpr int width = LIVEBED_WIDTH;

using Lanes = double __attribute__((vector_size(8 * LIVEBED_WIDTH)));
using Mask = std::int64_t __attribute__((vector_size(8 * LIVEBED_WIDTH)));  ///< a lane is -1 (true) or 0 (false)

/// Two rows of lanes in single precision: what takes one row in doubles.  A row holds a part of a slice; the two are
/// twice the same grains with a pair of neighbours each.
using Singles = float __attribute__((vector_size(8 * LIVEBED_WIDTH)));
using SingleMask = std::int32_t __attribute__((vector_size(8 * LIVEBED_WIDTH)));

inline Lanes all_lanes(double a) { return Lanes{} + a; }

inline Lanes load(const double* from) {
  Lanes a;
  std::memcpy(&a, from, sizeof a);
  return a;
}
inline void store(double* to, const Lanes& a) { std::memcpy(to, &a, sizeof a); }
/// A row of singles.
using SingleRow = float __attribute__((vector_size(4 * LIVEBED_WIDTH)));

[[gnu::always_inline]] inline Singles join_rows(const SingleRow& first, const SingleRow& second) {
#if LIVEBED_WIDTH == 8
  return __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#elif LIVEBED_WIDTH == 4
  return __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7);
#else
  return __builtin_shufflevector(first, second, 0, 1, 2, 3);
#endif
}
[[gnu::always_inline]] inline SingleRow first_row(const Singles& a) {
#if LIVEBED_WIDTH == 8
  return __builtin_shufflevector(a, a, 0, 1, 2, 3, 4, 5, 6, 7);
#elif LIVEBED_WIDTH == 4
  return __builtin_shufflevector(a, a, 0, 1, 2, 3);
#else
  return __builtin_shufflevector(a, a, 0, 1);
#endif
}
[[gnu::always_inline]] inline SingleRow second_row(const Singles& a) {
#if LIVEBED_WIDTH == 8
  return __builtin_shufflevector(a, a, 8, 9, 10, 11, 12, 13, 14, 15);
#elif LIVEBED_WIDTH == 4
  return __builtin_shufflevector(a, a, 4, 5, 6, 7);
#else
  return __builtin_shufflevector(a, a, 2, 3);
#endif
}

[[gnu::always_inline]] inline SingleRow load_row(const float* from) {
  SingleRow a;
  std::memcpy(&a, from, sizeof a);
  return a;
}
/// Rows of singles that lie one after the other, `lanes` places apart.
[[gnu::always_inline]] inline Singles load_rows(const float* from) {
  if constexpr (width == lanes) {
    Singles a;
    std::memcpy(&a, from, sizeof a);
    return a;
  } else {
    return join_rows(load_row(from), load_row(from + lanes));
  }
}
[[gnu::always_inline]] inline void store_rows(float* to, const Singles& a) {
  if constexpr (width == lanes) {
    std::memcpy(to, &a, sizeof a);
  } else {
    const SingleRow first = first_row(a), second = second_row(a);
    std::memcpy(to, &first, sizeof first);
    std::memcpy(to + lanes, &second, sizeof second);
  }
}

inline double select(bool which, double a, double b) { return which ? a : b; }
inline Lanes select(const Mask& which, const Lanes& a, const Lanes& b) { return which ? a : b; }
inline Singles select(const SingleMask& which, const Singles& a, const Singles& b) { return which ? a : b; }

template <class Real>
inline Real larger(const Real& a, const Real& b) {
  return select(a > b, a, b);
}
template <class Real>
inline Real smaller(const Real& a, const Real& b) {
  return select(a < b, a, b);
}

[[gnu::always_inline]] inline double root(double a) { return std::sqrt(a); }
[[gnu::always_inline]] inline Lanes root(const Lanes& a) {
#if LIVEBED_WIDTH == 8
  return (Lanes)_mm512_maskz_sqrt_pd(0xff, (__m512d)a);
#elif LIVEBED_WIDTH == 4
  return (Lanes)_mm256_sqrt_pd((__m256d)a);
#else
  return Lanes{std::sqrt(a[0]), std::sqrt(a[1])};
#endif
}
[[gnu::always_inline]] inline Singles root(const Singles& a) {
#if LIVEBED_WIDTH == 8
  return (Singles)_mm512_maskz_sqrt_ps(0xffff, (__m512)a);
#elif LIVEBED_WIDTH == 4
  return (Singles)_mm256_sqrt_ps((__m256)a);
#else
  return Singles{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}

[[gnu::always_inline]] inline SingleRow root_row(const SingleRow& a) {
#if LIVEBED_WIDTH == 8
  return (SingleRow)_mm256_sqrt_ps((__m256)a);
#elif LIVEBED_WIDTH == 4
  return (SingleRow)_mm_sqrt_ps((__m128)a);
#else
  return SingleRow{std::sqrt(a[0]), std::sqrt(a[1])};
#endif
}

/// A row of doubles in single precision, and back.
[[gnu::always_inline]] inline SingleRow narrow(const Lanes& a) {
#if LIVEBED_WIDTH == 8
  return (SingleRow)_mm512_maskz_cvtpd_ps(0xff, (__m512d)a);
#elif LIVEBED_WIDTH == 4
  return (SingleRow)_mm256_cvtpd_ps((__m256d)a);
#else
  return SingleRow{static_cast<float>(a[0]), static_cast<float>(a[1])};
#endif
}
[[gnu::always_inline]] inline Lanes widen(const SingleRow& a) {
#if LIVEBED_WIDTH == 8
  return (Lanes)_mm512_maskz_cvtps_pd(0xff, (__m256)a);
#elif LIVEBED_WIDTH == 4
  return (Lanes)_mm256_cvtps_pd((__m128)a);
#else
  return Lanes{a[0], a[1]};
#endif
}

/// 1/sqrt(a) to a few units of the last place: a first guess in single precision, whose root and reciprocal take a
/// third of the time of those in double, and one step of third order.
[[gnu::always_inline]] inline Lanes reciprocal_root(const Lanes& a) {
  const SingleRow guess = 1.0f / root_row(narrow(a));
  const Lanes y = widen(guess), h = 1.0 - a * (y * y);
  return y + (y * h) * (0.5 + 0.375 * h);
}

/// The sum of both rows, in both of them.
[[gnu::always_inline]] inline Singles sum_of_rows(const Singles& a) {
  return a + join_rows(second_row(a), first_row(a));
}

/// Doubles that hold two singles each: the first singles of two rows of them, the second ones, and those of the first
/// row together again.
[[gnu::always_inline]] inline Singles first_halves(const Lanes& first, const Lanes& second) {
#if LIVEBED_WIDTH == 8
  return __builtin_shufflevector((Singles)first, (Singles)second, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28,
                                 30);
#elif LIVEBED_WIDTH == 4
  return __builtin_shufflevector((Singles)first, (Singles)second, 0, 2, 4, 6, 8, 10, 12, 14);
#else
  return __builtin_shufflevector((Singles)first, (Singles)second, 0, 2, 4, 6);
#endif
}
[[gnu::always_inline]] inline Singles second_halves(const Lanes& first, const Lanes& second) {
#if LIVEBED_WIDTH == 8
  return __builtin_shufflevector((Singles)first, (Singles)second, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29,
                                 31);
#elif LIVEBED_WIDTH == 4
  return __builtin_shufflevector((Singles)first, (Singles)second, 1, 3, 5, 7, 9, 11, 13, 15);
#else
  return __builtin_shufflevector((Singles)first, (Singles)second, 1, 3, 5, 7);
#endif
}
[[gnu::always_inline]] inline Lanes join_halves(const Singles& first, const Singles& second) {
#if LIVEBED_WIDTH == 8
  return (Lanes)__builtin_shufflevector(first, second, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
#elif LIVEBED_WIDTH == 4
  return (Lanes)__builtin_shufflevector(first, second, 0, 8, 1, 9, 2, 10, 3, 11);
#else
  return (Lanes)__builtin_shufflevector(first, second, 0, 4, 1, 5);
#endif
}

/// One bit a lane.
inline unsigned bits(const Mask& a) {
#if LIVEBED_WIDTH == 8
  return _mm512_movepi64_mask((__m512i)a);
#elif LIVEBED_WIDTH == 4
  return static_cast<unsigned>(_mm256_movemask_pd((__m256d)a));
#else
  return static_cast<unsigned>((a[0] & 1) | (a[1] & 2));
#endif
}

/// Writes first + l for every lane l whose bit is set, in order; returns how many.  `width` places must be free.
inline int append_lanes(std::int32_t* to, std::int32_t first, unsigned which) {
#if LIVEBED_WIDTH == 8
  const __m256i all = _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_maskz_compress_epi32(static_cast<__mmask8>(which), all));
#else
  std::int32_t* next = to;
  for (unsigned left = which; left != 0; left &= left - 1) *next++ = first + std::countr_zero(left);
#endif
  return std::popcount(which);
}

/// Sum of the lanes, in pairs.
inline double sum(const Lanes& a) {
#if LIVEBED_WIDTH == 8
  return ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7]));
#elif LIVEBED_WIDTH == 4
  return (a[0] + a[1]) + (a[2] + a[3]);
#else
  return a[0] + a[1];
#endif
}

#if LIVEBED_WIDTH == 8

/// [records[i], records[j]] of four doubles each.
[[gnu::always_inline]] inline Lanes join_fours(const double* records, std::int32_t i, std::int32_t j) {
  const double *first = records + 4 * static_cast<std::ptrdiff_t>(i),
               *second = records + 4 * static_cast<std::ptrdiff_t>(j);
  // A masked broadcast from memory spares the shuffle unit, which the transposition needs.
  return (Lanes)_mm512_mask_broadcast_f64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(first)), 0xf0,
                                            _mm256_loadu_pd(second));
}

/// [records[at[0]], records[at[2]], records[at[4]], records[at[6]]] of two doubles each.
[[gnu::always_inline]] inline Lanes join_twos(const double* records, const std::int32_t* at) {
  const auto record = [&](int l) { return records + 2 * static_cast<std::ptrdiff_t>(at[l]); };
  __m512d four = _mm512_castpd128_pd512(_mm_loadu_pd(record(0)));
  four = _mm512_mask_broadcast_f64x2(four, 0x0c, _mm_loadu_pd(record(2)));
  four = _mm512_mask_broadcast_f64x2(four, 0x30, _mm_loadu_pd(record(4)));
  return (Lanes)_mm512_mask_broadcast_f64x2(four, 0xc0, _mm_loadu_pd(record(6)));
}

/// Turns records of four doubles, given as [record l, record l+4] for l = 0 to 3, into lanes: a[f] holds field f of
/// all.
[[gnu::always_inline]] inline void transpose_fours(const Lanes p[4], Lanes a[4]) {
  const Lanes even01 = __builtin_shufflevector(p[0], p[1], 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes odd01 = __builtin_shufflevector(p[0], p[1], 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes even23 = __builtin_shufflevector(p[2], p[3], 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes odd23 = __builtin_shufflevector(p[2], p[3], 1, 9, 3, 11, 5, 13, 7, 15);
  a[0] = __builtin_shufflevector(even01, even23, 0, 1, 8, 9, 4, 5, 12, 13);
  a[1] = __builtin_shufflevector(odd01, odd23, 0, 1, 8, 9, 4, 5, 12, 13);
  a[2] = __builtin_shufflevector(even01, even23, 2, 3, 10, 11, 6, 7, 14, 15);
  a[3] = __builtin_shufflevector(odd01, odd23, 2, 3, 10, 11, 6, 7, 14, 15);
}

/// Records of four doubles at as many places as a vector has lanes: a[f] holds field f of all.
[[gnu::always_inline]] inline void load_fours(const double* records, const std::int32_t* at, Lanes a[4]) {
  const Lanes p[4] = {join_fours(records, at[0], at[4]), join_fours(records, at[1], at[5]),
                      join_fours(records, at[2], at[6]), join_fours(records, at[3], at[7])};
  transpose_fours(p, a);
}

/// The same for records of two doubles.
[[gnu::always_inline]] inline void load_twos(const double* records, const std::int32_t* at, Lanes a[2]) {
  const Lanes even = join_twos(records, at), odd = join_twos(records, at + 1);
  a[0] = __builtin_shufflevector(even, odd, 0, 8, 2, 10, 4, 12, 6, 14);
  a[1] = __builtin_shufflevector(even, odd, 1, 9, 3, 11, 5, 13, 7, 15);
}

/// Consecutive records of four doubles from four lanes.
[[gnu::always_inline]] inline void store_fours(double* records, const Lanes& a, const Lanes& b, const Lanes& c,
                                               const Lanes& d) {
  const Lanes ab_even = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes ab_odd = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes cd_even = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes cd_odd = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes r02 = __builtin_shufflevector(ab_even, cd_even, 0, 1, 8, 9, 2, 3, 10, 11);
  const Lanes r13 = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 8, 9, 2, 3, 10, 11);
  const Lanes r46 = __builtin_shufflevector(ab_even, cd_even, 4, 5, 12, 13, 6, 7, 14, 15);
  const Lanes r57 = __builtin_shufflevector(ab_odd, cd_odd, 4, 5, 12, 13, 6, 7, 14, 15);
  store(records, __builtin_shufflevector(r02, r13, 0, 1, 2, 3, 8, 9, 10, 11));
  store(records + 8, __builtin_shufflevector(r02, r13, 4, 5, 6, 7, 12, 13, 14, 15));
  store(records + 16, __builtin_shufflevector(r46, r57, 0, 1, 2, 3, 8, 9, 10, 11));
  store(records + 24, __builtin_shufflevector(r46, r57, 4, 5, 6, 7, 12, 13, 14, 15));
}

/// Consecutive records of two doubles from two lanes.
[[gnu::always_inline]] inline void store_twos(double* records, const Lanes& a, const Lanes& b) {
  store(records, __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11));
  store(records + 8, __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15));
}

#elif LIVEBED_WIDTH == 4

/// Turns four rows of four into four columns of four.
[[gnu::always_inline]] inline void transpose(const Lanes p[4], Lanes a[4]) {
  const Lanes even01 = __builtin_shufflevector(p[0], p[1], 0, 4, 2, 6);
  const Lanes odd01 = __builtin_shufflevector(p[0], p[1], 1, 5, 3, 7);
  const Lanes even23 = __builtin_shufflevector(p[2], p[3], 0, 4, 2, 6);
  const Lanes odd23 = __builtin_shufflevector(p[2], p[3], 1, 5, 3, 7);
  a[0] = __builtin_shufflevector(even01, even23, 0, 1, 4, 5);
  a[1] = __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5);
  a[2] = __builtin_shufflevector(even01, even23, 2, 3, 6, 7);
  a[3] = __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7);
}

[[gnu::always_inline]] inline void load_fours(const double* records, const std::int32_t* at, Lanes a[4]) {
  const auto record = [&](int l) { return load(records + 4 * static_cast<std::ptrdiff_t>(at[l])); };
  const Lanes p[4] = {record(0), record(1), record(2), record(3)};
  transpose(p, a);
}

[[gnu::always_inline]] inline Lanes join_twos(const double* records, std::int32_t i, std::int32_t j) {
  return (Lanes)_mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(records + 2 * static_cast<std::ptrdiff_t>(i))),
                                     _mm_loadu_pd(records + 2 * static_cast<std::ptrdiff_t>(j)), 1);
}

[[gnu::always_inline]] inline void load_twos(const double* records, const std::int32_t* at, Lanes a[2]) {
  const Lanes even = join_twos(records, at[0], at[2]), odd = join_twos(records, at[1], at[3]);
  a[0] = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
  a[1] = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
}

[[gnu::always_inline]] inline void store_fours(double* records, const Lanes& a, const Lanes& b, const Lanes& c,
                                               const Lanes& d) {
  const Lanes p[4] = {a, b, c, d};
  Lanes r[4];
  transpose(p, r);
  for (int l = 0; l < 4; ++l) store(records + 4 * l, r[l]);
}

[[gnu::always_inline]] inline void store_twos(double* records, const Lanes& a, const Lanes& b) {
  const Lanes even = __builtin_shufflevector(a, b, 0, 4, 2, 6), odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  store(records, __builtin_shufflevector(even, odd, 0, 1, 4, 5));
  store(records + 4, __builtin_shufflevector(even, odd, 2, 3, 6, 7));
}

#else

[[gnu::always_inline]] inline void load_fours(const double* records, const std::int32_t* at, Lanes a[4]) {
  const double *first = records + 4 * static_cast<std::ptrdiff_t>(at[0]),
               *second = records + 4 * static_cast<std::ptrdiff_t>(at[1]);
  for (int f = 0; f < 4; ++f) a[f] = Lanes{first[f], second[f]};
}

[[gnu::always_inline]] inline void load_twos(const double* records, const std::int32_t* at, Lanes a[2]) {
  const double *first = records + 2 * static_cast<std::ptrdiff_t>(at[0]),
               *second = records + 2 * static_cast<std::ptrdiff_t>(at[1]);
  for (int f = 0; f < 2; ++f) a[f] = Lanes{first[f], second[f]};
}

[[gnu::always_inline]] inline void store_fours(double* records, const Lanes& a, const Lanes& b, const Lanes& c,
                                               const Lanes& d) {
  for (int l = 0; l < 2; ++l) {
    records[4 * l] = a[l], records[4 * l + 1] = b[l];
    records[4 * l + 2] = c[l], records[4 * l + 3] = d[l];
  }
}

[[gnu::always_inline]] inline void store_twos(double* records, const Lanes& a, const Lanes& b) {
  for (int l = 0; l < 2; ++l) records[2 * l] = a[l], records[2 * l + 1] = b[l];
}

#endif

}  // namespace LIVEBED_SET

}  // namespace livebed::grains
