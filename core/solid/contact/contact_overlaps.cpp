// What the listed pairs have in common at the present poses, and the laws by which they resist.
#include <cmath>

#include "core/solid/contact/contact.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

PairLaw Contact::law_of(ContactPair const& pair) const {
  ContactActor const &a = list_.actors()[at(pair.a)], &b = list_.actors()[at(pair.b)];
  Material const &ma = solid_.mesh().material(a.id), &mb = solid_.mesh().material(b.id);
  Real const volume = min(a.shape->volume, b.shape->volume);
  Real const nu = 0.5 * (ma.poisson_ratio + mb.poisson_ratio);
  PairLaw law;
  law.stiffness = config_.stiffness * min(ma.young_modulus, mb.young_modulus) / volume;
  // A thin body is crossed before its volume is overlapped: a fifth of the way through it counts as much.
  Real const through =
      min(a.shape->largest_face, b.shape->largest_face) * 2 * min(a.shape->inner_radius, b.shape->inner_radius);
  law.knee = 0.2 * min(volume, through);
  Real const thickness = 2 * min(a.shape->inner_radius, b.shape->inner_radius);
  law.barrier = {thickness, law.stiffness * square(volume / thickness),
                 0.05 * std::pow(thickness, solid_.mesh().dimension)};
  law.damping = damping_;
  law.friction = config_.friction;
  law.shear_ratio = config_.friction > 0 ? 2 * (1 - nu) / (2 - nu) : 0;
  return law;
}

void Contact::find_overlap(std::size_t pair, Axes axes) {
  ContactPair const& p = list_.pairs()[pair];
  Overlap& o = overlaps_[pair];
  o.common = {};
  o.barrier = {};
  if (list_.distance2(p) >= p.touching) return;
  PlacedConvex const &a = list_.placed(p.a), &b = list_.placed(p.b);
  Vec3 const shift = list_.pose(p.b).x - list_.pose(p.a).x;
  if (separated_by_face(a, b, shift, o.separating_plane)) return;
  o.common = clipper_.intersect(a, b, shift);
  if (!(o.common.volume > 0)) return;
  Quaternion const &qa = list_.pose(p.a).q, &qb = list_.pose(p.b).q;
  if (axes == Axes::choose)
    o.memory.axis =
        choose_axis(o.was_active ? o.before.axis : DepthAxis{}, o.law.barrier, o.common, a, b, qa, qb, shift);
  o.barrier = find_barrier(o.memory.axis, o.law.barrier, o.common, clipper_, qa, qb, shift);
}

void Contact::find_overlaps(Axes axes) {
  live_.clear();
  for (std::size_t k = 0; k < overlaps_.size(); ++k) {
    ContactPair const& p = list_.pairs()[k];
    Overlap& o = overlaps_[k];
    if (list_.distance2(p) >= p.touching && !o.active && !o.was_active) continue;  // most of the list: nothing to do
    find_overlap(k, axes);
    o.active = o.common.volume > 0;
    if (o.active || o.was_active) live_.push_back(k);
  }
}

/// Overlaps and their energy, without forces.
void Contact::measure() {
  find_overlaps(Axes::keep);
  for (std::size_t const k : live_) {
    Overlap& o = overlaps_[k];
    o.energy = o.law.energy(o.common.volume) + o.barrier.energy + o.memory.stored();
  }
}

}  // namespace brisance::solid
