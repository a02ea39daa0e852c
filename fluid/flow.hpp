// The fluid domain: grid, blocks of this rank, gas, and one sweep of all of them.
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fluid/boundary/boundaries.hpp"
#include "fluid/boundary_ledger.hpp"
#include "fluid/flow_config.hpp"
#include "fluid/flux/mixture_sweep.hpp"
#include "fluid/ghosts.hpp"
#include "fluid/grid/block.hpp"
#include "fluid/shock_sensor.hpp"
#include "fluid/sleep.hpp"
#include "fluid/survey.hpp"
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
  /// Null without [fluid.products].
  Mixture const* mixture() const { return mixture_ ? &*mixture_ : nullptr; }
  int components() const { return mixture_ ? 7 : 5; }
  int order() const { return order_; }
  parallel::Comm& comm() const { return comm_; }
  /// Owned blocks, ascending ids.
  /// The first of each two forms lets the caller write into the cells: until the next sweep, save or restore, which
  /// may take a block for asleep that was not asked for anew.
  std::vector<Block>& blocks();
  std::vector<Block> const& blocks() const { return blocks_; }
  Block* find(Index block_id);  ///< null when another rank owns it
  Block const* find(Index block_id) const;
  int owner(Index block_id) const { return owner_[static_cast<std::size_t>(block_id)]; }
  std::vector<int> const& owners() const { return owner_; }
  Boundaries const& boundaries() const { return boundaries_; }
  bool reflecting(int direction, int side) const { return boundaries_.law(direction, side) == Reflecting::name; }
  Ghosts& ghosts() { return ghosts_; }
  BoundaryLedger& ledger() { return ledger_; }
  BoundaryLedger const& ledger() const { return ledger_; }

  /// Null: all blocks are swept by the plain kernel. Not owned.
  void set_sweeper(BlockSweeper* sweeper) { sweeper_ = sweeper; }

  /// Collective. What the sweeps of a pair of steps need of the state at its start: the marks of the shock sensor,
  /// which reach two cells from a jump, further than a shock runs in the first step. Nothing to do in 1D or without the
  /// cure.
  void begin_pair();
  /// Marks of this pair in an owned block; null: none.
  CellLayer<std::uint8_t> const* marks(Block const& block) const {
    return sensor_ ? sensor_->marks(static_cast<std::size_t>(&block - blocks_.data())) : nullptr;
  }
  SweepOptions const& options() const { return options_; }
  Splitting splitting() const { return splitting_; }

  /// What the cells of the block at this position in blocks() hold now; looked at once, and again after they changed.
  Survey const& survey(std::size_t position) const;

  /// From now on every block is swept: for effects that act on uniform gas too, such as body forces.
  void keep_awake() { sleep_ = false; }
  /// May blocks sleep: the scene's wish, unless an effect keeps them awake?
  bool may_sleep() const { return sleep_; }
  /// What sleep saved on this rank since the start of the program.
  struct Saved {
    std::int64_t block_sweeps = 0, block_sweeps_skipped = 0;
    std::int64_t cell_sweeps = 0, cell_sweeps_skipped = 0;
  };
  Saved const& saved_by_sleep() const { return saved_by_sleep_; }

  /// Collective. Cell means at t -> after one sweep along `direction`, in place, ghosts included. `middle`: time at
  /// which the sides are taken, t + dt/2, s. The report of this rank: health bits or-ed, `where` = global index of the
  /// first bad cell (lowest id), ends of blocks left empty.
  /// A block that this sweep would leave as it is, bit by bit, sleeps (theory/fluid.md 7): same cells, report and
  /// ledger.
  SweepReport sweep(int direction, Real dt, Real middle = 0);

  /// Keeps the cells and the ledger for restore(): the state to which a rejected pair of steps returns. The cells stay
  /// where they are until they are about to change.
  void save();
  void restore();

  std::size_t bytes() const;  ///< memory of this rank: cells, saved copy, messages

 private:
  void sweep_block(std::size_t position, int direction, Real dt, SweepReport& total);
  void sweep_products(Block& block, int direction, Real dt, SweepReport& total);
  void take(SweepReport const& report, Block const& block, int direction, Real dt, SweepReport& total);
  bool sleeps(std::size_t position, int direction, Real dt, SweepReport& total);
  void look_at_blocks();
  void changed(std::size_t position);
  Block& spare(std::size_t position);
  void keep_saved(std::size_t position);
  std::size_t position(Index block_id) const;  ///< in blocks_, their number when another rank owns it

  Grid grid_;
  Gas gas_;
  std::optional<Mixture> mixture_;
  int order_;
  State ambient_{};
  std::vector<int> owner_;
  parallel::Comm& comm_;
  std::vector<Block> blocks_;
  Boundaries boundaries_;
  Ghosts ghosts_;
  BoundaryLedger ledger_, saved_ledger_;
  SweepOptions options_;
  Splitting splitting_;
  std::unique_ptr<ShockSensor> sensor_;
  bool sleep_;
  /// What save() promised of a block. Most blocks are never copied: their first sweep after it goes from the block into
  /// the spare and the two change places; a block that sleeps is not touched.
  struct SavedBlock {
    bool untouched = false;      ///< the block holds what is to be kept
    std::optional<Block> spare;  ///< else this does; made when it is needed first
  };
  std::vector<SavedBlock> saved_;
  BlockSweeper* sweeper_ = nullptr;
  UniformBlocks uniform_;
  UniformSweeps uniform_sweeps_;
  Saved saved_by_sleep_;
  mutable std::vector<std::optional<Survey>> surveys_;  ///< a cache
};

/// The cells of a block as a box for sweep_box, and of one that has products for sweep_mixture.
CellBox box_of(Block& block, int dimension);
MixtureBox mixture_box_of(Block& block);

/// Adds a block's report to a sum; `first` turns its local cell into a global one.
void merge(SweepReport& total, SweepReport const& report, CellIndex first, Grid const& grid);

}  // namespace brisance::fluid
