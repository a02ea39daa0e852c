// Plain 3-vectors and 3x3 matrices: trivially copyable, so that halos and files move them as bytes.
#pragma once
#include <cmath>

#include "core/base/real.hpp"

namespace brisance {

struct Vec3 {
  Real x = 0, y = 0, z = 0;
  Real& operator[](int d) { return d == 0 ? x : d == 1 ? y : z; }
  Real operator[](int d) const { return d == 0 ? x : d == 1 ? y : z; }
  Vec3& operator+=(Vec3 const& b) { return x += b.x, y += b.y, z += b.z, *this; }
  Vec3& operator-=(Vec3 const& b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  Vec3& operator*=(Real s) { return x *= s, y *= s, z *= s, *this; }
  bool operator==(Vec3 const&) const = default;
};

inline Vec3 operator+(Vec3 const& a, Vec3 const& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 const& a, Vec3 const& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 const& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(Real s, Vec3 const& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec3 operator*(Vec3 const& a, Real s) { return s * a; }
inline Vec3 operator/(Vec3 const& a, Real s) { return {a.x / s, a.y / s, a.z / s}; }
inline Real dot(Vec3 const& a, Vec3 const& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 const& a, Vec3 const& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real norm2(Vec3 const& a) { return dot(a, a); }
inline Real norm(Vec3 const& a) { return std::sqrt(norm2(a)); }
inline Vec3 normalized(Vec3 const& a) { return a / norm(a); }

/// Does a place lie in a box, as far as the first `dimension` coordinates tell?
inline bool in_box(Vec3 const& p, Vec3 const& low, Vec3 const& high, int dimension, Real slack = 0) {
  for (int d = 0; d < dimension; ++d)
    if (p[d] < low[d] - slack || p[d] > high[d] + slack) return false;
  return true;
}

}  // namespace brisance
