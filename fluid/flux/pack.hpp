// The vector of a kernel: one alias for the library's pack of doubles, and the few operations a kernel writes on values
// of any V, a Pack in the sweeps or a double in unit tests. Multiply-adds are real ones in every build: the bits depend
// on it.
#pragma once
// GCC 12 calls the "undefined" operands of its own intrinsics uninitialized (its bug 105593).
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>
#pragma GCC diagnostic pop

#include <cmath>
#include <limits>
#include <xsimd/xsimd.hpp>

#include "core/base/real.hpp"

#if !defined(__FMA__)
#error "Brisance needs fused multiply-adds: compile for x86-64-v3 or later"
#endif

#define BRISANCE_INLINE inline __attribute__((always_inline))
#define BRISANCE_UNROLL _Pragma("GCC unroll 16")

namespace brisance::fluid {

/// As many doubles as one register of this build holds.
using Pack = xsimd::batch<double>;
using PackMask = xsimd::batch_bool<double>;

template <class V>
struct PackTraits;
template <>
struct PackTraits<Real> {
  using Mask = bool;
  static constexpr int lanes = 1;
};
template <>
struct PackTraits<Pack> {
  using Mask = PackMask;
  static constexpr int lanes = static_cast<int>(Pack::size);
};
/// What a comparison of two V gives.
template <class V>
using Mask = typename PackTraits<V>::Mask;
template <class V>
inline constexpr int lanes_of = PackTraits<V>::lanes;

// ---- one double

using brisance::max;
using brisance::min;
/// a b + c with one rounding.
BRISANCE_INLINE Real fma(Real a, Real b, Real c) { return __builtin_fma(a, b, c); }
/// c - a b with one rounding.
BRISANCE_INLINE Real fnma(Real a, Real b, Real c) { return __builtin_fma(-a, b, c); }
/// a b - c with one rounding.
BRISANCE_INLINE Real fms(Real a, Real b, Real c) { return __builtin_fma(a, b, -c); }
BRISANCE_INLINE Real sqrt(Real a) { return std::sqrt(a); }
BRISANCE_INLINE Real exp(Real a) { return std::exp(a); }
BRISANCE_INLINE Real abs(Real a) { return std::fabs(a); }
/// True where the sign bit is set.
BRISANCE_INLINE bool negative(Real a) { return std::signbit(a); }
BRISANCE_INLINE Real select(bool m, Real a, Real b) { return m ? a : b; }
/// a, its sign changed where s is negative.
BRISANCE_INLINE Real flip(Real a, Real s) { return std::signbit(s) ? -a : a; }
/// minmod(a, b, 4a - b, 4b - a): the curvature of the limiter (theory/fluid.md 2.5).
BRISANCE_INLINE Real curvature(Real a, Real b) {
  if (std::signbit(a) != std::signbit(b)) return 0;
  Real const low = min(abs(a), abs(b)), high = max(abs(a), abs(b));
  return std::copysign(max(min(low, fma(4.0, low, -high)), 0.0), a);
}
BRISANCE_INLINE bool any_of(bool m) { return m; }
BRISANCE_INLINE std::uint32_t bits_of(bool m) { return m ? 1u : 0u; }
BRISANCE_INLINE void store(Real* p, Real v) { *p = v; }

// ---- a pack

#if defined(__AVX512DQ__)

BRISANCE_INLINE Pack fma(Pack a, Pack b, Pack c) { return _mm512_fmadd_pd(a, b, c); }
BRISANCE_INLINE Pack fnma(Pack a, Pack b, Pack c) { return _mm512_fnmadd_pd(a, b, c); }
BRISANCE_INLINE Pack fms(Pack a, Pack b, Pack c) { return _mm512_fmsub_pd(a, b, c); }
BRISANCE_INLINE Pack min(Pack a, Pack b) { return _mm512_min_pd(a, b); }
BRISANCE_INLINE Pack max(Pack a, Pack b) { return _mm512_max_pd(a, b); }
BRISANCE_INLINE Pack sqrt(Pack a) { return _mm512_sqrt_pd(a); }
BRISANCE_INLINE Pack abs(Pack a) { return _mm512_abs_pd(a); }
BRISANCE_INLINE PackMask negative(Pack a) { return _mm512_movepi64_mask(_mm512_castpd_si512(a)); }
BRISANCE_INLINE Pack select(PackMask m, Pack a, Pack b) {
  return _mm512_mask_blend_pd(static_cast<__mmask8>(m.data), b, a);
}
BRISANCE_INLINE Pack flip(Pack a, Pack s) {
  // a ^ (s & sign bit) in one operation
  return _mm512_castsi512_pd(_mm512_ternarylogic_epi64(_mm512_castpd_si512(a), _mm512_castpd_si512(s),
                                                       _mm512_castpd_si512(_mm512_set1_pd(-0.0)), 0x78));
}
BRISANCE_INLINE Pack curvature(Pack a, Pack b) {
  constexpr int smaller_magnitude = 0b1010, larger_magnitude = 0b1011;
  __m512d const low = _mm512_range_pd(a, b, smaller_magnitude), high = _mm512_range_pd(a, b, larger_magnitude);
  __m512d const size =
      _mm512_max_pd(_mm512_min_pd(low, _mm512_fmsub_pd(_mm512_set1_pd(4), low, high)), _mm512_setzero_pd());
  __m512i const sign_a = _mm512_castpd_si512(a), differ = _mm512_xor_si512(sign_a, _mm512_castpd_si512(b));
  // size | (a & sign bit) where the signs agree, else 0
  return _mm512_castsi512_pd(_mm512_maskz_ternarylogic_epi64(_knot_mask8(_mm512_movepi64_mask(differ)),
                                                             _mm512_castpd_si512(size), sign_a,
                                                             _mm512_castpd_si512(_mm512_set1_pd(-0.0)), 0xF8));
}
BRISANCE_INLINE std::uint32_t bits_of(PackMask m) { return m.data; }
/// The transpose of a tile of lanes x lanes values.
BRISANCE_INLINE void transpose(Pack (&row)[8]) {
  __m512d pair[8], quad[8];
  BRISANCE_UNROLL for (int i = 0; i < 8; i += 2) {
    pair[i] = _mm512_unpacklo_pd(row[i], row[i + 1]);
    pair[i + 1] = _mm512_unpackhi_pd(row[i], row[i + 1]);
  }
  BRISANCE_UNROLL for (int half = 0; half < 8; half += 4) {
    BRISANCE_UNROLL for (int i = half; i < half + 2; ++i) {
      quad[i] = _mm512_shuffle_f64x2(pair[i], pair[i + 2], 0b10001000);
      quad[i + 2] = _mm512_shuffle_f64x2(pair[i], pair[i + 2], 0b11011101);
    }
  }
  BRISANCE_UNROLL for (int i = 0; i < 4; ++i) {
    row[i] = _mm512_shuffle_f64x2(quad[i], quad[i + 4], 0b10001000);
    row[i + 4] = _mm512_shuffle_f64x2(quad[i], quad[i + 4], 0b11011101);
  }
}

#else  // AVX2 and FMA: 4 lanes

BRISANCE_INLINE Pack fma(Pack a, Pack b, Pack c) { return _mm256_fmadd_pd(a, b, c); }
BRISANCE_INLINE Pack fnma(Pack a, Pack b, Pack c) { return _mm256_fnmadd_pd(a, b, c); }
BRISANCE_INLINE Pack fms(Pack a, Pack b, Pack c) { return _mm256_fmsub_pd(a, b, c); }
BRISANCE_INLINE Pack min(Pack a, Pack b) { return _mm256_min_pd(a, b); }
BRISANCE_INLINE Pack max(Pack a, Pack b) { return _mm256_max_pd(a, b); }
BRISANCE_INLINE Pack sqrt(Pack a) { return _mm256_sqrt_pd(a); }
BRISANCE_INLINE Pack abs(Pack a) { return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a); }
BRISANCE_INLINE PackMask negative(Pack a) {
  return PackMask(static_cast<__m256d>(a));
}  // blends read the sign bit only
BRISANCE_INLINE Pack select(PackMask m, Pack a, Pack b) { return _mm256_blendv_pd(b, a, m); }
BRISANCE_INLINE Pack flip(Pack a, Pack s) { return _mm256_xor_pd(a, _mm256_and_pd(s, _mm256_set1_pd(-0.0))); }
BRISANCE_INLINE Pack curvature(Pack a, Pack b) {
  Pack const low = min(abs(a), abs(b)), high = max(abs(a), abs(b));
  Pack const size = max(min(low, _mm256_fmsub_pd(_mm256_set1_pd(4), low, high)), Pack(0.0));
  return _mm256_blendv_pd(flip(size, a), _mm256_setzero_pd(), _mm256_xor_pd(a, b));
}
BRISANCE_INLINE std::uint32_t bits_of(PackMask m) { return static_cast<std::uint32_t>(_mm256_movemask_pd(m)); }
BRISANCE_INLINE void transpose(Pack (&row)[4]) {
  __m256d const a = _mm256_unpacklo_pd(row[0], row[1]), b = _mm256_unpackhi_pd(row[0], row[1]);
  __m256d const c = _mm256_unpacklo_pd(row[2], row[3]), d = _mm256_unpackhi_pd(row[2], row[3]);
  row[0] = _mm256_permute2f128_pd(a, c, 0x20), row[2] = _mm256_permute2f128_pd(a, c, 0x31);
  row[1] = _mm256_permute2f128_pd(b, d, 0x20), row[3] = _mm256_permute2f128_pd(b, d, 0x31);
}

#endif

BRISANCE_INLINE bool any_of(PackMask m) { return bits_of(m) != 0; }
BRISANCE_INLINE Pack exp(Pack a) { return xsimd::exp(a); }
BRISANCE_INLINE void store(Real* p, Pack v) { v.store_unaligned(p); }

template <class V>
BRISANCE_INLINE V load(Real const* p) {
  if constexpr (lanes_of<V> == 1)
    return *p;
  else
    return V::load_unaligned(p);
}

}  // namespace brisance::fluid
