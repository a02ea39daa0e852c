// Bodies drawn at random, seeded: V2 with any convex body at any angle, and bodies of any shape, spin and Mach number
// between shocks, which may crash nothing, make nothing negative and lose nothing (theory/coupling.md
// sections 1.5, 1.7, 7).
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  /// One draw a statement: the order of evaluation within an expression is not given.
  Real uniform(Real low, Real high) {
    return low + (high - low) * static_cast<Real>(engine_() >> 11) * 0x1p-53;  // the same on every library
  }
  Real logarithmic(Real low, Real high) { return low * std::pow(high / low, uniform(0, 1)); }
  int integer(int low, int high) { return std::min(high, low + static_cast<int>(uniform(0, high - low + 1))); }
  Vec3 direction(int dimension) {
    for (;;) {
      Vec3 const v{uniform(-1, 1), uniform(-1, 1), dimension == 3 ? uniform(-1, 1) : 0};  // braces: left to right
      if (norm(v) > 0.1 && norm(v) < 1) return v / norm(v);
    }
  }

 private:
  std::mt19937_64 engine_;
};

std::string numbers(Vec3 const& v) { return "[" + digits(v.x) + ", " + digits(v.y) + ", " + digits(v.z) + "]"; }

/// Corners of a convex polygon on a turned ellipse; a fifth of the bodies have corners on nodes of the grid.
std::vector<Real> polygon(Draw& draw, Vec3 const& centre, Real size, Real h) {
  int const n = draw.integer(3, 12);
  std::vector<Real> angles;
  for (int i = 0; i < n; ++i) angles.push_back(2 * std::numbers::pi * (i + draw.uniform(0.05, 0.95)) / n);
  Real const flat = draw.uniform(0.25, 1), turn = draw.uniform(0, 2 * std::numbers::pi);
  if (draw.uniform(0, 1) < 0.2) {
    auto const on_node = [&](Real x) { return h * std::round(x / h); };
    Real const x = on_node(centre.x), y = on_node(centre.y), a = max(2 * h, on_node(size)),
               b = max(2 * h, on_node(flat * size));
    if (draw.uniform(0, 1) < 0.5) return {x - a, y - b, x + a, y - b, x + a, y + b, x - a, y + b};
    return {x - a, y, x, y - b, x + a, y, x, y + b};
  }
  std::vector<Real> corners;
  for (Real const a : angles) {
    Real const u = size * std::cos(a), v = flat * size * std::sin(a);
    corners.push_back(centre.x + u * std::cos(turn) - v * std::sin(turn));
    corners.push_back(centre.y + u * std::sin(turn) + v * std::cos(turn));
  }
  return corners;
}

/// Text of a rigid body about `centre` with a half width of about `size`.
std::string body(Draw& draw, int dimension, Vec3 const& centre, Real size, Real h) {
  if (dimension == 3 && draw.uniform(0, 1) < 0.6) {
    Vec3 const axis = draw.direction(3);
    Real const width = draw.uniform(0.7, 1.6) * size, thickness = draw.uniform(0.5, 1.6) * size;
    return "[[solid.body]]\nmaterial = \"rigid\"\nshape = \"plate\"\ncentre = " + vector(centre, "m") +
           "\naxis = " + numbers(axis) + "\nlength = " + quantity(1.6 * size, "m") +
           "\nwidth = " + quantity(width, "m") + "\nthickness = " + quantity(thickness, "m") + "\n";
  }
  std::string text = polygon_body(polygon(draw, centre, size, h));
  if (dimension == 3)
    text += "low = " + vector({0, 0, centre.z - 0.7 * size}, "m") +
            "\nhigh = " + vector({1, 1, centre.z + 0.7 * size}, "m") + "\n";
  return text;
}

std::string box(int dimension, int cells, std::string const& ambient, std::string const& euler) {
  std::string n = "[";
  for (int d = 0; d < dimension; ++d) n += (d > 0 ? ", " : "") + std::to_string(cells);
  return "[fluid]\nhigh = " + quantities(std::vector<Real>(static_cast<std::size_t>(dimension), 1), "m") +
         "\ncells = " + n + "]\nambient = " + ambient + "\neuler = " + euler + "\n";
}

TEST(RandomBodies, MoveWithTheGas) {
  for (int const dimension : {2, 3}) {
    int const count = evidence::full() ? (dimension == 2 ? 200 : 20) : (dimension == 2 ? 10 : 1),
              cells = dimension == 2 ? 40 : 20;
    Real gas = 0, solid = 0;
    for (int seed = 1; seed <= count; ++seed) {
      Draw draw(static_cast<std::uint64_t>(1000 * dimension + seed));
      Real const speed = draw.uniform(0.1, 0.4);
      Real const size = dimension == 2 ? draw.uniform(0.08, 0.14) : draw.uniform(0.1, 0.13);
      Vec3 const velocity = speed * draw.direction(dimension);
      std::string const state = gas_state(1.4, 1, velocity, dimension);
      // 100 steps lead past the middle of the domain, without a way out of it.
      Real const cfl = dimension == 2 ? 0.5 : 0.2;
      Vec3 const centre = Vec3{0.5, 0.5, 0.5} - 50 * cfl / (cells * (1 + speed)) * velocity;
      CoupledCase c("end_time = \"9 s\"\n" + box(dimension, cells, state, "{ order = 11, cfl = " + digits(cfl) + " }") +
                    inflow_everywhere(state, dimension) + "[solid]\n" + rigid_material(30) +
                    body(draw, dimension, centre, size, 1.0 / cells) + "velocity = " + vector(velocity, "m/s") +
                    "\n[coupling]\ncut_cells = {}\n");
      Real here = 0;
      c.run(evidence::full() || dimension == 2 ? 100 : 20, [&] {
        here = max(here, deviation(c, 1.4, velocity, 1));
        solid = max(solid, norm(c.velocity() - velocity));
      });
      EXPECT_LT(here, 1e-11) << "seed " << seed;
      gas = max(gas, here);
    }
    std::string const variant = std::to_string(dimension) + "D; " + std::to_string(count) + " bodies";
    EXPECT_TRUE(
        evidence::at_most("V2", "random bodies in common motion", variant, "largest deviation of the gas", gas, 1e-11));
    EXPECT_TRUE(evidence::at_most("V2", "random bodies in common motion", variant, "change of the bodies' velocity",
                                  solid, 1e-11));
  }
}

/// One to three bodies, each in a quarter (eighth) of the domain of its own, spinning and flying through a shock tube's
/// flow.
std::string scene(int dimension, std::uint64_t seed) {
  Draw draw(seed);
  int const cells = dimension == 2 ? 32 : 16;
  Real const ratio = draw.logarithmic(1, 300);  // of the pressures
  std::vector<Real> behind{1.4 * draw.logarithmic(1, 10), ratio};
  Real const speed_of_wind = draw.uniform(0, 3);
  Vec3 const wind = speed_of_wind * draw.direction(dimension);
  std::string const outflow =
      "boundary = { x_low = \"outflow\", x_high = \"outflow\", y_low = \"outflow\", y_high = "
      "\"outflow\"" +
      std::string(dimension == 3 ? ", z_low = \"outflow\", z_high = \"outflow\" }\n" : " }\n");
  std::string const order = std::to_string(2 * draw.integer(0, 5) + 1);
  Vec3 const front = draw.direction(dimension);
  std::string const wall = draw.uniform(0, 1) < 0.5 ? "cell" : "half_riemann";
  std::string text =
      "end_time = \"0.1 s\"\n" +
      box(dimension, cells, gas_state(1.4, 1, wind, dimension), "{ order = " + order + ", cfl = 0.5 }") + outflow +
      "[[fluid.region]]\nshape = \"half_space\"\npoint = [0.5, 0.5, 0.5]\nnormal = " + numbers(front) +
      "\ndensity = " + quantity(behind[0], "kg/m3") + "\npressure = " + quantity(behind[1], "Pa") + "\n[solid]\n" +
      // Heavier than the gas of the cells beside them, which the exchange of pressure needs (1.8).
      rigid_material(draw.logarithmic(30, 1000));
  int const bodies = draw.integer(1, 3);
  Real const fastest = bodies == 1 ? 2 : 0.4;  // several do not meet before the end
  for (int b = 0; b < bodies; ++b) {
    Vec3 const middle = bodies == 1 ? Vec3{0.5, 0.5, 0.5} : Vec3{b == 1 ? 0.75 : 0.25, b == 2 ? 0.75 : 0.25, 0.5};
    Vec3 const centre = middle + 0.05 * draw.direction(dimension);
    Real const size = dimension == 2 ? draw.uniform(0.06, 0.12) : draw.uniform(0.07, 0.1);
    Real const speed = draw.uniform(0, fastest), rim = draw.uniform(0, 1);
    Vec3 const way = draw.direction(dimension), axis = dimension == 2 ? Vec3{0, 0, 1} : draw.direction(3);
    text += body(draw, dimension, centre, size, 1.0 / cells);
    text += "velocity = " + vector(speed * way, "m/s") + "\nspin = " + vector(rim / size * axis, "rad/s") + "\n";
  }
  return text + "[coupling]\ncut_cells = { wall_pressure = \"" + wall + "\" }\n";
}

TEST(RandomBodies, SurviveAndBalance) {
  int const full = 2000, shortened = 50;
  int const count = evidence::full() ? full : shortened;
  Real mass = 0, momentum = 0, exchange = 0, energy = 0;
  int negative = 0, broken = 0;
  std::int64_t retries = 0;
  for (int seed = 1; seed <= count; ++seed) {
    int const dimension = seed % 25 == 0 ? 3 : 2;
    try {
      CoupledCase c(scene(dimension, static_cast<std::uint64_t>(seed)));
      bool positive = true;
      c.run(dimension == 2 ? 30 : 12, [&] {
        c.for_fluid([&](fluid::CellIndex, fluid::State const& u, Real) {
          positive = positive && u[0] >= 0 &&
                     2 * u[0] * u[4] - u[1] * u[1] - u[2] * u[2] - u[3] * u[3] >= -2e-13 * u[0] * u[4];
        });
      });
      negative += !positive;
      EXPECT_TRUE(positive) << "seed " << seed;
      Conservation const& k = c.conservation();
      mass = max(mass, k.mass);
      momentum = max(momentum, max(k.momentum.x, max(k.momentum.y, k.momentum.z)));
      exchange = max(exchange, k.exchange_energy);
      if (dimension == 2) energy = max(energy, k.energy);  // in 3D a spinning body oscillates with dt^2
      retries += c.simulation().statistics().retries;
    } catch (std::exception const& error) {
      ++broken;
      ADD_FAILURE() << "seed " << seed << ": " << error.what();
    }
  }
  std::string const variant = std::to_string(count) + " draws";
  auto const record = [&](std::string const& what, Real got, Real limit) {
    EXPECT_TRUE(evidence::at_most("V8", "random bodies between shocks", variant, what, got, limit));
  };
  record("runs that failed", broken, 0);
  record("runs with a negative density or pressure", negative, 0);
  record("mass defect", mass, 1e-12);
  record("momentum defect", momentum, 1e-12);
  record("exchange energy defect", exchange, 1e-12);
  record("energy defect in 2D", energy, 1e-12);
  record("rejected pairs per run", static_cast<Real>(retries) / count, 0.1);
}

}  // namespace
}  // namespace brisance
