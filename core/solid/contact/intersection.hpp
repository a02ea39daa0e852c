// The common part of two convex particles, by clipping one with the planes of the other.
#pragma once
#include <vector>

#include "core/solid/contact/convex.hpp"

namespace brisance::solid {

/// What the energy of an overlap and its gradient need (theory/solid.md section 15); places from the centre of A.
struct Intersection {
  Real volume = 0;         ///< m3; 0: they do not overlap
  Vec3 area{};             ///< S_A = sum S_f n_f over the pieces of A's surface, m2: the gradient of the volume by x_A
  Vec3 moment{};           ///< m_A = sum S_f c_f x n_f of the same pieces, m3: the gradient by a turn of A
  Vec3 centroid{};         ///< of the volume, m
  Real low = 0, high = 0;  ///< its heights along `area`, m
  Real order = 0;          ///< n of V ~ depth^n: 1 for a flat contact, 2 along an edge, 3 at a corner
};

/// Over the pieces of one body's surface that bound an overlap, with the depth s of a point below its centroid:
/// integrals of s n (m3) and of s x cross n (m4), x from the centre of A.
struct SurfaceMoments {
  Vec3 force{}, moment{};
};

/// Clips polyhedra; keeps its buffers from pair to pair.
/// Corners are shared by the faces and classified once, so what is left is closed whatever the rounding: faces of both
/// bodies may lie in one plane. Cost: 1 to 2 us for two bricks.
class Clipper {
 public:
  /// `shift`: from the centre of a to that of b.
  Intersection intersect(PlacedConvex const& a, PlacedConvex const& b, Vec3 const& shift);
  /// Of the overlap found last. `of_a`: over A's pieces, else over B's; depth is counted against `outward`.
  SurfaceMoments moments(bool of_a, Vec3 const& outward, Vec3 const& centroid) const;

 private:
  enum class Cut { missed, clipped, empty };
  Cut cut(Vec3 const& normal, Real offset);
  int crossing(int inside, int outside);
  Intersection measure() const;

  struct Faces {
    std::vector<int> loops, first;
    std::vector<char> of_a;
    void clear() { loops.clear(), first.assign(1, 0), of_a.clear(); }
    /// Ends the face whose corners were pushed to `loops`; a face with fewer than three corners vanishes.
    void close(char owner);
  };
  struct Crossing {
    int inside, outside, point;
  };
  std::vector<Vec3> points_, next_points_;
  std::vector<Real> height_;
  std::vector<int> renumbered_;
  Faces faces_, next_faces_;
  std::vector<Crossing> crossings_;
  std::vector<int> cap_;  ///< after the k-th crossing comes ...
};

}  // namespace brisance::solid
