#include "core/solid/contact/meeting_spheres.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace brisance::solid {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct Entry {
  Cell cell;
  Index sphere;
};

/// One grid: its entries sorted by cell.
struct Level {
  Real cell_size = 0;
  std::vector<Entry> entries;
  Cell cell_of(Vec3 const& p) const {
    Cell c{};
    for (int d = 0; d < 3; ++d)  // far away all share the outermost cells
      c[static_cast<std::size_t>(d)] = static_cast<std::int64_t>(clamp(std::floor(p[d] / cell_size), -4e15, 4e15));
    return c;
  }
};

}  // namespace

std::vector<std::pair<Index, Index>> meeting_spheres(std::span<Sphere const> spheres) {
  std::map<int, Level> levels;
  std::vector<int> level_of;
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    int const level = std::ilogb(2 * spheres[s].radius) + 1;  // cells at least as wide as the sphere
    level_of.push_back(level);
    Level& grid = levels[level];
    grid.cell_size = std::ldexp(1.0, level);
    grid.entries.push_back({grid.cell_of(spheres[s].centre), static_cast<Index>(s)});
  }
  for (auto& [level, grid] : levels)
    std::sort(grid.entries.begin(), grid.entries.end(),
              [](Entry const& a, Entry const& b) { return std::pair(a.cell, a.sphere) < std::pair(b.cell, b.sphere); });
  std::vector<std::pair<Index, Index>> pairs;
  for (std::size_t s = 0; s < spheres.size(); ++s)
    for (auto grid = levels.find(level_of[s]); grid != levels.end(); ++grid) {
      bool const own = grid->first == level_of[s];
      auto const& entries = grid->second.entries;
      Cell const centre = grid->second.cell_of(spheres[s].centre);
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy) {
          Cell const from{centre[0] + dx, centre[1] + dy, centre[2] - 1}, to{from[0], from[1], centre[2] + 1};
          auto entry = std::lower_bound(entries.begin(), entries.end(), from,
                                        [](Entry const& e, Cell const& cell) { return e.cell < cell; });
          for (; entry != entries.end() && entry->cell <= to; ++entry) {
            auto const other = static_cast<std::size_t>(entry->sphere);
            if (own && other <= s) continue;
            Real const reach = spheres[s].radius + spheres[other].radius;
            if (!(norm2(spheres[s].centre - spheres[other].centre) < reach * reach)) continue;
            pairs.push_back(std::minmax(static_cast<Index>(s), entry->sphere));
          }
        }
    }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace brisance::solid
