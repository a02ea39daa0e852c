// Bodies that meet: free, held, moving, turned; and the contact effect of a run.
#pragma once
#include <stdexcept>

#include "core/solid/contact/contact.hpp"
#include "tests/support/solid_run.hpp"

namespace brisance::testing {

inline solid::SolidConfig rigid(Real young_modulus = 1) {
  solid::SolidConfig config = one_material(1, young_modulus, 0);
  config.links.reset();
  config.contact.emplace();
  return config;
}

inline solid::Contact& contact_of(SolidRun& run) {
  for (auto const& effect : run.effects)
    if (auto* contact = dynamic_cast<solid::Contact*>(effect.get())) return *contact;
  throw std::logic_error("no contact");
}

inline solid::BodyConfig held(solid::BodyConfig body) {
  body.hold.push_back({{-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}});
  return body;
}

inline solid::BodyConfig moving(solid::BodyConfig body, Vec3 const& velocity, Vec3 const& spin = {}) {
  body.velocity = velocity;
  body.spin = spin;
  return body;
}

/// Turns a body about its centre, as a rigid one.
inline void turn(SolidRun& run, Index body, Vec3 const& centre, Quaternion const& q) {
  for (Index p = 0; p < run.solid.owned(); ++p) {
    if (run.mesh.particle(run.solid.id(p)).body != body) continue;
    solid::Pose& pose = run.solid.pose()[static_cast<std::size_t>(p)];
    pose.x = centre + rotate(q, pose.x - centre);
    pose.q = q * pose.q;
  }
}

}  // namespace brisance::testing
