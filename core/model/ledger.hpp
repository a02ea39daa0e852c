// What the coupled system holds, what crossed its boundaries, and the defect between the two (contract,
// conservation.*).
#pragma once
#include <array>
#include <cstddef>

#include "core/base/vec3.hpp"
#include "parallel/comm.hpp"

namespace brisance {

/// One line of the account. Totals are what is held now; the others are what came since the last audit.
enum class Entry : std::size_t {
  mass,
  momentum_x,
  momentum_y,
  momentum_z,
  energy,         // totals of fluid and solid
  momentum_size,  // total of the momentum's size over cells and particles
  fluid_energy,
  solid_kinetic,
  solid_elastic,
  solid_stored,  // parts of the energy; stored: by the hardening of metals
  in_mass,
  in_momentum_x,
  in_momentum_y,
  in_momentum_z,
  in_energy,         // crossed the boundaries inwards, sources, reactions
  fluid_in_energy,   // the part of in_energy that the fluid received
  wall_work,         // work of the fluid on the solid
  pressure_impulse,  // sum of the sizes of the impulses of all pressures
  exchanged_energy,  // sum of the sizes of all exchanges of energy
  dissipated,        // mechanical energy turned into cracks, slip, plastic work, damping: left the account, J
  links_broken,      // number
  count
};
constexpr std::size_t entry_count = static_cast<std::size_t>(Entry::count);

/// Largest relative defects over the run; of the energy, the largest defect over the largest scale.
struct Conservation {
  Real mass = 0;
  Vec3 momentum;
  Real exchange_energy = 0, energy = 0, energy_final = 0;
};

/// What the defects are held against: kg, kg m/s, J; never 0.
struct DefectScales {
  Real mass = 1, momentum = 1, energy = 1;
};

class Ledger {
 public:
  void add(Entry entry, Real value) { sums_[static_cast<std::size_t>(entry)].add(value); }
  void add(Entry entry, parallel::ExactSum const& value) { sums_[static_cast<std::size_t>(entry)].add(value); }
  /// Adds the three components starting at the x entry.
  void add(Entry x_entry, Vec3 const& value);

  /// Local. Adds what came to `part`, and none of its totals: a count of a part of the system in the middle of a step.
  void receive(Ledger const& part);
  /// Local. What was added to an entry since the last audit, on this rank.
  parallel::ExactSum const& added(Entry entry) const { return sums_[static_cast<std::size_t>(entry)]; }

  /// Collective. Reduces what was added since the last audit and updates the defects; the first audit sets the
  /// reference.
  void audit(parallel::Comm& comm);
  Conservation const& conservation() const { return result_; }
  DefectScales scales() const;
  Real total(Entry entry) const { return totals_[static_cast<std::size_t>(entry)]; }
  /// What came of it since the start of the scene, of the entries that are not totals.
  Real received(Entry entry) const { return crossed_[static_cast<std::size_t>(entry)]; }

  /// Everything a restart needs, as doubles; the same on every rank.
  static constexpr std::size_t stored_size = 2 * entry_count + entry_count + 10;
  std::array<Real, stored_size> store() const;
  void restore(std::array<Real, stored_size> const& stored);

 private:
  std::array<parallel::ExactSum, entry_count> sums_{};
  std::array<Real, entry_count> reference_{}, totals_{}, crossed_{};  // crossed: sums of the increments since the start
  bool started_ = false;
  Real largest_defect_ = 0, largest_scale_ = 0;  // of the energy, J
  Conservation result_;
};

}  // namespace brisance
