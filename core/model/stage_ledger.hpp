// The defects of mass, momentum and energy, charged to the part of the step that made them.
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/model/ledger.hpp"

namespace brisance {

/// Parts of a step.
enum class Part : std::size_t {
  sources,    // gravity on the gas
  diffusion,  // viscous terms
  sweep_x,
  sweep_y,
  sweep_z,    // fluxes along an axis, through the open parts of cut faces too
  transfers,  // gas that the wall swept from cell to cell
  wall,       // what the gas gave the wall against what the particles received
  mixing,     // merging and redistribution of small cells, then the new geometry
  motion,     // kicks, drift, internal forces, loads: the energy of Verlet oscillates by O(dt^2)
  contact,    // the same of the forces between bodies
  fracture,   // links that break, surfaces that open
  count
};
constexpr std::size_t part_count = static_cast<std::size_t>(Part::count);
char const* name(Part part);
inline Part sweep_part(int direction) {
  return static_cast<Part>(static_cast<std::size_t>(Part::sweep_x) + static_cast<std::size_t>(direction));
}

/// Mass, momentum and energy: kg, kg m/s, J (2D: per metre).
using Amounts = std::array<parallel::ExactSum, 5>;
void add(Amounts& to, Amounts const& from);
void subtract(Amounts& from, Amounts const& what);

/// Counted apart: while one of them is advanced, the other may be in a provisional state.
enum class Domain : std::size_t { flow, solid, count };

/// Charges every part of a step with the change of what is held, less what came from outside meanwhile. All sums are
/// exact and telescope: the parts add up to the defect of the whole. Parts that share one measurement split it by
/// `shift`, which leaves the sum as it is.
class StageLedger {
 public:
  using Account = std::function<void(Ledger&)>;
  /// Who counts what a domain holds and received.
  void watch(Domain domain, Account account);
  /// Called after each charge of the flow.
  void on_flow_charge(std::function<void(Part)> look) { looks_.push_back(std::move(look)); }

  /// Local. Before a pair of steps: what is held, unless it is known from the last one.
  void begin(Ledger& main);
  /// Local. The defect of the domain since its last charge goes to `part`, what the accounts received goes to `main`.
  void charge(Part part, Domain domain, Ledger& main);
  /// Local. Takes `amounts` off one part and puts them on another.
  void shift(Part from, Part to, Amounts const& amounts);
  /// Collective. Ends a pair of steps.
  void audit(parallel::Comm& comm);
  /// Back to the state of `begin`, for a rejected pair.
  void restore();

  /// Of all ranks, as of the last audit: the defect since the start of the scene, and the largest size it had.
  std::array<Real, 5> defect(Part part) const;
  std::array<Real, 5> const& largest(Part part) const { return largest_[static_cast<std::size_t>(part)]; }
  bool charged(Part part) const { return charged_[static_cast<std::size_t>(part)]; }  ///< has this scene such a part?

  /// Everything a restart needs, the same on every rank. Rows of five sums of limbs, and of five sizes and a flag.
  static constexpr int limbs_per_row = 5 * parallel::ExactSum::limbs, sizes_per_row = 6;
  std::vector<std::int64_t> store_limbs() const;
  std::vector<Real> store_sizes() const;
  void read(std::vector<std::int64_t> const& limbs, std::vector<Real> const& sizes);

 private:
  /// What a domain holds; what it received since the last count, less what it dissipated.
  struct Count {
    Amounts held, received;
  };
  Count count(Domain domain, Ledger& main);

  static constexpr std::size_t domain_count = static_cast<std::size_t>(Domain::count);
  std::array<std::vector<Account>, domain_count> accounts_;
  std::vector<std::function<void(Part)>> looks_;
  bool known_ = false;                                 ///< is held_ that of the present state?
  std::array<Amounts, domain_count> held_, at_begin_;  ///< of this rank: at the last charge, at the start of the pair
  std::array<Amounts, part_count> recent_;             ///< of this rank since the last audit
  std::array<Amounts, part_count> total_;              ///< of all ranks since the start
  std::array<std::array<Real, 5>, part_count> largest_{};
  std::array<bool, part_count> charged_{};
};

/// Names the parts that do not close to round-off, and by how much of the scales; empty when all do. Not the energy of
/// motion and contact, which the symplectic step lets oscillate.
std::string open_accounts(StageLedger const& stages, DefectScales const& scales);

}  // namespace brisance
