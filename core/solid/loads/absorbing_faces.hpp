// Boundary faces that let plane waves out.
#pragma once
#include <vector>

#include "core/model/plan.hpp"
#include "core/solid/loads/face_account.hpp"
#include "core/solid/loads/face_selection.hpp"

namespace brisance::solid {

/// solid.absorbing: dashpots t = -rho c_p (u'.n) n - rho c_s u'_t (Lysmer) on the surface points of faces, which follow
/// their particles through the springs 2 G / d of half a link: u' = v + w', t = 2 G w / d + lambda eps n.
/// Source: theory/solid.md section 7. On the rigid particle itself, without the springs, the dashpot stands half a cell
/// before the surface and reflects k h / 4 of a wave of number k.
/// Time: w and t at t^{n+1} by the rule of the mean over the step, t^n + t^{n+1} = -2 rho c (v + (w^{n+1} - w^n) / dt):
/// one small system per particle, as its faces share eps. It dissipates dt rho c |u'|^2 S exactly, at any step.
class AbsorbingFaces : public Effect {
 public:
  /// Errors: scene errors naming the selection; a face that bears another load.
  AbsorbingFaces(SolidConfig const& config, Solid& solid);
  void join(Plan& plan) override;
  void start() override;

 private:
  struct State {
    Vec3 traction{}, extension{};  ///< t, Pa, and w, m; body frame
  };
  /// The faces of a particle whose links are all here: owned or in the first layer of ghosts.
  struct Group {
    Index particle;
    std::size_t first, last;                          ///< places in states_
    Real resist_normal, resist_shear;                 ///< rho c_p, rho c_s
    std::vector<std::pair<std::size_t, Real>> links;  ///< links of this rank and the particle's weights in them
  };

  void update(Real dt);
  Real update(Group const& group, Real dt);
  void set_tractions();

  Solid& solid_;
  std::vector<FaceRef> here_;     ///< of each local face
  std::vector<GlobalId> number_;  ///< of each local face among all absorbing ones
  GlobalId total_ = 0;
  std::size_t offset_ = 0;  ///< of the local faces in Solid::face_tractions
  std::vector<State> states_, saved_;
  std::vector<Group> groups_;
  FaceAccount account_of_faces_;
  LoadAccount account_;
  parallel::ExactSum dissipated_;
};

}  // namespace brisance::solid
