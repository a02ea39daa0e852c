// How stiff is a mesh? A patch of it under homogeneous stress, solved statically, against Hooke's law.
#pragma once
#include "core/solid/mesh.hpp"

namespace brisance::solid {

/// Particles of one body, cut out of a mesh; faces towards others are boundary like free ones.
class Patch {
 public:
  /// The particle of `body` nearest to its middle and those linked to it, nearest first, up to `most`.
  Patch(Mesh const& mesh, Index body, GlobalId most);

  /// Affine displacement that fits the poles best, u = A X + b, and what it leaves.
  struct Response {
    Mat3 gradient{};              ///< A
    Real scatter = 0;             ///< rms distance of the poles from the fit over rms A X
    std::array<bool, 3> spans{};  ///< do the poles differ along x, y, z, independently of the other directions?
    int iterations = 0;           ///< of the conjugate gradients
    bool converged = true;
  };
  /// Equilibrium of the linearised links (E = 1, this Poisson ratio) under tractions stress . n on all boundary faces,
  /// the traction term of the volumetric strain included. Source: theory/solid.md sections 3 to 9.
  Response respond(Mat3 const& stress, Real poisson_ratio, Real tolerance) const;

  GlobalId size() const { return static_cast<GlobalId>(cells_.size()); }
  int dimension() const { return dimension_; }

 private:
  struct Cell {
    Vec3 centre{}, pole{};  ///< absolute
    Real volume = 0;
  };
  struct Tie {
    Index i, j;
    Real area, length, weight;
    Vec3 normal, arm_i, arm_j;
    Mat3 second;  ///< M2 of the face
  };
  struct Face {
    Index cell;
    Real area, distance;
    Vec3 normal, arm;
  };
  friend class PatchSystem;
  int dimension_;
  std::vector<Cell> cells_;
  std::vector<Tie> ties_;
  std::vector<Face> faces_;
};

/// Effective elastic constants of a patch, relative to those put in.
struct PatchModuli {
  Real young = 0, shear = 0;  ///< the deviation E_eff/E - 1, G_eff/G - 1 of the direction where it is largest
  Real poisson = 0;           ///< nu_eff - nu where it is largest
  Real scatter = 0;           ///< largest Response::scatter
  bool converged = true;
  bool stretch = false, shearing = false, squeeze = false;  ///< could they be measured?
};
/// Three uniaxial stresses and three shears (2D: two and one, in plane strain); only in directions that the poles span
/// (not across a single layer).
PatchModuli measure_moduli(Patch const& patch, Real poisson_ratio, Real tolerance);

}  // namespace brisance::solid
