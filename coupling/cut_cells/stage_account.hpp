// The part of the ledger by stages that only the cut cells know.
#pragma once
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "core/model/stage_ledger.hpp"
#include "coupling/cut_cells/wall_sweeper.hpp"

namespace brisance::coupling {

/// The sweeps change cut cells as if they were whole, and the balance rewrites them from the fluxes through what is
/// open. So their change in the sweeps is taken off the parts that made it, and what the balance gives is charged to
/// them instead. `mixing` stands in between: it gets all that neither explains.
class StageAccount {
 public:
  StageAccount(StageLedger& stages, fluid::Flow const& flow, WallSweeper const& sweeper)
      : stages_(stages), flow_(flow), sweeper_(sweeper) {}

  /// A step begins: nothing was swept.
  void begin_step() { swept_.clear(); }
  /// The part of the flow that ended here left these states in the blocks that hold walls.
  void look(Part part);
  /// The balance begins: it will rewrite these cells (global), cut by `record` until now, and holds `counted`.
  void begin_balance(std::span<fluid::CellIndex const> cells, WallRecord const& record, Amounts counted);
  /// The balance holds `counted` now; the change is the work of `part`.
  void charge(Part part, Amounts const& counted);
  /// What the particles received from the gas in a (sub-)step.
  void solid_received(Amounts const& amounts) { stages_.shift(Part::motion, Part::wall, amounts); }
  std::size_t bytes() const;

 private:
  using States = std::map<Index, std::vector<fluid::State>>;  ///< of blocks with walls

  StageLedger& stages_;
  fluid::Flow const& flow_;
  WallSweeper const& sweeper_;
  std::vector<std::pair<Part, States>> swept_;  ///< after each part of the step, in order
  Amounts counted_{};
};

}  // namespace brisance::coupling
