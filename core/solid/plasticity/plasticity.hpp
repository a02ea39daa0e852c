// The effect solid.plasticity: particles yield, links follow, what flow costs goes to the account.
#pragma once
#include <vector>

#include "core/model/plan.hpp"
#include "core/solid/plasticity/return_mapping.hpp"
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// Once per step, after the drift, every particle returns to its yield surface; the forces of the step are those of the
/// new plastic strain. Its work is the trapezoidal rule over the step: the mean of the driving stress before and after,
/// each in equilibrium with the strain of its instant, so that kinetic + elastic + stored + dissipated energy carries
/// only the oscillation of Verlet.  Source: theory/solid.md section 16 (a).
class Plasticity : public Effect {
 public:
  /// Errors: scene errors of the laws; links are missing.
  Plasticity(SolidConfig const& config, Solid& solid, parallel::Comm& comm);
  void join(Plan& plan) override;
  void start() override;

  /// Flow of a step that ends at the present poses. Collective among neighbours.
  void flow(Real dt);
  /// After the forces of the new plastic strain: books the work.
  void settle();
  /// Breaks the links of particles at the end of their ductility. Returns whether this rank had any.
  bool fail();

  std::span<PlasticState const> state() const { return state_; }  ///< of owned particles
  /// Driving stress of section 16 of the owned particles at the last settle, Pa; a deviator.
  Symmetric stress(Index particle) const;
  parallel::ExactSum const& dissipated() const { return dissipated_; }  ///< J since the last account, this rank

 private:
  struct Yielding {
    Index particle;
    PlasticFlow flow;
  };
  PlasticLaw const* law_of(Index particle) const;
  void spread();
  void set_threshold(Index particle);
  Verdict judge() const;
  std::string find_large_strain() const;
  void keep(Plan& plan);
  std::vector<double> pack() const;
  void unpack(std::span<double const> rows);

  Solid& solid_;
  parallel::Comm& comm_;
  std::vector<PlasticLaw> laws_;
  std::vector<Index> law_of_material_;  // -1: elastic
  bool fails_ = false;

  std::vector<PlasticState> state_;        // owned
  std::vector<Symmetric> stress_, trial_;  // V times the driving stress, owned
  std::vector<double> rows_;               // strain and damage of all local particles, for ghosts
  std::vector<Yielding> yielding_;         // since the last settle
  std::vector<Real> threshold_;            // square of the yield stress at rest over 3/2, owned; -1: elastic
  Index overstrained_ = -1;                // a particle beyond what the law can bear
  parallel::ExactSum dissipated_;
  std::int64_t links_broken_ = 0;
};

}  // namespace brisance::solid
