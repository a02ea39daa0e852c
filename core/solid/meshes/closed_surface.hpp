// Is a surface the boundary of a body, and is that body convex?
#pragma once
#include <memory>
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

/// Any body inside a closed surface, for Voronoi cells: a generator is mirrored at each point of the surface that is
/// nearer to it than the points around (one behind a round surface, two beside an edge, ...), so that cells end at the
/// surface or, at inward edges and curved parts, near it.  Source: theory/solid.md section 9.
class SurfaceDomain : public Domain {
 public:
  /// `reach`: how far from the surface generators are mirrored, some mean spacings, m.
  SurfaceDomain(TriangleSurface const& surface, Real reach);
  ~SurfaceDomain() override;
  Vec3 low() const override { return low_; }
  Vec3 high() const override { return high_; }
  Real volume() const override;
  bool contains(Vec3 const& p) const override;
  std::vector<Wall> walls() const override { return {}; }
  std::vector<Vec3> images(Vec3 const& p) const override;
  /// Distance of a point outside from the surface, 0 inside, m.
  Real outside(Vec3 const& p) const;

 private:
  struct Inside;
  TriangleSurface const& surface_;
  Real reach_;
  Vec3 low_, high_;
  std::vector<Vec3> normal_;                  // of facets
  std::vector<std::vector<std::size_t>> at_;  // facets at a vertex
  std::unique_ptr<Inside> inside_;
};

/// Volume inside a closed surface, m3.
Real enclosed_volume(TriangleSurface const& surface);

}  // namespace brisance::solid
