// One OSMP sweep, order chosen at run time, compiled per order and direction (house, section 7; fluid_speed.md section
// 4).
#pragma once
#include <cstddef>
#include <cstdint>

#include "fluid/gas/gas.hpp"
#include "fluid/grid/grid.hpp"

namespace brisance::fluid {

/// Choices of the scheme beside its order.
struct SweepOptions {
  bool hybrid = false;  ///< acoustic waves with frozen coefficients next to pressure jumps (fluid/README.md)
  Real shear_dissipation =
      0;  ///< eta of the cure beside transverse shocks (theory/fluid.md 2.7); acts where marks are set
  /// Orders >= 3: terms of smooth nonlinear flow (smooth.hpp). Third order for ideal and stiffened gas when cells hold
  /// point values.
  bool smooth = false;
};

/// Cells needed on either side of a pencil (theory/fluid.md 2.2).
constexpr Index ghost_depth(int order) { return order <= 5 ? 3 : (order + 1) / 2; }

/// Components of a state in sweep coordinates (1 = normal momentum): y exchanges 1 and 2, z exchanges 1 and 3.
constexpr std::array<std::size_t, 5> sweep_components(int direction) {
  switch (direction) {
    case 1:
      return {0, 2, 1, 3, 4};
    case 2:
      return {0, 3, 2, 1, 4};
    default:
      return {0, 1, 2, 3, 4};
  }
}

/// What a sweep noticed. Extrema are over the cells it updated; `flux_*` sum the face fluxes of both ends of the block
/// in a fixed order (real coordinates: component 1 is x momentum), per unit area and not multiplied by dt.
struct SweepReport {
  Real signal_max = 0;  ///< m/s: largest |u_d| + c before the sweep
  /// Faces blended with the low-order flux (theta < 1), vacuum faces not counted. A face belongs to the cell on its
  /// high side; the high ends are given apart, for the caller to add where no neighbour block has counted them.
  std::int64_t fallback_faces = 0, fallback_faces_high_end = 0;
  std::uint64_t health = 0;  ///< bits of `Health`
  CellIndex where{};         ///< local cell of the first bad state, valid when health != 0
  State flux_low{}, flux_high{};
};
enum class Health : std::uint64_t { negative_density = 1, negative_energy = 2, not_finite = 4, courant = 8 };

/// A block, or any strided box of cells: pointers at local cell (0,0,0).
struct CellBox {
  std::array<Real*, 5> u;
  std::array<Index, 3> size;
  std::array<std::ptrdiff_t, 3> stride;
  int dimension;
  /// Marks of the shock sensor, one byte a cell, bit d: a shock runs along d; at local cell (0,0,0), with one ghost on
  /// every side. Null: no cell is marked.
  std::uint8_t const* marks = nullptr;
  std::array<std::ptrdiff_t, 3> mark_stride{};
  /// Where the new cells go, laid out as `u`; all null: in place.
  std::array<Real*, 5> result{};
};

/// Cell means at t -> after the sweep along `direction`, in place or into `result`. Ghosts of that direction must be
/// filled. Shape: any size; what is narrower than a vector is padded. Units: sigma = dt/h in s/m. Errors: raises health
/// bits (theory/fluid.md 4.4, 4.6), never throws. Source: theory/fluid.md 2-4.
SweepReport sweep_box(int order, CellBox const& box, int direction, Real sigma, Gas const& gas,
                      SweepOptions const& options = {});

/// Lanes of the vector this build uses.
int lanes();

/// A bundle of `lanes()` pencils in scratch memory, lane fastest, sweep coordinates (component 1 = normal momentum).
/// Cells run from -ghost_depth(order) to n-1+ghost_depth(order); pointers are at cell 0 / face 0 (face f = low side of
/// cell f).
struct LineBundle {
  Index n;         ///< cells to advance
  Real const* u;   ///< [cell][5][lane]
  Real* result;    ///< [cell 0..n-1][5][lane]: provisional new states
  Real* flux;      ///< [face 0..n][5][lane]: final (blended) fluxes
  Real* pressure;  ///< [cell 0..n-1][lane]: pressure before the sweep (0 in vacuum)
  /// [face 0..n][lane]: order of each face, at most `order` (1 only if it is `order`); 0: the face is outside the
  /// run of its lane, its flux is nonsense, and it and its cells enter neither counts nor extrema.
  std::uint8_t const* face_order;
  /// [cell -1..n]: lanes (one bit each) where a shock runs across the sweep; at cell 0. Null: nowhere.
  std::uint32_t const* marks = nullptr;
};
/// As sweep_box for runs between walls (theory/coupling.md 1.9). `flux_low/high`, `where` and health are left empty:
/// the caller judges. Faces see neighbours only through `u`: mirror cells stand there. Counts fallback faces per lane
/// mask.
SweepReport sweep_lines(int order, LineBundle const& lines, std::uint32_t valid_lanes, Real sigma, Gas const& gas,
                        SweepOptions const& options = {});

}  // namespace brisance::fluid
