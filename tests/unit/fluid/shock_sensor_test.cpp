// Marks of the shock sensor: where the theory puts them, and the same on any blocks and ranks.
#include "fluid/shock_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "fluid/initial_state.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

FlowConfig config(std::vector<int> cells, int block, std::string const& sides) {
  FlowConfig c = testing::unit_box(static_cast<int>(cells.size()), 1);
  c.cells = std::move(cells);
  c.block = block;
  testing::set_boundaries(c, sides);
  return c;
}

struct Mark {
  GlobalId cell;
  int bits;
};

/// Marks of all cells of all ranks after filling the cells with these pressures, by cell id; only the set ones.
std::map<GlobalId, int> marks_of(FlowConfig const& c, std::function<Real(CellIndex)> const& pressure) {
  parallel::Comm& comm = testing::comm();
  auto const domain = testing::make_flow(c, comm);
  Flow& flow = *domain;
  fill(flow, [&](CellIndex i) {
    Real const p = pressure(i);
    return p > 0 ? flow.gas().conserved(1, {}, p) : State{};
  });
  flow.begin_pair();
  parallel::Bytes mine;
  for (Block const& block : flow.blocks())
    if (auto const* layer = flow.marks(block))
      for (Index k = 0; k < block.size()[2]; ++k)
        for (Index j = 0; j < block.size()[1]; ++j)
          for (Index i = 0; i < block.size()[0]; ++i)
            if (int const mark = *layer->at(i, j, k)) {
              CellIndex const first = block.first();
              parallel::put(mine, Mark{flow.grid().cell_id({first[0] + i, first[1] + j, first[2] + k}), mark});
            }
  std::map<GlobalId, int> marks;
  for (parallel::Bytes const& bytes : comm.all_gather(mine))
    for (std::span<std::byte const> in(bytes); !in.empty();) {
      Mark const m = parallel::take<Mark>(in);
      marks[m.cell] = m.bits;
    }
  return marks;
}

TEST(ShockSensor, MarksTwoCellsOnEitherSideOfAJumpAlongItsDirectionOnly) {
  for (int block : {24, 9}) {
    auto const marks = marks_of(config({24, 12}, block, "reflecting"), [](CellIndex c) { return c[0] < 9 ? 1.6 : 1; });
    EXPECT_EQ(marks.size(), 4u * 12);
    for (Index j = 0; j < 12; ++j)
      for (Index i = 7; i < 11; ++i) {
        ASSERT_TRUE(marks.contains(i + 24 * j)) << i << " " << j << " block " << block;
        EXPECT_EQ(marks.at(i + 24 * j), 1);
      }
  }
}

TEST(ShockSensor, LeavesSmallJumpsAndVacuumAlone) {
  EXPECT_TRUE(marks_of(config({24, 12}, 8, "reflecting"), [](CellIndex c) { return c[0] < 9 ? 1.49 : 1; }).empty());
  EXPECT_TRUE(marks_of(config({24, 12}, 8, "reflecting"), [](CellIndex c) { return c[1] < 5 ? 1 : 0; }).empty());
}

/// A front of pressure 9 to 1, smeared over some cells, at angles to the grid. Cells at the sides of the domain see
/// half of its jump across them and are left out.
TEST(ShockSensor, LeavesObliqueShocksAlone) {
  auto const marked = [](Real slope) {
    std::size_t inner = 0;
    for (auto const& [cell, bits] : marks_of(config({48, 16}, 16, "outflow"), [slope](CellIndex c) {
           return 5 - 4 * std::tanh(c[0] - 24 + slope * (c[1] - 8));
         }))
      inner += cell / 48 >= 2 && cell / 48 < 14;
    return inner;
  };
  EXPECT_GE(marked(0), 12u * 4);
  EXPECT_GE(marked(0.1), 12u * 3);
  EXPECT_LT(marked(0.5), marked(0) / 2);
  EXPECT_EQ(marked(1), 0u);
  EXPECT_EQ(marked(-1), 0u);
}

TEST(ShockSensor, ReachesAcrossPeriodicSides) {
  auto const marks = marks_of(config({12, 12}, 12, "periodic"), [](CellIndex c) { return c[1] < 6 ? 2 : 1; });
  for (Index j : {0, 1, 4, 5, 6, 7, 10, 11}) EXPECT_EQ(marks.at(3 + 12 * j), 2) << j;
  EXPECT_EQ(marks.size(), 8u * 12);
}

TEST(ShockSensor, IsTheSameForAllBlocksAndRanks) {
  auto const pressure = [](CellIndex c) { return 1 + ((c[0] * 7 + c[1] / 6 * 5 + c[2] / 7 * 3) % 11 < 3 ? 4. : 0.2); };
  auto const whole = marks_of(config({20, 18, 16}, 48, "reflecting"), pressure);
  EXPECT_GT(whole.size(), 100u);
  EXPECT_EQ(whole, marks_of(config({20, 18, 16}, 6, "reflecting"), pressure));
}

}  // namespace
}  // namespace brisance::fluid
