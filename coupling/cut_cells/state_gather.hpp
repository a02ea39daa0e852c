// States of cells anywhere on the grid, fetched from the ranks that own them: fixed list, refreshed values.
#pragma once
#include <functional>
#include <vector>

#include "fluid/flow.hpp"
#include "parallel/comm.hpp"

namespace brisance::coupling {

/// Reads a local cell of an owned block.
using ReadCell = std::function<fluid::State(fluid::Block const&, Index i, Index j, Index k)>;

class StateGather {
 public:
  /// Collective. `wanted`: global cell ids, sorted, unique; slot s of `values` belongs to wanted[s].
  void plan(parallel::Comm& comm, fluid::Flow& flow, std::vector<GlobalId> wanted);
  /// Collective. Fetches the present values through `read`.
  void refresh(parallel::Comm& comm, ReadCell const& read);
  Index slot(GlobalId cell) const;  ///< -1 if it is not in the list
  fluid::State const& operator[](Index s) const { return values_[static_cast<std::size_t>(s)]; }
  std::size_t size() const { return wanted_.size(); }

 private:
  struct Local {
    fluid::Block const* block;
    Index i, j, k;
  };
  Local locate(GlobalId cell) const;
  fluid::Flow* flow_ = nullptr;
  std::vector<GlobalId> wanted_;
  std::vector<fluid::State> values_;
  std::vector<std::pair<Index, Local>> here_;              // slot, cell of an owned block
  std::vector<std::pair<int, std::vector<Index>>> asked_;  // rank, slots in the order asked
  std::vector<std::pair<int, std::vector<Local>>> asks_;   // rank, cells it wants from here
};

}  // namespace brisance::coupling
