// Two states beyond a side, separated by a plane that moves: a shock that runs along or through the side.
#pragma once
#include "fluid/boundary/ghost_cell.hpp"

namespace brisance::fluid {

/// The plane where it stands at one instant. A ghost it cuts holds the mean of both states by volume (sampled in
/// several dimensions unless the plane is normal to an axis).
struct Front {
  static constexpr char const* name = "inflow";
  Grid const* grid;
  Vec3 point, normal;  ///< unit normal, towards `ahead`
  State ahead, behind;
  Index source(Index) const { return 0; }
  State operator()(State const& u, GhostCell const& ghost) const;
};

/// The plane runs along its normal with a constant speed, m/s.
struct MovingFront {
  Front start;  ///< at time 0
  Real speed;
  Front at(Real time) const {
    Front now = start;
    now.point += speed * time * now.normal;
    return now;
  }
};

}  // namespace brisance::fluid
