// Plain 3x3 matrices (row major) and unit quaternions for rigid particles.
#pragma once
#include <cmath>
#include "core/base/vec3.hpp"

namespace brisance {

/// Row-major 3x3 matrix.
struct Mat3 {
  std::array<Vec3, 3> row{};
  static Mat3 diagonal(Real a, Real b, Real c) { return {{Vec3{a, 0, 0}, Vec3{0, b, 0}, Vec3{0, 0, c}}}; }
  static Mat3 identity() { return diagonal(1, 1, 1); }
  Vec3& operator[](int i) { return row[static_cast<std::size_t>(i)]; }
  Vec3 const& operator[](int i) const { return row[static_cast<std::size_t>(i)]; }
  bool operator==(Mat3 const&) const = default;
};

inline Vec3 operator*(Mat3 const& a, Vec3 const& v) { return {dot(a[0], v), dot(a[1], v), dot(a[2], v)}; }
inline Mat3 transpose(Mat3 const& a) {
  return {{Vec3{a[0].x, a[1].x, a[2].x}, Vec3{a[0].y, a[1].y, a[2].y}, Vec3{a[0].z, a[1].z, a[2].z}}};
}
inline Mat3 operator*(Mat3 const& a, Mat3 const& b) {
  Mat3 const t = transpose(b);
  Mat3 c;
  for (int i = 0; i < 3; ++i) c[i] = {dot(a[i], t[0]), dot(a[i], t[1]), dot(a[i], t[2])};
  return c;
}
inline Mat3 operator*(Real s, Mat3 const& a) { return {{s * a[0], s * a[1], s * a[2]}}; }
inline Mat3 operator+(Mat3 const& a, Mat3 const& b) { return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}}; }
inline Mat3 operator-(Mat3 const& a, Mat3 const& b) { return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}}; }
inline Mat3 outer(Vec3 const& a, Vec3 const& b) { return {{a.x * b, a.y * b, a.z * b}}; }
inline Real trace(Mat3 const& a) { return a[0].x + a[1].y + a[2].z; }

/// Unit quaternion w + (x, y, z): rotation from the reference frame to the current one.
struct Quaternion {
  Real w = 1;
  Vec3 v{};
  bool operator==(Quaternion const&) const = default;
};

inline Quaternion operator*(Quaternion const& a, Quaternion const& b) {
  return {a.w * b.w - dot(a.v, b.v), a.w * b.v + b.w * a.v + cross(a.v, b.v)};
}
inline Quaternion conjugate(Quaternion const& q) { return {q.w, -q.v}; }
/// q r q^-1 for a unit quaternion.
inline Vec3 rotate(Quaternion const& q, Vec3 const& r) {
  Vec3 const t = 2.0 * cross(q.v, r);
  return r + q.w * t + cross(q.v, t);
}
inline Mat3 matrix(Quaternion const& q) {
  return transpose({{rotate(q, {1, 0, 0}), rotate(q, {0, 1, 0}), rotate(q, {0, 0, 1})}});
}
/// Rotation vector of a turn, rad.
inline Vec3 rotation_vector(Quaternion const& q) {
  Real const sine = norm(q.v), sign = q.w < 0 ? -1 : 1;
  if (sine == 0) return {};
  return (2 * sign * std::atan2(sine, sign * q.w) / sine) * q.v;
}

}  // namespace brisance
