// Pieces of scene text for the nondimensional cases of theory/coupling.md section 7, where gas at rest is
// rho = 1.4, p = 1 (sound speed 1); and how far a flow is from a uniform one.
#pragma once
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/coupled_case.hpp"

namespace brisance::testing {

/// A number with all its digits.
inline std::string digits(Real x) {
  std::ostringstream text;
  text.precision(17);
  text << x;
  return text.str();
}

/// A quantity as the scene writes it: "0.5 m".
inline std::string quantity(Real x, std::string const& unit) { return "\"" + digits(x) + " " + unit + "\""; }

/// An array of quantities.
inline std::string quantities(std::vector<Real> const& values, std::string const& unit) {
  std::string text = "[";
  for (std::size_t i = 0; i < values.size(); ++i) text += (i == 0 ? "" : ", ") + quantity(values[i], unit);
  return text + "]";
}

/// A vector of three components.
inline std::string vector(Vec3 const& v, std::string const& unit) { return quantities({v.x, v.y, v.z}, unit); }

/// { density, pressure, velocity } of a gas state.
inline std::string gas_state(Real density, Real pressure, Vec3 const& velocity, int dimension = 2) {
  std::vector<Real> v{velocity.x, velocity.y, velocity.z};
  v.resize(static_cast<std::size_t>(dimension));
  return "{ density = " + quantity(density, "kg/m3") + ", pressure = " + quantity(pressure, "Pa") +
         ", velocity = " + quantities(v, "m/s") + " }";
}

/// The same state enters through every side.
inline std::string inflow_everywhere(std::string const& state, int dimension = 2) {
  std::string sides = "[fluid.boundary]\n", states = "[fluid.inflow]\n";
  for (int d = 0; d < dimension; ++d)
    for (char const* end : {"_low", "_high"}) {
      std::string const side = std::string(1, "xyz"[d]) + end;
      sides += side + " = \"inflow\"\n";
      states += side + " = " + state + "\n";
    }
  return sides + states;
}

/// Corners of a regular polygon, the first at the angle `phase`.
inline std::vector<Real> regular_polygon(int sides, Real radius, Vec3 const& centre, Real phase) {
  std::vector<Real> corners;
  for (int i = 0; i < sides; ++i) {
    Real const angle = phase + 2 * std::numbers::pi * i / sides;
    corners.push_back(centre.x + radius * std::cos(angle));
    corners.push_back(centre.y + radius * std::sin(angle));
  }
  return corners;
}

/// Corners of a rectangle with sides 2 half.x, 2 half.y, turned by `angle` about its centre.
inline std::vector<Real> rectangle(Vec3 const& centre, Vec3 const& half, Real angle) {
  Vec3 const u{std::cos(angle), std::sin(angle), 0}, v{-u.y, u.x, 0};
  std::vector<Real> corners;
  for (auto const& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    Vec3 const p = centre + a * half.x * u + b * half.y * v;
    corners.push_back(p.x);
    corners.push_back(p.y);
  }
  return corners;
}

/// A rigid body of one particle with these corners; `more` are further keys.
inline std::string polygon_body(std::vector<Real> const& corners, std::string const& more = "") {
  return "[[solid.body]]\nmaterial = \"rigid\"\nshape = \"prism\"\ncorners = " + quantities(corners, "m") + "\n" + more;
}

/// The material of rigid bodies: only its density counts.
inline std::string rigid_material(Real density) {
  return "[solid.material.rigid]\ndensity = " + quantity(density, "kg/m3") +
         "\nyoung_modulus = \"1 Pa\"\npoisson_ratio = 0.0\n";
}

/// Largest difference of density, velocity and pressure from a uniform state, over the cells that hold fluid.
inline Real deviation(CoupledCase& c, Real density, Vec3 const& velocity, Real pressure) {
  Real largest = 0;
  fluid::Gas const& gas = c.world->flow->gas();
  c.for_fluid([&](fluid::CellIndex, fluid::State const& u, Real) {
    Vec3 const v = Vec3{u[1], u[2], u[3]} / u[0] - velocity;
    for (Real const x : {u[0] - density, v.x, v.y, v.z, gas.pressure(u) - pressure})
      largest = std::isfinite(x) ? max(largest, std::abs(x)) : std::numeric_limits<Real>::infinity();
  });
  return largest;
}

}  // namespace brisance::testing
