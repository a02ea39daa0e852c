// Bodies glued together: links through faces of different bodies that lie on each other.
#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/location.hpp"
#include "core/base/real.hpp"

namespace brisance {
template <class T>
class Keys;
}

namespace brisance::solid {

struct Cells;
struct SolidConfig;

/// Bodies whose touching faces are linked as if they were one.
struct BondConfig {
  std::vector<std::string> bodies;
  Location at;
  static void keys(Keys<BondConfig>& k);
};

/// A face of the cells of all bodies, numbered one body after the other.
struct CellFace {
  std::size_t cell = 0;
  int face = 0;
  auto operator<=>(CellFace const&) const = default;
};

/// Partners across the bonds of a scene, both ways. `cells`, `offset`: of each body; `dimension`: of the scene.
/// Two faces are partners when centre, size and direction agree to a millionth of their size.
/// Errors: Failure::scene for an unknown body, fewer than two, no links, and a body without any matching face.
std::map<CellFace, CellFace> find_bonds(SolidConfig const& config, std::span<Cells const> cells,
                                        std::span<std::size_t const> offset, int dimension);

}  // namespace brisance::solid
