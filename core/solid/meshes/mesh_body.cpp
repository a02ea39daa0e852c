#include "core/solid/meshes/mesh_body.hpp"

#include <algorithm>
#include <filesystem>

#include "core/solid/meshes/closed_surface.hpp"
#include "core/solid/meshes/elements.hpp"
#include "core/solid/meshes/gmsh.hpp"
#include "core/solid/meshes/tetrahedra.hpp"
#include "parallel/error.hpp"

namespace brisance::solid {
namespace {

std::string extension(std::string const& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return e;
}

/// Voronoi cells in a convex surface, tetrahedra in another.
Cells fill(TriangleSurface const& surface, BodyConfig const& body) {
  auto const convex = convex_body(surface);
  std::string const how = body.tessellation.value_or(convex ? "voronoi" : "tetrahedra");
  if (how == "voronoi") {
    if (!convex)
      throw Error(Failure::scene, surface.path +
                                      ": the surface is not convex: Voronoi cells would reach out of it. "
                                      "Take tessellation = \"tetrahedra\", or leave it out.");
    return voronoi(*convex, body.particles, body.seed, body.lloyd, 3);
  }
  if (how != "tetrahedra")
    throw Error(Failure::scene,
                surface.path + ": a surface is filled with \"voronoi\" or \"tetrahedra\", not \"" + how + "\".");
  return tetrahedra_in(surface, body.particles);
}

Cells read_cells(BodyConfig const& body, int dimension) {
  MeshFileConfig const& file = *body.mesh;
  std::string const path = file.path(), kind = extension(path), how = body.tessellation.value_or("elements");
  if (kind == ".msh") {
    if (how != "elements")
      throw Error(Failure::scene, path + ": a .msh brings its own cells: take tessellation = \"elements\", not \"" +
                                      how + "\", or leave it out.");
    return cells_of(read_gmsh(path), file, dimension);
  }
  if (kind != ".stl" && kind != ".off")
    throw Error(Failure::scene, path + ": files \"" + kind + "\" are not read; .msh, .stl and .off are.");
  if (dimension < 3) throw Error(Failure::scene, path + ": a surface bounds a body in three dimensions only.");
  TriangleSurface surface = kind == ".stl" ? read_stl(path) : read_off(path);
  for (Vec3& x : surface.vertices) x *= file.unit;
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
