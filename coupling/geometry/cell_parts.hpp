// The connected parts of the fluid in cells that a thin wall divides: a pure function of the pieces.
#pragma once
#include <span>

#include "coupling/geometry/cell_map.hpp"
#include "coupling/geometry/cut_geometry.hpp"

namespace brisance::coupling {

/// Parts a cell may have; a cell that falls into more keeps one state.
constexpr std::size_t most_parts = 4;

/// A cell whose fluid falls into several parts; part 0, the largest, is the one that fields and sweeps know as the
/// cell.
struct PartedCell {
  CellIndex cell{};
  Index first_piece = 0, last_piece = 0;  ///< of the cell, in Geometry::pieces
  Index first_part = 0;                   ///< of its pieces, in CellParts::of_piece
  std::size_t parts = 0;
  std::array<Real, most_parts> volume{};                                  ///< m3
  std::array<Vec3, most_parts> area{};                                    ///< sum of the area vectors, m2
  std::array<std::array<std::array<Real, 2>, 3>, most_parts> aperture{};  ///< m2, as in CutCell
};

/// What joins a part of a cell to a part of the next one along a direction.
struct Opening {
  CellIndex low{};  ///< the cell on the low side
  int direction = 0;
  std::uint8_t low_part = 0, high_part = 0;
  Real area = 0;  ///< m2
};

struct CellParts {
  std::vector<PartedCell> cells;       ///< sorted by key
  std::vector<std::uint8_t> of_piece;  ///< of the pieces of these cells
  /// Of all faces of these cells, sorted by low and direction.
  std::vector<Opening> openings;
  Index undivided = 0;         ///< cells that opposite walls cross and which have one state all the same
  CellIndex undivided_cell{};  ///< one of them

  bool empty() const { return cells.empty(); }
  /// After `cells` and `openings` were filled: makes them found.
  void index();
  std::size_t bytes() const;
  /// Null where the fluid of a cell is connected.
  PartedCell const* find(CellIndex const& c) const;
  /// Openings of the face on the high side of `low`, when a cell beside it has parts.
  std::span<Opening const> through(CellIndex const& low, int direction) const;
  /// Whether part 0 on both sides of the high face of `low` is one fluid.
  bool joined(CellIndex const& low, int direction) const;
  /// Whether the box holds a divided cell.
  bool any_within(CellBox const& box) const;
  std::size_t part_of(PartedCell const& c, Index piece) const {
    return of_piece[static_cast<std::size_t>(c.first_part + piece - c.first_piece)];
  }

 private:
  /// Of a divided cell or the low side of an opening.
  struct Slot {
    Index cell = -1;                 ///< place in `cells`, -1: it is not divided
    std::array<Index, 4> opening{};  ///< those along direction d begin at d and end at d + 1
  };
  CellPlaces places_;
  std::vector<Slot> slots_;
};

/// Fills `out` for the cells of `geometry`. Parts are what is left connected by the pieces, joined along common edges,
/// the open components of the faces and the corners of the cell; volumes follow from the divergence theorem. Only cells
/// in which pieces face away from each other are looked at. Covered
/// cells are left out. Where apertures and volumes of the parts do not make up those of the cell, it stays undivided.
void divide(Lattice const& lattice, Geometry const& geometry, Real covered_volume, CellParts& out);

}  // namespace brisance::coupling
