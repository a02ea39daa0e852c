#include "core/solid/meshes/mesh_body.hpp"

#include <algorithm>
#include <filesystem>

#include "core/solid/meshes/elements.hpp"
#include "core/solid/meshes/gmsh.hpp"
#include "parallel/error.hpp"

namespace brisance::solid {
namespace {

std::string extension(std::string const& path) {
  std::string e = std::filesystem::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return e;
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
  throw Error(Failure::scene, path + ": files \"" + kind + "\" are not read; .msh, .stl and .off are.");
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
