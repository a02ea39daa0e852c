// Impulse and work of the tractions on some faces of a rank.
#pragma once
#include <vector>

#include "core/solid/loads/load_account.hpp"
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// Follows faces [first, last) of Solid::face_tractions through a step, particle by particle.
/// Source: theory/solid.md section 7, the last paragraph on free faces.
class FaceAccount {
 public:
  void follow(Solid& solid, std::size_t first, std::size_t last);
  /// At the state at which the coming step starts: initial, resumed or put back.
  void start();
  void before_first_kick();
  void after_first_kick();
  /// After the drift, before the tractions change to those of the end of the step.
  void before_change();
  /// After the second kick: adds the step of the owned particles.
  void after_second_kick(Real dt, LoadAccount& account);
  std::size_t bytes() const { return loaded_.size() * sizeof(Loaded) + normal_.size() * 2 * sizeof(Real); }

 private:
  /// An owned particle and its faces.
  struct Loaded {
    Index particle;
    std::size_t first_face, last_face;
    KickLoad first, second;
    KickVelocity velocity;
  };
  void measure_wrenches();

  Solid* solid_ = nullptr;
  std::vector<Loaded> loaded_;
  std::size_t offset_ = 0;
  std::vector<Real> normal_, extension_;  ///< t_n and S w_f of each face at the start of the step
};

}  // namespace brisance::solid
