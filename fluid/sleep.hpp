// Blocks that need no sweep because nothing in them or at their ends differs (theory/fluid.md 7).
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "fluid/flux/sweep.hpp"
#include "fluid/grid/block.hpp"

namespace brisance::fluid {

/// Are these the same bits? -0 and +0 are not; a NaN equals itself.
bool same_bits(State const& a, State const& b);

/// Which of a set of blocks hold one state in all their cells. A function of the state alone: what is kept here only
/// saves looking again. A block that was told not to be uniform costs one comparison of two cells a look: its last
/// differing cell is remembered.
class UniformBlocks {
 public:
  explicit UniformBlocks(std::size_t blocks) : known_(blocks) {}

  /// The cells of block b may have changed.
  void changed(std::size_t b) { known_[b].looked = false; }
  /// Looks at block b if it may have changed since the last look.
  void look(std::size_t b, Block const& block);
  /// The state in all cells of block b as of the last look; null: not uniform, or changed since.
  State const* state(std::size_t b) const { return known_[b].looked && known_[b].uniform ? &known_[b].state : nullptr; }

 private:
  struct Known {
    bool looked = false, uniform = false;
    State state{};
    std::ptrdiff_t witness = 0;  ///< where a cell differed from the first one
  };
  std::vector<Known> known_;
};

/// What a sweep does to a block of one state whose ghosts hold one state at either end, found by sweeping one short
/// pencil through the same kernel: it depends on the gas, the scheme and the law at the side, and no rule for them has
/// to be written twice.
class UniformSweeps {
 public:
  struct Outcome {
    bool unchanged = false;  ///< every cell keeps its bits; nothing was blended and health is good
    SweepReport face;        ///< signal speed, and the fluxes of one face at either end
  };

  /// Begins a sweep: what other sweeps found is forgotten.
  void begin(int order, int dimension, int direction, Real sigma, Gas const& gas, SweepOptions const& options = {});
  /// `cells`: length of the block along the sweep. The result holds until the next call.
  Outcome const& find(State const& inside, State const& low, State const& high, Index cells);

 private:
  struct Case {
    State inside, low, high;
    Index cells;
    Outcome outcome;
  };
  Outcome sweep_pencil(State const& inside, State const& low, State const& high, Index cells);

  int order_ = 1, dimension_ = 1, direction_ = 0;
  Real sigma_ = 0;
  Gas gas_;
  SweepOptions options_;
  std::vector<Case> cases_;
  std::vector<Real> pencil_;
};

/// The sum that a sweep makes of `faces` equal fluxes, in its order.
State sum_of_equal(State const& flux, std::int64_t faces);

}  // namespace brisance::fluid
