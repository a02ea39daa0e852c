// Boundary faces that let plane waves out.
#pragma once
#include <vector>

#include "core/model/plan.hpp"
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// solid.absorbing: dashpots t = -rho c_p (v.n) n - rho c_s v_t at the centroids of faces (Lysmer).
/// Source: theory/solid.md section 7.
/// They act on the velocities between the last kick of a step and the first of the next, by the rule of the mean
/// velocity: (M + dt/2 C) v+ = (M - dt/2 C) v-. This takes exactly dt v C v, of the mean velocity v, out of the kinetic
/// energy, at any step, and leaves Verlet's own account of energy alone.
class AbsorbingFaces : public Effect {
 public:
  /// Errors: scene errors naming the selection.
  AbsorbingFaces(SolidConfig const& config, Solid& solid);
  void join(Plan& plan) override;

 private:
  using Matrix = std::array<std::array<Real, 6>, 6>;
  using Vector = std::array<Real, 6>;
  /// An owned free particle with absorbing faces; body frame.
  struct Dashpot {
    Index particle;
    Matrix damping;  ///< C of (v, Omega)
    Matrix mass;     ///< M = diag(m, J)
    Mat3 inverse;    ///< J^-1
    Matrix step;     ///< (M + dt/2 C)^-1 (M - dt/2 C)
  };
  void add_face(Dashpot& to, GlobalId particle, FaceGeometry const& face) const;
  void prepare(Real dt);
  void damp(Real dt);

  Solid& solid_;
  std::vector<Dashpot> dashpots_;
  Real prepared_for_ = 0;  ///< s
  std::array<parallel::ExactSum, 3> impulse_{};
  parallel::ExactSum dissipated_, push_;
};

}  // namespace brisance::solid
