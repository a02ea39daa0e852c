// Closed surfaces from STL (ASCII, binary) and OFF files.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/base/vec3.hpp"

namespace brisance::solid {

/// Triangles, counter-clockwise seen from outside the body.
struct TriangleSurface {
  std::string path;
  std::vector<Vec3> vertices;  ///< m, once scaled
  std::vector<std::array<Index, 3>> facets;
  std::vector<std::int64_t> number;              ///< of the facet in the file (OFF: polygon), from 1; empty: f + 1
  std::vector<std::vector<std::string>> groups;  ///< names of the physical surfaces of a facet; may be empty
};

/// Adds the facets of three corners each; corners that agree to 1e-7 of the size of all are one vertex, facets that
/// shrink to an edge vanish (their neighbours then meet). Facet f gets number f + 1.
void weld(std::vector<Vec3> const& corners, TriangleSurface& surface);

/// Vertices of STL that agree to 1e-7 of the size of the surface are one.
/// Errors: Failure::scene "path:line: ...": unreadable, cut off, no facets, a facet with an unknown vertex.
TriangleSurface read_stl(std::string const& path);
TriangleSurface read_off(std::string const& path);

}  // namespace brisance::solid
