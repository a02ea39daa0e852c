#include "core/solid/meshes/closed_surface.hpp"
#include "core/base/place.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <map>

#include "core/solid/meshes/element_mesh.hpp"
#include "core/solid/meshes/refill.hpp"

namespace brisance::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace processing = CGAL::Polygon_mesh_processing;

Vec3 const& vertex(TriangleSurface const& s, Index v) { return s.vertices[static_cast<std::size_t>(v)]; }

std::string facet_text(TriangleSurface const& s, std::size_t f) {
  return (s.path.ends_with("off") || s.path.ends_with("OFF") ? "face " : "facet ") +
         std::to_string(s.number.empty() ? static_cast<std::int64_t>(f) + 1 : s.number[f]);
}

Vec3 middle(TriangleSurface const& s, std::size_t f) {
  auto const& [a, b, c] = s.facets[f];
  return (vertex(s, a) + vertex(s, b) + vertex(s, c)) / 3;
}

/// Twice the vector area of a facet.
Vec3 spread(TriangleSurface const& s, std::size_t f) {
  auto const& [a, b, c] = s.facets[f];
  return cross(vertex(s, b) - vertex(s, a), vertex(s, c) - vertex(s, a));
}

Real size_of(TriangleSurface const& s) {
  Vec3 low = s.vertices[0], high = low;
  for (Vec3 const& x : s.vertices)
    for (int d = 0; d < 3; ++d) low[d] = min(low[d], x[d]), high[d] = max(high[d], x[d]);
  return norm(high - low);
}

/// Every directed edge has its opposite, once.
void check_edges(TriangleSurface const& s) {
  std::map<std::pair<Index, Index>, std::vector<std::size_t>> edges;
  for (std::size_t f = 0; f < s.facets.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) edges[{s.facets[f][k], s.facets[f][(k + 1) % 3]}].push_back(f);
  for (auto const& [edge, facets] : edges) {
    auto const back = edges.find({edge.second, edge.first});
    if (facets.size() == 1 && back != edges.end() && back->second.size() == 1) continue;
    std::string const from_to = "the edge from " + place_text(vertex(s, edge.first)) + " to " +
                                place_text(vertex(s, edge.second)) + " of " + facet_text(s, facets[0]);
    if (facets.size() == 2 && back == edges.end())
      mesh_error(s.path, 0,
                 facet_text(s, facets[1]) + " is turned against its neighbour at " + from_to +
                     ": outside must be on the same side of all facets. Reorient the surface.");
    if (facets.size() > 1 || (back != edges.end() && back->second.size() > 1))
      mesh_error(s.path, 0,
                 "more than two facets meet at " + from_to + ". A body has two at every edge: separate them.");
    if (back == edges.end())
      mesh_error(s.path, 0, "the surface is open at " + from_to + ". Close it: a body needs a watertight surface.");
  }
}

SurfaceMesh to_cgal(TriangleSurface const& s) {
  SurfaceMesh mesh;
  for (Vec3 const& x : s.vertices) mesh.add_vertex({x.x, x.y, x.z});
  using V = SurfaceMesh::Vertex_index;
  for (std::size_t f = 0; f < s.facets.size(); ++f) {
    auto const& [a, b, c] = s.facets[f];
    auto const v = [](Index i) { return V(static_cast<SurfaceMesh::size_type>(i)); };
    if (mesh.add_face(v(a), v(b), v(c)) == SurfaceMesh::null_face())
      mesh_error(s.path, 0,
                 "two pieces of the surface touch at a vertex of " + facet_text(s, f) + " at " +
                     place_text(middle(s, f)) + ". Separate them.");
  }
  return mesh;
}

}  // namespace

Real enclosed_volume(TriangleSurface const& s) {
  Real six = 0;
  Vec3 const apex = s.vertices[0];
  for (auto const& [a, b, c] : s.facets)
    six += dot(vertex(s, a) - apex, cross(vertex(s, b) - apex, vertex(s, c) - apex));
  return six / 6;
}

void check_closed(TriangleSurface& s) {
  if (s.facets.size() < 4) mesh_error(s.path, 0, "a closed surface has four facets or more");
  Real const size = size_of(s);
  check_edges(s);
  for (std::size_t f = 0; f < s.facets.size(); ++f)
    if (norm(spread(s, f)) <= 1e-14 * square(size))
      mesh_error(s.path, 0, facet_text(s, f) + " has no area, at " + place_text(middle(s, f)) + ". Remove it.");
  SurfaceMesh mesh = to_cgal(s);
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> cuts;
  processing::self_intersections(mesh, std::back_inserter(cuts));
  if (!cuts.empty()) {
    auto const [f, g] = *std::min_element(cuts.begin(), cuts.end());
    mesh_error(s.path, 0,
               "the surface cuts itself: " + facet_text(s, f) + " and " + facet_text(s, g) + ", at " +
                   place_text(middle(s, f)) + " (" + std::to_string(cuts.size()) + " such pairs). Repair the surface.");
  }
  if (!processing::does_bound_a_volume(mesh)) {
    processing::orient_to_bound_a_volume(mesh);
    for (auto const f : mesh.faces()) {
      std::size_t k = 0;
      for (auto const v : mesh.vertices_around_face(mesh.halfedge(f)))
        s.facets[f][k++] = static_cast<Index>(static_cast<SurfaceMesh::size_type>(v));
    }
  }
  if (enclosed_volume(s) < 0)
    for (auto& facet : s.facets) std::swap(facet[0], facet[1]);
  if (!(enclosed_volume(s) > 0)) mesh_error(s.path, 0, "the surface encloses no volume");
}

struct SurfaceDomain::Inside {
  SurfaceMesh mesh;
  CGAL::Side_of_triangle_mesh<SurfaceMesh, Kernel> side;
  explicit Inside(TriangleSurface const& s) : mesh(to_cgal(s)), side(mesh) {}
};

SurfaceDomain::SurfaceDomain(TriangleSurface const& surface, Real reach)
    : surface_(surface),
      reach_(reach),
      low_(surface.vertices[0]),
      high_(low_),
      at_(surface.vertices.size()),
      inside_(std::make_unique<Inside>(surface)) {
  for (Vec3 const& x : surface.vertices)
    for (int d = 0; d < 3; ++d) low_[d] = min(low_[d], x[d]), high_[d] = max(high_[d], x[d]);
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    normal_.push_back(normalized(spread(surface, f)));
    for (Index v : surface.facets[f]) at_[static_cast<std::size_t>(v)].push_back(f);
  }
}

SurfaceDomain::~SurfaceDomain() = default;
Real SurfaceDomain::volume() const { return enclosed_volume(surface_); }

bool SurfaceDomain::contains(Vec3 const& p) const { return inside_->side({p.x, p.y, p.z}) == CGAL::ON_BOUNDED_SIDE; }

std::vector<Vec3> SurfaceDomain::images(Vec3 const& p) const {
  std::vector<Vec3> feet;
  for (std::size_t f = 0; f < surface_.facets.size(); ++f) {
    // Only from inside, and only within reach of the plane.
    Real const depth = dot(vertex(surface_, surface_.facets[f][0]) - p, normal_[f]);
    if (depth > reach_ || depth < -reach_) continue;
    Vec3 const foot = nearest_point(surface_, f, p);
    Real const distance = norm(foot - p), slack = 1e-9 * reach_;
    if (distance > reach_ || distance <= slack) continue;
    // A foot on the rim of the facet counts when no facet around it comes nearer.
    Vec3 normal{};
    bool least = true;
    for (Index v : surface_.facets[f])
      for (std::size_t g : at_[static_cast<std::size_t>(v)]) {
        if (norm(nearest_point(surface_, g, foot) - foot) > slack) continue;
        normal += normal_[g];
        least = least && norm(nearest_point(surface_, g, p) - p) >= distance - slack;
      }
    if (!least || dot(normal, foot - p) <= 0) continue;
    bool const known =
        std::any_of(feet.begin(), feet.end(), [&](Vec3 const& other) { return norm(other - foot) <= 1e-6 * reach_; });
    if (!known) feet.push_back(foot);
  }
  std::vector<Vec3> images;
  for (Vec3 const& foot : feet) images.push_back(p + 2.0 * (foot - p));
  return images;
}

Real SurfaceDomain::outside(Vec3 const& p) const {
  if (contains(p)) return 0;
  Real least = 1e300;
  for (std::size_t f = 0; f < surface_.facets.size(); ++f) least = min(least, norm(nearest_point(surface_, f, p) - p));
  return least;
}

std::optional<PlaneDomain> convex_body(TriangleSurface const& s) {
  // Coordinates of STL are rounded to 6e-8 of their size.
  Real const slack = 1e-6 * size_of(s);
  std::vector<std::size_t> by_area(s.facets.size());
  for (std::size_t f = 0; f < by_area.size(); ++f) by_area[f] = f;
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](std::size_t a, std::size_t b) { return norm2(spread(s, a)) > norm2(spread(s, b)); });
  std::vector<Domain::Wall> walls;
  std::vector<char> done(s.facets.size(), 0);
  for (std::size_t f : by_area) {
    if (done[f]) continue;
    // The largest facet of a plane gives it; all facets within the slack of it belong to it.
    Domain::Wall const wall{vertex(s, s.facets[f][0]), normalized(spread(s, f))};
    for (Vec3 const& x : s.vertices)
      if (dot(x - wall.point, wall.normal) > slack) return std::nullopt;
    for (std::size_t g = 0; g < s.facets.size(); ++g) {
      bool const in_plane = std::all_of(s.facets[g].begin(), s.facets[g].end(), [&](Index v) {
        return std::abs(dot(vertex(s, v) - wall.point, wall.normal)) <= slack;
      });
      if (in_plane) done[g] = 1;
    }
    walls.push_back(wall);
  }
  return PlaneDomain(std::move(walls), s.vertices, enclosed_volume(s));
}

}  // namespace brisance::solid
