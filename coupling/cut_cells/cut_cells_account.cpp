// What the cut cells tell others: the account, the digest, counts for the summary.
#include <algorithm>

#include "coupling/cut_cells/cut_cells.hpp"

namespace brisance::coupling {

GlobalId CutCells::cut_cell_count() const {
  return std::count_if(record_.geometry.cells.begin(), record_.geometry.cells.end(),
                       [&](CutCell const& c) { return owned(c.cell); });
}

void CutCells::account(Ledger& ledger) {
  for (std::vector<Content> const* contents : {&kept_, &minor_})
    for (Content const& k : *contents) {
      ledger.add(Entry::mass, k.amount[0]);
      ledger.add(Entry::momentum_x, Vec3{k.amount[1], k.amount[2], k.amount[3]});
      ledger.add(Entry::energy, k.amount[4]);
      ledger.add(Entry::fluid_energy, k.amount[4]);
    }
  ledger.add(Entry::in_mass, crossed_[0]);
  for (std::size_t d = 0; d < 3; ++d)
    ledger.add(static_cast<Entry>(static_cast<std::size_t>(Entry::in_momentum_x) + d), crossed_[1 + d]);
  ledger.add(Entry::in_energy, crossed_[4]);
  ledger.add(Entry::fluid_in_energy, crossed_[4]);
  parallel::ExactSum lost_heat;  // not rounded: the sum of this rank alone depends on the partition
  lost_heat.subtract(wall_heat_);
  ledger.add(Entry::in_energy, lost_heat);
  ledger.add(Entry::fluid_in_energy, lost_heat);
  ledger.add(Entry::wall_work, wall_work_);
  ledger.add(Entry::pressure_impulse, pressure_impulse_);
  ledger.add(Entry::exchanged_energy, exchanged_energy_);
  for (std::size_t d = 0; d < 3; ++d)
    ledger.add(static_cast<Entry>(static_cast<std::size_t>(Entry::in_momentum_x) + d), ambient_given_[d]);
  ledger.add(Entry::in_energy, ambient_given_[3]);
  for (auto& sum : crossed_) sum = {};
  for (auto& sum : ambient_given_) sum = {};
  wall_work_ = pressure_impulse_ = exchanged_energy_ = wall_heat_ = {};
}

std::string CutCells::remark_on_mixed() const {
  std::int64_t mixed = cost_.mixed;
  comm_.sum(std::span(&mixed, 1));
  if (mixed == 0) return {};
  return "a thin wall leaked within a cell: " + std::to_string(mixed) +
         " time(s) the parts into which it divides one could not be followed through a step, and shared their gas. "
         "Mass, momentum and energy are kept. Smaller steps (fluid.euler.cfl) or finer cells help; "
         "geometry.mixed_divided_cells in summary.json counts such cells.";
}

void CutCells::digest(parallel::Digest& digest) const {
  constexpr std::uint32_t covered_kind = 3;
  for (Content const& k : kept_) digest.add(covered_kind, k.cell, k.amount);
  for (Content const& m : minor_) digest.add(covered_kind + static_cast<std::uint32_t>(m.unit), m.cell, m.amount);
}

}  // namespace brisance::coupling
