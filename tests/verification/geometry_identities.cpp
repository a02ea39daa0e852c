// V5 (theory/coupling.md section 7): the identities of the moving geometry, in 3D and 2D.
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/identities.hpp"

namespace brisance::testing {
namespace {

using coupling::Lattice;

constexpr Real h = 1.0 / 48;
Lattice const space{3, {0, 0, 0}, {h, h, h}};
Lattice const plane{2, {0, 0, 0}, {h, h, 1}};

std::function<Vec3(Vec3)> shift(Real x, Real y, Real z = 0) {
  return [=](Vec3 p) { return p + h * Vec3{x, y, z}; };
}
std::function<Vec3(Vec3)> turn(Vec3 axis, Real angle, Vec3 c = {0.5, 0.5, 0.5}) {
  Vec3 const e = normalized(axis);
  return [=](Vec3 p) {
    Vec3 const r = p - c;
    return c + std::cos(angle) * r + std::sin(angle) * cross(e, r) + (1 - std::cos(angle)) * dot(e, r) * e;
  };
}
Vec3 deform(Vec3 p) { return p + 0.3 * h * Vec3{std::sin(9 * p.y), std::sin(7 * p.z + 1), std::cos(8 * p.x)}; }

/// The limits of V5; volumes of whole bodies in the larger of body and cell.
void verify(char const* name, char const* variant, Lattice const& lattice, Shape const& old, Shape const& now) {
  Identities const r = measure(lattice, old, now);
  using evidence::at_most;
  EXPECT_TRUE(at_most("V5", name, variant, "closure before snapping [faces]", r.residual, 1e-14));
  EXPECT_TRUE(at_most("V5", name, variant, "closure G1 [faces]", r.closure, 1e-14));
  EXPECT_TRUE(at_most("V5", name, variant, "x y z volumes [cells]", r.mismatch, 1e-12));
  EXPECT_TRUE(at_most("V5", name, variant, "per-cell G2 [cells]", r.cell_law, 1e-12));
  EXPECT_TRUE(at_most("V5", name, variant, "prism G3 [cells]", r.prism, 1e-12));
  EXPECT_TRUE(at_most("V5", name, variant, "sum W - dV [larger of body and cell]", r.total, 1e-12));
  EXPECT_TRUE(at_most("V5", name, variant, "volume against polyhedron [larger of body and cell]", r.volume, 1e-12));
  EXPECT_EQ(r.overlapped, 0);
  EXPECT_GT(r.cells, 0u);
}

TEST(GeometryIdentities, Sphere) {
  for (int level : {3, 4}) {
    Shape const s = icosphere({0.503, 0.497, 0.511}, 0.3, level);
    std::string const n = level == 3 ? " 1280" : " 5120";
    verify("sphere", ("translation" + n).c_str(), space, s, mapped(s, shift(0.3, -0.17, 0.11)));
    verify("sphere", ("translation along x" + n).c_str(), space, s, mapped(s, shift(0.3, 0, 0)));
    verify("sphere", ("rotation" + n).c_str(), space, s, mapped(s, turn({1, 2, 3}, 0.03)));
    verify("sphere", ("rotation about z" + n).c_str(), space, s, mapped(s, turn({0, 0, 1}, 0.03)));
    verify("sphere", ("deformation" + n).c_str(), space, s, mapped(s, deform));
  }
}

TEST(GeometryIdentities, BoxOnPlanes) {
  Shape const b = box({12 * h, 10 * h, 13 * h}, {30 * h, 31 * h, 33 * h});
  Shape const c = mapped(b, shift(0.5, 0.5, 0.5));
  verify("box on planes", "at rest", space, b, b);
  verify("box on planes", "leaving by half a cell", space, b, c);
  verify("box on planes", "arriving by half a cell", space, c, b);
  verify("box on planes", "sliding along its faces", space, b, mapped(b, shift(0.5, 0, 0)));
  verify("box on planes", "whole cell", space, b, mapped(b, shift(1, -1, 0)));
  // Ten half-cell steps: rounding moves the faces off the planes by a few 1e-16.
  Shape s = b;
  for (int i = 0; i < 10; ++i) {
    Shape const next = mapped(s, shift(0.5, 0, -0.5));
    verify("box on planes", ("half-cell step " + std::to_string(i)).c_str(), space, s, next);
    s = next;
  }
}

TEST(GeometryIdentities, Plate) {
  Real const thick = h / 300;
  for (Real at : {13.3, 13.0}) {
    Shape const p = box({12.4 * h, 10 * h, at * h}, {30.7 * h, 31 * h, at * h + thick});
    std::string const where = at == 13.0 ? "on a plane" : "inside cells";
    verify("plate h/300", (where + " at rest").c_str(), space, p, p);
    verify("plate h/300", (where + " moving").c_str(), space, p, mapped(p, shift(0.1, 0.2, 0.3)));
    verify("plate h/300", (where + " turning").c_str(), space, p, mapped(p, turn({1, 0, 2}, 0.02)));
  }
}

TEST(GeometryIdentities, TwoSpheres) {
  Shape two = icosphere({0.3, 0.5, 0.5}, 0.15, 4);
  two.append(icosphere({0.6 + 0.16 * h, 0.5, 0.5}, 0.15, 4));
  verify("two spheres", "gap 0.16 cell", space, two, mapped(two, shift(0.3, 0.1, 0)));
  verify("two spheres", "gap 0.16 cell turning", space, two, mapped(two, turn({1, 1, 0}, 0.02)));
}

TEST(GeometryIdentities, AnisotropicCellsAwayFromTheOrigin) {
  Lattice const oblong{3, {-31.7, 4.1, 12.3}, {0.013, 0.021, 0.034}};
  Vec3 const centre{-31.5, 4.4, 12.9};  // far from the box of the grid too: indices of either sign
  Shape const s = icosphere(centre, 0.31, 3);
  verify("sphere", "oblong cells and negative indices", oblong, s, mapped(s, turn({1, 2, 3}, 0.01, centre)));
}

TEST(GeometryIdentities, Plane) {
  Shape const d = disk({0.5, 0.5, 0}, 0.3, 400);
  verify("disk polygon", "translation", plane, d, mapped(d, shift(0.3, 0.2)));
  verify("disk polygon", "rotation", plane, d, mapped(d, turn({0, 0, 1}, 0.02)));
  verify("disk polygon", "deformation", plane, d, mapped(d, deform));
  Shape const q = outline({{12 * h, 10 * h, 0}, {30 * h, 10 * h, 0}, {30 * h, 20 * h, 0}, {12 * h, 20 * h, 0}});
  verify("square on lines", "at rest", plane, q, q);
  verify("square on lines", "half cells", plane, q, mapped(q, shift(0.5, 0.5)));
  verify("square on lines", "arriving", plane, mapped(q, shift(0.5, -0.5)), q);
  verify("square on lines", "sliding", plane, q, mapped(q, shift(0.5, 0)));
  Shape const o = outline({{12 * h, 10 * h, 0}, {22 * h, 20 * h, 0}, {12 * h, 30 * h, 0}, {2 * h, 20 * h, 0}});
  verify("diamond on nodes", "along its diagonal", plane, o, mapped(o, shift(0.3, 0.3)));
  verify("diamond on nodes", "turning", plane, o, mapped(o, turn({0, 0, 1}, 0.02, {12 * h, 20 * h, 0})));
  Shape const s = outline({{3.3 * h, 7.2 * h, 0}, {40.1 * h, 22.7 * h, 0}, {3.3 * h, 7.2 * h + h / 300, 0}});
  verify("sliver h/300", "translation", plane, s, mapped(s, shift(0.4, 0.3)));
  verify("sliver h/300", "rotation", plane, s, mapped(s, turn({0, 0, 1}, 0.01)));
}

}  // namespace
}  // namespace brisance::testing
