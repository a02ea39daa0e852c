// Rows of archives from ids.
#pragma once
#include <span>
#include <vector>

#include "core/base/real.hpp"
#include "parallel/archive.hpp"

namespace brisance::solid {

/// Ids, each the number of a row, as ranges of rows in the same order.
inline std::vector<parallel::Range> rows_of(std::span<GlobalId const> ids) {
  std::vector<parallel::Range> ranges;
  for (GlobalId const id : ids) {
    if (!ranges.empty() && ranges.back().first + ranges.back().count == id)
      ++ranges.back().count;
    else
      ranges.push_back({id, 1});
  }
  return ranges;
}

}  // namespace brisance::solid
