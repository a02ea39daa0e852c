#include "core/solid/meshes/tetrahedra.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_polyhedron_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/Random.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/solid/meshes/closed_surface.hpp"
#include "core/solid/meshes/elements.hpp"
#include "core/solid/meshes/smoothing.hpp"

namespace brisance::solid {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedral = CGAL::Mesh_polyhedron_3<Kernel>::type;
using MeshDomain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<MeshDomain>::type;
using Complex =
    CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, MeshDomain::Corner_index, MeshDomain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

/// Hands vertices and facets to CGAL.
class Builder : public CGAL::Modifier_base<Polyhedral::HalfedgeDS> {
 public:
  explicit Builder(TriangleSurface const& surface) : surface_(surface) {}
  void operator()(Polyhedral::HalfedgeDS& hds) override {
    CGAL::Polyhedron_incremental_builder_3<Polyhedral::HalfedgeDS> build(hds, false);
    build.begin_surface(surface_.vertices.size(), surface_.facets.size());
    for (Vec3 const& x : surface_.vertices) build.add_vertex({x.x, x.y, x.z});
    for (auto const& facet : surface_.facets) build.add_facet(facet.begin(), facet.end());
    build.end_surface();
  }

 private:
  TriangleSurface const& surface_;
};

/// The tetrahedra in an order that depends on their places only: nodes and elements by coordinates.
ElementMesh numbered(Complex const& complex, std::string const& path) {
  ElementMesh mesh;
  mesh.path = path;
  auto const less = [](Vec3 const& a, Vec3 const& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  auto const place = [](Complex::Vertex_handle v) {
    auto const p = v->point().point();
    return Vec3{p.x(), p.y(), p.z()};
  };
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell)
    for (int k = 0; k < 4; ++k) mesh.nodes.push_back(place(cell->vertex(k)));
  std::sort(mesh.nodes.begin(), mesh.nodes.end(), less);
  mesh.nodes.erase(std::unique(mesh.nodes.begin(), mesh.nodes.end()), mesh.nodes.end());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) mesh.node_tag.push_back(static_cast<std::int64_t>(n) + 1);
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    MeshElement e;
    for (int k = 0; k < 4; ++k) {
      auto const at = std::lower_bound(mesh.nodes.begin(), mesh.nodes.end(), place(cell->vertex(k)), less);
      e.node[static_cast<std::size_t>(k)] = static_cast<Index>(at - mesh.nodes.begin());
    }
    // Ascending, then the last two exchanged where that turned the tetrahedron inside out.
    std::sort(e.node.begin(), e.node.begin() + 4);
    auto const x = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(e.node[k])]; };
    if (dot(cross(x(1) - x(0), x(2) - x(0)), x(3) - x(0)) < 0) std::swap(e.node[2], e.node[3]);
    mesh.elements.push_back(e);
  }
  std::sort(mesh.elements.begin(), mesh.elements.end(),
            [](MeshElement const& a, MeshElement const& b) { return a.node < b.node; });
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) mesh.elements[k].tag = static_cast<std::int64_t>(k) + 1;
  return mesh;
}

}  // namespace

Cells tetrahedra_in(TriangleSurface const& surface, int particles) {
  Polyhedral polyhedron;
  Builder builder(surface);
  polyhedron.delegate(builder);
  MeshDomain domain(polyhedron);
  constexpr double sharp =
      60;  // degrees between normals: a finer angle would keep every edge of a coarse round surface
  domain.detect_features(sharp);

  // The edge of a regular tetrahedron of the mean volume; the mesher bounds radii, and its cells are smaller than
  // their bounds, by a factor measured on cubes and balls.
  double const edge = std::cbrt(enclosed_volume(surface) / particles * 6 * std::sqrt(2.0));
  double const bound = 1.15 * edge;
  namespace parameter = CGAL::parameters;
  Criteria const criteria(parameter::edge_size = bound, parameter::facet_angle = 25, parameter::facet_size = bound,
                          parameter::facet_distance = 0.05 * edge, parameter::cell_radius_edge_ratio = 2,
                          parameter::cell_size = bound);
  // Without the optimisers of CGAL: they order by addresses, and two ranks would end with different meshes.
  CGAL::get_default_random() = CGAL::Random(0);  // of the first points on the surface
  Complex const complex = CGAL::make_mesh_3<Complex>(domain, criteria, parameter::no_perturb(), parameter::no_exude());
  if (complex.number_of_cells_in_complex() == 0)
    mesh_error(surface.path, 0,
               "no tetrahedra of this size fit into the surface: ask for more than " + std::to_string(particles) +
                   " particles.");

  ElementMesh mesh = numbered(complex, surface.path);
  improve_tetrahedra(mesh);
  Cells cells = cells_of(std::move(mesh), {}, 3);
  cells.whole_volume = enclosed_volume(surface);
  return cells;
}

}  // namespace brisance::solid
