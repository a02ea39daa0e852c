#include "core/solid/effects.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/base/errors.hpp"
#include "core/solid/contact/contact.hpp"
#include "core/solid/damping/damping.hpp"
#include "core/solid/fracture/fracture.hpp"
#include "core/solid/loads/absorbing_faces.hpp"
#include "core/solid/loads/point_loads.hpp"
#include "core/solid/loads/surface_loads.hpp"
#include "core/solid/plasticity/plasticity.hpp"
#include "core/solid/rows.hpp"
#include "core/solid/supports/moving_supports.hpp"
#include "parallel/archive.hpp"

namespace brisance::solid {

namespace {

constexpr std::size_t bytes_per_link = 176;  // ends, stiffness, area, arms, normal, bending tensor

}  // namespace

void Dynamics::join(Plan& plan) {
  solid_.let_sleep();
  plan.effect("solid.motion", [this] {
    return static_cast<std::size_t>(solid_.count()) *
           (sizeof(Pose) + sizeof(Motion) + sizeof(HalfVelocity) + 2 * sizeof(Wrench) + sizeof(Inertia));
  });
  plan.at(Stage::kick, [this](Clock const& c) { solid_.half_kick(c.dt); });
  plan.at(Stage::drift, [this](Clock const& c) { solid_.move(c.dt); });
  plan.at(Stage::kick_again, [this](Clock const& c) {
    solid_.half_kick(c.dt);
    elapsed_ += c.dt;
  });
  // One look at the particles serves both limits, which are asked in this order.
  plan.limit("solid.motion", [this](Clock const&) {
    limit_ = solid_.stable_limit();
    return limit_.by_rotation ? limit_.dt : 1e300;
  });
  plan.health([this](Clock const&) { return judge(); });
  plan.account([this](Ledger& ledger) { account(ledger); });
  auto saved = std::make_shared<Solid::Saved>();
  Plan::Keep keep;
  keep.save = [this, saved] { solid_.save(*saved); };
  keep.restore = [this, saved] {
    solid_.restore(*saved, Solid::Restore::state_and_load);
    elapsed_ = 0;
    solid_.exchange_pose();
  };
  keep.write = [this](parallel::ArchiveWriter& file) {
    file.rows("solid/particles", solid_.mesh().size(), Solid::row_size, rows_of(solid_.owned_ids()), solid_.pack());
    if (solid_.damageable())
      file.rows("solid/links_intact", static_cast<std::int64_t>(solid_.mesh().links.size()), 1,
                rows_of(solid_.owned_link_ids()), solid_.pack_intact());
  };
  keep.read = [this](parallel::ArchiveReader& file) {
    solid_.unpack(solid_.owned_ids(), file.rows("solid/particles", Solid::row_size, rows_of(solid_.owned_ids())));
    solid_.exchange_pose();
    if (!solid_.damageable()) {
      solid_.compute_strains();  // reactions and gauges read them before the next forces
      return;
    }
    std::vector<GlobalId> links;
    for (std::size_t k = 0; k < solid_.links(); ++k) links.push_back(static_cast<GlobalId>(solid_.mesh_link(k)));
    auto const intact = file.rows("solid/links_intact", 1, rows_of(links));
    for (std::size_t k = 0; k < links.size(); ++k)
      if (intact[k] != 1) solid_.weaken(k, intact[k]);
    solid_.compute_strains();
  };
  keep.digest = [this](parallel::Digest& digest) { solid_.digest(digest); };
  plan.keep(std::move(keep));

  if (config_.gravity) plan.effect("solid.gravity", [] { return std::size_t{0}; });
  if (config_.links) {
    plan.effect("solid.links", [this] { return solid_.links() * (bytes_per_link + 2 * sizeof(Wrench)); });
    plan.at(Stage::forces, [this](Clock const&) {
      solid_.compute_forces();
      link_updates_ += solid_.link_updates();
      if (solid_.may_sleep()) links_asleep_ += static_cast<std::int64_t>(solid_.links()) - solid_.link_updates();
    });
    plan.limit("solid.links", [this](Clock const&) { return limit_.by_rotation ? 1e300 : limit_.dt; });
  } else {
    // Other effects add to the forces, which have to start from nothing.
    plan.at(Stage::forces, [this](Clock const&) { solid_.compute_forces(); });
  }
}

void Dynamics::start() {
  solid_.exchange_pose();
  solid_.compute_forces();
}

/// With consistent strains a break can raise the energy: the release of section 14 holds for the basic term alone.
void refuse_damage(SolidConfig const& config, Location const& at, std::string const& what) {
  require(
      !config.links || config.links->volumetric == "basic", at,
      what + " damages links, and solid.links.volumetric = \"consistent\" needs links that stay whole: use \"basic\".");
}

/// Absorbing faces solve for elastic particles with the basic strain.
void refuse_absorbing(SolidConfig const& config, Location const& at, std::string const& what) {
  require(config.absorbing.empty(), at,
          what + " does not go with solid.absorbing yet: enlarge the body instead of absorbing waves at its faces.");
}

/// Images of particles carry no gradients.
void refuse_images(Mesh const& mesh, Location const& at, std::string const& what) {
  for (FarSide const& side : mesh.far_sides)
    require(side.kind == FarSide::Kind::moving_wall, at,
            what + " does not go with symmetry planes and periodic sides: model the whole body.");
}

std::vector<std::unique_ptr<Effect>> make_effects(SolidConfig const& config, Solid& solid, parallel::Comm& comm) {
  std::vector<std::unique_ptr<Effect>> effects;
  if (config.links && config.links->volumetric == "consistent") {
    refuse_absorbing(config, config.at, "solid.links.volumetric = \"consistent\"");
    refuse_images(solid.mesh(), config.at, "solid.links.volumetric = \"consistent\"");
  }
  if (!solid.mesh().motions.empty()) effects.push_back(std::make_unique<MovingSupports>(solid));
  if (!config.pressure.empty() || !config.traction.empty() || !config.blast.empty())
    effects.push_back(std::make_unique<SurfaceLoads>(config, solid));
  if (!config.point_force.empty() || !config.moment_tensor.empty())
    effects.push_back(std::make_unique<PointLoads>(config, solid));
  if (!config.absorbing.empty()) effects.push_back(std::make_unique<AbsorbingFaces>(config, solid));
  auto const yields = [](auto const& material) { return material.second.plasticity.has_value(); };
  if (std::any_of(config.material.begin(), config.material.end(), yields)) {
    for (auto const& [name, material] : config.material) {
      if (!material.plasticity) continue;
      refuse_absorbing(config, material.plasticity->at, "solid.material." + name + ".plasticity");
      if (material.plasticity->failure)
        refuse_damage(config, material.plasticity->at, "solid.material." + name + ".plasticity.failure");
    }
    effects.push_back(std::make_unique<Plasticity>(config, solid, comm));
  }
  if (config.contact) effects.push_back(std::make_unique<Contact>(config, solid, comm));
  if (config.damping) effects.push_back(std::make_unique<Damping>(*config.damping, config, solid, comm));
  if (config.fracture) {
    require(config.links.has_value(), config.fracture->at,
            "solid.fracture breaks links, and the scene has none: add links = {} to [solid]");
    refuse_damage(config, config.fracture->at, "solid.fracture");
    effects.push_back(std::make_unique<Fracture>(*config.fracture, solid, comm));
  }
  return effects;
}

void require_multirate_support(SolidConfig const& config, Plan const& plan) {
  if (!config.motion.multirate) return;
  Location const& at = config.motion.multirate->at;
  if (!config.links) scene_error(at, "solid.motion.multirate needs solid.links: free particles all take one step");
  if (config.motion.step != "guaranteed")
    scene_error(at, "solid.motion.multirate needs the limit of every particle, solid.motion.step = \"" +
                        config.motion.step + "\" knows only that of the whole solid: take \"guaranteed\"");
  constexpr std::array<std::string_view, 3> supported{"solid.motion", "solid.links", "solid.gravity"};
  for (Plan::EffectCost const& effect : plan.effects()) {
    std::string_view const name = effect.name;
    if (!name.starts_with("solid.") && !name.starts_with("coupling.")) continue;
    if (std::find(supported.begin(), supported.end(), name) != supported.end()) continue;
    scene_error(at, "solid.motion.multirate does not go together with " + effect.name +
                        ", which acts on all particles at one step. Leave one of them out.");
  }
}

Verdict Dynamics::judge() const {
  Solid const& solid = solid_;  // who may write wakes the sleeping
  for (Index i = 0; i < solid_.owned(); ++i) {
    auto const at = static_cast<std::size_t>(i);
    Vec3 const x = solid.pose()[at].x;
    Motion const& motion = solid.motion()[at];
    if (std::isfinite(norm2(x) + norm2(motion.v) + norm2(motion.spin))) continue;
    Mesh const& mesh = solid_.mesh();
    GlobalId const id = solid_.id(i);
    return {false, "particle " + std::to_string(id) + " of body \"" +
                       mesh.bodies[static_cast<std::size_t>(mesh.particle(id).body)].name +
                       "\" has a position or velocity that is not a number"};
  }
  return {};
}

void Dynamics::account(Ledger& ledger) {
  Measures here;
  solid_.measure(here);
  ledger.add(Entry::mass, here.sums[Measures::mass]);
  for (std::size_t d = 0; d < 3; ++d)
    ledger.add(static_cast<Entry>(static_cast<std::size_t>(Entry::momentum_x) + d), here.sums[Measures::momentum + d]);
  ledger.add(Entry::energy, here.sums[Measures::kinetic]);
  ledger.add(Entry::energy, here.sums[Measures::elastic]);
  ledger.add(Entry::solid_kinetic, here.sums[Measures::kinetic]);
  ledger.add(Entry::solid_elastic, here.sums[Measures::elastic]);
  ledger.add(Entry::momentum_size, here.sums[Measures::momentum_scale]);
  Reactions const supports = solid_.take_reactions();
  for (std::size_t d = 0; d < 3; ++d)
    ledger.add(static_cast<Entry>(static_cast<std::size_t>(Entry::in_momentum_x) + d), supports.sums[d]);
  ledger.add(Entry::in_energy, supports.sums[6]);
  if (config_.gravity) {
    // Weight as a potential energy of the free particles, and its impulse as one that crosses the boundary.
    // Particle by particle: a product with a sum of this rank would round as the partition has it.
    Vec3 const g = *config_.gravity;
    for (Index l = 0; l < solid_.owned(); ++l) {
      auto const at = static_cast<std::size_t>(l);
      if (solid_.motion()[at].turns == 0) continue;
      Real const mass = solid_.mesh().particle(solid_.id(l)).mass;
      ledger.add(Entry::energy, -mass * dot(g, solid_.pose()[at].x));
      ledger.add(Entry::in_momentum_x, (elapsed_ * mass) * g);
    }
  }
  elapsed_ = 0;
  ledger.add(Entry::pressure_impulse, norm(supports.impulse()));
  ledger.add(Entry::exchanged_energy, std::abs(supports.work()));
}

}  // namespace brisance::solid
