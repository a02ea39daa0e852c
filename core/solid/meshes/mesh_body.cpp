#include "core/solid/meshes/mesh_body.hpp"
#include "core/base/place.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/solid/meshes/closed_surface.hpp"
#include "core/solid/meshes/elements.hpp"
#include "core/solid/meshes/gmsh.hpp"
#include "core/solid/meshes/refill.hpp"
#include "core/solid/meshes/tetrahedra.hpp"
#include "parallel/error.hpp"

namespace brisance::solid {
namespace {

std::string extension(std::string const& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return e;
}

/// A face between two cells that lies outside of the surface would tie parts of the body across a gap.
void check_gaps(SurfaceDomain const& domain, Cells const& cells, TriangleSurface const& surface, Real spacing) {
  for (std::size_t c = 0; c < cells.count(); ++c) {
    Shape const& s = cells.shapes[static_cast<std::size_t>(cells.shape[c])];
    for (std::size_t f = 0; f < s.faces.size(); ++f) {
      if (cells.neighbour[cells.first[c] + f] < static_cast<Index>(c) || s.faces[f].area < 0.01 * square(spacing))
        continue;
      Vec3 const x = cells.centre[c] + s.faces[f].centroid;
      if (domain.outside(x) < 0.3 * spacing) continue;
      throw Error(Failure::scene, surface.path + ": Voronoi cells " + std::to_string(spacing) +
                                      " m wide would join across the gap at " + place_text(x) +
                                      ": ask for more particles, or take tessellation = \"tetrahedra\".");
    }
  }
}

Cells fill(TriangleSurface const& surface, BodyConfig const& body) {
  std::string const how = body.tessellation.value_or("voronoi");
  if (how == "tetrahedra") return tetrahedra_in(surface, body.particles);
  if (how != "voronoi")
    throw Error(Failure::scene,
                surface.path + ": a surface is filled with \"voronoi\" or \"tetrahedra\", not \"" + how + "\".");
  if (auto const convex = convex_body(surface)) return voronoi(*convex, body.particles, body.seed, body.lloyd, 3);
  Real const spacing = std::cbrt(enclosed_volume(surface) / body.particles);
  SurfaceDomain const domain(surface, 3 * spacing);
  Cells cells = voronoi(domain, body.particles, body.seed, body.lloyd, 3);
  check_gaps(domain, cells, surface, spacing);
  return cells;
}

/// Voronoi cells in the place of the elements of a mesh: physical surfaces go to the cells that touch them.
Cells refill(Cells const& elements, std::string const& path, BodyConfig const& body) {
  for (Index const r : elements.region)
    if (r != elements.region[0] && body.material.empty())
      throw Error(Failure::scene, path +
                                      ": Voronoi cells do not follow the border of two physical volumes: give the "
                                      "body a material, or one body per physical volume by mesh.group.");
  TriangleSurface surface = boundary_of(elements, path);
  check_closed(surface);
  Cells cells = fill(surface, body);
  name_faces(surface, cells);
  cells.region_names = elements.region_names;
  if (!elements.region.empty()) cells.region.assign(cells.count(), elements.region[0]);
  return cells;
}

Cells read_cells(BodyConfig const& body, int dimension) {
  MeshFileConfig const& file = *body.mesh;
  std::string const path = file.path(), kind = extension(path), how = body.tessellation.value_or("elements");
  if (kind == ".msh") {
    if (how == "voronoi" && dimension == 3) return refill(cells_of(read_gmsh(path), file, dimension), path, body);
    if (how != "elements")
      throw Error(Failure::scene,
                  path + ": a .msh brings its own cells, tessellation = \"elements\", or its surface is filled " +
                      "anew by \"voronoi\" (3D), not by \"" + how + "\".");
    return cells_of(read_gmsh(path), file, dimension);
  }
  if (kind != ".stl" && kind != ".off")
    throw Error(Failure::scene, path + ": files \"" + kind + "\" are not read; .msh, .stl and .off are.");
  if (dimension < 3) throw Error(Failure::scene, path + ": a surface bounds a body in three dimensions only.");
  TriangleSurface surface = kind == ".stl" ? read_stl(path) : read_off(path);
  for (Vec3& x : surface.vertices) x = file.unit * x + file.shift;
  check_closed(surface);
  return fill(surface, body);
}

}  // namespace

Cells cells_from_file(BodyConfig const& body, int dimension) {
  try {
    return read_cells(body, dimension);
  } catch (Error const& error) {
    if (error.kind() != Failure::scene) throw;
    throw Error(Failure::scene, body.at.text() + ": solid.body \"" + body.name + "\": " + error.what());
  }
}

}  // namespace brisance::solid
