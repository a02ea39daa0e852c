// Slip wall that moves along its normal.
#pragma once
#include "fluid/boundary/ghost_cell.hpp"
#include "fluid/boundary/time_table.hpp"

namespace brisance::fluid {

/// Ghost k mirrors the k-th cell inside in the frame of the wall: u_g = 2 u_w - u, the rest kept. The side of the grid
/// stays where it is, and the gas is continued to it: what enters or leaves there between the side and the wall, and
/// the work of the wall, are in the account of the sides (BoundaryLedger).  Source: theory/fluid.md 6.
struct MovingWall {
  static constexpr char const* name = "moving_wall";
  Real speed = 0;  ///< along +direction, m/s
  Index source(Index ghost) const { return ghost; }
  State operator()(State u, GhostCell const& ghost) const {
    Real& momentum = u[ghost.normal()];
    Real const before = momentum;
    momentum = 2 * (u[0] * speed) - before;
    if (u[0] > 0) u[4] += 0.5 * (momentum * momentum - before * before) / u[0];
    return u;
  }
};

/// Speed as a function of time.
struct WallHistory {
  TimeTable<1> table;  ///< m/s along +direction
  MovingWall at(Real time) const { return {table.at(time)[0]}; }
  /// Largest distance of the wall from where it stands at time 0, up to `end`: exact for the linear pieces. m
  Real largest_displacement(Real end) const;
};

}  // namespace brisance::fluid
