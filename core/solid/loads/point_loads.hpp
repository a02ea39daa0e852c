// Forces at points and seismic sources.
#pragma once
#include <vector>

#include "core/model/plan.hpp"
#include "core/solid/loads/history.hpp"
#include "core/solid/loads/load_account.hpp"
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// solid.point_force and solid.moment_tensor: forces at points that particles carry along, added to the internal forces
/// of t^{n+1}.  Source: theory/solid.md section 7.
class PointLoads : public Effect {
 public:
  /// Errors: scene errors naming the load: no such body, nothing near the position, a source at the boundary.
  PointLoads(SolidConfig const& config, Solid& solid);
  void join(Plan& plan) override;
  void start() override;

 private:
  /// A force on an owned particle.
  struct Part {
    std::size_t history;
    Index particle;
    Index frame;      ///< particle whose rotation turns the force; -1: fixed in space
    Vec3 force, arm;  ///< at factor 1, N; from the mass centre in the body frame, m
    KickLoad first, second;
    KickVelocity velocity;
  };

  void add_force(PointForceConfig const& config, std::string const& name);
  void add_source(MomentTensorConfig const& config, std::string const& name);
  void add_part(GlobalId particle, Index frame, Vec3 const& force, Vec3 const& arm);
  void measure_wrenches(Real time);
  void add_to_forces() const;

  SolidConfig config_;
  Solid& solid_;
  std::vector<History> histories_;
  std::vector<Part> parts_;
  LoadAccount account_;
  Real longest_step_ = 1e300;  ///< s
  Real time_ = 0, saved_time_ = 0;
  bool resumed_ = false;  ///< a checkpoint holds the forces of its time
};

}  // namespace brisance::solid
