#include "core/solid/meshes/mesh_file_config.hpp"

#include <filesystem>

#include "core/base/keys.hpp"

namespace brisance::solid {

std::string MeshFileConfig::path() const {
  std::filesystem::path const given = file;
  if (given.is_absolute()) return file;
  return (std::filesystem::path(at.file).parent_path() / given).string();
}

void MeshFileConfig::keys(Keys<MeshFileConfig>& k) {
  k("file", &MeshFileConfig::file, "",
    "Gmsh .msh (2.2 or 4.1, ASCII or binary) or closed surface .stl or .off; relative to the scene file")
      .required();
  k("group", &MeshFileConfig::group, "", ".msh: the physical volume (3D) or surface (2D) that is this body; else all");
  k("unit", &MeshFileConfig::unit, "m", "length of 1 in the file").above(0);
  k("shift", &MeshFileConfig::shift, "m", "where the origin of the file lies");
  k("warped", &MeshFileConfig::warped, "",
    "elements with faces that are not plane: refuse them, or split them into pyramids and tetrahedra")
      .one_of({"refuse", "split"});
  k("coincident_nodes", &MeshFileConfig::coincident_nodes, "",
    "boundary nodes at the same place: refuse them, merge them, or keep the crack between them")
      .one_of({"refuse", "merge", "keep"});
}

}  // namespace brisance::solid
