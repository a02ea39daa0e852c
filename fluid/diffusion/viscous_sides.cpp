#include "fluid/diffusion/viscous_sides.hpp"

#include "fluid/flow_config.hpp"

namespace brisance::fluid {

State wall_mirror(State const& u, Gas const& gas, bool slip, std::optional<double> const& temperature,
                  Vec3 const& wall_velocity, Vec3 const& normal) {
  Real const pressure = gas.pressure(u);
  if (!(pressure > 0)) return u;  // vacuum feels no wall
  Vec3 velocity = Vec3{u[1], u[2], u[3]} / u[0];
  if (slip)
    velocity -= 2 * dot(velocity - wall_velocity, normal) * normal;
  else
    velocity = 2.0 * wall_velocity - velocity;
  Real density = u[0];
  if (temperature) {
    Real const mirrored = 2 * *temperature - gas.temperature(density, pressure);
    density = pressure / (gas.gas_constant * max(0.2 * *temperature, mirrored));
  }
  return gas.conserved(density, velocity, pressure);
}

State WallMirror::operator()(State const& u, GhostCell const& ghost) const {
  Vec3 normal;
  normal[ghost.direction] = 1;
  return wall_mirror(u, gas, wall.slip, wall.temperature, wall.velocity, normal);
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
