// The cut-cell geometry against exact arithmetic: volumes and apertures of random bodies in degenerate places, the
// identities of a step of each, and swept volumes of pieces.
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/exact_cell.hpp"
#include "tests/support/identities.hpp"
#include "tests/support/wild_bodies.hpp"

namespace brisance::testing {
namespace {

using coupling::CellIndex;
using exact::Number;
using Point = exact::Point<Number>;

coupling::Lattice const unit{};

/// Largest defects met, in cells or faces.
struct Worst {
  Real volume = 0, aperture = 0, residual = 0, closure = 0, mismatch = 0, cell_law = 0, prism = 0;
  long pairs = 0, rational = 0;
};

std::vector<exact::Triangle> in_grid_units(std::vector<coupling::SurfaceTriangle> const& triangles, bool old) {
  std::vector<exact::Triangle> out;
  for (auto const& t : triangles) {
    auto const& x = old ? t.x_old : t.x_new;
    out.push_back({unit.grid_point(x[0]), unit.grid_point(x[1]), unit.grid_point(x[2])});
  }
  return out;
}

/// Cells of the geometry against the exact integrals over a few of its cells and of those around it.
void check_cells(coupling::Geometry const& g, std::vector<exact::Triangle> const& skin, WildBodies& random, Worst& w) {
  std::vector<CellIndex> cells;
  for (int n = 0; n < 6 && !g.cells.empty(); ++n)
    cells.push_back(g.cells[static_cast<std::size_t>(random.pick(static_cast<int>(g.cells.size())))].cell);
  for (std::size_t n = 0; n < 2 && !cells.empty(); ++n) {
    CellIndex near = cells[n];
    near[static_cast<std::size_t>(random.pick(3))] += random.pick(2) ? 1 : -1;
    cells.push_back(near);
  }
  for (std::size_t n = 0; n < g.solid.size(); n += 1 + g.solid.size() / 2) cells.push_back(g.solid[n].first);
  auto const is_solid = [&](CellIndex const& c) {
    return std::any_of(g.solid.begin(), g.solid.end(), [&](auto const& run) {
      return c[1] == run.first[1] && c[2] == run.first[2] && c[0] >= run.first[0] && c[0] < run.first[0] + run.count;
    });
  };
  for (CellIndex const& c : cells) {
    ++w.pairs;
    auto const along = static_cast<std::size_t>(random.pick(3));
    // Two ways to the exact number: mostly the cheap one.
    Real const inside =
        w.pairs % 64 ? exact::winding_along(skin, c, along, w.rational) : exact::winding(skin, c, w.rational);
    Index const at = g.find(c);
    if (at < 0) {  // uncut: inside one body or several, or outside (a surface turned inside out counts as fluid)
      w.volume = max(w.volume, is_solid(c) ? max(0, 1 - inside) : max(0, inside));
      continue;
    }
    auto const& cut = g.cells[static_cast<std::size_t>(at)];
    w.volume = max(w.volume, std::abs(1 - inside - cut.volume));
    std::size_t const side = static_cast<std::size_t>(random.pick(2));
    CellIndex face = c, beyond = c;
    face[along] += static_cast<int>(side);
    beyond[along] += side ? 1 : -1;
    Real flat = 0;
    Real open = 1 - exact::winding_on_face(skin, face, along, flat, w.rational);
    // Towards an uncut cell the aperture is that of the cell: closed or open, whatever the number of bodies.
    if (g.find(beyond) < 0) open = min(max(open, 0), 1);
    w.aperture = max(w.aperture, std::abs(open - cut.aperture[along][side]) - flat);
  }
}

/// (G1) to (G3) over one step; cells that are uncut inside several bodies, or in a surface turned inside out, hold what
/// their winding number says.
void check_step(std::vector<coupling::SurfaceTriangle> const& triangles, coupling::Geometry const& g0,
                coupling::Geometry const& g1, Worst& w) {
  std::map<CellIndex, Real> change;
  for (auto const& c : g0.cells) change[c.cell] -= c.volume;
  for (auto const& c : g1.cells) change[c.cell] += c.volume;
  std::vector<coupling::Swept> parts;
  for (auto const& p : g1.pieces) {
    parts.clear();
    auto const& t = triangles[static_cast<std::size_t>(p.triangle)];
    swept(unit, g1, p, t, parts);
    Real sum = 0;
    for (auto const& s : parts) {
      sum += s.volume;
      change[s.cell] += s.volume;
    }
    w.prism = max(w.prism, std::abs(sum - prism_volume(unit, g1, p, t)));
  }
  for (auto const& [c, defect] : change) {
    // What uncut cells hold is a whole number.
    bool const whole = g0.find(c) < 0 || g1.find(c) < 0;
    w.cell_law = max(w.cell_law, std::abs(whole ? defect - std::nearbyint(defect) : defect));
  }
  for (auto const* g : {&g0, &g1}) {
    w.residual = max(w.residual, g->residual);
    w.mismatch = max(w.mismatch, g->volume_mismatch);
    for (auto const& c : g->cells)
      for (std::size_t d = 0; d < 3; ++d)
        if (g->find({c.cell[0] + (d == 0), c.cell[1] + (d == 1), c.cell[2] + (d == 2)}) >= 0)
          w.closure = max(w.closure, std::abs(c.aperture[d][1] - c.aperture[d][0] - c.area[static_cast<int>(d)]));
  }
}

TEST(CutGeometryExact, WildBodies) {
  long const wanted = evidence::full() ? 1'000'000 : 4'000;
  std::array<Worst, static_cast<std::size_t>(Wild::count)> worst{};
  long pairs = 0;
  coupling::Geometry g0, g1;
  for (unsigned seed = 0; pairs < wanted; ++seed) {
    auto const kind = static_cast<Wild>(seed % static_cast<unsigned>(Wild::count));
    WildBodies wild(seed);
    Shape const s = wild.body(kind), now = wild.moved(s);
    auto const start = surface(s, s, 3), triangles = surface(s, now, 3);
    build(unit, start, std::span(&everywhere, 1), g0);
    build(unit, triangles, std::span(&everywhere, 1), g1);
    Worst& w = worst[static_cast<std::size_t>(kind)];
    Worst const before = w;
    check_cells(g0, in_grid_units(triangles, true), wild, w);
    check_cells(g1, in_grid_units(triangles, false), wild, w);
    check_step(triangles, g0, g1, w);
    pairs += w.pairs - before.pairs;
    auto const failed = [](Worst const& x) {
      return max(max(max(x.volume, x.aperture), max(x.residual, x.closure)),
                 max(max(x.mismatch, x.cell_law), x.prism)) > 1e-13;
    };
    if (failed(w) && !failed(before))
      ADD_FAILURE() << name(kind) << " with seed " << seed << ": volume " << w.volume << ", aperture " << w.aperture
                    << ", residual " << w.residual << ", closure " << w.closure << ", mismatch " << w.mismatch
                    << ", cell law " << w.cell_law << ", prism " << w.prism;
  }
  for (std::size_t k = 0; k < worst.size(); ++k) {
    Worst const& w = worst[k];
    std::string const kind = name(static_cast<Wild>(k));
    using evidence::at_most;
    EXPECT_TRUE(at_most("V5", "wild bodies", kind, "volume against exact arithmetic [cells]", w.volume, 1e-13));
    EXPECT_TRUE(at_most("V5", "wild bodies", kind, "aperture against exact arithmetic [faces]", w.aperture, 1e-13));
    EXPECT_TRUE(at_most("V5", "wild bodies", kind, "closure G1 [faces]", max(w.residual, w.closure), 1e-13));
    EXPECT_TRUE(at_most("V5", "wild bodies", kind, "x y z volumes [cells]", w.mismatch, 1e-13));
    EXPECT_TRUE(at_most("V5", "wild bodies", kind, "per-cell G2 [cells]", w.cell_law, 1e-13));
    EXPECT_TRUE(at_most("V5", "wild bodies", kind, "prism G3 [cells]", w.prism, 1e-13));
    std::printf(
        "%-10s %8ld pairs, %6ld integrals in rationals; volume %.1e aperture %.1e G1 %.1e xyz %.1e G2 %.1e G3 %.1e\n",
        kind.c_str(), w.pairs, w.rational, w.volume, w.aperture, max(w.residual, w.closure), w.mismatch, w.cell_law,
        w.prism);
  }
}

TEST(CutGeometryExact, SweptVolumesOfPieces) {
  std::mt19937 random(12);
  std::uniform_real_distribution<Real> u(-0.5, 0.5);
  Real worst = 0, swept_somewhere = 0;
  int const wanted = evidence::full() ? 150 : 30;
  for (int n = 0; n < wanted; ++n) {
    WildBodies wild(static_cast<unsigned>(random()));
    Shape const s = wild.body(Wild::plain);
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
      now.push_back(exact::point(c.point));
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
          for (auto const& f : skin) expected += exact::within<Number>({now[0], f[0], f[1], f[2]}, cell);
          Real got = 0;
          for (auto const& w : parts)
            if (w.cell == cell) got = w.volume;
          worst = max(worst, std::abs(got - CGAL::to_double(expected)));
          swept_somewhere += std::abs(got);
        }
  }
  EXPECT_GT(swept_somewhere, 0.5);
  EXPECT_LE(worst, 1e-14);
}

}  // namespace
}  // namespace brisance::testing
