// Linear profiles in cells near walls: least-squares gradients of the neighbours that a cell sees through its open
// faces, each value at the centroid of the fluid it is the mean of.
#pragma once
#include <span>
#include <vector>

#include "coupling/cut_cells/state_gather.hpp"
#include "coupling/cut_cells/wall_record.hpp"

namespace brisance::coupling {

/// What varies within a cell: nothing but the density, at the velocity and pressure of the cell, or all.
enum class ProfileKind { density, all };
/// Gradient of the conserved variables along each axis, per m.
using Profile = std::array<fluid::State, 3>;
fluid::State change_along(Profile const& profile, Vec3 const& offset);

/// The mean of a cell and where its centroid lies from that of another, m.
struct PlacedState {
  fluid::State state;
  Vec3 offset;
};
/// The least-squares profile of a mean `u` among its neighbours; false, where it is to be flat: beside vacuum and
/// jumps. Cost: 26 neighbours, 0.3 us.
bool fit_profile(ProfileKind kind, fluid::Gas const& gas, Vec3 const& spacing, int dimension, fluid::State const& u,
                 std::span<PlacedState const> neighbours, Profile& profile);

/// Is there a way from c to a cell of its 3^d neighbourhood, one step along each axis that differs, through open faces?
bool sees(WallRecord const& record, CellIndex c, CellIndex to);

class WallSlopes {
 public:
  /// Collective. `cells`: global ids, sorted, unique; a cell that is solid in `record`
  /// has the profile of the nearest fluid among its neighbours, if any.
  void plan(parallel::Comm& comm, fluid::Flow& flow, WallRecord const& record, std::vector<GlobalId> cells);
  /// Collective. Gradients of the states that `read` gives, 0 beside jumps and vacuum.
  void refresh(parallel::Comm& comm, ReadCell const& read, ProfileKind kind);
  void clear();
  bool planned() const { return planned_; }

  /// The profile of `cell` at `x`, m from its centre, where its mean is `u`; `u` itself where there is none, or where
  /// it would leave the admissible states.
  fluid::State value(GlobalId cell, fluid::State const& u, Vec3 const& x) const;
  /// Null: flat.
  Profile const* profile(GlobalId cell) const;
  /// The mean that the profile of `cell` has at the centroid, at the last refresh; null: unknown.
  fluid::State const* mean(GlobalId cell) const;
  std::size_t bytes() const;

 private:
  struct Neighbour {
    Index slot;
    Vec3 offset;  ///< of its centroid from that of the cell, m
  };
  struct Cell {
    Index slot = -1;  ///< in the gather; -1: solid
    Index first = 0, last = 0;
    Vec3 centroid;  ///< m from the centre of the cell
    bool flat = true;
    Profile profile{};
  };
  Cell const* find(GlobalId cell) const;
  void fit(Cell& cell, ProfileKind kind) const;

  bool planned_ = false;
  int dimension_ = 3;
  fluid::Gas gas_;
  Vec3 spacing_;
  std::vector<GlobalId> ids_;
  std::vector<Cell> cells_;
  std::vector<Neighbour> neighbours_;
  StateGather states_;
};

/// u + change, or u where that would be no admissible state or near none.
fluid::State moved_within(fluid::Gas const& gas, fluid::State const& u, fluid::State const& change);

/// The change of the flux along d when `change` is added to `u`; 0 where that would leave the admissible states.
fluid::State flux_change(fluid::Gas const& gas, fluid::State const& u, fluid::State const& change, int d);

}  // namespace brisance::coupling
