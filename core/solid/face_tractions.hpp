// Tractions on boundary faces that turn with their particles, and the volume that they open.
#pragma once
#include <span>
#include <vector>

#include "core/solid/mesh.hpp"
#include "core/solid/particles.hpp"

namespace brisance::solid {

/// The loaded faces of a rank. A normal traction moves a free face by itself, which the volumetric strain of its
/// particle has to know.  Source: theory/solid.md section 7.
class FaceTractions {
 public:
  struct Face {
    Index particle;    ///< local
    int face;          ///< of its shape
    Vec3 traction{};   ///< body frame, Pa; may be changed, then `open`
    Vec3 normal, arm;  ///< body frame; arm from the mass centre to the centroid, m
    Real area;         ///< m2
    Real compliance;   ///< S d / 2G: volume opened by the normal traction alone, m3/Pa
    Real normal_traction() const { return dot(traction, normal); }  ///< t_n, Pa
  };

  void clear() { faces_.clear(); }
  /// Errors: Failure::internal when the face is no free face of the particle.
  void add(Mesh const& mesh, GlobalId particle, int face, Index local, Vec3 const& traction);
  std::span<Face> faces() { return faces_; }
  std::span<Face const> faces() const { return faces_; }

  /// Volumes opened by the present tractions, m3: entries of loaded particles are set, others left.
  void open(std::span<double> opening) const;
  /// Forces and torques of the present tractions at the given poses, added in the order of the faces.
  void add_wrench(std::span<Pose const> pose, std::span<Wrench> wrench) const;
  /// Extension of face f beyond its rigid particle w_f = d/2G (t_n - lambda eps), times its area: m3.
  static Real extension(Face const& f, Real pressure) { return f.compliance * (f.normal_traction() - pressure); }
  /// -S d t_n^2 / 4G of one face: its part of the elastic energy, J.
  static Real energy(Face const& f) { return -0.5 * f.compliance * f.normal_traction() * f.normal_traction(); }

 private:
  std::vector<Face> faces_;
};

}  // namespace brisance::solid
