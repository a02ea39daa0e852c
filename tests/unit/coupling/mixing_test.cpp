// Merging of small cells (theory/coupling.md 4.2): conservation, growth until admissible, and independence of the
// numbering of cells and of the part of the grid a rank sees.
#include "coupling/cut_cells/mixing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "tests/support/shapes.hpp"

namespace brisance::coupling {
namespace {

using fluid::State;

constexpr Real small_cell = 0.5;

/// A 2D grid with one body in it, and the cells within two of its boundary.
class Case {
 public:
  Case(Case const&) = delete;  // the record points to the grid
  Case(testing::Shape const& body, std::array<Index, 2> cells, bool transposed = false) : transposed_(transposed) {
    auto const place = [&](Vec3 const& x) { return transposed ? Vec3{x.y, x.x, x.z} : x; };
    testing::Shape shape = testing::mapped(body, place);
    if (transposed) {  // a reflection turns the outline over
      std::reverse(shape.points.begin(), shape.points.end());
      cells = {cells[1], cells[0]};
    }
    grid_.dimension = 2;
    grid_.cells = {cells[0], cells[1], 1};
    record_.set_grid(grid_);
    record_.set_region({CellBox{{-4, -4, 0}, {cells[0] + 4, cells[1] + 4, 1}}});
    record_.triangles = testing::surface(shape, shape, 2);
    record_.rebuild();
    std::set<GlobalId> near;
    for (CutCell const& cut : record_.geometry.cells)
      for_neighbourhood(grid_, cut.cell, 2, [&](CellIndex c) {
        if (grid_.inside(c)) near.insert(grid_.cell_id(c));
      });
    for (GlobalId const id : near) {
      NearCell cell;
      cell.id = id;
      cell.cell = cell_from_id(grid_, id);
      cell.volume = cell.volume_before = record_.volume(cell.cell);
      for (int d = 0; d < 2; ++d)
        for (int side = 0; side < 2; ++side)
          cell.aperture[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)] =
              record_.aperture(cell.cell, d, side);
      cell.rewritten = record_.cut_index(cell.cell) >= 0;
      cell.mine = true;
      State const u = state(cell.cell);
      for (std::size_t q = 0; q < 5; ++q) cell.amount[q] = std::max<Real>(0, cell.volume) * u[q];
      cells_.push_back(cell);
    }
  }

  std::vector<NearCell>& cells() { return cells_; }
  fluid::Grid const& grid() const { return grid_; }
  NearCell* at(CellIndex c) {
    if (transposed_) std::swap(c[0], c[1]);
    GlobalId const id = grid_.cell_id(c);
    auto const f =
        std::lower_bound(cells_.begin(), cells_.end(), id, [](NearCell const& n, GlobalId i) { return n.id < i; });
    return f != cells_.end() && f->id == id ? &*f : nullptr;
  }
  std::string merge() { return merge_small_cells(grid_, small_cell, Sight::everything, cells_).trouble; }
  Merging merge(std::vector<NearCell>& some) const { return merge_small_cells(grid_, small_cell, Sight::halo, some); }
  /// Of the grid before transposition; the momentum is not turned, it is a label that must arrive unchanged.
  CellIndex place(NearCell const& n) const {
    return transposed_ ? CellIndex{n.cell[1], n.cell[0], 0} : CellIndex{n.cell[0], n.cell[1], 0};
  }

 private:
  /// Positive, and different in every cell.
  State state(CellIndex c) const {
    if (transposed_) std::swap(c[0], c[1]);
    Real const a = std::sin(1.3 * c[0] + 2.1 * c[1]), b = std::cos(0.7 * c[0] - 1.9 * c[1]);
    Real const rho = 1.4 + 0.5 * a, u = 0.3 * b, v = -0.2 * a, p = 1 + 0.4 * b;
    return {rho, rho * u, rho * v, 0, p / 0.4 + 0.5 * rho * (u * u + v * v)};
  }

  bool transposed_;
  fluid::Grid grid_;
  WallRecord record_;
  std::vector<NearCell> cells_;
};

testing::Shape oblique_bar() {
  Vec3 const u{std::cos(0.21), std::sin(0.21), 0}, v{-u.y, u.x, 0}, m{45.37, 20.61, 0};
  return testing::outline({m - 35 * u - 3.3 * v, m + 35 * u - 3.3 * v, m + 35 * u + 3.3 * v, m - 35 * u + 3.3 * v});
}
Case bar(bool transposed = false) { return Case(oblique_bar(), {90, 40}, transposed); }

bool positive(State const& u) {
  return u[0] >= 0 && u[4] - 0.5 * (u[1] * u[1] + u[2] * u[2] + u[3] * u[3]) / u[0] >= -1e-13 * std::abs(u[4]);
}

/// What the cells hold after merging, against what they held before.
void expect_conserved(std::vector<NearCell> const& cells) {
  std::array<long double, 5> before{}, after{}, size{};
  for (NearCell const& c : cells)
    for (std::size_t q = 0; q < 5; ++q) {
      before[q] += c.amount[q];
      size[q] += std::abs(c.amount[q]);
      after[q] += c.grouped ? static_cast<long double>(c.mean[q]) * c.volume : c.amount[q];
    }
  for (std::size_t q = 0; q < 5; ++q)
    EXPECT_LE(std::abs(static_cast<double>(after[q] - before[q])), 1e-15 * static_cast<double>(size[q]))
        << "component " << q;
}

TEST(Mixing, EverySmallCellShares) {
  Case c = bar();
  ASSERT_EQ(c.merge(), "");
  Index small = 0, alone = 0;
  std::map<State, Real> volume;  // by mean: of a group
  for (NearCell const& n : c.cells()) {
    if (n.grouped) volume[n.mean] += n.volume;
    if (n.volume > covered_fraction && n.volume < small_cell) {
      ++small;
      EXPECT_TRUE(n.grouped) << n.cell[0] << ", " << n.cell[1];
    }
    if (!n.rewritten && !n.grouped) ++alone;
  }
  EXPECT_GT(small, 40);
  EXPECT_GT(alone, 40);
  for (auto const& [mean, v] : volume) EXPECT_GE(v, small_cell);
  expect_conserved(c.cells());
}

TEST(Mixing, LeavesLargeCellsAndEmptyOnesAlone) {
  Case c = bar();
  for (NearCell& n : c.cells())
    if (n.volume < small_cell) n.volume = 0, n.amount = {}, n.rewritten = true;
  ASSERT_EQ(c.merge(), "");
  for (NearCell const& n : c.cells()) EXPECT_FALSE(n.grouped);
}

TEST(Mixing, CoveredCellGivesItsContentAway) {
  Case c = bar();
  // A cell the wall has just covered: next to a cut one, without volume, but not empty.
  NearCell* covered = nullptr;
  for (NearCell& n : c.cells())
    if (n.volume <= covered_fraction)
      for (int d = 0; d < 2 && !covered; ++d) {
        CellIndex m = n.cell;
        m[static_cast<std::size_t>(d)] += 1;
        if (NearCell* const o = c.at(m); o && o->rewritten && o->volume > 0.6) covered = &n;
      }
  ASSERT_NE(covered, nullptr);
  covered->amount = {1e-3, 2e-4, -1e-4, 0, 2e-3};
  covered->rewritten = true;
  ASSERT_EQ(c.merge(), "");
  EXPECT_TRUE(covered->grouped);
  expect_conserved(c.cells());
}

TEST(Mixing, GroupsGrowUntilTheyAreAdmissible) {
  // Ever larger deficits of one cell take ever more neighbours.
  std::size_t fewer = 0;
  for (Real const deficit : {0.5, 3.0, 9.0}) {
    Case c = bar();
    NearCell* worst = nullptr;
    for (NearCell& n : c.cells())
      if (n.rewritten && n.volume > 0.7 && n.volume < 0.8 && n.cell[0] > 30 && n.cell[0] < 60) worst = &n;
    ASSERT_NE(worst, nullptr);
    worst->amount[4] -= deficit + worst->amount[4];
    EXPECT_FALSE(positive(worst->amount));
    ASSERT_EQ(c.merge(), "") << deficit;
    std::size_t members = 0;
    for (NearCell const& n : c.cells()) {
      if (n.grouped) {
        EXPECT_TRUE(positive(n.mean));
        members += n.mean == worst->mean;
      }
    }
    EXPECT_GT(members, fewer) << deficit;
    fewer = members;
    expect_conserved(c.cells());
  }
}

TEST(Mixing, NegativeDensityIsMendedToo) {
  Case c = bar();
  for (NearCell& n : c.cells())
    if (n.rewritten && n.volume > 0.9) n.amount[0] = -0.01;
  ASSERT_EQ(c.merge(), "");
  for (NearCell const& n : c.cells()) {
    EXPECT_TRUE(n.grouped || !n.rewritten || n.volume <= 0.9);
    EXPECT_TRUE(!n.grouped || n.mean[0] >= 0);
  }
  expect_conserved(c.cells());
}

TEST(Mixing, WhatCannotBeMendedIsTold) {
  for (Real const energy : {-1e6, std::numeric_limits<Real>::quiet_NaN()}) {
    Case c = bar();
    for (NearCell& n : c.cells())
      if (n.rewritten && n.volume > 0.9) n.amount[4] = energy;
    EXPECT_NE(c.merge(), "");
  }
}

TEST(Mixing, VacuumIsAdmissible) {
  Case c = bar();
  for (NearCell& n : c.cells()) n.amount = {};
  ASSERT_EQ(c.merge(), "");
  for (NearCell const& n : c.cells()) EXPECT_EQ(n.mean, State{});
}

TEST(Mixing, GroupsDoNotDependOnTheNumberingOfCells) {
  Case straight = bar(), turned = bar(true);
  for (Case* c : {&straight, &turned})
    for (NearCell& n : c->cells()) {
      CellIndex const at = c->place(n);
      if (n.rewritten && n.volume > 0.6 && at[0] % 7 == 3) n.amount[4] -= 1.5;
    }
  ASSERT_EQ(straight.merge(), "");
  ASSERT_EQ(turned.merge(), "");
  ASSERT_EQ(straight.cells().size(), turned.cells().size());
  for (NearCell const& n : straight.cells()) {
    NearCell const* const m = turned.at(straight.place(n));
    ASSERT_NE(m, nullptr);
    EXPECT_NEAR(n.volume, m->volume, 1e-12);
    EXPECT_EQ(n.grouped, m->grouped);
    for (std::size_t q = 0; q < 5; ++q) EXPECT_NEAR(n.mean[q], m->mean[q], 1e-11);
  }
}

TEST(Mixing, APartOfTheGridGivesTheSameBits) {
  Case whole = bar();
  for (NearCell& n : whole.cells())
    if (n.rewritten && n.volume > 0.6 && n.cell[0] % 7 == 3) n.amount[4] -= 1.5;
  std::vector<NearCell> const before = whole.cells();
  ASSERT_EQ(whole.merge(), "");
  for (Index const low : {0, 30, 45}) {
    Index const high = low + 30;  // the cells of a rank
    std::vector<NearCell> part;
    for (NearCell n : before) {
      if (n.cell[0] < low - mixing_halo || n.cell[0] >= high + mixing_halo) continue;
      n.mine = n.cell[0] >= low && n.cell[0] < high;
      part.push_back(n);
    }
    Merging const merging = whole.merge(part);
    ASSERT_EQ(merging.trouble, "");
    ASSERT_FALSE(merging.outgrown);
    for (NearCell const& n : part) {
      if (!n.mine) continue;
      NearCell const& reference = *whole.at(n.cell);
      EXPECT_EQ(n.grouped, reference.grouped);
      EXPECT_EQ(n.mean, reference.mean);
    }
  }
}

TEST(Mixing, AGroupBeyondTheHaloAsksForEverything) {
  Case c = bar();
  // A deficit that takes more cells than the halo shows.
  NearCell* worst = nullptr;
  for (NearCell& n : c.cells())
    if (n.cell[0] == 45 && n.rewritten && n.volume > 0.6) worst = &n;
  ASSERT_NE(worst, nullptr);
  worst->amount[4] -= 150;
  std::vector<NearCell> part;
  for (NearCell n : c.cells()) {
    if (n.cell[0] < 30 - mixing_halo || n.cell[0] >= 60 + mixing_halo) continue;
    n.mine = n.cell[0] >= 30 && n.cell[0] < 60;
    part.push_back(n);
  }
  EXPECT_TRUE(c.merge(part).outgrown);
  ASSERT_EQ(c.merge(), "");
  CellIndex low{90, 90, 0}, high{};
  for (NearCell const& n : c.cells()) {
    if (!n.grouped) continue;
    EXPECT_TRUE(positive(n.mean));
    if (n.mean != worst->mean) continue;
    low[0] = std::min(low[0], n.cell[0]), high[0] = std::max(high[0], n.cell[0]);
  }
  EXPECT_GT(high[0] - low[0], largest_group);
  expect_conserved(c.cells());
}

TEST(Mixing, CellsOfAGapKeepTheirOwnState) {
  // Two blocks with a gap of a fifth of a cell between them: every cell of it is small, as open as it is full.
  auto const block = [](Real x0, Real x1) {
    return testing::outline({{x0, 10.3, 0}, {x1, 10.3, 0}, {x1, 30.7, 0}, {x0, 30.7, 0}});
  };
  testing::Shape blocks = block(20.5, 30.3);
  blocks.append(block(30.5, 40.5));
  Case c(blocks, {60, 40});
  NearCell* const inside = c.at({30, 20, 0});
  ASSERT_NE(inside, nullptr);
  EXPECT_NEAR(inside->volume, 0.2, 1e-12);
  ASSERT_EQ(c.merge(), "");
  EXPECT_FALSE(inside->grouped);
  EXPECT_TRUE(c.at({30, 10, 0})->grouped || c.at({30, 10, 0})->volume > small_cell);
  // While the walls close fast, it shares with a larger cell.
  inside->volume_before = 0.5;
  c.at({30, 21, 0})->volume = 0.22;
  ASSERT_EQ(c.merge(), "");
  EXPECT_TRUE(inside->grouped);
  expect_conserved(c.cells());
}

/// Two bodies overlap in a grid plane: between the covered cells (1, 0) and (1, 1) the whole face is inside out, and
/// its flux has moved half a cell of gas. A crack of 1e-7 opens (1, 1) to the gas at its left, the other goes to the
/// right.
TEST(Mixing, NoGasComesThroughAFaceThatIsInsideOut) {
  fluid::Grid grid;
  grid.dimension = 2;
  grid.cells = {4, 2, 1};
  std::vector<NearCell> cells;
  for (Index j = 0; j < 2; ++j)
    for (Index i = 0; i < 4; ++i) {
      NearCell& c = cells.emplace_back();
      c.cell = {i, j, 0};
      c.id = grid.cell_id(c.cell);
      c.mine = c.rewritten = true;
    }
  auto const set = [&](std::size_t at, Real volume, State const& u, Real moved) {
    cells[at].volume = cells[at].volume_before = volume * grid.cell_volume();
    for (std::size_t q = 0; q < 5; ++q) cells[at].amount[q] = (volume + moved) * grid.cell_volume() * u[q];
  };
  State const left{3, 0, 0, 0, 6}, right{1, 0, 0, 0, 2};
  set(1, -4e-4, right, -0.5);
  set(5, 1e-10, right, 0.5);
  set(2, -2e-8, right, 0);
  set(4, 0.9, left, 0);
  set(6, 1, right, 0);
  set(7, 1, right, 0);
  auto const face = [&](std::size_t low, std::size_t high, std::size_t d, Real part) {
    cells[low].aperture[d][1] = cells[high].aperture[d][0] = part * grid.face_area(static_cast<int>(d));
  };
  face(1, 5, 1, -1);
  face(4, 5, 0, 1e-7);
  face(1, 2, 0, -8e-4);
  face(6, 7, 0, 1);
  EXPECT_EQ(merge_small_cells(grid, small_cell, Sight::everything, cells).trouble, "");
  EXPECT_EQ(cells[1].group, cells[5].group);
  EXPECT_EQ(cells[5].group, cells[6].group);
  EXPECT_FALSE(cells[4].grouped);
  EXPECT_NEAR(cells[6].mean[0], 1, 1e-12);
}

}  // namespace
}  // namespace brisance::coupling
