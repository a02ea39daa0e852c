// Links that lose a share of themselves, and what that does to their particles.  Source: theory/solid.md section 14.
#include <algorithm>

#include "core/solid/solid.hpp"

namespace brisance::solid {

std::optional<std::size_t> Solid::local_link(std::size_t mesh_link) const {
  auto const found = std::lower_bound(mesh_link_.begin(), mesh_link_.end(), mesh_link);
  if (found == mesh_link_.end() || *found != mesh_link) return std::nullopt;
  return static_cast<std::size_t>(found - mesh_link_.begin());
}

bool Solid::linked(GlobalId a, GlobalId b) const {
  for (std::size_t const l : mesh_.links_of(a)) {
    Link const& link = mesh_.links[l];
    if ((link.i == a ? link.j : link.i) != b) continue;
    auto const here = local_link(l);
    if (here && intact(*here) > 0) return true;
  }
  return false;
}

void Solid::set_bulk(GlobalId particle) {
  // Anew from the mesh and in global order, so that the bits do not depend on the order of the breaks.
  Real volume = mesh_.particle(particle).effective_volume;
  Material const& material = mesh_.material(particle);
  for (std::size_t const l : mesh_.links_of(particle)) {
    auto const here = local_link(l);
    if (!here) continue;  // a particle of the second layer, whose strain belongs to other ranks
    Link const& link = mesh_.links[l];
    volume += material.free_ratio() * (1 - intact_[*here]) * mesh_.face(link.i, link.face_i).area *
              face_distance(mesh_, link, particle);
  }
  bulk_[static_cast<std::size_t>(local(particle))] = material.lame() / volume;
}

void Solid::weaken(std::size_t link, Real intact) {
  if (intact_[link] == 0) --broken_;
  if (intact == 0) ++broken_;
  if ((intact == 0) != (intact_[link] == 0)) ++breaks_;
  intact_[link] = intact;
  Link const& of = mesh_.links[mesh_link_[link]];
  LinkRest<double> rest = rest_of(of);
  rest.stiffness *= intact;
  rest.area = intact * rest.area;
  for (double& c : rest.bending) c *= intact;
  links_.set_rest(link, rest);
  if (plastic_) plastic_->free_share(link, 1 - intact);
  if (rates_)
    for (Rung& rung : rates_->rungs) {
      auto const found = std::lower_bound(rung.place.begin(), rung.place.end(), link);
      if (found != rung.place.end() && *found == link)
        rung.links.set_rest(static_cast<std::size_t>(found - rung.place.begin()), rest);
    }
  set_bulk(of.i);
  if (of.j != Link::wall) set_bulk(of.j);
}

std::vector<GlobalId> Solid::owned_link_ids() const {
  std::vector<GlobalId> ids;
  for (std::size_t k = 0; k < links_.count(); ++k)
    if (links_.end_i(k) < owned_) ids.push_back(static_cast<GlobalId>(mesh_link_[k]));
  return ids;
}

std::vector<double> Solid::pack_intact() const {
  std::vector<double> rows;
  for (std::size_t k = 0; k < links_.count(); ++k)
    if (links_.end_i(k) < owned_) rows.push_back(intact(k));
  return rows;
}

}  // namespace brisance::solid
