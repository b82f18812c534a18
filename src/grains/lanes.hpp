#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

/// Eight grains at a time: a slice of the grain loop.  The laws are written once for `double` and for `Lanes`; this
/// file is the only one that knows vector instructions, and each of them has a plain form beside it.
namespace livebed::grains {

inline constexpr int lanes = 8;
#if defined(__AVX512F__) && defined(__AVX512DQ__)

using Lanes = double __attribute__((vector_size(64)));
using Mask = std::int64_t __attribute__((vector_size(64)));  ///< a lane is -1 (true) or 0 (false)

#else

// Compilers take a vector wider than the machine's apart lane by lane, so without AVX-512 it is made of two halves.
using Half = double __attribute__((vector_size(32)));
using HalfMask = std::int64_t __attribute__((vector_size(32)));

struct Mask {
  HalfMask low, high;
  friend Mask operator~(const Mask& a) { return {~a.low, ~a.high}; }
  Mask& operator|=(const Mask& a) { return *this = {low | a.low, high | a.high}; }
};

struct Lanes {
  Half low, high;

  double operator[](int l) const { return l < 4 ? low[l] : high[l - 4]; }

  friend Lanes operator-(const Lanes& a) { return {-a.low, -a.high}; }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return {a.low + b.low, a.high + b.high}; }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return {a.low - b.low, a.high - b.high}; }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return {a.low * b.low, a.high * b.high}; }
  friend Lanes operator+(const Lanes& a, double b) { return {a.low + b, a.high + b}; }
  friend Lanes operator-(const Lanes& a, double b) { return {a.low - b, a.high - b}; }
  friend Lanes operator*(const Lanes& a, double b) { return {a.low * b, a.high * b}; }
  friend Lanes operator+(double a, const Lanes& b) { return {a + b.low, a + b.high}; }
  friend Lanes operator-(double a, const Lanes& b) { return {a - b.low, a - b.high}; }
  friend Lanes operator*(double a, const Lanes& b) { return {a * b.low, a * b.high}; }
  friend Lanes operator/(double a, const Lanes& b) { return {a / b.low, a / b.high}; }
  Lanes& operator+=(const Lanes& a) { return *this = *this + a; }
  Lanes& operator-=(const Lanes& a) { return *this = *this - a; }

  friend Mask operator<(const Lanes& a, const Lanes& b) { return {a.low < b.low, a.high < b.high}; }
  friend Mask operator>(const Lanes& a, const Lanes& b) { return {a.low > b.low, a.high > b.high}; }
  friend Mask operator<=(const Lanes& a, const Lanes& b) { return {a.low <= b.low, a.high <= b.high}; }
  friend Mask operator>=(const Lanes& a, const Lanes& b) { return {a.low >= b.low, a.high >= b.high}; }
};

#endif

inline Lanes all_lanes(double a) { return Lanes{} + a; }

inline Lanes load(const double* from) {
  Lanes a;
  std::memcpy(&a, from, sizeof a);
  return a;
}

inline void store(double* to, const Lanes& a) { std::memcpy(to, &a, sizeof a); }

inline double select(bool which, double a, double b) { return which ? a : b; }
#if defined(__AVX512F__) && defined(__AVX512DQ__)
inline Lanes select(const Mask& which, const Lanes& a, const Lanes& b) { return which ? a : b; }
#else
inline Lanes select(const Mask& which, const Lanes& a, const Lanes& b) {
  return {which.low ? a.low : b.low, which.high ? a.high : b.high};
}
#endif

template <class Real>
inline Real larger(const Real& a, const Real& b) {
  return select(a > b, a, b);
}
template <class Real>
inline Real smaller(const Real& a, const Real& b) {
  return select(a < b, a, b);
}

inline Lanes root(const Lanes& a) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return (Lanes)_mm512_maskz_sqrt_pd(0xff, (__m512d)a);
#else
  double each[lanes];
  std::memcpy(each, &a, sizeof a);
  for (double& one : each) one = std::sqrt(one);
  Lanes result;
  std::memcpy(&result, each, sizeof a);
  return result;
#endif
}

/// One bit a lane.
inline unsigned bits(const Mask& a) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  return _mm512_movepi64_mask((__m512i)a);
#elif defined(__AVX2__)
  return static_cast<unsigned>(_mm256_movemask_pd((__m256d)a.low) | _mm256_movemask_pd((__m256d)a.high) << 4);
#else
  std::int64_t each[lanes];
  std::memcpy(each, &a, sizeof a);
  unsigned result = 0;
  for (int l = 0; l < lanes; ++l) result |= static_cast<unsigned>(each[l] & (1 << l));
  return result;
#endif
}

/// Writes first + l for every lane l whose bit is set, in order; returns how many.  Eight places must be free.
inline int append_lanes(std::int32_t* to, std::int32_t first, unsigned which) {
#if defined(__AVX512F__) && defined(__AVX512VL__)
  const __m256i all = _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_maskz_compress_epi32(static_cast<__mmask8>(which), all));
#else
  std::int32_t* next = to;
  for (unsigned left = which; left != 0; left &= left - 1) *next++ = first + std::countr_zero(left);
#endif
  return std::popcount(which);
}

inline double sum(const Lanes& a) { return ((a[0] + a[1]) + (a[2] + a[3])) + ((a[4] + a[5]) + (a[6] + a[7])); }

#if defined(__AVX512F__) && defined(__AVX512DQ__)

/// [records[i], records[j]] of four doubles each.
inline Lanes join_fours(const double* records, std::int32_t i, std::int32_t j) {
  const double *first = records + 4 * static_cast<std::ptrdiff_t>(i),
               *second = records + 4 * static_cast<std::ptrdiff_t>(j);
  // A masked broadcast from memory spares the shuffle unit, which the transposition needs.
  return (Lanes)_mm512_mask_broadcast_f64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(first)), 0xf0,
                                            _mm256_loadu_pd(second));
}

/// [records[at[0]], records[at[2]], records[at[4]], records[at[6]]] of two doubles each.
inline Lanes join_twos(const double* records, const std::int32_t* at) {
  const auto record = [&](int l) { return records + 2 * static_cast<std::ptrdiff_t>(at[l]); };
  __m512d four = _mm512_castpd128_pd512(_mm_loadu_pd(record(0)));
  four = _mm512_mask_broadcast_f64x2(four, 0x0c, _mm_loadu_pd(record(2)));
  four = _mm512_mask_broadcast_f64x2(four, 0x30, _mm_loadu_pd(record(4)));
  return (Lanes)_mm512_mask_broadcast_f64x2(four, 0xc0, _mm_loadu_pd(record(6)));
}

/// Turns records of four doubles, given as [record l, record l+4] for l = 0 to 3, into lanes: a[f] holds field f of
/// all.
inline void transpose_fours(const Lanes p[4], Lanes a[4]) {
  const Lanes even01 = __builtin_shufflevector(p[0], p[1], 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes odd01 = __builtin_shufflevector(p[0], p[1], 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes even23 = __builtin_shufflevector(p[2], p[3], 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes odd23 = __builtin_shufflevector(p[2], p[3], 1, 9, 3, 11, 5, 13, 7, 15);
  a[0] = __builtin_shufflevector(even01, even23, 0, 1, 8, 9, 4, 5, 12, 13);
  a[1] = __builtin_shufflevector(odd01, odd23, 0, 1, 8, 9, 4, 5, 12, 13);
  a[2] = __builtin_shufflevector(even01, even23, 2, 3, 10, 11, 6, 7, 14, 15);
  a[3] = __builtin_shufflevector(odd01, odd23, 2, 3, 10, 11, 6, 7, 14, 15);
}

/// Records of four doubles at eight places: a[f] holds field f of all eight.
inline void load_fours(const double* records, const std::int32_t* at, Lanes a[4]) {
  const Lanes p[4] = {join_fours(records, at[0], at[4]), join_fours(records, at[1], at[5]),
                      join_fours(records, at[2], at[6]), join_fours(records, at[3], at[7])};
  transpose_fours(p, a);
}

/// The same for records of two doubles.
inline void load_twos(const double* records, const std::int32_t* at, Lanes a[2]) {
  const Lanes even = join_twos(records, at), odd = join_twos(records, at + 1);
  a[0] = __builtin_shufflevector(even, odd, 0, 8, 2, 10, 4, 12, 6, 14);
  a[1] = __builtin_shufflevector(even, odd, 1, 9, 3, 11, 5, 13, 7, 15);
}

/// Eight consecutive records of four doubles from four lanes.
inline void store_fours(double* records, const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d) {
  const Lanes ab_even = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes ab_odd = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes cd_even = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
  const Lanes cd_odd = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  const Lanes r02 = __builtin_shufflevector(ab_even, cd_even, 0, 1, 8, 9, 2, 3, 10, 11);
  const Lanes r13 = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 8, 9, 2, 3, 10, 11);
  const Lanes r46 = __builtin_shufflevector(ab_even, cd_even, 4, 5, 12, 13, 6, 7, 14, 15);
  const Lanes r57 = __builtin_shufflevector(ab_odd, cd_odd, 4, 5, 12, 13, 6, 7, 14, 15);
  const Lanes r01 = __builtin_shufflevector(r02, r13, 0, 1, 2, 3, 8, 9, 10, 11);
  const Lanes r23 = __builtin_shufflevector(r02, r13, 4, 5, 6, 7, 12, 13, 14, 15);
  const Lanes r45 = __builtin_shufflevector(r46, r57, 0, 1, 2, 3, 8, 9, 10, 11);
  const Lanes r67 = __builtin_shufflevector(r46, r57, 4, 5, 6, 7, 12, 13, 14, 15);
  std::memcpy(records, &r01, sizeof r01);
  std::memcpy(records + 8, &r23, sizeof r23);
  std::memcpy(records + 16, &r45, sizeof r45);
  std::memcpy(records + 24, &r67, sizeof r67);
}

/// Eight consecutive records of two doubles from two lanes.
inline void store_twos(double* records, const Lanes& a, const Lanes& b) {
  const Lanes low = __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11);
  const Lanes high = __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15);
  std::memcpy(records, &low, sizeof low);
  std::memcpy(records + 8, &high, sizeof high);
}

#else

// Without AVX-512 the same in halves of four lanes.

inline Half half_of(const double* from) {
  Half a;
  std::memcpy(&a, from, sizeof a);
  return a;
}
/// Turns four rows of four into four columns of four.
inline void transpose(Half a[4]) {
  const Half even01 = __builtin_shufflevector(a[0], a[1], 0, 4, 2, 6);
  const Half odd01 = __builtin_shufflevector(a[0], a[1], 1, 5, 3, 7);
  const Half even23 = __builtin_shufflevector(a[2], a[3], 0, 4, 2, 6);
  const Half odd23 = __builtin_shufflevector(a[2], a[3], 1, 5, 3, 7);
  a[0] = __builtin_shufflevector(even01, even23, 0, 1, 4, 5);
  a[1] = __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5);
  a[2] = __builtin_shufflevector(even01, even23, 2, 3, 6, 7);
  a[3] = __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7);
}

inline void load_fours(const double* records, const std::int32_t* at, Lanes a[4]) {
  for (int which = 0; which < 2; ++which) {
    Half part[4];
    for (int l = 0; l < 4; ++l) part[l] = half_of(records + 4 * static_cast<std::ptrdiff_t>(at[4 * which + l]));
    transpose(part);
    for (int f = 0; f < 4; ++f) (which == 0 ? a[f].low : a[f].high) = part[f];
  }
}

inline void load_twos(const double* records, const std::int32_t* at, Lanes a[2]) {
  double fields[2][lanes];
  for (int l = 0; l < lanes; ++l) {
    const double* const record = records + 2 * static_cast<std::ptrdiff_t>(at[l]);
    fields[0][l] = record[0];
    fields[1][l] = record[1];
  }
  for (int f = 0; f < 2; ++f) a[f] = load(fields[f]);
}

inline void store_fours(double* records, const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d) {
  Half first[4] = {a.low, b.low, c.low, d.low}, last[4] = {a.high, b.high, c.high, d.high};
  transpose(first);
  transpose(last);
  std::memcpy(records, first, sizeof first);
  std::memcpy(records + 16, last, sizeof last);
}

inline void store_twos(double* records, const Lanes& a, const Lanes& b) {
  for (int l = 0; l < lanes; ++l) {
    records[2 * l] = a[l];
    records[2 * l + 1] = b[l];
  }
}

#endif

}  // namespace livebed::grains
