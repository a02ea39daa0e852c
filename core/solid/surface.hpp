// Deformed boundary of the solid: triangles in 3D, segments in 2D, points in 1D, closed by shared vertices.
#pragma once
#include <map>
#include <span>
#include <vector>

#include "core/solid/mesh.hpp"

namespace brisance::solid {

class Solid;

/// One particle of the group of a vertex, and the reference arm a0 - X_I from its centre, m.
struct Corner {
  GlobalId particle = 0;
  Vec3 arm{};
};

/// A piece of boundary. 3D: triangle, outward by the right-hand rule. 2D: segment from vertex 0 to vertex 1 with
/// outward normal (dy, -dx). 1D: point; `side` is the outward direction along x.
struct Element {
  GlobalId id = 0;
  Index body = 0;
  GlobalId particle = 0;
  std::array<Index, 3> vertex{-1, -1, -1};
  int side = 0;
};

/// Topology of the boundary, the same on every rank; positions come from the particles of each vertex.
/// Source: theory/coupling.md 1.6 and 3.1: a vertex is the mean of the images of its corner under the connected group
/// of particles around it; faces with more than three corners are fanned around their centre.
class Surface {
 public:
  explicit Surface(Mesh const& mesh) : Surface(mesh, {}, nullptr) {}
  /// With links that are broken, by their place in Mesh::links: their faces belong to the boundary, and corners they
  /// alone held together part. `before`: the surface they open in, for `origin`. Source: theory/coupling.md 3.2.
  Surface(Mesh const& mesh, std::vector<bool> const& broken, Surface const* before);

  int dimension() const { return dimension_; }
  std::span<Element const> elements() const { return elements_; }
  Index vertices() const { return static_cast<Index>(first_.size()) - 1; }
  /// Corners of a vertex, by particle.
  std::span<Corner const> corners(Index vertex) const {
    auto const v = static_cast<std::size_t>(vertex);
    return std::span(corners_).subspan(first_[v], first_[v + 1] - first_[v]);
  }
  /// Place of the corners of a vertex in arrays that run over all corners (such as the frozen arms of a step).
  std::size_t first_corner(Index vertex) const { return first_[static_cast<std::size_t>(vertex)]; }
  std::size_t corner_count() const { return corners_.size(); }

  /// Are all particles of the vertex on this rank (owned or ghosts)?
  bool known(Index vertex, Solid const& solid) const;
  /// Mean over the group of x_I + R_I (a0 - X_I), m.  Expects: known(vertex, solid).
  Vec3 position(Index vertex, Solid const& solid) const;
  /// Current arms R_I (a0 - X_I) of the corners of a vertex, written to `arms` in their order.
  void arms(Index vertex, Solid const& solid, std::span<Vec3> arms) const;
  /// Mean over the group of V_I + Omega_I x arm_I with the half-step velocities, m/s.
  Vec3 velocity(Index vertex, Solid const& solid, std::span<Vec3 const> arms) const;
  /// Where a vertex was in the surface before: the mean of these of its vertices, mostly one, or, where there was no
  /// boundary, the mean of the images of these corners. Vertices that parted have one origin.
  struct Origin {
    std::vector<Index> vertices;
    std::vector<Corner> corners;
  };
  Origin const& origin(Index vertex) const { return origins_[static_cast<std::size_t>(vertex)]; }
  /// Every particle that may ever share a vertex with `particle`: those whose corners lie at the same reference point
  /// and that links join, broken or not. By id, without itself.
  static std::vector<std::vector<GlobalId>> neighbours(Mesh const& mesh);

  /// Position in the reference state, m.
  Vec3 reference(Index vertex, Mesh const& mesh) const;

 private:
  void check_closed() const;
  int dimension_;
  std::vector<Element> elements_;
  std::vector<Corner> corners_;
  std::vector<std::size_t> first_{0};
  std::vector<bool> broken_;                                  ///< links of the mesh; empty: none
  std::vector<std::size_t> root_of_corner_;                   ///< over the corners of all particles
  std::map<std::size_t, Index> vertex_of_root_;               ///< groups on the boundary
  std::map<std::pair<GlobalId, int>, Index> vertex_of_face_;  ///< centres of faces
  std::vector<Origin> origins_;                               ///< empty without a surface before
};

}  // namespace brisance::solid
