#include "core/solid/contact/kinship.hpp"

#include <algorithm>

namespace brisance::solid {

void Kinship::update() {
  if (!solid_.damageable()) return;
  parallel::Bytes mine;
  for (std::size_t k = 0; k < solid_.links(); ++k)
    if (solid_.intact(k) == 0 && solid_.link_store().end_i(k) < solid_.owned())
      parallel::put(mine, static_cast<std::int64_t>(solid_.mesh_link(k)));
  broken_.assign(solid_.mesh().links.size(), false);
  for (parallel::Bytes const& part : comm_.all_gather(mine)) {
    std::span<std::byte const> in = part;
    while (!in.empty()) broken_[static_cast<std::size_t>(parallel::take<std::int64_t>(in))] = true;
  }
}

bool Kinship::opened(GlobalId particle) const {
  if (broken_.empty()) return false;
  auto const links = solid_.mesh().links_of(particle);
  return std::any_of(links.begin(), links.end(), [&](std::size_t l) { return broken_[l]; });
}

std::vector<GlobalId> const& Kinship::around(GlobalId particle) {
  Mesh const& mesh = solid_.mesh();
  around_.assign(1, particle);
  std::size_t begin = 0;
  for (int hop = 0; hop < mesh.dimension; ++hop) {
    std::size_t const end = around_.size();
    for (std::size_t k = begin; k < end; ++k)
      for (std::size_t const l : mesh.links_of(around_[k])) {
        Link const& link = mesh.links[l];
        if (link.j != Link::wall && !is_broken(l)) around_.push_back(link.i == around_[k] ? link.j : link.i);
      }
    // What was found before stays in front: only new particles are looked at in the next hop.
    auto const fresh = around_.begin() + static_cast<std::ptrdiff_t>(end);
    std::sort(fresh, around_.end());
    around_.erase(std::unique(fresh, around_.end()), around_.end());
    around_.erase(std::remove_if(around_.begin() + static_cast<std::ptrdiff_t>(end), around_.end(),
                                 [&](GlobalId p) {
                                   auto const known = around_.begin() + static_cast<std::ptrdiff_t>(end);
                                   return std::find(around_.begin(), known, p) != known;
                                 }),
                  around_.end());
    begin = end;
  }
  std::sort(around_.begin(), around_.end());
  return around_;
}

bool Kinship::parted(GlobalId a, GlobalId b) const {
  if (broken_.empty()) return false;
  Mesh const& mesh = solid_.mesh();
  bool broke = false;
  for (std::size_t const l : mesh.links_of(a)) {
    Link const& link = mesh.links[l];
    if ((link.i == a ? link.j : link.i) != b) continue;
    if (!broken_[l]) return false;
    broke = true;
  }
  return broke;
}

}  // namespace brisance::solid
