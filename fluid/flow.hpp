// The fluid domain: grid, blocks of this rank, gas, and one sweep of all of them.
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "fluid/boundary/boundaries.hpp"
#include "fluid/boundary_ledger.hpp"
#include "fluid/flow_config.hpp"
#include "fluid/flux/sweep.hpp"
#include "fluid/ghosts.hpp"
#include "fluid/grid/block.hpp"
#include "fluid/shock_sensor.hpp"
#include "parallel/comm.hpp"

namespace brisance::fluid {

/// Sweeps blocks that the plain kernel cannot, such as those that hold walls. Registered with Flow::set_sweeper.
struct BlockSweeper {
  virtual ~BlockSweeper() = default;
  virtual bool handles(Index block_id) const = 0;
  /// Collective; called once before the ghosts of `direction` are filled, when all blocks hold the state before the
  /// sweep.
  virtual void prepare(int direction, Real dt) = 0;
  /// Advances one block whose ghosts along `direction` are complete. `where` is a local cell, as in sweep_box. What
  /// crosses sides of the domain is its own affair (Flow::ledger).
  virtual SweepReport sweep(Block& block, int direction, Real dt) = 0;
  /// Does this cell of a block that it handles hold a state of the fluid at the start of the step?
  virtual bool is_fluid(Block const& block, Index i, Index j, Index k) const = 0;
};

class Flow {
 public:
  /// `owner`: rank of every block of the grid. All cells hold the ambient state; fill() (initial_state.hpp) sets the
  /// scene's.
  Flow(FlowConfig const& config, Grid grid, std::vector<int> owner, parallel::Comm& comm);
  Flow(Flow const&) = delete;
  Flow& operator=(Flow const&) = delete;

  Grid const& grid() const { return grid_; }
  Gas const& gas() const { return gas_; }
  int order() const { return order_; }
  parallel::Comm& comm() const { return comm_; }
  /// Owned blocks, ascending ids.
  std::vector<Block>& blocks() { return blocks_; }
  std::vector<Block> const& blocks() const { return blocks_; }
  Block* find(Index block_id);  ///< null when another rank owns it
  int owner(Index block_id) const { return owner_[static_cast<std::size_t>(block_id)]; }
  std::vector<int> const& owners() const { return owner_; }
  Boundaries const& boundaries() const { return boundaries_; }
  bool reflecting(int direction, int side) const { return boundaries_.law(direction, side) == Reflecting::name; }
  Ghosts& ghosts() { return ghosts_; }
  BoundaryLedger& ledger() { return ledger_; }
  BoundaryLedger const& ledger() const { return ledger_; }

  /// Null: all blocks are swept by the plain kernel. Not owned.
  void set_sweeper(BlockSweeper* sweeper) { sweeper_ = sweeper; }

  /// Collective. What the sweeps of a step need of the state at its start: the marks of the shock sensor. Nothing to do
  /// in 1D or without the cure.
  void begin_step();
  /// Marks of this step in an owned block; null: none.
  CellLayer<std::uint8_t> const* marks(Block const& block) const {
    return sensor_ ? sensor_->marks(static_cast<std::size_t>(&block - blocks_.data())) : nullptr;
  }
  SweepOptions const& options() const { return options_; }

  /// Collective. Cell means at t -> after one sweep along `direction`, in place, ghosts included. `middle`: time at
  /// which the sides are taken, t + dt/2, s. The report of this rank: health bits or-ed, `where` = global index of the
  /// first bad cell (lowest id), ends of blocks left empty.
  SweepReport sweep(int direction, Real dt, Real middle = 0);

  /// Keeps the cells and the ledger for restore(): the state to which a rejected pair of steps returns.
  void save();
  void restore();

  std::size_t bytes() const;  ///< memory of this rank: cells, saved copy, messages

 private:
  void sweep_block(Block& block, int direction, Real dt, SweepReport& total);

  Grid grid_;
  Gas gas_;
  int order_;
  std::vector<int> owner_;
  parallel::Comm& comm_;
  std::vector<Block> blocks_;
  Boundaries boundaries_;
  Ghosts ghosts_;
  BoundaryLedger ledger_, saved_ledger_;
  std::vector<std::vector<Real>> saved_;
  BlockSweeper* sweeper_ = nullptr;
  SweepOptions options_;
  std::unique_ptr<ShockSensor> sensor_;
};

/// The cells of a block as a box for sweep_box.
CellBox box_of(Block& block, int dimension);

/// Adds a block's report to a sum; `first` turns its local cell into a global one.
void merge(SweepReport& total, SweepReport const& report, CellIndex first, Grid const& grid);

}  // namespace brisance::fluid
