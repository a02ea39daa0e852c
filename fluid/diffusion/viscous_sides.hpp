// Ghosts of the viscous terms at the sides of the domain: mirrors of no-slip and isothermal walls; the law of the
// sweeps elsewhere.
#pragma once
#include <array>
#include <optional>

#include "fluid/boundary/boundaries.hpp"
#include "fluid/diffusion/diffusion_config.hpp"
#include "fluid/gas/gas.hpp"

namespace brisance::fluid {

/// State g mirrored from the state m across a wall of velocity u_w and, if given, temperature T_w: u_g = 2 u_w - u_m,
/// or only its part along the unit `normal` where the gas slips; T_g = max(0.2 T_w, 2 T_w - T_m), else T_m; p_g = p_m.
/// Source: theory/fluid.md 5.3.  Units: m/s, K.
State wall_mirror(State const& u, Gas const& gas, bool slip, std::optional<double> const& temperature,
                  Vec3 const& wall_velocity, Vec3 const& normal);

/// The same for the ghosts of a side of the domain. The mean velocity at the face is that of the wall, and its work
/// exact.
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
