#include "coupling/cut_cells/light_solid.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

namespace brisance::coupling {
namespace {

/// Area vector in the reference state, m2.
Vec3 area_of(solid::Element const& e, solid::Surface const& surface, solid::Mesh const& mesh) {
  Vec3 const a = surface.reference(e.vertex[0], mesh), b = surface.reference(e.vertex[1], mesh);
  if (surface.dimension() == 2) return {b.y - a.y, a.x - b.x, 0};
  return 0.5 * cross(b - a, surface.reference(e.vertex[2], mesh) - a);
}

}  // namespace

std::vector<Real> areal_masses(solid::Surface const& surface, solid::Mesh const& mesh) {
  auto const elements = surface.elements();
  std::vector<std::vector<std::size_t>> of_particle(static_cast<std::size_t>(mesh.size()));
  std::vector<Vec3> areas;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    areas.push_back(area_of(elements[e], surface, mesh));
    of_particle[static_cast<std::size_t>(elements[e].particle)].push_back(e);
  }
  std::vector<Real> masses(elements.size(), std::numeric_limits<Real>::infinity());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    solid::Particle const& particle = mesh.particle(elements[e].particle);
    Real const size = norm(areas[e]);
    if (particle.freedom != solid::Freedom::free || !(size > 0)) continue;
    Real seen = 0;
    for (std::size_t const other : of_particle[static_cast<std::size_t>(elements[e].particle)])
      seen += std::abs(dot(areas[other], areas[e])) / size;
    masses[e] = particle.mass / seen;
  }
  return masses;
}

std::string describe(LightestPlace const& place, solid::Surface const& surface, solid::Mesh const& mesh, bool limited,
                     bool cell_pressure) {
  if (place.element < 0 || place.ratio >= light_ratio) return {};
  solid::Element const& e = surface.elements()[static_cast<std::size_t>(place.element)];
  char text[700];
  std::snprintf(
      text, sizeof text,
      "light solid: particle %lld of body \"%s\" at (%.4g, %.4g, %.4g) m weighs %.3g kg per m2 of wetted surface, the "
      "gas in a cell beside it %.3g kg/m2: %.3g of it. Below %.1f, loads and motion can drive each other. %s. Finer "
      "cells or thicker particles raise the ratio%s",
      static_cast<long long>(e.particle), mesh.bodies[static_cast<std::size_t>(e.body)].name.c_str(), place.where.x,
      place.where.y, place.where.z, place.solid, place.gas, place.ratio, light_ratio,
      limited ? "Steps are limited to this share of the gas's own (coupling.light_solids = \"limit\")"
              : "Steps are not limited (coupling.light_solids = \"warn\"): expect noise, or take \"limit\"",
      cell_pressure
          ? "; and take wall_pressure = \"half_riemann\": nothing damps such a wall under the pressure of its "
            "cell, at any step"
          : "");
  return text;
}

}  // namespace brisance::coupling
