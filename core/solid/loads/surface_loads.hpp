// Pressures, tractions and blasts on boundary faces.
#pragma once
#include "core/model/plan.hpp"
#include "core/solid/loads/blast_wave.hpp"
#include "core/solid/loads/face_account.hpp"
#include "core/solid/loads/face_selection.hpp"
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// solid.pressure, solid.traction and solid.blast: all that loads a face adds up to one traction, whose normal part
/// also enters the volumetric strain.  Source: theory/solid.md section 7. The tractions of t^{n+1} are set after the
/// drift, before the forces of t^{n+1}; they depend on time and poses alone, so nothing of them is kept.
class SurfaceLoads : public Effect {
 public:
  /// Errors: scene errors naming the load: no face selected, no such body, no possible history.
  SurfaceLoads(SolidConfig const& config, Solid& solid);
  void join(Plan& plan) override;
  void start() override;

 private:
  /// A face here (its place in Solid::face_tractions) and what acts on it.
  struct Part {
    std::size_t face;
    Vec3 traction;  ///< Pa at factor 1; body frame or fixed in space
  };
  struct Load {
    History history;
    bool follow;
    std::vector<Part> parts;
  };
  struct BlastPart {
    std::size_t face;
    BlastWave wave;
  };
  void find_faces();
  void set_tractions(Real time);

  SolidConfig config_;
  Solid& solid_;
  std::vector<Load> loads_;
  std::vector<BlastPart> blasts_;
  std::size_t count_ = 0;  ///< of the loaded faces of this rank: the first of Solid::face_tractions
  FaceAccount account_of_faces_;
  LoadAccount account_;
  Real longest_step_ = 1e300;  ///< s
  Real time_ = 0, saved_time_ = 0;
};

}  // namespace brisance::solid
