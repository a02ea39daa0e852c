// Ghosts of the viscous terms at the sides of the domain: mirrors of no-slip and isothermal walls; the law of the
// sweeps elsewhere.
#pragma once
#include <array>
#include <optional>

#include "fluid/boundary/boundaries.hpp"
#include "fluid/diffusion/diffusion_config.hpp"
#include "fluid/gas/gas.hpp"

namespace brisance::fluid {

/// Ghost g mirrored from the cell m across the wall: u_g = 2 u_w - u_m; T_g = max(0.2 T_w, 2 T_w - T_m) where the wall
/// has a temperature, else T_m; p_g = p_m. The mean velocity at the face is then that of the wall, and its work exact.
/// A wall that lets the gas slip turns the normal velocity only.  Source: theory/fluid.md 5.3.
struct WallMirror {
  WallConfig wall;
  Gas gas;
  Index source(Index ghost) const { return ghost; }
  State operator()(State const& u, GhostCell const& ghost) const;
};

class ViscousSides {
 public:
  /// `boundaries` must outlive this.
  ViscousSides(FlowConfig const& config, Gas const& gas, Boundaries const& boundaries);
  /// Fills the given ghosts of a block whose `side` lies on the side of the domain.
  void fill(Block& block, int direction, int side, Real time, GhostRange const& range) const;

 private:
  Boundaries const& boundaries_;
  std::array<std::optional<WallMirror>, 6> walls_;
};

}  // namespace brisance::fluid
