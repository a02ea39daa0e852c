// The ledger by stages: defects of the parts of a step add up to that of the whole, every conservative part closes to
// round-off, and a fault put into one part is charged to this part alone.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/coupled_case.hpp"

namespace brisance {
namespace {

using namespace testing;

/// A brittle shell around hot gas, which bursts within some steps.
std::string shell(std::string const& fluid = "", std::string const& coupling = "cut_cells = {}") {
  return R"(end_time = 0.3
[output]
ledger = "stage"
[fluid]
low = [-0.5, -0.5]
high = [0.5, 0.5]
cells = [40, 40]
block = 20
euler = { order = 5, cfl = 0.5 }
ambient = { density = 1.4, pressure = 1 }
)" + fluid +
         R"(
[[fluid.region]]
shape = "ball"
centre = [0.03, 0.02]
radius = 0.15
density = 28
pressure = 40
[solid]
links = {}
gravity = [0, -0.1]
contact = {}
damping = { rate = 0.1 }
[solid.material.shell]
density = 50
young_modulus = 2500
[[solid.body]]
material = "shell"
shape = "tube"
tessellation = "polar"
centre = [0, 0]
inner_radius = 0.25
outer_radius = 0.3
cells = [1, 30]
phase = 0.013
[[solid.fracture.law]]
stress = { tensile_strength = 40 }
[coupling]
)" + coupling +
         "\n";
}

using Defects = std::array<Real, 5>;

/// Of the whole, from the totals of the ledger.
Defects whole(Ledger const& ledger) {
  auto const start = ledger.store();  // begins with the totals of the start
  Defects d{};
  for (std::size_t q = 0; q < 5; ++q)
    d[q] = ledger.total(static_cast<Entry>(q)) - start[q] -
           ledger.received(static_cast<Entry>(static_cast<std::size_t>(Entry::in_mass) + q));
  d[4] += ledger.received(Entry::dissipated);
  return d;
}

Defects scales(Ledger const& ledger) {
  DefectScales const s = ledger.scales();
  return {s.mass, s.momentum, s.momentum, s.momentum, s.energy};
}

bool oscillates(Part part) { return part == Part::motion || part == Part::contact; }

void expect_closed(CoupledCase& c, Part but = Part::count) {
  Ledger const& ledger = c.simulation().ledger();
  StageLedger const& stages = *c.simulation().stages();
  Defects const scale = scales(ledger), all = whole(ledger);
  Defects sum{};
  for (std::size_t p = 0; p < part_count; ++p) {
    Part const part = static_cast<Part>(p);
    Defects const d = stages.defect(part);
    for (std::size_t q = 0; q < 5; ++q) {
      sum[q] += d[q];
      if (part == but || (q == 4 && oscillates(part))) continue;
      EXPECT_LE(std::abs(d[q]), 1e-14 * scale[q]) << name(part) << ", item " << q;
    }
  }
  for (std::size_t q = 0; q < 5; ++q) EXPECT_NEAR(sum[q], all[q], 1e-15 * scale[q]) << "item " << q;
}

TEST(StageLedger, PartsAddUpAndClose) {
  std::string const viscous =
                        "gas = { gas_constant = 1 }\ngravity = { acceleration = [0, -0.5] }\nviscosity = { law = "
                        "\"constant\", dynamic_viscosity = 1e-3 }",
                    outflow = "boundary = { x_low = \"outflow\", x_high = \"outflow\", y_low = \"outflow\" }";
  struct Variant {
    std::string fluid, coupling;
  };
  for (Variant const& v :
       {Variant{outflow, "cut_cells = {}"}, Variant{outflow, "scheme = \"semi\"\ncut_cells = { load = \"relative\" }"},
        Variant{outflow, "scheme = \"explicit\"\nsub_steps = 2\ncut_cells = {}"},
        Variant{viscous, "cut_cells = { wall = { temperature = 0.8 } }"},
        Variant{outflow, "cut_cells = { profile = \"density\", small_cells = \"redistribution\" }"}}) {
    SCOPED_TRACE(v.fluid + v.coupling);
    CoupledCase c(shell(v.fluid, v.coupling));
    c.run(120);
    EXPECT_GT(c.simulation().ledger().received(Entry::links_broken), 0);
    EXPECT_GT(c.simulation().ledger().received(Entry::dissipated), 0);
    expect_closed(c);
    EXPECT_EQ(open_accounts(*c.simulation().stages(), c.simulation().ledger().scales()), "");
    for (Part const part :
         {Part::sweep_x, Part::sweep_y, Part::transfers, Part::wall, Part::mixing, Part::motion, Part::fracture})
      EXPECT_TRUE(c.simulation().stages()->charged(part)) << name(part);
    EXPECT_FALSE(c.simulation().stages()->charged(Part::sweep_z));
    // The step of Verlet is what does not close.
    Real const steps =
        c.simulation().stages()->defect(Part::motion)[4] + c.simulation().stages()->defect(Part::contact)[4];
    EXPECT_NEAR(steps, whole(c.simulation().ledger())[4], 1e-13 * scales(c.simulation().ledger())[4]);
  }
}

/// A task that spoils the state once, in the step after `begin`.
struct Fault {
  Part part;
  Stage stage;
  bool in_gas;
};

TEST(StageLedger, NamesThePartThatIsWrong) {
  constexpr Real amount = 1e-3;
  for (Fault const& fault : {Fault{Part::sources, Stage::source, true}, Fault{Part::diffusion, Stage::diffuse, true},
                             Fault{Part::sweep_y, Stage::sweeps, true}, Fault{Part::mixing, Stage::mix, true},
                             Fault{Part::wall, Stage::load_solid, false}, Fault{Part::motion, Stage::kick_again, false},
                             Fault{Part::fracture, Stage::fracture, false}}) {
    SCOPED_TRACE(name(fault.part));
    CoupledCase c(shell());
    Real expected = 0;
    Plan& plan = c.world->plan;
    plan.effect("test.fault", [] { return std::size_t{0}; });
    auto const spoil = [&](Clock const& clock) {
      if (clock.step != 5) return;
      if (fault.in_gas) {
        fluid::Grid const& grid = c.world->flow->grid();
        if (fluid::Block* const block = c.world->flow->find(grid.block_of({1, 1, 0}))) {
          fluid::State u = block->load(1, 1, 0);
          u[1] += amount;  // momentum alone
          block->store(1, 1, 0, u);
        }
        expected = amount * grid.cell_volume();
        return;
      }
      solid::Solid& solid = *c.world->solid;
      if (fault.part == Part::wall) {
        for (Index l = 0; l < solid.owned(); ++l)
          if (solid.id(l) == 3) solid.load()[static_cast<std::size_t>(l)].force.x += amount;
        expected = clock.dt * amount;
        return;
      }
      for (Index l = 0; l < solid.owned(); ++l)
        if (solid.id(l) == 3) solid.motion()[static_cast<std::size_t>(l)].v.x += amount;
      expected = amount * c.world->mesh->particle(3).mass;
    };
    if (fault.stage == Stage::sweeps)
      plan.at(fault.stage, spoil, [](Clock const&) { return Part::sweep_y; });
    else
      plan.at(fault.stage, spoil);
    c.run(10);
    ASSERT_GT(expected, 0);
    StageLedger const& stages = *c.simulation().stages();
    EXPECT_NEAR(stages.defect(fault.part)[1], expected, 1e-14 * c.simulation().ledger().scales().momentum);
    expect_closed(c, fault.part);
    std::string const text = open_accounts(stages, c.simulation().ledger().scales());
    for (std::size_t p = 0; p < part_count; ++p) {
      Part const part = static_cast<Part>(p);
      bool const named = text.find(std::string(" ") + name(part) + " (") != std::string::npos;
      EXPECT_EQ(named, part == fault.part) << text;
    }
  }
}

TEST(StageLedger, IsAbsentUnlessAskedFor) {
  CoupledCase c(shell(), {"output.ledger=\"total\""});
  EXPECT_EQ(c.simulation().stages(), nullptr);
  c.run(6);
  CoupledCase with(shell());
  with.run(6);
  EXPECT_EQ(c.digest(), with.digest());
}

}  // namespace
}  // namespace brisance
