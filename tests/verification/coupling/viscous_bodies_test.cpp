// Friction and heat on cut cells: a gas between a turning cylinder and a ring that is held (theory/fluid.md 5.3).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

constexpr Real inner = 0.3, outer = 0.7, turning = 2, viscosity = 0.1, prandtl = 0.72;
constexpr Real temperature = 100 / 1.4;  // speed of sound 10, gas constant 1

/// The steady flow: velocity s (R^2 / r - r) around the axis; between walls of one temperature the heat of friction
/// leaves a rise of A / r^2 + B ln r + C.
constexpr Real scale = turning * inner * inner / (outer * outer - inner * inner);
Real exact_velocity(Real r) { return scale * (outer * outer / r - r); }
Real exact_rise(Real r) {
  constexpr Real heat_capacity = 1.4 / 0.4;
  Real const a = -prandtl / heat_capacity * scale * scale * square(outer * outer);
  Real const b = -a * (1 / square(outer) - 1 / square(inner)) / std::log(outer / inner);
  return a * (1 / square(r) - 1 / square(inner)) + b * std::log(r / inner);
}
constexpr Real exact_torque =
    -4 * std::numbers::pi * viscosity * turning * (inner * outer) * (inner * outer) / (outer * outer - inner * inner);

std::string scene(int cells, std::string const& wall, Real ring = 0.2) {
  return "end_time = \"2 s\"\n[fluid]\nlow = [-1.25, -1.25]\nhigh = [1.25, 1.25]\ncells = [" + std::to_string(cells) +
         ", " + std::to_string(cells) + "]\nambient = " + gas_state(1, temperature, {}) +
         "\neuler = { order = 5 }\ngas = { gas_constant = 1 }\n"
         "viscosity = { law = \"constant\", dynamic_viscosity = " +
         quantity(viscosity, "Pa s") + " }\n[solid]\nlinks = {}\n" + rigid_material(1e6) +
         polygon_body(regular_polygon(240, inner, {0, 0, 0}, 0.01), "spin = [0, 0, 2]\n") +
         "[[solid.body]]\nmaterial = \"rigid\"\nshape = \"tube\"\ntessellation = \"polar\"\ncentre = [0, 0]\n"
         "inner_radius = 0.7\nouter_radius = " +
         quantity(outer + ring, "m") +
         "\ncells = [1, 120, 1]\n"
         "hold = [{ low = [-1, -1], high = [1, 1] }]\n[coupling]\ncut_cells = { " +
         wall + " }\n";
}

struct Outcome {
  Real velocity = 0, rise = 0, torque = 0;  // over the speed of the wall, the largest rise, the exact torque
  Real outside = 0;                         // largest speed and part of the temperature that the gas beyond gains
};

/// Mean errors over the whole cells between the walls, and the error of the torque that slows the cylinder. `ring`: its
/// thickness, m.
Outcome turn(int cells, std::string const& variant, std::string const& wall = "", Real ring = 0.2) {
  CoupledCase c(scene(cells, wall, ring));
  auto const momentum = [&] {
    Real sum = 0;
    for (Index i = 0; i < c.world->solid->owned(); ++i)
      if (c.world->mesh->particle(c.world->solid->id(i)).body == 0)
        sum += c.world->solid->motion()[static_cast<std::size_t>(i)].spin.z;
    return sum;
  };
  Real time = 0, spin = 0;
  c.run(-1, [&] {
    if (c.time() > 1.5 && time == 0) time = c.time(), spin = momentum();
  });
  Outcome o;
  o.torque = std::abs((momentum() - spin) / (c.time() - time) / exact_torque - 1);
  fluid::Grid const& grid = c.world->flow->grid();
  fluid::Gas const& gas = c.world->flow->gas();
  Real count = 0, largest = 0;
  c.for_fluid([&](fluid::CellIndex cell, fluid::State const& u, Real volume) {
    Vec3 const x = grid.centre(cell);
    Real const r = std::hypot(x.x, x.y);
    if (r > outer + ring + 0.5 * grid.spacing.x)
      o.outside = max(o.outside, max(std::hypot(u[1], u[2]) / u[0],
                                     std::abs(gas.temperature(u[0], gas.pressure(u)) / temperature - 1)));
    if (r > outer || r < inner || volume < grid.cell_volume()) return;
    o.velocity += std::abs((x.x * u[2] - x.y * u[1]) / (r * u[0]) - exact_velocity(r));
    o.rise += std::abs(gas.temperature(u[0], gas.pressure(u)) - temperature - exact_rise(r));
    largest = max(largest, exact_rise(r));
    count += 1;
  });
  o.velocity /= count * turning * inner;
  o.rise /= count * largest;
  Conservation const& k = c.conservation();
  auto const closed = [&](std::string const& what, Real defect, Real limit) {
    EXPECT_TRUE(evidence::at_most("F26", "turning cylinder", variant, what + " defect", defect, limit));
  };
  closed("mass", k.mass, 1e-14);
  closed("momentum x", k.momentum.x, 1e-14);
  closed("momentum y", k.momentum.y, 1e-14);
  closed("exchange of energy", k.exchange_energy, 1e-13);
  closed("energy", k.energy, 1e-13);
  return o;
}

TEST(TurningCylinder, DragsTheGasWithTheExactTorque) {
  struct Case {
    int cells;
    Real velocity, torque;
  };
  std::vector<Case> cases{{40, 6.4e-3, 6.3e-3}};
  if (evidence::full()) cases.insert(cases.end(), {{60, 2.4e-3, 4.1e-3}, {80, 1.8e-3, 2.2e-3}});
  Real coarsest = 0, finest = 0;
  for (Case const& c : cases) {
    std::string const variant = std::to_string(c.cells) + "^2; bodies adiabatic";
    Outcome const o = turn(c.cells, variant);
    if (coarsest == 0) coarsest = o.velocity;
    finest = o.velocity;
    auto const record = [&](std::string const& what, Real got, Real reference) {
      EXPECT_TRUE(evidence::at_most("F26", "turning cylinder", variant, what, got, 1.1 * reference));
    };
    record("error of velocity over that of the wall", o.velocity, c.velocity);
    record("relative error of torque", o.torque, c.torque);
  }
  if (cases.size() == 1) return;
  EXPECT_TRUE(evidence::near("F26", "turning cylinder", "80^2; bodies adiabatic", "observed order of velocity",
                             std::log2(coarsest / finest), 2, 0.3));
}

/// The ring is thinner than a cell: the flow is as good, and the gas around it feels nothing.
TEST(TurningCylinder, DoesNotShowBehindAThinRing) {
  for (Real const part : {0.2, 0.8}) {
    std::string const variant = "40^2; ring of " + digits(part) + " cells";
    Outcome const o = turn(40, variant, "", part * 2.5 / 40);
    EXPECT_TRUE(evidence::at_most("F26", "turning cylinder", variant, "error of velocity over that of the wall",
                                  o.velocity, 1.1 * 6.4e-3));
    EXPECT_TRUE(
        evidence::at_most("F26", "turning cylinder", variant, "relative error of torque", o.torque, 1.1 * 6.3e-3));
    EXPECT_TRUE(
        evidence::at_most("F26", "turning cylinder", variant, "speed and heat of the gas outside", o.outside, 1e-11));
  }
}

TEST(TurningCylinder, LosesTheHeatOfFrictionToIsothermalBodies) {
  struct Case {
    int cells;
    Real rise;
  };
  std::vector<Case> cases{{40, 5.9e-2}};
  if (evidence::full()) cases.insert(cases.end(), {{60, 3.8e-2}, {80, 1.31e-2}});
  for (Case const& c : cases) {
    std::string const variant = std::to_string(c.cells) + "^2; bodies isothermal";
    Outcome const o = turn(c.cells, variant, "wall = { temperature = " + quantity(temperature, "K") + " }");
    EXPECT_TRUE(evidence::at_most("F26", "turning cylinder", variant, "error of temperature over its rise", o.rise,
                                  1.1 * c.rise));
  }
}

TEST(TurningCylinder, LeavesTheGasAloneWhereItSlips) {
  CoupledCase c(scene(40, "wall = { slip = true }"));
  Real before = 0;
  auto const spin = [&] { return c.world->solid->motion()[0].spin.z; };
  before = spin();
  c.run(20);
  EXPECT_EQ(c.step(), 20);
  EXPECT_LT(c.conservation().energy, 1e-14);
  EXPECT_NEAR(spin(), before, 1e-3 * std::abs(exact_torque) * c.time());
}

}  // namespace
}  // namespace brisance
