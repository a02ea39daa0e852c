// A wall thinner than a cell divides the fluid of the cell: parts against volumes in closed form.
#include "coupling/geometry/cell_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace brisance::coupling {
namespace {

/// Part of the unit cell at `low` with n x <= s, for a unit normal without zero components (inclusion and exclusion
/// over the corners).
Real below_plane(CellIndex const& low, Vec3 n, Real s, int dimension) {
  for (int d = 0; d < dimension; ++d) s -= n[d] * low[static_cast<std::size_t>(d)];
  for (int d = 0; d < dimension; ++d)
    if (n[d] < 0) s -= n[d], n[d] = -n[d];
  Real sum = 0;
  for (unsigned v = 0; v < (1u << dimension); ++v) {
    Real room = s;
    int sign = 1;
    for (int d = 0; d < dimension; ++d)
      if (v >> d & 1u) room -= n[d], sign = -sign;
    if (room > 0) sum += sign * std::pow(room, dimension);
  }
  for (int d = 0; d < dimension; ++d) sum /= n[d] * (d + 1);
  return sum;
}

/// A plate: centre, unit axes (the first across it), half sizes.
struct Plate {
  Vec3 centre;
  std::array<Vec3, 3> axis;
  Vec3 half;
  Vec3 corner(int i, int j, int k) const {
    return centre + (i * half.x) * axis[0] + (j * half.y) * axis[1] + (k * half.z) * axis[2];
  }
};

std::vector<SurfaceTriangle> surface(Plate const& p, int dimension) {
  std::vector<std::array<Vec3, 3>> faces;
  if (dimension == 2) {
    std::array<Vec3, 4> const c{p.corner(-1, -1, 0), p.corner(1, -1, 0), p.corner(1, 1, 0), p.corner(-1, 1, 0)};
    for (std::size_t e = 0; e < 4; ++e) faces.push_back({c[e], c[(e + 1) % 4], Vec3{}});
  } else {
    for (int d = 0; d < 3; ++d)
      for (int side : {-1, 1}) {
        auto const at = [&](int u, int v) {
          std::array<int, 3> x{};
          x[static_cast<std::size_t>(d)] = side;
          x[static_cast<std::size_t>((d + 1) % 3)] = u;
          x[static_cast<std::size_t>((d + 2) % 3)] = v;
          return p.corner(x[0], x[1], x[2]);
        };
        std::array<Vec3, 4> const q{at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)};
        std::array<std::size_t, 4> const o =
            side > 0 ? std::array<std::size_t, 4>{0, 1, 2, 3} : std::array<std::size_t, 4>{0, 3, 2, 1};
        faces.push_back({q[o[0]], q[o[1]], q[o[2]]});
        faces.push_back({q[o[0]], q[o[2]], q[o[3]]});
      }
  }
  std::vector<SurfaceTriangle> all;
  for (auto const& f : faces) {
    SurfaceTriangle t;
    t.id = static_cast<GlobalId>(all.size());
    t.x_old = t.x_new = f;
    all.push_back(t);
  }
  return all;
}

struct Divided {
  Geometry geometry;
  CellParts parts;
  Lattice lattice;
  Divided(std::vector<SurfaceTriangle> const& triangles, int dimension, Index n) {
    lattice.dimension = dimension;
    CellBox const all{{0, 0, 0}, {n, n, dimension == 3 ? n : 1}};
    build(lattice, triangles, std::span(&all, 1), geometry);
    divide(lattice, geometry, 1e-9, parts);
  }
};

Plate random_plate(std::mt19937& random, int dimension, Real thickness) {
  std::normal_distribution<Real> normal;
  std::uniform_real_distribution<Real> unit;
  Plate p;
  Vec3 u{normal(random), normal(random), normal(random)}, v{normal(random), normal(random), normal(random)};
  if (dimension == 2) u.z = 0, v = Vec3{-u.y, u.x, 0};
  u = normalized(u);
  v = normalized(v - dot(u, v) * u);
  p.axis = {u, v, cross(u, v)};
  p.centre = {5 + unit(random), 5 + unit(random), dimension == 3 ? 5 + unit(random) : 0};
  p.half = {0.5 * thickness, 3, 3};
  return p;
}

void compare(int dimension, int plates) {
  std::mt19937 random(7);
  Index parted = 0;
  for (int n = 0; n < plates; ++n)
    for (Real const thickness : {1e-3, 0.2, 0.32, 0.8, 1.2}) {
      Plate const plate = random_plate(random, dimension, thickness);
      Divided const d(surface(plate, dimension), dimension, 12);
      EXPECT_EQ(d.parts.undivided, 0);
      for (CutCell const& cell : d.geometry.cells) {
        // Away from the rim of the plate the cell lies between two parallel planes and what is beyond them.
        Vec3 const x =
            Vec3{cell.cell[0] + 0.5, cell.cell[1] + 0.5, dimension == 3 ? cell.cell[2] + 0.5 : 0} - plate.centre;
        if (std::abs(dot(x, plate.axis[1])) > 2) continue;
        if (dimension == 3 && std::abs(dot(x, plate.axis[2])) > 2) continue;
        Real const at = dot(plate.centre, plate.axis[0]);
        Real const one = below_plane(cell.cell, plate.axis[0], at - plate.half.x, dimension);
        Real const two = below_plane(cell.cell, -1 * plate.axis[0], -at - plate.half.x, dimension);
        PartedCell const* const c = d.parts.find(cell.cell);
        if (one > 1e-12 && two > 1e-12) {
          ASSERT_TRUE(c) << one << " " << two;
          ++parted;
          ASSERT_EQ(c->parts, 2u);
          EXPECT_NEAR(c->volume[0], std::max(one, two), 1e-11);
          EXPECT_NEAR(c->volume[1], std::min(one, two), 1e-11);
          Vec3 const outwards = one > two ? -1 * plate.axis[0] : plate.axis[0];
          EXPECT_GT(dot(c->area[0], outwards), 0);
          EXPECT_LT(dot(c->area[1], outwards), 0);
        } else if (c) {
          EXPECT_LT(c->volume[1], 1e-11);
        }
      }
      for (PartedCell const& c : d.parts.cells) {
        CutCell const& cell = d.geometry.cells[static_cast<std::size_t>(d.geometry.find(c.cell))];
        Real volume = 0;
        for (std::size_t p = 0; p < c.parts; ++p) volume += c.volume[p];
        EXPECT_NEAR(volume, cell.volume, 1e-14);
        for (int e = 0; e < dimension; ++e)
          for (std::size_t side = 0; side < 2; ++side) {
            Real open = 0, through = 0;
            for (std::size_t p = 0; p < c.parts; ++p) open += c.aperture[p][static_cast<std::size_t>(e)][side];
            EXPECT_NEAR(open, cell.aperture[static_cast<std::size_t>(e)][side], 1e-14);
            CellIndex low = c.cell;
            if (side == 0) low[static_cast<std::size_t>(e)] -= 1;
            for (Opening const& o : d.parts.through(low, e)) through += o.area;
            EXPECT_NEAR(through, open, 1e-14);
          }
      }
    }
  EXPECT_GT(parted, plates);
}

TEST(CellParts, VolumesBesideRandomPlates2D) { compare(2, 200); }
TEST(CellParts, VolumesBesideRandomPlates3D) { compare(3, 12); }

}  // namespace
}  // namespace brisance::coupling
