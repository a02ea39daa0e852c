// Is a surface the boundary of a body, and is that body convex?
#pragma once
#include <optional>

#include "core/solid/meshes/surface_file.hpp"
#include "core/solid/shapes/domains.hpp"

namespace brisance::solid {

/// Turns the surface outward where it is inside out as a whole.
/// Errors: Failure::scene naming facet and place: open, facets turned against each other, more than two facets at an
/// edge, flat facets, a surface that cuts itself, pieces that bound no volume.
void check_closed(TriangleSurface& surface);

/// The planes of a convex surface (facets in one plane are one), nothing for another.
std::optional<PlaneDomain> convex_body(TriangleSurface const& surface);

/// Volume inside a closed surface, m3.
Real enclosed_volume(TriangleSurface const& surface);

}  // namespace brisance::solid
