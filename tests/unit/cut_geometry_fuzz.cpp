// Random bodies in degenerate places: corners snapped to planes, lines and nodes of the grid, random motion.
#include <gtest/gtest.h>

#include "tests/support/identities.hpp"

namespace brisance::testing {
namespace {

using coupling::Lattice;

class Fuzz {
 public:
  explicit Fuzz(unsigned seed) : random_(seed) {}
  Real uniform(Real low, Real high) { return std::uniform_real_distribution<Real>(low, high)(random_); }
  int pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  /// A coordinate near x: left alone, or on a plane, or off it by 1e-17 to 1e-6 of a cell.
  Real snapped(Real x, Real low, Real h) {
    Real const on = low + h * std::nearbyint((x - low) / h);
    switch (pick(4)) {
      case 0:
        return x;
      case 1:
        return on + h * (pick(2) ? 1 : -1) * std::pow(10.0, uniform(-17, -6));
      default:
        return on;
    }
  }
  Vec3 snapped(Vec3 p, Lattice const& l) {
    for (int d = 0; d < l.dimension; ++d) p[d] = snapped(p[d], l.low[d], l.spacing[d]);
    return p;
  }

 private:
  std::mt19937 random_;
};

void expect_identities(Identities const& r, unsigned seed) {
  EXPECT_LE(r.residual, 1e-14) << seed;
  EXPECT_LE(r.mismatch, 1e-13) << seed;
  EXPECT_LE(r.cell_law, 1e-13) << seed;
  EXPECT_LE(r.prism, 1e-13) << seed;
}

TEST(CutGeometryFuzz, BodiesInSpace) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    Fuzz f(seed);
    Lattice const l{3, {f.uniform(-2, 2), f.uniform(-2, 2), 0}, {0.1, 0.1 * f.uniform(0.5, 2), 0.1}};
    Shape s;
    if (f.pick(2)) {
      s = icosphere({f.uniform(-1, 1), f.uniform(-1, 1), f.uniform(-1, 1)}, f.uniform(0.05, 0.4), f.pick(3));
    } else {
      Vec3 const low{f.uniform(-1, 1), f.uniform(-1, 1), f.uniform(-1, 1)};
      s = box(low, low + Vec3{f.uniform(0.02, 0.5), f.uniform(0.02, 0.5), f.uniform(0.02, 0.5)});
    }
    // Snapping may turn the body partly inside out; the identities of cells hold for any closed surface, apertures and
    // closure for those whose winding number is 0 or 1, which small moves of large faces keep.
    bool const gentle = f.pick(2);
    if (!gentle) s = mapped(s, [&](Vec3 p) { return f.snapped(p, l); });
    if (gentle) {
      Vec3 const to = f.snapped(s.points[0], l) - s.points[0];
      s = mapped(s, [&](Vec3 p) { return p + to; });
    }
    Vec3 const move{f.uniform(-0.05, 0.05), f.pick(2) ? 0 : f.uniform(-0.05, 0.05), f.pick(2) ? 0.05 : 0};
    Shape now = mapped(s, [&](Vec3 p) { return p + move; });
    if (f.pick(2))
      now = mapped(now, [&](Vec3 p) { return p + 0.01 * Vec3{std::sin(3 * p.y), std::cos(5 * p.x), p.x}; });
    if (!gentle && f.pick(2)) now = mapped(now, [&](Vec3 p) { return f.snapped(p, l); });
    expect_identities(measure(l, s, now), seed);
    if (HasFailure()) return;
  }
}

TEST(CutGeometryFuzz, PolygonsInThePlane) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    Fuzz f(seed);
    Lattice const l{2, {f.uniform(-2, 2), 0, 0}, {0.1, 0.1 * f.uniform(0.5, 2), 1}};
    Shape s = disk({f.uniform(-1, 1), f.uniform(-1, 1), 0}, f.uniform(0.05, 0.5), 3 + f.pick(9), f.uniform(0, 6));
    s = mapped(s, [&](Vec3 p) { return f.snapped(p, l); });
    Vec3 const move{f.uniform(-0.05, 0.05), f.pick(2) ? 0 : f.uniform(-0.05, 0.05), 0};
    Shape const now = mapped(s, [&](Vec3 p) { return f.pick(2) ? p + move : f.snapped(p + move, l); });
    expect_identities(measure(l, s, now), seed);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace brisance::testing
