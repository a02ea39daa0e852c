// What the solid holds: energies, momenta, moments.
#include <algorithm>

#include "core/solid/solid.hpp"
#include "parallel/sum_batch.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }
Triple<double> triple(Vec3 const& v) { return {v.x, v.y, v.z}; }

}  // namespace

void Solid::measure(Measures& to) const {
  using parallel::SumBatch;
  SumBatch kinetic(to.sums[Measures::kinetic]), elastic(to.sums[Measures::elastic]), masses(to.sums[Measures::mass]),
      scale(to.sums[Measures::momentum_scale]), free_mass(to.sums[Measures::free_mass]);
  auto const three = [&](Measures::Item first) {
    auto const item = static_cast<std::size_t>(first);
    return std::array<SumBatch, 3>{SumBatch(to.sums[item]), SumBatch(to.sums[item + 1]), SumBatch(to.sums[item + 2])};
  };
  auto const add = [](std::array<SumBatch, 3>& sums, Vec3 const& v) {
    sums[0].add(v.x), sums[1].add(v.y), sums[2].add(v.z);
  };
  auto momentum_sum = three(Measures::momentum), angular = three(Measures::angular),
       moment = three(Measures::first_moment);
  for (Index l = 0; l < owned_; ++l) {
    Real const mass = mesh_.particle(id(l)).mass;
    Motion const& m = motion_[at(l)];
    Pose const& pose = pose_[at(l)];
    Vec3 const momentum = mass * m.v;
    Rotation<double> const rotation(Turn<double>{pose.q.w, triple(pose.q.v)});
    Triple<double> const spin = rotation.back(triple(m.spin));
    Inertia const& inertia = inertia_[at(inertia_of_[at(l)])];
    kinetic.add(0.5 * (dot(momentum, m.v) + dot(spin, symmetric_times(inertia.inverse.data(), spin))));
    elastic.add(volumetric_energy(l));
    if (plastic_) elastic.add(plastic_->slab_energy(l));
    masses.add(mass);
    scale.add(norm(momentum));
    add(momentum_sum, momentum);
    add(angular, cross(pose.x, momentum) + m.spin);
    if (m.turns != 0) {
      add(moment, mass * pose.x);
      free_mass.add(mass);
    }
  }
  // A link to a mirror image is half outside.
  bool const mirrors = !mesh_.far_sides.empty();
  auto const share = [&](std::size_t link) {
    return mirrors && mesh_.is_mirror(mesh_.links[mesh_link_[link]]) ? 0.5 : 1;
  };
  // Links of sleeping particles hold no energy.
  auto const add_links = [&](LinkStore::Range range) {
    for (std::size_t b = range.first; b < range.end; ++b) {
      std::array<double, lanes> const energy = links_.energy(pose_, b);
      for (std::size_t k = 0; k < lanes && b * lanes + k < links_.count(); ++k)
        if (links_.block(b).i[k] < owned_) elastic.add(share(b * lanes + k) * energy[k]);
    }
  };
  if (plastic_) {
    for (std::size_t k = 0; k < links_.count(); ++k)
      if (links_.end_i(k) < owned_) elastic.add(link_energy(k));
  } else if (sleep_ && !written_)
    for (LinkStore::Range const& range : sleep_->opening()) add_links(range);
  else
    add_links(links_.all());
  for (FaceTractions::Face const& face : face_tractions_.faces())
    if (face.particle < owned_) {
      elastic.add(FaceTractions::energy(face));
      if (plastic_) elastic.add(-face.normal_traction() * plastic_extension(face));
    }
}

}  // namespace brisance::solid
