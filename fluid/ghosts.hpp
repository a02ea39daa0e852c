// Ghost cells of one direction: copies between face neighbours, messages, and the sides of the domain.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "fluid/boundary/boundaries.hpp"
#include "fluid/grid/block.hpp"
#include "parallel/comm.hpp"

namespace brisance::fluid {

/// The exchange pattern of a set of blocks, computed once. Sweeps read no diagonal ghosts, so slabs span only the cells
/// of a block across the direction.
class Ghosts {
 public:
  /// `blocks`: owned blocks in ascending order of id; they must outlive this and not move.
  Ghosts(Grid const& grid, std::vector<int> const& owner, std::vector<Block>& blocks, Boundaries const& boundaries,
         parallel::Comm& comm);

  /// Sends what other ranks need and fills the ghosts that depend on this rank alone. Afterwards the cells of `ready`
  /// blocks may be changed: nothing reads them any more. `time`: of the laws of the sides, s.
  void start(int direction, Real time = 0);
  /// Waits for the messages of start() and fills the other ghosts.
  void finish(int direction);

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
  struct Partner {
    int rank;
    std::vector<Slab> sends, receives;
    std::vector<Real> out, in;
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

  std::vector<Block>& blocks_;
  Boundaries const& boundaries_;
  parallel::Comm& comm_;
  std::array<Exchange, 3> exchanges_;
  std::unique_ptr<parallel::Comm::Pending> pending_;
};

}  // namespace brisance::fluid
