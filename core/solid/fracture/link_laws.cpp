#include "core/solid/fracture/link_laws.hpp"

#include <algorithm>
#include <cstdio>

#include "core/base/errors.hpp"

namespace brisance::solid {
namespace {

template <class Named>
std::vector<std::string> names_of(std::vector<Named> const& all) {
  std::vector<std::string> names;
  for (Named const& one : all) names.push_back(one.name);
  return names;
}

Index place_of(std::vector<std::string> const& names, std::string const& name, char const* what, Location const& at) {
  auto const found = std::find(names.begin(), names.end(), name);
  require(found != names.end(), at,
          std::string("solid.fracture.law: there is no ") + what + " \"" + name + "\"; the scene has " + joined(names));
  return static_cast<Index>(found - names.begin());
}

Real scatter_of(LawConfig const& law, Mesh const& mesh, Link const& link) {
  if (!law.weibull) return 1;
  bool const wall = link.j == Link::wall;
  Section const s = section_of(mesh, link);
  Real const factor = law.weibull->factor(link.i, link.j, wall ? link.face_i : 0, s.area * s.length);
  // The strongest of many softening links still break at their toughness, as brittle ones do.
  return law.cohesive ? min(factor, law.cohesive->largest_scatter(mesh.material(link.i).young_modulus, s.length))
                      : factor;
}

/// A link that stores more than its toughness when it reaches its strength cannot soften.
void require_room_to_soften(LawConfig const& law, Mesh const& mesh, Link const& link) {
  Real const longest = law.cohesive->longest(mesh.material(link.i).young_modulus);
  if (link.rest_length < longest) return;
  char text[400];
  Vec3 const x = mesh.particle(link.i).centre;
  std::snprintf(
      text, sizeof text,
      "solid.fracture.law.cohesive: the link of particles %lld and %lld at (%.4g, %.4g, %.4g) m is %.3g m long, "
      "but at its strength it stores more than its toughness from 2 E G_c / f_t^2 = %.3g m on. Take smaller "
      "particles, a lower strength, or the criterion energy.",
      static_cast<long long>(link.i), static_cast<long long>(link.j), x.x, x.y, x.z, link.rest_length, longest);
  scene_error(law.at, text);
}

Watch watch_of(Criterion const& criterion, Section const& s, Solid const& solid, std::size_t k, Real scatter) {
  Index const i = solid.link_store().end_i(k), j = solid.end_j(k);
  Real const stiffness = s.modulus / s.length;
  Real const safe = std::visit([&](auto const& law) { return law.safe_traction(scatter, stiffness); }, criterion);
  return {i, j == solid.count() ? i : j, stiffness, 2 * stiffness / s.area, safe};
}

}  // namespace

LawFinder::LawFinder(FractureConfig const& config, Mesh const& mesh) : mesh_(mesh) {
  auto const bodies = names_of(mesh.bodies), materials = names_of(mesh.materials);
  for (LawConfig const& law : config.law) {
    Selector s;
    s.clamps = law.clamps;
    if (law.body) s.body = place_of(bodies, *law.body, "body", law.at);
    if (law.material) s.material = place_of(materials, *law.material, "material", law.at);
    if (!law.between.empty()) {
      require(law.between.size() == 2 && law.between[0] != law.between[1], law.at,
              "solid.fracture.law.between wants two different materials");
      for (std::size_t n = 0; n < 2; ++n) s.pair[n] = place_of(materials, law.between[n], "material", law.at);
    }
    selectors_.push_back(s);
  }
}

bool LawFinder::fits(Selector const& law, Link const& link) const {
  bool const wall = link.j == Link::wall;
  if (wall && !law.clamps) return false;
  Particle const &i = mesh_.particle(link.i), &j = mesh_.particle(wall ? link.i : link.j);
  if (law.body && (i.body != *law.body || j.body != *law.body)) return false;
  if (law.material && (i.material != *law.material || j.material != *law.material)) return false;
  return law.pair[0] < 0 || (i.material == law.pair[0] && j.material == law.pair[1]) ||
         (i.material == law.pair[1] && j.material == law.pair[0]);
}

std::optional<std::size_t> LawFinder::operator()(Link const& link) const {
  for (std::size_t law = selectors_.size(); law-- > 0;)
    if (fits(selectors_[law], link)) return law;
  return std::nullopt;
}

Section section_of(Mesh const& mesh, Link const& link) {
  Real const area = mesh.face(link.i, link.face_i).area;
  return {area, link.rest_length, link.weight, link.stiffness * link.rest_length / area};
}

std::vector<LawGroup> assign_laws(FractureConfig const& config, Solid const& solid) {
  Mesh const& mesh = solid.mesh();
  require(!config.law.empty(), config.at, "solid.fracture has no law: add [[solid.fracture.law]] with a criterion");
  std::vector<LawGroup> groups;
  for (LawConfig const& law : config.law) groups.push_back({law.criterion(), {}, {}, {}, {}});
  LawFinder const finder(config, mesh);
  for (Link const& link : mesh.links)
    if (auto const law = finder(link); law && config.law[*law].cohesive)
      require_room_to_soften(config.law[*law], mesh, link);
  for (std::size_t k = 0; k < solid.links(); ++k) {
    Link const& link = mesh.links[solid.mesh_link(k)];
    auto const law = finder(link);
    if (!law) continue;
    LawGroup& group = groups[*law];
    Real const scatter = scatter_of(config.law[*law], mesh, link);
    group.links.push_back(k);
    group.watch.push_back(watch_of(group.criterion, section_of(mesh, link), solid, k, scatter));
    if (config.law[*law].weibull) group.scatter.push_back(scatter);
  }
  for (LawGroup& group : groups)
    if (std::holds_alternative<Cohesive>(group.criterion)) group.history.resize(group.links.size());
  return groups;
}

}  // namespace brisance::solid
