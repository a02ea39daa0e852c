#include "core/solid/rates/levels.hpp"

#include <algorithm>
#include <cmath>

namespace brisance::solid {
namespace {

std::size_t at(GlobalId p) { return static_cast<std::size_t>(p); }

constexpr Real no_limit = 1e299;

/// Calls visit(other) for the particles linked to p.
template <class Visit>
void for_neighbours(Mesh const& mesh, GlobalId p, Visit visit) {
  for (std::size_t l : mesh.links_of(p)) {
    Link const& link = mesh.links[l];
    if (link.j != Link::wall) visit(link.i == p ? link.j : link.i);
  }
}

/// What each particle could take by itself, then graded: impulses of coarse steps resonate with fast neighbours unless
/// the ratio of their steps is 2 at most.
std::vector<std::uint8_t> own_levels(Mesh const& mesh, std::span<Real const> limits, int most, Real finest) {
  std::vector<std::uint8_t> own(limits.size(), static_cast<std::uint8_t>(most - 1));
  for (std::size_t p = 0; p < limits.size(); ++p)
    for (int l = most - 1; l > 0 && limits[p] < finest * static_cast<Real>(1 << l); --l)
      own[p] = static_cast<std::uint8_t>(l - 1);
  for (int l = 0; l + 2 < most; ++l)
    for (GlobalId p = 0; p < mesh.size(); ++p)
      if (own[at(p)] == l)
        for_neighbours(mesh, p, [&](GlobalId other) {
          own[at(other)] = std::min(own[at(other)], static_cast<std::uint8_t>(l + 1));
        });
  std::uint8_t top = 0;  // particles without a limit follow the others
  for (std::size_t p = 0; p < limits.size(); ++p)
    if (limits[p] < no_limit) top = std::max(top, own[p]);
  for (std::uint8_t& l : own) l = std::min(l, top);
  return own;
}

/// `late_volumes`: volumes may come one level after the fastest of their particles.
Levels levels_for(Mesh const& mesh, StepLimits const& limits, int most, Real finest, bool late_volumes) {
  std::vector<std::uint8_t> const own = own_levels(mesh, limits.all, most, finest);
  Levels levels;
  levels.finest = finest;
  levels.top = own.empty() ? 0 : *std::max_element(own.begin(), own.end());
  auto const top = static_cast<std::uint8_t>(levels.top);
  levels.volume.assign(own.size(), top);
  // A thin link makes its particles fast, but hardly their volumes: these may come one level later, if all volumetric
  // forces on a particle together allow it. Not so for nu < 0, where they undo a part of the stiffness of the links:
  // measured on balls of random cells, three levels then blow up.
  auto const may = [&](GlobalId p) {
    std::uint8_t const l = own[at(p)];
    bool const later =
        late_volumes && mesh.material(p).lame() > 0 && limits.volumes[at(p)] >= finest * static_cast<Real>(2 << l);
    return static_cast<std::uint8_t>(later ? l + 1 : l);
  };
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    if (mesh.material(p).lame() == 0) continue;  // no volumetric force
    std::uint8_t& level = levels.volume[at(p)];
    level = std::min(level, may(p));
    for_neighbours(mesh, p, [&](GlobalId other) { level = std::min(level, may(other)); });
  }
  levels.particle = own;
  for (Link const& link : mesh.links) {
    bool const wall = link.j == Link::wall;
    std::uint8_t const of_link = wall ? own[at(link.i)] : std::min(own[at(link.i)], own[at(link.j)]);
    std::uint8_t const first = std::min({of_link, levels.volume[at(link.i)], wall ? top : levels.volume[at(link.j)]});
    levels.link.push_back(of_link);
    levels.first.push_back(first);
    levels.particle[at(link.i)] = std::min(levels.particle[at(link.i)], first);
    if (!wall) levels.particle[at(link.j)] = std::min(levels.particle[at(link.j)], first);
  }
  return levels;
}

}  // namespace

std::int64_t Levels::link_updates() const {
  std::int64_t sum = 0;
  for (std::uint8_t l : first) sum += std::int64_t{1} << (top - l);
  return sum;
}

Levels assign_levels(Mesh const& mesh, StepLimits const& limits, int most) {
  Real smallest = 1e300;
  for (Real limit : limits.all) smallest = min(smallest, limit);
  if (smallest > no_limit) smallest = 1e300;
  // Impulses of a coarser level resonate with motions that turn by half a period within its step. With steps of at most
  // 0.7 of the limits no motion does so within two of its steps. Above, two levels were seen to hold where all forces
  // on a particle come at its own level (graded bars, 6e4 steps), but three levels, or late volumes, were not.
  constexpr Real safe = 0.7;
  Levels best;
  Real least = 1e300;
  auto const propose = [&](int levels_wanted, bool late_volumes, Real cfl) {
    // A finest step somewhat below the smallest limit may let many particles into the next level.
    constexpr int choices = 16;
    for (int c = 0; c < choices; ++c) {
      Real const finest = smallest * std::exp2(-static_cast<Real>(c) / choices);
      Levels levels = levels_for(mesh, limits, levels_wanted, finest, late_volumes);
      levels.cfl = cfl;
      Real const updates = static_cast<Real>(levels.link_updates()) / levels.step();  // per second
      if (updates < least) least = updates, best = std::move(levels);
    }
  };
  propose(1, false, limits.cfl);
  propose(2, false, limits.cfl);
  propose(most, true, min(limits.cfl, safe));
  best.plain_step = limits.cfl * smallest;
  return best;
}

}  // namespace brisance::solid
