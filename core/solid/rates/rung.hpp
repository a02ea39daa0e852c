// The forces that meet at one kind of instant inside a coarse step, and the particles they act on.
#pragma once
#include <span>
#include <vector>

#include "core/solid/halo.hpp"
#include "core/solid/links/link_store.hpp"
#include "core/solid/rates/levels.hpp"

namespace brisance::solid {

/// At odd multiples of 2^m finest steps the forces of the levels 0 .. m act, each for its own step. Rung m holds them;
/// their shares of the kick, relative to a kick of 2^m finest steps, are powers of two.
/// Shape: links and particles are local and in global order.
struct Rung {
  std::vector<std::size_t> place;  ///< of its links among the links of the rank
  LinkStore links;
  std::vector<double> link_share;    ///< of stiffness and bending, by link, padded to whole blocks
  std::vector<Index> touched;        ///< ends of its links
  std::vector<double> volume_share;  ///< of the pressures, by touched particle
  std::vector<Index> kicked;         ///< owned ones
  std::vector<Index> held;           ///< owned ones that do not move freely
  std::vector<std::size_t> clamps;   ///< its links to the wall whose particle is owned
  Halo halo;                         ///< of the ghosts of levels 0 .. m, which move when such an instant begins
};

/// Everything a rank needs for multi-rate steps.
struct Rates {
  Levels levels;
  std::vector<std::vector<Index>> drifting;  ///< owned particles by level
  std::vector<Rung> rungs;                   ///< m = 0 .. top - 1
  // At the ends of a coarse step all forces act, relative to a kick of a coarse step.
  std::vector<double> link_share, volume_share, pressure;  ///< pressure: shares of it, Pa; one entry more, the wall
  std::int64_t link_updates = 0;                           ///< in one coarse step

  std::size_t bytes() const;
  /// How many steps a particle takes in one coarse step.
  Real steps_of(GlobalId p) const { return power(levels.top, levels.particle[static_cast<std::size_t>(p)]); }
  /// 2^(a - b)
  static double power(int a, int b) {
    return a < b ? 1.0 / static_cast<double>(1 << (b - a)) : static_cast<double>(1 << (a - b));
  }
};

}  // namespace brisance::solid
