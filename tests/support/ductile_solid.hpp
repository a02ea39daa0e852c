// A solid without a fluid that may yield, stepped as the program steps it.
#pragma once
#include "core/model/simulation.hpp"
#include "core/solid/effects.hpp"
#include "core/solid/plasticity/plasticity.hpp"
#include "tests/support/solids.hpp"

namespace brisance::testing {

/// Mesh, solid, its effects and the simulation around them, on all ranks of `comm`.
struct DuctileSolid {
  solid::Mesh mesh;
  parallel::Comm& comm;
  solid::Solid solid;
  solid::Dynamics dynamics;
  std::vector<std::unique_ptr<Effect>> effects;
  Plan plan;
  Simulation simulation;

  DuctileSolid(solid::SolidConfig const& config, int dimension, Real end_time, parallel::Comm& all,
               std::vector<int> const& owner, Real output_interval = 0)
      : mesh(solid::build_mesh(config, dimension)),
        comm(all),
        solid(mesh, config, owner, comm, dimension),
        dynamics(config, solid),
        effects(solid::make_effects(config, solid, comm)),
        simulation(plan, comm, {end_time, 1, output_interval}) {
    dynamics.join(plan);
    for (auto const& effect : effects) effect->join(plan);
  }
  DuctileSolid(solid::SolidConfig const& config, int dimension, Real end_time, parallel::Comm& all)
      : DuctileSolid(config, dimension, end_time, all, slices(solid::build_mesh(config, dimension), all.size())) {}

  /// After the initial motion has been set.
  void start() {
    dynamics.start();
    for (auto const& effect : effects) effect->start();
    simulation.audit();
  }
  solid::Plasticity& plasticity() {
    for (auto const& effect : effects)
      if (auto* found = dynamic_cast<solid::Plasticity*>(effect.get())) return *found;
    throw std::logic_error("the scene has no plasticity");
  }
  Ledger const& ledger() const { return simulation.ledger(); }

  /// Traction on the faces that look along +x and -x: the bar is pulled with `stress`, Pa.
  void pull(Real stress) {
    std::vector<solid::FaceLoad> loads;
    for (solid::FreeFace const& f : mesh.free_faces) {
      if (f.clamped) continue;
      Vec3 const n = mesh.face(f.particle, f.face).normal;
      if (std::abs(n.x) > 0.5) loads.push_back({f.particle, f.face, {stress * n.x, 0, 0}});
    }
    solid.load_faces(loads);
  }
  /// Loses a share of all velocities: damping that leaves statics alone.
  void slow(Real share) {
    for (solid::Motion& m : solid.motion()) m.v *= 1 - share, m.spin *= 1 - share;
  }
};

}  // namespace brisance::testing
