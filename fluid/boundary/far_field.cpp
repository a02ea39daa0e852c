#include "fluid/boundary/far_field.hpp"

#include <cmath>

namespace brisance::fluid {
namespace {

/// A state in the frame of the side.
struct Seen {
  State const& conserved;
  Real speed;  ///< outwards, m/s
  Real sound;
};

Seen seen(State const& u, GhostCell const& ghost, Gas const& gas) {
  if (gas.vacuum(u)) return {u, 0, 0};
  return {u, ghost.outwards() * u[ghost.normal()] / u[0], gas.sound_speed(u)};
}

/// `from` with another density, pressure and outward speed, its tangential velocity kept.
State changed(Seen const& from, Real density, Real speed, Real pressure, GhostCell const& ghost, Gas const& gas) {
  State const& u = from.conserved;
  Vec3 velocity{u[1] / u[0], u[2] / u[0], u[3] / u[0]};
  velocity[ghost.direction] = ghost.outwards() * speed;
  return gas.conserved(density, velocity, pressure);
}

/// Ideal or stiffened: the pressure and the speed at which both states meet when each changes along its isentrope, so
/// that u + k c of the inside and u - k c of the ambient state are kept, k = 2/Gamma. Between them may lie a contact:
/// hot gas at ambient pressure leaves without a wave.
State by_isentropic_waves(Seen const& inside, Seen const& ambient, GhostCell const& ghost, Gas const& gas) {
  Real const k = 2 / gas.kappa();
  auto const on_isentrope = [&](Seen const& from, Real speed, Real sound) {
    if (speed == from.speed && sound == from.sound) return from.conserved;
    Real const density = from.conserved[0] * std::pow(sound / from.sound, k);
    return changed(from, density, speed, density * sound * sound / gas.gamma - gas.curve.stiffness, ghost, gas);
  };
  Real const leaving = inside.speed + k * inside.sound, entering = ambient.speed - k * ambient.sound;
  // Fans that span the side hold the sonic state there, or vacuum where they do not reach it.
  auto const sonic_exit = [&] {
    return leaving > 0 ? on_isentrope(inside, leaving / (1 + k), leaving / (1 + k)) : State{};
  };
  auto const sonic_entry = [&] {
    return entering < 0 ? on_isentrope(ambient, entering / (1 + k), -entering / (1 + k)) : State{};
  };
  if (!(ambient.sound > 0)) return sonic_exit();
  Real const approach = k * (inside.sound + ambient.sound) + (inside.speed - ambient.speed);
  if (!(approach > 0)) return leaving > 0 ? sonic_exit() : sonic_entry();  // they part, vacuum between them
  // Sound speeds on both isentropes at the common pressure. Equal states give exactly themselves.
  Real const p_ratio =
      (gas.pressure(inside.conserved) + gas.curve.stiffness) / (gas.pressure(ambient.conserved) + gas.curve.stiffness);
  Real const c_ratio = std::pow(p_ratio, 1 / (k * gas.gamma));
  Real const share_in = approach / (k * (inside.sound + ambient.sound * c_ratio));
  Real const sound_in = share_in * inside.sound, speed_in = inside.speed + k * (inside.sound - sound_in);
  if (speed_in >= sound_in) return sonic_exit();
  if (speed_in > 0) return on_isentrope(inside, speed_in, sound_in);
  Real const share_out = approach / (k * (ambient.sound + inside.sound / c_ratio));
  Real const sound_out = share_out * ambient.sound, speed_out = ambient.speed - k * (ambient.sound - sound_out);
  return speed_out <= -sound_out ? sonic_entry() : on_isentrope(ambient, speed_out, sound_out);
}

State by_linear_waves(Seen const& inside, Seen const& ambient, GhostCell const& ghost, Gas const& gas) {
  Real const p_in = gas.pressure(inside.conserved), p_out = gas.pressure(ambient.conserved);
  Real const impedance = inside.conserved[0] * inside.sound;
  Real const rise = 0.5 * (p_in - p_out + impedance * (inside.speed - ambient.speed));
  Real const pressure = p_out + rise, speed = ambient.speed + rise / impedance;
  Seen const& from = speed > 0 ? inside : ambient;
  Real const p_from = speed > 0 ? p_in : p_out;
  if (speed == from.speed && pressure == p_from) return from.conserved;
  Real const density = from.conserved[0] + (pressure - p_from) / (from.sound * from.sound);
  bool const admissible = density > gas.vacuum_density && pressure > gas.reference_pressure(density);
  return admissible ? changed(from, density, speed, pressure, ghost, gas) : from.conserved;
}

}  // namespace

State FarField::operator()(State const& u, GhostCell const& ghost) const {
  Seen const outside = seen(ambient, ghost, gas);
  if (gas.vacuum(u)) return ambient;
  Seen const inside = seen(u, ghost, gas);
  bool const gas_outside = outside.sound > 0;
  if (gas_outside && outside.speed <= -outside.sound) return ambient;
  if (inside.speed >= inside.sound) return u;
  if (!gas.curve.exponential()) return by_isentropic_waves(inside, outside, ghost, gas);
  return gas_outside ? by_linear_waves(inside, outside, ghost, gas) : u;
}

}  // namespace brisance::fluid
