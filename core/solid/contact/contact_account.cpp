#include "core/solid/contact/contact_account.hpp"

namespace brisance::solid {

void ContactAccount::before_kick() {
  for (Pushed& p : pushed_) p.velocity.begin(solid_, p.particle);
}

void ContactAccount::after_kick(Real dt) {
  Solid const& solid = solid_;
  for (Pushed& p : pushed_) {
    auto const at = static_cast<std::size_t>(p.particle);
    KickLoad mean{};
    p.velocity.take(solid, p.particle, mean);
    // Of held and driven particles the supports take the force, and they are charged on the way of the step.
    if (solid.motion()[at].turns == 0)
      mean.v = solid.half_velocity()[at].v, mean.omega = solid.half_velocity()[at].omega;
    for (int d = 0; d < solid.mesh().dimension; ++d) given_[1 + static_cast<std::size_t>(d)].add(0.5 * dt * p.force[d]);
    given_[4].add(0.5 * dt * (dot(p.force, mean.v) + dot(p.torque, mean.omega)));
  }
}

void ContactAccount::end_step(parallel::ExactSum const& energy, parallel::ExactSum const& dissipated) {
  given_[4].add(energy);
  given_[4].subtract(energy_);
  given_[4].add(dissipated);
  stages_.shift(Part::motion, Part::contact, given_);
  given_ = {};
}

void ContactAccount::write(parallel::ArchiveWriter& file) const {
  // Several contacts of a particle are one row: their order is that of the pairs, the same on every rank.
  std::vector<GlobalId> ids;
  std::vector<double> rows;
  for (Pushed const& p : pushed_) {
    ids.push_back(solid_.id(p.particle));
    rows.insert(rows.end(), {p.force.x, p.force.y, p.force.z, p.torque.x, p.torque.y, p.torque.z});
  }
  file.sparse("solid/contact_forces", 6, ids, rows);
}

void ContactAccount::read(parallel::ArchiveReader& file) {
  pushed_.clear();
  given_ = {};
  if (!file.has("solid/contact_forces")) return;
  auto const stored = file.sparse("solid/contact_forces", 6);
  std::vector<Index> local(static_cast<std::size_t>(solid_.mesh().size()), -1);
  for (Index l = 0; l < solid_.owned(); ++l) local[static_cast<std::size_t>(solid_.id(l))] = l;
  for (std::size_t r = 0; r < stored.ids.size(); ++r) {
    Index const l = local[static_cast<std::size_t>(stored.ids[r])];
    double const* const row = stored.data.data() + 6 * r;
    if (l >= 0) add(l, {row[0], row[1], row[2]}, {row[3], row[4], row[5]});
  }
}

}  // namespace brisance::solid
