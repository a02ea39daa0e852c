// The cut-cell geometry on single features: regions, coincident planes, errors, closest points.
#include <gtest/gtest.h>

#include "coupling/geometry/nearest.hpp"
#include "parallel/error.hpp"
#include "tests/support/identities.hpp"

namespace brisance::coupling {
namespace {

using testing::box;
using testing::everywhere;
using testing::icosphere;
using testing::mapped;
using testing::Shape;
using testing::surface;

constexpr Real h = 0.125;
Lattice const space{3, {0, 0, 0}, {h, h, h}};

Geometry geometry_of(Lattice const& lattice, std::vector<SurfaceTriangle> const& triangles,
                     std::vector<CellBox> const& keep = {everywhere}) {
  Geometry g;
  build(lattice, triangles, keep, g);
  return g;
}

TEST(CutGeometry, FacesOnPlanesBelongToTheFluid) {
  Shape const b = box({2 * h, 2 * h, 2 * h}, {4 * h, 4 * h, 4 * h});
  Geometry const g = geometry_of(space, surface(b, b, 3));
  ASSERT_EQ(g.cells.size(), 24u);
  for (auto const& c : g.cells) {
    EXPECT_EQ(c.volume, h * h * h);
    bool inside = true;
    for (int d = 0; d < 3; ++d)
      inside = inside && c.cell[static_cast<std::size_t>(d)] >= 2 && c.cell[static_cast<std::size_t>(d)] < 4;
    EXPECT_FALSE(inside);
    EXPECT_EQ(norm2(c.area), h * h * h * h);
  }
  ASSERT_EQ(g.solid.size(), 4u);
  for (auto const& run : g.solid) EXPECT_EQ(run.count, 2);
  Index const left = g.find({1, 2, 2});
  ASSERT_GE(left, 0);
  EXPECT_EQ(g.cells[static_cast<std::size_t>(left)].aperture[0][1], 0);
  EXPECT_EQ(g.cells[static_cast<std::size_t>(left)].aperture[0][0], h * h);
  EXPECT_EQ(g.find({2, 2, 2}), -1);
}

TEST(CutGeometry, BodiesThatTouchInAPlaneLeaveNoAperture) {
  Shape two = box({2 * h, 2 * h, 2 * h}, {4 * h, 4 * h, 4 * h});
  two.append(box({4 * h, 2 * h, 2 * h}, {6 * h, 4 * h, 4 * h}));     // same face
  two.append(box({2 * h, 2.25 * h, 4 * h}, {6 * h, 5 * h, 5 * h}));  // parts of faces
  Geometry const g = geometry_of(space, surface(two, two, 3));
  EXPECT_LE(g.residual, 1e-14);
  EXPECT_EQ(g.overlapped, 0);
  for (auto const& c : g.cells)
    for (auto const& a : c.aperture)
      for (Real const x : a) {
        EXPECT_GE(x, -1e-15);
        EXPECT_LE(x, h * h * (1 + 1e-14));
      }
  EXPECT_LE(g.volume_mismatch, 1e-14);
}

/// What a cell gets must not depend on which boxes are asked for, nor on triangles that do not meet their rows.
TEST(CutGeometry, RegionsAgreeWithTheWholeToTheBit) {
  Shape s = icosphere({0.5, 0.5, 0.5}, 0.31, 3);
  s.append(box({1.1, 0.2, 0.3}, {1.5, 0.9, 0.8}));
  auto const all = surface(s, s, 3);
  Geometry const whole = geometry_of(space, all);
  std::vector<CellBox> const keep{{{1, 2, 3}, {4, 4, 5}}, {{3, 3, 4}, {10, 5, 5}}, {{-9, -9, -9}, {-3, -3, -3}}};
  std::vector<SurfaceTriangle> some;
  for (auto const& t : all) {
    bool near = false;
    for (auto const& b : keep) {
      int meets[3];
      for (int d = 0; d < 3; ++d) {
        Real const low = min(t.x_new[0][d], min(t.x_new[1][d], t.x_new[2][d]));
        Real const high = max(t.x_new[0][d], max(t.x_new[1][d], t.x_new[2][d]));
        meets[d] = low <= h * b.high[static_cast<std::size_t>(d)] && high >= h * b.low[static_cast<std::size_t>(d)];
      }
      near = near || meets[0] + meets[1] + meets[2] >= 2;
    }
    if (near) some.push_back(t);
  }
  ASSERT_LT(some.size(), all.size());
  Geometry const part = geometry_of(space, some, keep);
  EXPECT_LE(part.residual, 1e-14);
  auto const kept = [&](CellIndex const& c) {
    for (auto const& b : keep)
      if (b.holds(c)) return true;
    return false;
  };
  std::size_t n = 0;
  for (auto const& c : whole.cells) {
    if (!kept(c.cell)) {
      EXPECT_EQ(part.find(c.cell), -1);
      continue;
    }
    ++n;
    Index const at = part.find(c.cell);
    ASSERT_GE(at, 0);
    auto const& o = part.cells[static_cast<std::size_t>(at)];
    EXPECT_EQ(o.volume, c.volume);
    EXPECT_EQ(o.aperture, c.aperture);
    EXPECT_EQ(o.area, c.area);
    ASSERT_EQ(o.last_piece - o.first_piece, c.last_piece - c.first_piece);
    for (Index i = 0; i < c.last_piece - c.first_piece; ++i) {
      auto const& p = whole.pieces[static_cast<std::size_t>(c.first_piece + i)];
      auto const& q = part.pieces[static_cast<std::size_t>(o.first_piece + i)];
      EXPECT_EQ(all[static_cast<std::size_t>(p.triangle)].id, some[static_cast<std::size_t>(q.triangle)].id);
      EXPECT_EQ(p.area, q.area);
      EXPECT_EQ(p.centroid, q.centroid);
    }
  }
  EXPECT_EQ(part.cells.size(), n);
  std::vector<CellIndex> expected, got;
  auto const expand = [](Geometry const& g, auto&& use) {
    for (auto const& run : g.solid)
      for (Index i = 0; i < run.count; ++i) use(CellIndex{run.first[0] + i, run.first[1], run.first[2]});
  };
  expand(whole, [&](CellIndex c) {
    if (kept(c)) expected.push_back(c);
  });
  expand(part, [&](CellIndex c) { got.push_back(c); });
  EXPECT_FALSE(expected.empty());
  EXPECT_EQ(expected, got);
}

TEST(CutGeometry, RepeatedBuildsDoNotAllocate) {
  Shape const s = icosphere({0.5, 0.5, 0.5}, 0.31, 3);
  auto const triangles = surface(s, s, 3);
  Geometry g;
  build(space, triangles, std::span(&everywhere, 1), g);
  auto const* corners = g.corners.data();
  auto const* pieces = g.pieces.data();
  auto const cells = g.cells.size();
  build(space, triangles, std::span(&everywhere, 1), g);
  EXPECT_EQ(g.corners.data(), corners);
  EXPECT_EQ(g.pieces.data(), pieces);
  EXPECT_EQ(g.cells.size(), cells);
}

TEST(CutGeometry, OpenBoundariesAreErrorsAndInvertedOnesAreCounted) {
  Shape s = icosphere({0.5, 0.5, 0.5}, 0.31, 2);
  Geometry g = geometry_of(space, surface(s, s, 3));
  EXPECT_NO_THROW(require_closed(space, g));
  Shape open = s;
  open.faces.pop_back();
  g = geometry_of(space, surface(open, open, 3));
  EXPECT_THROW(require_closed(space, g), Error);
  for (auto& f : s.faces) std::swap(f[1], f[2]);
  g = geometry_of(space, surface(s, s, 3));
  EXPECT_NO_THROW(require_closed(space, g));  // in a run its inside counts as fluid
  EXPECT_GT(g.inverted, 0);                   // at set-up it is an error
}

TEST(CutGeometry, OverlappingBodiesAreSolidAndCounted) {
  Shape s = box({1.3 * h, 1.3 * h, 1.3 * h}, {7.2 * h, 7.2 * h, 7.2 * h});
  s.append(box({2.3 * h, 2.3 * h, 2.3 * h}, {9.2 * h, 9.2 * h, 9.2 * h}));
  Geometry const g = geometry_of(space, surface(s, s, 3));
  EXPECT_NO_THROW(require_closed(space, g));
  EXPECT_GT(g.overlapped, 0);
  bool found = false;
  for (auto const& run : g.solid)
    found = found || (run.first[1] == 4 && run.first[2] == 4 && run.first[0] <= 4 && run.first[0] + run.count > 4);
  EXPECT_TRUE(found);
}

TEST(CutGeometry, CentroidsAndAreasOfPieces) {
  Shape const s = icosphere({0.5, 0.5, 0.5}, 0.31, 1);
  auto const triangles = surface(s, s, 3);
  Geometry const g = geometry_of(space, triangles);
  std::vector<Vec3> area(triangles.size()), moment(triangles.size());
  for (auto const& p : g.pieces) {
    area[static_cast<std::size_t>(p.triangle)] += p.area;
    moment[static_cast<std::size_t>(p.triangle)] += norm(p.area) * p.centroid;
    EXPECT_NEAR(p.bary_centroid[0] + p.bary_centroid[1] + p.bary_centroid[2], 1, 1e-14);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    auto const& x = triangles[t].x_new;
    Vec3 const s2 = 0.5 * cross(x[1] - x[0], x[2] - x[0]);
    EXPECT_LE(norm(area[t] - s2), 1e-15);
    EXPECT_LE(norm(moment[t] / norm(s2) - (x[0] + x[1] + x[2]) / 3), 1e-14);
  }
}

TEST(CutGeometry, SweptVolumesOfAnUnmovedTriangleAreEmpty) {
  Shape const s = icosphere({0.5, 0.5, 0.5}, 0.31, 1);
  auto triangles = surface(s, mapped(s, [](Vec3 x) { return x + Vec3{0.01, 0, 0}; }), 3);
  triangles[7].x_old = triangles[7].x_new;
  Geometry const g = geometry_of(space, triangles);
  std::vector<Swept> out;
  std::size_t moved = 0;
  for (auto const& p : g.pieces) {
    out.clear();
    swept(space, g, p, triangles[static_cast<std::size_t>(p.triangle)], out);
    if (p.triangle == 7)
      EXPECT_TRUE(out.empty());
    else
      moved += !out.empty();
  }
  EXPECT_GT(moved, 50u);
}

/// Against a dense sampling of the polygon: no sample is closer, and the point is on the polygon.
TEST(ClosestPoint, BeatsASampling) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> u(0, 1);
  Shape const s = icosphere({0.5, 0.5, 0.5}, 0.31, 1);
  auto const triangles = surface(s, s, 3);
  Geometry const g = geometry_of(space, triangles);
  for (int n = 0; n < 300; ++n) {
    auto const& p = g.pieces[random() % g.pieces.size()];
    auto const& t = triangles[static_cast<std::size_t>(p.triangle)];
    Vec3 const x = p.centroid + 0.3 * Vec3{u(random) - 0.5, u(random) - 0.5, u(random) - 0.5};
    Nearest const on_piece = closest_point(space, g, p, x), on_triangle = closest_point(space, t, x);
    EXPECT_LE(on_triangle.distance2, on_piece.distance2 + 1e-15);
    auto const corners = g.corners_of(p);
    for (int i = 0; i < 200; ++i) {
      Vec3 sample{};
      Real total = 0;
      for (auto const& c : corners) {
        Real const w = -std::log(u(random) + 1e-300);
        total += w;
        sample += w * space.position(c.point);
      }
      EXPECT_GE(norm2(x - sample / total), on_piece.distance2 - 1e-15);
    }
    for (auto const& [near, name] : {std::pair{on_piece, "piece"}, std::pair{on_triangle, "triangle"}}) {
      Vec3 back{};
      for (std::size_t v = 0; v < 3; ++v) back += near.bary[v] * t.x_new[v];
      EXPECT_LE(norm(back - near.point), 1e-14) << name;
      EXPECT_NEAR(near.distance2, norm2(x - near.point), 1e-15) << name;
    }
  }
}

TEST(ClosestPoint, OnSegmentsInThePlane) {
  Lattice const plane{2, {0, 0, 0}, {h, h, 1}};
  SurfaceTriangle t;
  t.x_new = {{{0, 0, 0}, {1, 1, 0}, {}}};
  Nearest n = closest_point(plane, t, {1, 0, 0.5});
  EXPECT_NEAR(n.point.x, 0.5, 1e-15);
  EXPECT_EQ(n.point.z, 0.5);  // no component out of the plane
  EXPECT_NEAR(n.distance2, 0.5, 1e-15);
  n = closest_point(plane, t, {3, 2, 0.5});
  EXPECT_EQ(n.bary[1], 1);
}

}  // namespace
}  // namespace brisance::coupling
