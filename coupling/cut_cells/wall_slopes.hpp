// Quadratic profiles in cells near walls: least squares among the neighbours that a cell sees through open faces, each
// value the mean over the fluid of its cell.
#pragma once
#include <span>
#include <vector>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/moments.hpp"
#include "coupling/cut_cells/state_gather.hpp"
#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

/// What varies within a cell: nothing but the density, at the velocity and pressure of the cell and as far as entropy
/// makes it vary, or all.
enum class ProfileKind { density, all };
/// Change of the conserved variables from the mean of a region: linear in the moments about a common point.
struct Profile {
  std::array<fluid::State, 3> slope{};  ///< along each axis at that point, per m
  std::array<fluid::State, 6> curve{};  ///< half of the second derivatives xx, yy, zz, and xy, yz, zx; per m2
};
/// Difference of the means over two regions, given the difference of their moments.
fluid::State change_between(Profile const& profile, Moments const& difference);
Profile operator+(Profile a, Profile const& b);
Profile operator*(Real f, Profile p);
/// The same profile about a point farther by `by`.
Profile moved(Profile profile, Vec3 const& by);

/// The mean of a region with its moments, m about the point that the profile is to be taken about.
struct PlacedState {
  fluid::State state;
  Moments region;
  bool near = true;  ///< among the 3^d cells around
};
/// The least-squares profile of a mean among its neighbours: quadratic where they are enough, else linear among the
/// near ones; false, where it is to be flat: beside vacuum and jumps.
bool fit_profile(ProfileKind kind, fluid::Gas const& gas, Vec3 const& spacing, int dimension, PlacedState const& centre,
                 std::span<PlacedState const> neighbours, Profile& profile);

/// Cells around in each direction among which profiles are fitted.
constexpr Index profile_reach = 2;
inline bool adjacent(CellIndex a, CellIndex b) {
  for (std::size_t d = 0; d < 3; ++d)
    if (a[d] > b[d] + 1 || b[d] > a[d] + 1) return false;
  return true;
}

/// The fluid cells within profile_reach of a cell to which a way leads through open faces, no longer than without
/// walls.
class WaysAround {
 public:
  WaysAround(WallRecord const& record, CellIndex from);
  bool reach(CellIndex c) const { return seen_[place(c)]; }

 private:
  static constexpr Index width = 2 * profile_reach + 1;
  std::size_t place(CellIndex c) const {
    return static_cast<std::size_t>(c[0] - low_[0] + width * (c[1] - low_[1] + width * (c[2] - low_[2])));
  }
  CellIndex low_;
  std::array<bool, static_cast<std::size_t>(width* width* width)> seen_{};
};
/// Calls visit(c) for these cells, in the order of for_neighbourhood; `from` is one of them.
template <class Visit>
void for_seen(WallRecord const& record, CellIndex from, Visit&& visit) {
  WaysAround const ways(record, from);
  for_neighbourhood(record.grid(), from, profile_reach, [&](CellIndex c) {
    if (ways.reach(c)) visit(c);
  });
}

class WallSlopes {
 public:
  /// Collective. `cells`: global ids, sorted, unique; a cell that is solid in `record`
  /// has the profile of the nearest fluid among its neighbours, if any.
  void plan(parallel::Comm& comm, fluid::Flow& flow, WallRecord const& record, std::vector<GlobalId> cells);
  /// Collective. Gradients of the states that `read` gives, 0 beside jumps and vacuum.
  void refresh(parallel::Comm& comm, ReadCell const& read, ProfileKind kind);
  void clear();
  bool planned() const { return planned_; }

  /// The mean of the profile of `cell` over a region, about its centre, where the mean over its fluid is `u`; `u`
  /// itself where there is none, or where it would leave the admissible states.
  fluid::State value(GlobalId cell, fluid::State const& u, Moments const& region) const;
  /// About the centre of the cell; null: flat.
  Profile const* profile(GlobalId cell) const;
  /// The mean that the profile of `cell` has at the centroid, at the last refresh; null: unknown.
  fluid::State const* mean(GlobalId cell) const;
  std::size_t bytes() const;

 private:
  struct Neighbour {
    Index slot;
    Moments region;  ///< of its fluid about the centre of the cell
    bool near;
  };
  struct Cell {
    Index slot = -1;  ///< in the gather; -1: solid
    Index first = 0, last = 0;
    Moments region;  ///< about the centre of the cell
    bool flat = true;
    Profile profile{};
  };
  Cell const* find(GlobalId cell) const;
  void fit(Cell& cell, ProfileKind kind);

  bool planned_ = false;
  int dimension_ = 3;
  fluid::Gas gas_;
  Vec3 spacing_;
  std::vector<GlobalId> ids_;
  std::vector<Cell> cells_;
  std::vector<Neighbour> neighbours_;
  StateGather states_;
  std::vector<PlacedState> around_;  ///< work space
};

/// u + change, or u where that would be no admissible state or near none.
fluid::State moved_within(fluid::Gas const& gas, fluid::State const& u, fluid::State const& change);

/// The change of the flux along d when `change` is added to `u`; 0 where that would leave the admissible states.
fluid::State flux_change(fluid::Gas const& gas, fluid::State const& u, fluid::State const& change, int d);

}  // namespace brisance::coupling
