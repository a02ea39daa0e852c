// Means of x and of x x^T over a part of a cell or of a face: what a quadratic profile needs to know of it.
#pragma once
#include <array>

#include "core/base/vec3.hpp"

namespace brisance::coupling {

/// Axes of the six products of two coordinates.
constexpr std::array<std::array<int, 2>, 6> product_axes{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

struct Moments {
  Vec3 mean;                      ///< m, from the point they are taken about
  std::array<Real, 6> product{};  ///< m2, in the order of product_axes
};

/// The same region about a point from which it lies farther by `by`.
inline Moments moved(Moments const& m, Vec3 const& by) {
  Moments result{m.mean + by, m.product};
  for (std::size_t k = 0; k < 6; ++k) {
    auto const [a, b] = product_axes[k];
    result.product[k] += m.mean[a] * by[b] + by[a] * m.mean[b] + by[a] * by[b];
  }
  return result;
}

inline Moments moments_of_point(Vec3 const& x) { return moved(Moments{}, x); }

/// Of a box of this size about its centre.
inline Moments moments_of_box(Vec3 const& size) {
  Moments m;
  for (int d = 0; d < 3; ++d) m.product[static_cast<std::size_t>(d)] = size[d] * size[d] / 12;
  return m;
}

inline Moments operator+(Moments a, Moments const& b) {
  a.mean += b.mean;
  for (std::size_t k = 0; k < 6; ++k) a.product[k] += b.product[k];
  return a;
}
inline Moments operator*(Real f, Moments m) {
  m.mean = f * m.mean;
  for (Real& x : m.product) x *= f;
  return m;
}
inline Moments operator-(Moments const& a, Moments const& b) { return a + -1.0 * b; }

}  // namespace brisance::coupling
