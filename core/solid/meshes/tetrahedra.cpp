#include "core/solid/meshes/tetrahedra.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_polyhedron_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <CGAL/make_mesh_3.h>

#include <cmath>
#include <map>

#include "core/solid/meshes/closed_surface.hpp"
#include "core/solid/meshes/elements.hpp"

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
  Complex const complex = CGAL::make_mesh_3<Complex>(domain, criteria, parameter::perturb(), parameter::exude());
  if (complex.number_of_cells_in_complex() == 0)
    mesh_error(surface.path, 0,
               "no tetrahedra of this size fit into the surface: ask for more than " + std::to_string(particles) +
                   " particles.");

  ElementMesh mesh;
  mesh.path = surface.path;
  std::map<Complex::Vertex_handle, Index> node;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    MeshElement e;
    e.tag = static_cast<std::int64_t>(mesh.elements.size()) + 1;
    for (int k = 0; k < 4; ++k) {
      auto const [it, fresh] = node.try_emplace(cell->vertex(k), static_cast<Index>(mesh.nodes.size()));
      if (fresh) {
        auto const p = cell->vertex(k)->point().point();
        mesh.nodes.push_back({p.x(), p.y(), p.z()});
        mesh.node_tag.push_back(static_cast<std::int64_t>(mesh.nodes.size()));
      }
      e.node[static_cast<std::size_t>(k)] = it->second;
    }
    mesh.elements.push_back(e);
  }
  Cells cells = cells_of(std::move(mesh), {}, 3);
  cells.whole_volume = enclosed_volume(surface);
  return cells;
}

}  // namespace brisance::solid
