// A solid with its effects, stepped as a run steps it.
#pragma once
#include "core/model/simulation.hpp"
#include "core/solid/effects.hpp"
#include "tests/support/solids.hpp"

namespace brisance::testing {

struct SolidRun {
  solid::Mesh mesh;
  solid::Solid solid;
  solid::Dynamics dynamics;
  std::vector<std::unique_ptr<Effect>> effects;
  Plan plan;
  Simulation simulation;
  parallel::Comm& comm;

  SolidRun(solid::SolidConfig const& config, int dimension, Real end_time, parallel::Comm& with)
      : SolidRun(config, dimension, end_time, with, {}) {}
  /// `owner`: empty = slices along the numbering.
  SolidRun(solid::SolidConfig const& config, int dimension, Real end_time, parallel::Comm& with,
           std::vector<int> const& owner)
      : mesh(solid::build_mesh(config, dimension)),
        solid(mesh, config, owner.empty() ? slices(mesh, with.size()) : owner, with, dimension),
        dynamics(config, solid),
        effects(solid::make_effects(config, solid, with)),
        simulation(plan, with, TimeControl{end_time, 1, 0}),
        comm(with) {
    dynamics.join(plan);
    for (auto const& effect : effects) effect->join(plan);
  }
  void start() {
    dynamics.start();
    for (auto const& effect : effects) effect->start();
    simulation.audit();
  }
  void to_the_end() {
    while (!simulation.finished()) simulation.pair();
  }

  solid::Measures measure() {
    solid::Measures m;
    solid.measure(m);
    comm.sum(std::span(m.sums));
    return m;
  }
  Real energy() const { return simulation.ledger().total(Entry::energy); }
  Real dissipated() const { return simulation.ledger().received(Entry::dissipated); }
  /// Mean velocity of a body on one rank, m/s.
  Vec3 velocity(Index body) const {
    Vec3 momentum{};
    for (Index p = 0; p < solid.owned(); ++p)
      if (auto const& of = mesh.particle(solid.id(p)); of.body == body)
        momentum += of.mass * solid.motion()[static_cast<std::size_t>(p)].v;
    return momentum / mesh.bodies[static_cast<std::size_t>(body)].mass;
  }
};

}  // namespace brisance::testing
