#include "fluid/diffusion/viscous_sides.hpp"

#include "fluid/flow_config.hpp"

namespace brisance::fluid {

State WallMirror::operator()(State const& u, GhostCell const& ghost) const {
  Real const pressure = gas.pressure(u);
  if (!(pressure > 0)) return u;  // vacuum feels no wall
  Vec3 velocity = Vec3{u[1], u[2], u[3]} / u[0];
  if (wall.slip)
    velocity[ghost.direction] = -velocity[ghost.direction];
  else
    velocity = 2.0 * wall.velocity - velocity;
  Real density = u[0];
  if (wall.temperature) {
    Real const wanted = *wall.temperature, temperature = gas.temperature(density, pressure);
    density = pressure / (gas.gas_constant * max(0.2 * wanted, 2 * wanted - temperature));
  }
  return gas.conserved(density, velocity, pressure);
}

ViscousSides::ViscousSides(FlowConfig const& config, Gas const& gas, Boundaries const& boundaries)
    : boundaries_(boundaries) {
  for (int d = 0; d < 3; ++d)
    for (int side = 0; side < 2; ++side)
      if (auto const& wall = config.wall.side(d, side))
        walls_[static_cast<std::size_t>(2 * d + side)] = WallMirror{*wall, gas};
}

void ViscousSides::fill(Block& block, int direction, int side, Real time, GhostRange const& range) const {
  boundaries_.fill(block, direction, side, time, range);
  if (auto const& wall = walls_[static_cast<std::size_t>(2 * direction + side)])
    fill_ghosts(*wall, block, direction, side, range,
                [&](CellIndex const& c) { return !boundaries_.patched(direction, side, c); });
}

}  // namespace brisance::fluid
