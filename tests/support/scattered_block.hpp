// A small block of particles far from rest, its elastic energy, and derivatives of that by differences.
#pragma once
#include "tests/support/solids.hpp"

namespace brisance::testing {

/// 3 x 3 x `layers` cells of unit size, bricks or Voronoi, E = rho = 1.
inline solid::SolidConfig block_of_cells(Index layers, Real poisson_ratio, bool voronoi) {
  solid::SolidConfig config = one_material(1, 1, poisson_ratio);
  config.body.push_back(box({0, 0, 0}, {3, 3, static_cast<Real>(layers)}, {3, 3, layers}));
  if (voronoi) {
    config.body[0].tessellation = "voronoi";
    config.body[0].particles = 9 * layers;
    config.body[0].lloyd = 3;
  }
  return config;
}

/// Positions off by 0.3 h, rotations of about 1 rad.
inline void scatter(solid::Solid& solid, Random& random) {
  for (solid::Pose& p : solid.pose()) {
    p.x += 0.3 * random.vector();
    p.q = rotation(random.vector());
  }
  solid.compute_forces();
}

inline Real elastic(Lone& body) {
  body.solid.compute_forces();
  return body.measure().value(solid::Measures::elastic);
}

/// -dE/ds along a one-parameter change, by sixth-order differences.
template <class Change>
Real slope(Lone& body, Change change) {
  Real const h = 2e-3;
  solid::Solid::Saved saved;
  body.solid.save(saved);
  auto at = [&](Real s) {
    body.solid.restore(saved);
    change(s);
    return elastic(body);
  };
  Real const value = -(45 * (at(h) - at(-h)) - 9 * (at(2 * h) - at(-2 * h)) + (at(3 * h) - at(-3 * h))) / (60 * h);
  body.solid.restore(saved);
  return value;
}

}  // namespace brisance::testing
