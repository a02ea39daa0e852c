// Volumes, apertures and swept volumes against exact rational arithmetic: signed tetrahedra cut by the planes of a
// cell.
#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/identities.hpp"

namespace brisance::testing {
namespace {

using coupling::CellIndex;
using Number = CGAL::Exact_rational;
using Point = std::array<Number, 3>;
using Tetrahedron = std::array<Point, 4>;

Point exact(Vec3 const& x) { return {Number(x.x), Number(x.y), Number(x.z)}; }

Number determinant(Tetrahedron const& t) {
  std::array<Point, 3> e;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t d = 0; d < 3; ++d) e[i][d] = t[i + 1][d] - t[0][d];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// Keeps the part of the tetrahedra with sign * (x_d - plane) <= 0.
std::vector<Tetrahedron> cut(std::vector<Tetrahedron> const& all, std::size_t d, int plane, int sign) {
  std::vector<Tetrahedron> kept;
  for (auto const& t : all) {
    std::vector<std::size_t> in, out;
    std::array<Number, 4> height;
    for (std::size_t v = 0; v < 4; ++v) {
      height[v] = sign * (t[v][d] - plane);
      (height[v] <= 0 ? in : out).push_back(v);
    }
    auto const crossing = [&](std::size_t a, std::size_t b) {
      Number const s = height[a] / (height[a] - height[b]);
      Point p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = t[a][k] + s * (t[b][k] - t[a][k]);
      return p;
    };
    // A wedge between two triangles is three tetrahedra.
    auto const wedge = [&](std::array<Point, 3> const& a, std::array<Point, 3> const& b) {
      kept.push_back({a[0], a[1], a[2], b[0]});
      kept.push_back({a[1], a[2], b[0], b[1]});
      kept.push_back({a[2], b[0], b[1], b[2]});
    };
    if (in.size() == 4) kept.push_back(t);
    if (in.size() == 1)
      kept.push_back({t[in[0]], crossing(in[0], out[0]), crossing(in[0], out[1]), crossing(in[0], out[2])});
    if (in.size() == 3)
      wedge({t[in[0]], t[in[1]], t[in[2]]},
            {crossing(in[0], out[0]), crossing(in[1], out[0]), crossing(in[2], out[0])});
    if (in.size() == 2)
      wedge({t[in[0]], crossing(in[0], out[0]), crossing(in[0], out[1])},
            {t[in[1]], crossing(in[1], out[0]), crossing(in[1], out[1])});
  }
  return kept;
}

/// Signed volume of a tetrahedron within a cell of the unit lattice.
Number within(Tetrahedron const& t, CellIndex const& cell) {
  Number const whole = determinant(t);
  if (whole == 0) return 0;
  std::vector<Tetrahedron> parts{t};
  for (std::size_t d = 0; d < 3 && !parts.empty(); ++d) {
    parts = cut(parts, d, cell[d], -1);
    parts = cut(parts, d, cell[d] + 1, 1);
  }
  Number sum = 0;
  for (auto const& p : parts) sum += CGAL::abs(determinant(p));
  return (whole > 0 ? sum : Number(-sum)) / 6;
}

coupling::Lattice const unit{};

/// A body a few cells wide: a sphere, a box or a tetrahedron, some of them on planes and nodes.
Shape body(std::mt19937& random) {
  std::uniform_real_distribution<Real> u(-2, 2);
  auto const coordinate = [&] { return random() % 3 ? u(random) : std::nearbyint(u(random)); };
  Vec3 const at{coordinate(), coordinate(), coordinate()};
  switch (random() % 3) {
    case 0:
      return icosphere(at, 0.3 + std::abs(coordinate()), static_cast<int>(random() % 2));
    case 1:
      return box(at, at + Vec3{0.1 + std::abs(coordinate()), 0.1 + std::abs(coordinate()), 1.0});
    default: {
      Shape s;
      s.points = {at, at + Vec3{1 + std::abs(coordinate()), 0.1 * u(random), 0},
                  at + Vec3{0.1 * u(random), 1 + std::abs(coordinate()), 0.1 * u(random)},
                  at + Vec3{0, 0.1 * u(random), 1 + std::abs(coordinate())}};
      s.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
      return s;
    }
  }
}

TEST(CutGeometryExact, VolumesOfConvexBodies) {
  std::mt19937 random(11);
  Real worst = 0;
  int pairs = 0;
  int const wanted = evidence::full() ? 3000 : 500;
  while (pairs < wanted) {
    Shape const s = body(random);
    Point const apex = exact(unit.grid_point(s.points[0]));
    auto const triangles = surface(s, s, 3);
    coupling::Geometry g;
    build(unit, triangles, std::span(&everywhere, 1), g);
    std::vector<Tetrahedron> solid;
    for (auto const& t : triangles)
      solid.push_back({apex, exact(unit.grid_point(t.x_new[0])), exact(unit.grid_point(t.x_new[1])),
                       exact(unit.grid_point(t.x_new[2]))});
    auto const check = [&](CellIndex const& c, Real fluid) {
      Number inside = 0;
      for (auto const& t : solid) inside += within(t, c);
      worst = max(worst, std::abs(CGAL::to_double(1 - inside) - fluid));
      ++pairs;
    };
    for (std::size_t i = 0; i < g.cells.size(); i += 1 + g.cells.size() / 12) check(g.cells[i].cell, g.cells[i].volume);
    for (auto const& run : g.solid) check(run.first, 0);
  }
  EXPECT_LE(worst, 1e-14);
}

TEST(CutGeometryExact, SweptVolumesOfPieces) {
  std::mt19937 random(12);
  std::uniform_real_distribution<Real> u(-0.5, 0.5);
  Real worst = 0, swept_somewhere = 0;
  int const wanted = evidence::full() ? 150 : 30;
  for (int n = 0; n < wanted; ++n) {
    Shape const s = body(random);
    Vec3 const move{u(random), random() % 2 ? 0 : u(random), random() % 2 ? 0.5 : u(random)};
    Real const turn = 0.2 * u(random);
    auto const triangles = surface(s,
                                   mapped(s,
                                          [&](Vec3 x) {
                                            return x + move + turn * Vec3{-x.y, x.x, 0.5 * x.y};
                                          }),
                                   3);
    coupling::Geometry g;
    build(unit, triangles, std::span(&everywhere, 1), g);
    auto const& p = g.pieces[random() % g.pieces.size()];
    auto const& t = triangles[static_cast<std::size_t>(p.triangle)];
    std::vector<coupling::Swept> parts;
    swept(unit, g, p, t, parts);
    std::vector<Point> now, before;
    std::vector<std::array<Point, 3>> skin;
    for (auto const& c : g.corners_of(p)) {
      now.push_back(exact(c.point));
      Point x;
      for (std::size_t d = 0; d < 3; ++d) {
        int const k = static_cast<int>(d);
        Number const x0 = unit.grid_point(t.x_old[0])[k];
        x[d] = x0 + Number(c.bary[1]) * (Number(unit.grid_point(t.x_old[1])[k]) - x0) +
               Number(c.bary[2]) * (Number(unit.grid_point(t.x_old[2])[k]) - x0);
      }
      before.push_back(x);
    }
    std::size_t const m = now.size();
    for (std::size_t c = 1; c + 1 < m; ++c) {
      skin.push_back({now[0], now[c], now[c + 1]});
      skin.push_back({before[0], before[c + 1], before[c]});
    }
    for (std::size_t c = 0; c < m; ++c) {
      std::size_t const e = (c + 1) % m;
      std::array<Point, 4> const q{before[c], before[e], now[e], now[c]};
      Point mean;
      for (std::size_t d = 0; d < 3; ++d) mean[d] = (q[0][d] + q[1][d] + q[2][d] + q[3][d]) / 4;
      for (std::size_t k = 0; k < 4; ++k) skin.push_back({q[k], q[(k + 1) % 4], mean});
    }
    for (Index i = -2; i <= 2; ++i)
      for (Index j = -2; j <= 2; ++j)
        for (Index k = -2; k <= 2; ++k) {
          CellIndex const cell{p.cell[0] + i, p.cell[1] + j, p.cell[2] + k};
          Number expected = 0;
          for (auto const& f : skin) expected += within({now[0], f[0], f[1], f[2]}, cell);
          Real got = 0;
          for (auto const& w : parts)
            if (w.cell == cell) got = w.volume;
          worst = max(worst, std::abs(got - CGAL::to_double(expected)));
          swept_somewhere += std::abs(got);
        }
  }
  EXPECT_GT(swept_somewhere, 1);
  EXPECT_LE(worst, 1e-14);
}

}  // namespace
}  // namespace brisance::testing
