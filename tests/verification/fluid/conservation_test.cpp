// Mass and energy of a blast in a closed box, with open sides, and through rejected pairs.
#include <gtest/gtest.h>

#include <cmath>

#include "fluid/advance.hpp"
#include "fluid/initial_state.hpp"
#include "fluid/totals.hpp"
#include "parallel/error.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

/// F23, the cylindrical Sedov blast: a quarter plane with walls, the energy in the corner cell.
FlowConfig sedov() {
  FlowConfig config = testing::unit_box(2, 60, 1.2);
  config.ambient = {1, 0.4e-5, {}};
  config.block = 24;
  return config;
}

void set_corner_energy(Flow& flow) {
  if (Block* corner = flow.find(0)) {
    State u = corner->load(0, 0, 0);
    u[4] = 0.244816 / flow.grid().cell_volume();
    corner->store(0, 0, 0, u);
  }
}

struct Outcome {
  Real mass, energy;  // defects relative to the totals
  Vec3 momentum;      // relative to momentum and impulses
  Real density_max;
  std::int64_t rejected;
  Real left;  // share of the mass that left through the sides
};

Outcome run(Flow& flow, Real end, Real cfl) {
  Totals const before = totals(flow);
  FlowClock clock;
  advance(flow, clock, {.end = end, .cfl = cfl});
  EXPECT_EQ(clock.time, end);
  Totals const after = totals(flow);
  BoundaryLedger::Totals const crossed = flow.ledger().totals(flow.comm());
  Outcome o;
  o.mass = std::abs(after.mass - before.mass - crossed.gained[0]) / before.mass;
  o.energy = std::abs(after.energy - before.energy - crossed.gained[4]) / before.energy;
  for (int d = 0; d < 3; ++d)
    o.momentum[d] = std::abs(after.momentum[d] - before.momentum[d] - crossed.gained[static_cast<std::size_t>(1 + d)]) /
                    (after.momentum_size + crossed.impulse);
  o.left = -crossed.gained[0] / before.mass;
  o.rejected = clock.retry.rejected();
  o.density_max = 0;
  for (Block const& block : flow.blocks())
    for (Index k = 0; k < block.size()[2]; ++k)
      for (Index j = 0; j < block.size()[1]; ++j)
        for (Index i = 0; i < block.size()[0]; ++i) o.density_max = max(o.density_max, block.load(i, j, k)[0]);
  return o;
}

/// Largest density on the axis (row 0) and on the diagonal.
std::array<Real, 2> peaks(Flow& flow) {
  std::array<Real, 2> peak{};
  for (Block const& block : flow.blocks())
    for (Index j = 0; j < block.size()[1]; ++j)
      for (Index i = 0; i < block.size()[0]; ++i) {
        CellIndex const c{block.first()[0] + i, block.first()[1] + j, 0};
        Real const density = block.load(i, j, 0)[0];
        if (c[1] == 0) peak[0] = max(peak[0], density);
        if (c[0] == c[1]) peak[1] = max(peak[1], density);
      }
  return peak;
}

void expect_conserved(Outcome const& o, std::string const& id, std::string const& name, std::string const& variant) {
  EXPECT_TRUE(evidence::at_most(id, name, variant, "mass defect", o.mass, 1e-13));
  EXPECT_TRUE(evidence::at_most(id, name, variant, "energy defect", o.energy, 1e-13));
  for (int d = 0; d < 3; ++d)
    EXPECT_TRUE(evidence::at_most(id, name, variant, std::string("momentum defect ") + "xyz"[d], o.momentum[d], 1e-13));
}

TEST(Conservation, ClosedBoxKeepsMassAndEnergyOfASedovBlast) {
  struct Case {
    int order;
    Real axis, diagonal;
  };  // peaks of the theory without the transverse sensor
  for (Case const& c : {Case{1, 1.96, 3.35}, Case{5, 4.02, 4.23}, Case{11, 4.63, 4.51}}) {
    FlowConfig config = sedov();
    config.euler->order = c.order;
    config.euler->hybrid = false;
    config.euler->shear_dissipation = 0;
    auto const flow = testing::make_flow(config, testing::comm());
    fill(*flow, config);
    set_corner_energy(*flow);
    Outcome const o = run(*flow, 1, 0.9);
    std::string const variant = "order " + std::to_string(c.order) + " without sensor";
    expect_conserved(o, "F23", "Sedov", variant);
    EXPECT_LE(std::abs(o.left), 1e-13);
    auto const p = peaks(*flow);
    EXPECT_TRUE(evidence::near("F23", "Sedov", variant, "peak density on the axis", p[0], c.axis, 0.02 * c.axis));
    EXPECT_TRUE(
        evidence::near("F23", "Sedov", variant, "peak density on the diagonal", p[1], c.diagonal, 0.02 * c.diagonal));
  }
}

TEST(Conservation, RejectedPairsLeaveNoTrace) {
  FlowConfig config = sedov();
  auto const flow = testing::make_flow(config, testing::comm());
  fill(*flow, config);
  set_corner_energy(*flow);
  Outcome const o = run(*flow, 1, 1.6);
  EXPECT_GT(o.rejected, 10);
  expect_conserved(o, "F23", "Sedov", "nominal Courant number 1.6");
  EXPECT_GT(o.density_max, 4);
}

TEST(Conservation, OpenSidesAreAccountedFor) {
  for (int dimension : {1, 2, 3}) {
    FlowConfig config = testing::unit_box(dimension, dimension == 3 ? 24 : 48);
    testing::set_boundaries(config, "outflow");
    config.boundary.x_low = "inflow";
    config.inflow.x_low = GasState{2, 1.5, {1.1, 0.2, 0}};
    config.block = 16;
    RegionConfig ball;
    ball.shape = "ball";
    ball.centre = Vec3{0.6, 0.45, 0.5};
    ball.radius = 0.25;
    ball.density = 3;
    ball.pressure = 50;
    config.region = {ball};
    auto const flow = testing::make_flow(config, testing::comm());
    fill(*flow, config);
    Outcome const o = run(*flow, 0.2, 0.8);
    expect_conserved(o, "F30", "blast with open sides", std::to_string(dimension) + "D");
    EXPECT_GT(std::abs(o.left), 0.01);
  }
}

/// The signal speed grows by orders of magnitude in the first pair: the state before it must come back exactly.
TEST(Retry, RestoreBringsBackEveryBit) {
  FlowConfig config = sedov();
  auto const flow = testing::make_flow(config, testing::comm());
  fill(*flow, config);
  set_corner_energy(*flow);
  parallel::Digest before, changed, after;
  add_cells(before, *flow);
  flow->save();
  flow->sweep(0, 1e-4);
  flow->sweep(1, 1e-4);
  add_cells(changed, *flow);
  EXPECT_FALSE(changed == before);
  flow->restore();
  add_cells(after, *flow);
  EXPECT_TRUE(after == before);
  EXPECT_EQ(flow->ledger().totals(flow->comm()).impulse, 0);
}

TEST(Retry, GivesUpWithTheCellAndTheCause) {
  FlowConfig config = sedov();
  auto const flow = testing::make_flow(config, testing::comm());
  fill(*flow, config);
  Block& block = flow->blocks().front();
  block.store(5, 7, 0, {1, 0, 0, 0, -1});
  FlowClock clock;
  try {
    advance(*flow, clock, {.end = 1, .cfl = 0.9});
    FAIL();
  } catch (Error const& e) {
    EXPECT_EQ(e.kind(), Failure::numerical);
    EXPECT_NE(std::string(e.what()).find("negative internal energy"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace brisance::fluid
