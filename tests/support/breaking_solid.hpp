// A solid without a fluid that may break, stepped as the program steps it.
#pragma once
#include <cstdio>
#include <string>

#include "core/model/simulation.hpp"
#include "core/solid/effects.hpp"
#include "core/solid/fracture/fracture.hpp"
#include "tests/support/solids.hpp"

namespace brisance::testing {

/// A number as texts show it.
inline std::string figure(Real x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

inline solid::LawConfig stress_law(Real tensile_strength, Real beta = 1) {
  solid::LawConfig law;
  law.stress.emplace();
  law.stress->tensile_strength = tensile_strength;
  law.stress->beta = beta;
  return law;
}

/// Mesh, solid, its effects and the simulation around them, on all ranks of `comm`.
struct BreakingSolid {
  solid::Mesh mesh;
  parallel::Comm& comm;
  solid::Solid solid;
  solid::Dynamics dynamics;
  std::vector<std::unique_ptr<Effect>> effects;
  Plan plan;
  Simulation simulation;

  BreakingSolid(solid::SolidConfig const& config, int dimension, Real end_time, parallel::Comm& all,
                std::vector<int> const& owner)
      : mesh(solid::build_mesh(config, dimension)),
        comm(all),
        solid(mesh, config, owner, comm, dimension),
        dynamics(config, solid),
        effects(solid::make_effects(config, solid, comm)),
        simulation(plan, comm, {end_time, 1, 0}) {
    dynamics.join(plan);
    for (auto const& effect : effects) effect->join(plan);
  }
  BreakingSolid(solid::SolidConfig const& config, int dimension, Real end_time, parallel::Comm& all)
      : BreakingSolid(config, dimension, end_time, all, slices(solid::build_mesh(config, dimension), all.size())) {}

  /// After the initial motion has been set.
  void start() {
    dynamics.start();
    for (auto const& effect : effects) effect->start();
    simulation.audit();
  }
  solid::Fracture& fracture() {
    for (auto const& effect : effects)
      if (auto* found = dynamic_cast<solid::Fracture*>(effect.get())) return *found;
    throw std::logic_error("the scene has no fracture");
  }
  Ledger const& ledger() const { return simulation.ledger(); }
  Real broken() const { return ledger().received(Entry::links_broken); }
  Real dissipated() const { return ledger().received(Entry::dissipated); }
};

}  // namespace brisance::testing
