// Ghost cells of one direction: copies between face neighbours, messages, and the sides of the domain.
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "fluid/boundary/boundaries.hpp"
#include "fluid/grid/block.hpp"
#include "fluid/sleep.hpp"
#include "parallel/comm.hpp"

namespace brisance::fluid {

/// Which ghosts are filled.
struct GhostShape {
  Index depth = 0;  ///< layers; 0: all that the blocks have
  /// Also the edges of a block (corners in 2D): the slabs of a direction then span the ghosts of the directions before
  /// it, so directions must be exchanged in ascending order.
  bool edges = false;
};

/// The exchange pattern of a set of blocks, computed once. Sweeps read no diagonal ghosts, so by default slabs span
/// only the cells of a block across the direction.
class Ghosts {
 public:
  /// Fills the ghosts of a block at a side of the domain.
  using FillSide = std::function<void(Block&, int direction, int side, Real time, GhostRange const&)>;

  /// `blocks`: owned blocks in ascending order of id; they must outlive this and not move. `fill_side`: takes the place
  /// of the laws of `boundaries`; not with sleeping blocks.
  Ghosts(Grid const& grid, std::vector<int> const& owner, std::vector<Block>& blocks, Boundaries const& boundaries,
         parallel::Comm& comm, GhostShape shape = {}, FillSide fill_side = nullptr);

  /// Sends what other ranks need and fills the ghosts that depend on this rank alone. Afterwards the cells of `ready`
  /// blocks may be changed: nothing reads them any more. `time`: of the laws of the sides, s.
  /// With `uniform` (all blocks looked at; it must not change before finish()), uniform blocks are neither copied from
  /// cell by cell nor sent, and the ghosts of a uniform block may be left as they were: see end() and complete().
  void start(int direction, Real time = 0, UniformBlocks const* uniform = nullptr);
  /// Waits for the messages of start() and fills the other ghosts.
  void finish(int direction);

  /// The state that all ghosts of a uniform block hold, or will hold after complete(), at `side`; null: they differ.
  State const* end(std::size_t block, int side) const {
    End const& e = ends_[block][static_cast<std::size_t>(side)];
    return e.uniform ? &e.state : nullptr;
  }
  /// Fills the ghosts that were left out at the ends of a uniform block.
  void complete(std::size_t block, int direction);

  /// Positions in `blocks` of those complete after start(), and of those that wait for finish().
  std::vector<std::size_t> const& ready(int direction) const { return exchange(direction).ready; }
  std::vector<std::size_t> const& waiting(int direction) const { return exchange(direction).waiting; }
  std::size_t bytes() const;  ///< held by message buffers

 private:
  struct Copy {
    std::size_t to, from;
    int side;
  };  // `side` of the receiving block
  struct Slab {
    std::size_t block;
    int side;
  };
  /// A message is its slabs in turn: one number that tells whether the slab is uniform, then its one state or all of
  /// its cells. Buffers have room for all cells.
  struct Partner {
    int rank;
    std::vector<Slab> sends, receives;
    std::vector<Real> out, in;
  };
  /// Ghosts at one side of a uniform block.
  struct End {
    bool uniform = false;
    bool filled = true;  ///< false: the ghosts do not hold `state` yet
    State state{};
  };
  struct Exchange {
    std::vector<Copy> copies;
    std::vector<Slab> domain;
    std::vector<Partner> partners;
    std::vector<parallel::Comm::Send> sends;  // the buffers of the partners
    std::vector<parallel::Comm::Receive> receives;
    std::vector<std::size_t> ready, waiting;
  };
  Exchange const& exchange(int direction) const { return exchanges_[static_cast<std::size_t>(direction)]; }
  void build(Grid const& grid, std::vector<int> const& owner, int direction);
  Partner& partner(Exchange& exchange, int rank);
  void set_end(Slab const& slab, int direction, State const& state);
  void look_at_end(Slab const& slab, int direction);
  bool find_end(Slab const& slab, int direction, Real time);
  bool sleepy(std::size_t block) const { return uniform_ && uniform_->state(block); }

  std::vector<Block>& blocks_;
  Boundaries const& boundaries_;
  parallel::Comm& comm_;
  GhostShape shape_;
  FillSide fill_side_;
  std::array<Exchange, 3> exchanges_;
  std::unique_ptr<parallel::Comm::Pending> pending_;
  std::vector<std::array<End, 2>> ends_;
  std::vector<Block> pencils_;  ///< one per direction, on which laws of sides are tried
  struct Tried {
    int side;
    State inside;
    std::optional<State> ghosts;
  };
  std::vector<Tried> tried_;                ///< laws of the exchange under way
  UniformBlocks const* uniform_ = nullptr;  // of the exchange under way
};

}  // namespace brisance::fluid
