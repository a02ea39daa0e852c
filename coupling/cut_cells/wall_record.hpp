// The solid boundary at one time level as the fluid of this rank sees it: triangles, cut cells, and what every cell is.
#pragma once
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "coupling/geometry/cell_map.hpp"
#include "coupling/geometry/cell_parts.hpp"
#include "coupling/geometry/cut_geometry.hpp"
#include "coupling/geometry/nearest.hpp"
#include "fluid/grid/grid.hpp"

namespace brisance::coupling {

/// Cells around its blocks within which a rank keeps pieces: runs beyond the ghosts, projections, images and their
/// neighbourhoods all stay inside.
constexpr Index wall_margin = 20;
/// A block knows nothing of a wall farther than this.
constexpr Index wall_reach = wall_margin + 4;

/// Fluid fraction below which a cell counts as solid (theory/coupling.md 1.9).
constexpr Real covered_fraction = 1e-9;

/// Part of a face that must be inside out, as between bodies that overlap, to make the covered cells beside it one:
/// more than what contact makes of the faces across it.
constexpr Real inside_out = 0.1;

/// Point of the wall nearest to a cell centre: the base of a mirror state.
struct Projection {
  bool found = false;
  Vec3 point, normal;  ///< normal: from the cell centre to the point
  Vec3 velocity;       ///< of the wall at the point
};

class WallRecord {
 public:
  void set_grid(fluid::Grid const& grid);
  /// Cells this rank may ask about: boxes of its blocks and a margin. Fixed until the partition changes.
  void set_region(std::vector<CellBox> boxes) { region_ = std::move(boxes); }

  /// Triangles of the record, sorted by id; `x_new` is the position at the time of the record.
  std::vector<SurfaceTriangle> triangles;
  Geometry geometry;
  /// Parts of cells that thin walls divide.
  CellParts parts;

  /// Cuts the cells by `triangles`. Closed surfaces whose vertices are where they were in the last call, and which no
  /// moving one is next to, keep their pieces and cells: these come first in `geometry`, sorted among themselves, and
  /// cost a comparison of their vertices. Errors: numerical error when the surface is not closed.
  void rebuild();

  bool solid(CellIndex c) const {
    Index const i = map_.at(c);
    return i == uncut_solid || (i >= 0 && cut(i).volume <= covered_fraction * cell_volume_);
  }
  /// Index of the cut cell, -1 when c holds no piece.
  Index cut_index(CellIndex c) const {
    Index const i = map_.at(c);
    return i >= 0 ? i : -1;
  }
  CutCell const& cut(Index i) const { return geometry.cells[static_cast<std::size_t>(i)]; }
  /// Fluid volume, m3.
  Real volume(CellIndex c) const {
    Index const i = map_.at(c);
    return i == uncut_fluid ? cell_volume_ : i == uncut_solid ? 0 : cut(i).volume;
  }
  /// Fluid volume of the part of a cell that fields and sweeps know as the cell, m3.
  Real main_volume(CellIndex c) const {
    PartedCell const* const p = parts.find(c);
    return p ? p->volume[0] : volume(c);
  }
  /// Fluid area of the low (0) or high (1) face in direction d, m2.
  Real aperture(CellIndex c, int d, int side) const {
    Index const i = map_.at(c);
    if (i >= 0) return cut(i).aperture[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)];
    return i == uncut_fluid ? face_area_[d] : 0;
  }
  /// True when the range holds a cell that is not plain fluid.
  bool touches(CellBox const& range) const;

  /// Nearest wall point to the centre of `c`. With `direction` >= 0 only pieces that face a run lying on the side
  /// `side`
  /// (-1 or +1) of the cell along that direction, and have the centre behind them. Source: theory/coupling.md 1.9.
  /// `hint`: a piece that may be near, -1: none; becomes the piece found. It saves time and changes nothing.
  /// `eligible`: the pieces that may be found; none given: all.
  Projection project(CellIndex c, int direction, int side, Index& hint,
                     std::function<bool(Index)> const& eligible = {}) const;
  /// Does a wall at an angle to the grid, of 3 degrees or more, or a corner stand within two cells of `c`? Beside a
  /// periodic side: no.
  bool oblique_near(CellIndex const& c) const;

  fluid::Grid const& grid() const { return *grid_; }
  Lattice const& lattice() const { return lattice_; }
  /// Velocity of the wall at a point given by barycentric coordinates of a triangle, m/s.
  Vec3 wall_velocity(Index triangle, std::array<Real, 3> const& bary) const {
    SurfaceTriangle const& t = triangles[static_cast<std::size_t>(triangle)];
    return bary[0] * t.velocity[0] + bary[1] * t.velocity[1] + bary[2] * t.velocity[2];
  }
  std::size_t bytes() const {
    return map_.bytes() + parts.bytes() + 7 * facing_[6].bytes() +
           geometry.pieces.capacity() * (sizeof(Piece) + sizeof(Facet));
  }
  /// Boxes of the triangles that moved, changed their velocity, came or went between two records.
  static std::vector<CellBox> differences(WallRecord const& a, WallRecord const& b);

 private:
  /// Sizes of `geometry` up to some place.
  struct Extent {
    std::size_t pieces = 0, corners = 0, cells = 0, runs = 0;
  };
  Extent extent() const {
    return {geometry.pieces.size(), geometry.corners.size(), geometry.cells.size(), geometry.solid.size()};
  }
  void cut_all();
  void forget(Extent const& from);
  void truncate(Extent const& kept);
  void enter(Extent const& from);
  void mark_facing(CutCell const& cell);
  void clear();
  std::vector<GlobalId> unmoved_surfaces();
  void cut_resting();
  std::vector<GlobalId> resting_beside(Geometry const& moving) const;
  void append(Geometry const& part, std::vector<Index> const& place);

  static constexpr Index uncut_fluid = -1, uncut_solid = -2;
  fluid::Grid const* grid_ = nullptr;
  Lattice lattice_;
  Real cell_volume_ = 0;
  Vec3 face_area_;
  std::vector<CellBox> region_;
  CellMap<Index> map_;
  // For projections.
  static constexpr Index reach = 6;  ///< cells within which a wall is looked for
  std::vector<Facet> facets_;        ///< by piece
  /// Cut cells that hold a piece which faces the low or high side of a direction (2 d + side), and all of them (last).
  std::array<CellBits, 7> facing_;
  /// Per direction: squared distance from the centre of a cell to cells so many further on, m2.
  std::array<std::array<Real, reach + 1>, 3> gap2_{};

  struct Known {
    GlobalId id, surface;
    std::array<Vec3, 3> x;
  };
  std::vector<Known> known_;       ///< triangles of the last rebuild
  std::vector<GlobalId> resting_;  ///< surfaces whose cells come first in `geometry`, up to `rest_`
  std::vector<GlobalId> beside_;   ///< surfaces that rest next to a moving one: cut with it
  Extent rest_;
  std::vector<Index> rest_place_;                       ///< per triangle at rest: its place in `triangles`
  std::vector<Index> rest_piece_;                       ///< per piece at rest: its triangle, a place in rest_place_
  using RestCell = std::pair<std::uint64_t, GlobalId>;  ///< key, surface
  std::vector<RestCell> rest_cells_;                    ///< cut by surfaces at rest, kept or not, sorted
  Index rebuilds_ = 0;
  Real rest_residual_ = 0, rest_mismatch_ = 0;
  Index rest_overlapped_ = 0, rest_inverted_ = 0;
  Geometry part_;  ///< work space
  std::vector<SurfaceTriangle> part_triangles_;
};

}  // namespace brisance::coupling
