// What a scene says about a mesh file: where it is and how to take it.
#pragma once
#include <optional>
#include <string>

#include "core/base/location.hpp"
#include "core/base/vec3.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

/// A volume mesh (.msh of Gmsh) or a closed surface (.stl, .off).
struct MeshFileConfig {
  std::string file;                         ///< relative to the scene file
  std::optional<std::string> group;         ///< .msh: the physical volume that is the body; all elements otherwise
  Real unit = 1;                            ///< length of 1 in the file, m
  Vec3 shift{};                             ///< where the origin of the file lies, m
  std::string warped = "refuse";            ///< elements with faces that are not plane: refuse, split
  std::string coincident_nodes = "refuse";  ///< nodes of the boundary at one place: refuse, merge, keep
  Location at;
  /// The path to open.
  std::string path() const;
  static void keys(Keys<MeshFileConfig>& k);
};

}  // namespace brisance::solid
