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

/// Ideal or stiffened. Each wave keeps u +- k c of the gas it runs through, k = 2/Gamma: u + k c of the inside leaves.
/// Exit: what enters is as if the gas of the last cell went on to the ambient pressure and speed. So neither hot gas at
/// that pressure nor a wave in it sends anything back. Entry: gas of the ambient isentrope meets that of the inside.
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
  // Sound speed of one gas at the pressure of the other, over its own. Equal states give exactly themselves below.
  Real const p_ratio =
      (gas.pressure(inside.conserved) + gas.curve.stiffness) / (gas.pressure(ambient.conserved) + gas.curve.stiffness);
  Real const c_ratio = std::pow(p_ratio, 1 / (k * gas.gamma));
  Real const relaxed = inside.sound / c_ratio;  // the inside at ambient pressure
  Real const speed_exit = 0.5 * (inside.speed + ambient.speed) + 0.5 * k * (inside.sound - relaxed);
  Real const sound_exit = 0.5 * (inside.sound + relaxed) + 0.5 / k * (inside.speed - ambient.speed);
  if (speed_exit >= 0) return speed_exit >= sound_exit ? sonic_exit() : on_isentrope(inside, speed_exit, sound_exit);
  Real const approach = k * (inside.sound + ambient.sound) + (inside.speed - ambient.speed);
  if (!(approach > 0)) return sonic_entry();  // they part, vacuum between them
  Real const sound_entry = ambient.sound * (approach / (k * (ambient.sound + relaxed)));
  Real const speed_entry = ambient.speed - k * (ambient.sound - sound_entry);
  return speed_entry <= -sound_entry ? sonic_entry() : on_isentrope(ambient, speed_entry, sound_entry);
}

/// Other equations of state: the same with linear waves, of the impedance of the last cell (exit) or of both gases.
State by_linear_waves(Seen const& inside, Seen const& ambient, GhostCell const& ghost, Gas const& gas) {
  Real const p_in = gas.pressure(inside.conserved), p_out = gas.pressure(ambient.conserved);
  Real const z_in = inside.conserved[0] * inside.sound, z_out = ambient.conserved[0] * ambient.sound;
  Real const rise = p_in - p_out + z_in * (inside.speed - ambient.speed);
  bool const exit = ambient.speed + 0.5 * rise / z_in >= 0;
  Real const z_beyond = exit ? z_in : z_out;
  Real const pressure = p_out + z_beyond / (z_in + z_beyond) * rise, speed = ambient.speed + rise / (z_in + z_beyond);
  Seen const& from = exit ? inside : ambient;
  Real const p_from = exit ? p_in : p_out;
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
