// The effect coupling.body_loads: what the fluid does to each body. Watches, changes nothing.
#pragma once
#include <array>
#include <vector>

#include "core/model/plan.hpp"
#include "core/solid/solid.hpp"

namespace brisance::coupling {

/// Force, impulse and energy that every body of the scene receives from the fluid, as the table body_loads.csv: a row
/// per body and output time. The numbers are those that the particles feel, so that they are the fluid's loss
/// (theory/coupling.md 1.6); pieces of a body that broke count as that body. Sums are exact: the same bytes on any
/// number of ranks and after restart.
class BodyLoads : public Effect {
 public:
  BodyLoads(solid::Solid& solid, parallel::Comm& comm);
  void join(Plan& plan) override;

  /// Of one body: N, N m (about the origin), N s, N m s (about the origin), J.
  struct Row {
    Vec3 force, torque, impulse, angular_impulse;
    Real energy = 0;
  };
  /// Collective. Of all bodies, in the order of the scene; force and torque are those of the last step.
  std::vector<Row> rows();

 private:
  enum Item { impulse, angular_impulse = 3, energy = 6, items };
  using Sums = std::array<parallel::ExactSum, items>;

  void add(Real dt);
  std::string table(Clock const& clock);
  void write(parallel::ArchiveWriter& file) const;
  void read(parallel::ArchiveReader& file);

  solid::Solid& solid_;
  parallel::Comm& comm_;
  std::vector<Sums> sums_, saved_;  ///< per body, this rank's share since the start
};

}  // namespace brisance::coupling
