// A scene given as text, run inside a test: the whole world is there to be looked at between pairs of steps.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/keys.hpp"
#include "drivers/assembly.hpp"
#include "drivers/scene.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::testing {

class CoupledCase {
 public:
  /// `overrides`: as --set on the command line.
  explicit CoupledCase(std::string const& toml, std::vector<std::string> const& overrides = {}) {
    Tree tree = parse_toml(toml, "case");
    for (std::string const& o : overrides) apply_override(tree, o);
    scene = read_keys<drivers::Scene>(tree);
    world = drivers::assemble(scene, comm());
    drivers::start(*world, scene);
  }
  Simulation& simulation() { return *world->simulation; }
  Real time() const { return world->simulation->clock().time; }
  std::int64_t step() const { return world->simulation->clock().step; }
  /// Runs to the end of the scene, or until `steps` steps are done; `each` is called after every pair.
  void run(std::int64_t steps = -1, std::function<void()> const& each = {}) {
    while (!simulation().finished() && (steps < 0 || step() < steps)) {
      simulation().pair();
      if (each) each();
    }
  }
  Conservation const& conservation() const { return world->simulation->ledger().conservation(); }
  std::string digest() { return simulation().digest().hex(); }

  /// Calls visit(cell, state, fluid volume) for the cells of this rank that hold fluid.
  void for_fluid(std::function<void(fluid::CellIndex, fluid::State const&, Real)> const& visit) {
    for (fluid::Block const& b : world->flow->blocks()) {
      fluid::CellIndex const first = b.first();
      for (Index k = 0; k < b.size()[2]; ++k)
        for (Index j = 0; j < b.size()[1]; ++j)
          for (Index i = 0; i < b.size()[0]; ++i) {
            fluid::CellIndex const c{first[0] + i, first[1] + j, first[2] + k};
            Real const v = world->cut_cells ? world->cut_cells->fluid_volume(c) : world->flow->grid().cell_volume();
            if (v > 0) visit(c, b.load(i, j, k), v);
          }
    }
  }
  /// Mass centre and mean velocity of all particles of this rank (tests on one rank: of the solid).
  Vec3 mass_centre() const {
    Vec3 sum;
    Real mass = 0;
    solid::Solid const& s = *world->solid;
    for (Index i = 0; i < s.owned(); ++i) {
      Real const m = world->mesh->particle(s.id(i)).mass;
      sum += m * s.pose()[static_cast<std::size_t>(i)].x;
      mass += m;
    }
    return sum / mass;
  }
  Vec3 velocity(Index particle = 0) const { return world->solid->motion()[static_cast<std::size_t>(particle)].v; }

  drivers::Scene scene;
  std::unique_ptr<drivers::World> world;
};

}  // namespace brisance::testing
