// Symmetric 3x3 tensors of six numbers: xx, yy, zz, xy, xz, yz.
#pragma once
#include <array>
#include <cmath>

#include "core/base/vec3.hpp"

namespace brisance::solid {

struct Symmetric {
  std::array<double, 6> c{};
  bool operator==(Symmetric const&) const = default;
};

inline Symmetric operator*(Real s, Symmetric a) {
  for (double& x : a.c) x *= s;
  return a;
}
inline Symmetric operator+(Symmetric a, Symmetric const& b) {
  for (std::size_t n = 0; n < 6; ++n) a.c[n] += b.c[n];
  return a;
}
inline Symmetric operator-(Symmetric a, Symmetric const& b) {
  for (std::size_t n = 0; n < 6; ++n) a.c[n] -= b.c[n];
  return a;
}
/// a : b
inline Real contract(Symmetric const& a, Symmetric const& b) {
  return a.c[0] * b.c[0] + a.c[1] * b.c[1] + a.c[2] * b.c[2] +
         2 * (a.c[3] * b.c[3] + a.c[4] * b.c[4] + a.c[5] * b.c[5]);
}
inline Real trace(Symmetric const& a) { return a.c[0] + a.c[1] + a.c[2]; }
inline Symmetric deviator(Symmetric a) {
  Real const mean = trace(a) / 3;
  for (std::size_t n = 0; n < 3; ++n) a.c[n] -= mean;
  return a;
}
/// a a^T
inline Symmetric dyad(Vec3 const& a) { return {{a.x * a.x, a.y * a.y, a.z * a.z, a.x * a.y, a.x * a.z, a.y * a.z}}; }
inline Vec3 operator*(Symmetric const& t, Vec3 const& a) {
  return {t.c[0] * a.x + t.c[3] * a.y + t.c[4] * a.z, t.c[3] * a.x + t.c[1] * a.y + t.c[5] * a.z,
          t.c[4] * a.x + t.c[5] * a.y + t.c[2] * a.z};
}
/// sqrt(3/2 s:s) of a deviator: the equivalent stress of von Mises.
inline Real equivalent(Symmetric const& s) { return std::sqrt(1.5 * contract(s, s)); }

}  // namespace brisance::solid
