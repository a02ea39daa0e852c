// The value type of solid kernels: a double in tests and in rare scalar paths, a pack of four in the hot loops.
// Multiply-adds are written out, so both forms do the same operations whatever the flags of the compiler.
#pragma once
#include <cmath>
#include <xsimd/xsimd.hpp>

#include "core/base/mat3.hpp"

namespace brisance::solid {

#if defined(__AVX2__) && defined(__FMA__)
using Lanes = xsimd::batch<double, xsimd::fma3<xsimd::avx2>>;
#else
#error "The solid kernels need a processor with AVX2 and FMA (x86-64-v3)."
#endif
constexpr Index lanes = 4;
static_assert(Lanes::size == lanes);

/// Four values in the order of the lanes.
inline Lanes four_values(double a, double b, double c, double d) { return _mm256_setr_pd(a, b, c, d); }

inline double multiply_add(double a, double b, double c) { return std::fma(a, b, c); }        ///<  a b + c
inline double multiply_subtract(double a, double b, double c) { return std::fma(a, b, -c); }  ///<  a b - c
inline double subtract_product(double a, double b, double c) { return std::fma(-a, b, c); }   ///<  c - a b
inline double root(double a) { return std::sqrt(a); }
inline Lanes multiply_add(Lanes a, Lanes b, Lanes c) { return xsimd::fma(a, b, c); }
inline Lanes multiply_subtract(Lanes a, Lanes b, Lanes c) { return xsimd::fms(a, b, c); }
inline Lanes subtract_product(Lanes a, Lanes b, Lanes c) { return xsimd::fnma(a, b, c); }
inline Lanes root(Lanes a) { return xsimd::sqrt(a); }

/// 3-vector of values.
template <class V>
struct Triple {
  V x, y, z;
};
template <class V>
inline Triple<V> operator+(Triple<V> const& a, Triple<V> const& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
inline Triple<V> operator-(Triple<V> const& a, Triple<V> const& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
inline Triple<V> operator*(V const& s, Triple<V> const& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class V>
inline V dot(Triple<V> const& a, Triple<V> const& b) {
  return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z));
}
template <class V>
inline Triple<V> cross(Triple<V> const& a, Triple<V> const& b) {
  return {multiply_subtract(a.y, b.z, a.z * b.y), multiply_subtract(a.z, b.x, a.x * b.z),
          multiply_subtract(a.x, b.y, a.y * b.x)};
}
/// s a + b
template <class V>
inline Triple<V> multiply_add(V const& s, Triple<V> const& a, Triple<V> const& b) {
  return {multiply_add(s, a.x, b.x), multiply_add(s, a.y, b.y), multiply_add(s, a.z, b.z)};
}
/// a x b + c
template <class V>
inline Triple<V> cross_add(Triple<V> const& a, Triple<V> const& b, Triple<V> const& c) {
  return {multiply_add(a.y, b.z, subtract_product(a.z, b.y, c.x)),
          multiply_add(a.z, b.x, subtract_product(a.x, b.z, c.y)),
          multiply_add(a.x, b.y, subtract_product(a.y, b.x, c.z))};
}

/// Unit quaternion of values: rotation reference -> current.
template <class V>
struct Turn {
  V w;
  Triple<V> v;
};

/// Rotation matrix by rows, for several vectors turned by one quaternion.
template <class V>
struct Rotation {
  Triple<V> row0, row1, row2;
  explicit Rotation(Turn<V> const& q) {
    V const one(1.0), two(2.0);
    V const x2 = two * q.v.x, y2 = two * q.v.y, z2 = two * q.v.z;
    V const wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
    row0 = {subtract_product(q.v.y, y2, subtract_product(q.v.z, z2, one)), multiply_subtract(q.v.x, y2, wz),
            multiply_add(q.v.x, z2, wy)};
    row1 = {multiply_add(q.v.x, y2, wz), subtract_product(q.v.x, x2, subtract_product(q.v.z, z2, one)),
            multiply_subtract(q.v.y, z2, wx)};
    row2 = {multiply_subtract(q.v.x, z2, wy), multiply_add(q.v.y, z2, wx),
            subtract_product(q.v.x, x2, subtract_product(q.v.y, y2, one))};
  }
  Triple<V> operator*(Triple<V> const& r) const { return {dot(row0, r), dot(row1, r), dot(row2, r)}; }
  /// R^T r
  Triple<V> back(Triple<V> const& r) const { return multiply_add(r.x, row0, multiply_add(r.y, row1, r.z * row2)); }
};

/// Symmetric 3x3 tensor xx, yy, zz, xy, xz, yz times a vector.
template <class V>
inline Triple<V> symmetric_times(V const* t, Triple<V> const& a) {
  return {multiply_add(t[0], a.x, multiply_add(t[3], a.y, t[4] * a.z)),
          multiply_add(t[3], a.x, multiply_add(t[1], a.y, t[5] * a.z)),
          multiply_add(t[4], a.x, multiply_add(t[5], a.y, t[2] * a.z))};
}

/// Four rows of four become four columns, in registers.
inline void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  __m256d const p = _mm256_unpacklo_pd(a, b), q = _mm256_unpackhi_pd(a, b);
  __m256d const r = _mm256_unpacklo_pd(c, d), s = _mm256_unpackhi_pd(c, d);
  a = _mm256_permute2f128_pd(p, r, 0x20), b = _mm256_permute2f128_pd(q, s, 0x20);
  c = _mm256_permute2f128_pd(p, r, 0x31), d = _mm256_permute2f128_pd(q, s, 0x31);
}

}  // namespace brisance::solid
