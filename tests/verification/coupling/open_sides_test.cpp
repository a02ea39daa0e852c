// Bodies in common motion with the gas leave the domain without a trace, and a wall that deforms along itself is not
// felt (theory/coupling.md sections 1.5, 7).
#include <gtest/gtest.h>

#include <random>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  Real between(Real low, Real high) {
    return low + (high - low) * static_cast<Real>(engine_()) / static_cast<Real>(std::mt19937::max());
  }
  int below(int n) { return std::min(static_cast<int>(between(0, n)), n - 1); }
  bool chance(Real share) { return between(0, 1) < share; }
  Vec3 direction(int dimension) {
    Real const z = dimension == 2 ? 0 : between(-1, 1), angle = between(0, 2 * std::numbers::pi);
    Real const r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

 private:
  std::mt19937 engine_;
};

/// Corners of a random convex polygon: on an ellipse about the centre, in its order, turned.
std::vector<Real> convex_polygon(Random& random, Vec3 const& centre, Real radius) {
  int const n = 3 + random.below(8);
  Real const slender = random.between(0.35, 1), turn = random.between(0, 2 * std::numbers::pi);
  std::vector<Real> corners;
  for (int i = 0; i < n; ++i) {
    Real const angle = 2 * std::numbers::pi * (i + random.between(-0.3, 0.3)) / n;
    Real const x = radius * std::cos(angle), y = slender * radius * std::sin(angle);
    corners.push_back(centre.x + x * std::cos(turn) - y * std::sin(turn));
    corners.push_back(centre.y + x * std::sin(turn) + y * std::cos(turn));
  }
  return corners;
}

/// Keys of a random convex rigid body about `centre`; sizes are of a sphere around it.
std::string convex_body(Random& random, int dimension, Vec3 const& centre, Real radius) {
  std::string const head = "[[solid.body]]\nmaterial = \"rigid\"\n";
  if (dimension == 3 && random.chance(0.5))
    return head + "shape = \"plate\"\ncentre = " + vector(centre, "m") + "\naxis = [" + digits(random.between(-1, 1)) +
           ", " + digits(random.between(-1, 1)) + ", " + digits(random.between(0.1, 1)) +
           "]\nlength = " + digits(random.between(0.6, 1.1) * radius) +
           "\nwidth = " + digits(random.between(0.6, 1.1) * radius) +
           "\nthickness = " + digits(random.between(0.5, 1.1) * radius) + "\n";
  std::string text = head + "shape = \"prism\"\n";
  if (dimension == 3) {
    Real const half = random.between(0.3, 0.6) * radius;
    text += "low = " + vector(centre - Vec3{radius, radius, half}, "m") +
            "\nhigh = " + vector(centre + Vec3{radius, radius, half}, "m") + "\n";
  }
  return text + "corners = " + quantities(convex_polygon(random, centre, (dimension == 3 ? 0.8 : 1) * radius), "m") +
         "\n";
}

std::string components(Vec3 const& v, int dimension, std::string const& unit) {
  return quantities(dimension == 2 ? std::vector<Real>{v.x, v.y} : std::vector<Real>{v.x, v.y, v.z}, unit);
}

std::string grid(int dimension, int cells) {
  std::string text = "[fluid]\nhigh = " + components({1, 1, 1}, dimension, "m") + "\ncells = [";
  for (int d = 0; d < dimension; ++d) text += (d > 0 ? ", " : "") + std::to_string(cells);
  return text + "]\n";
}

/// In common motion out of the domain, through sides, edges and corners: what is beyond a side does not press, so the
/// load is taken relative to the pressure of the gas.
TEST(OpenSides, CommonMotionOutOfTheDomainIsKept) {
  for (int const dimension : {2, 3}) {
    int const runs = evidence::full() ? 20 : dimension == 2 ? 6 : 2, cells = dimension == 2 ? 24 : 14;
    Real gas = 0, body = 0, mass = 0;
    for (int seed = 0; seed < runs; ++seed) {
      Random random(static_cast<unsigned>(2000 + seed));
      Vec3 const velocity = random.between(0.4, 1.2) * random.direction(dimension);
      Vec3 const centre = Vec3{0.5, 0.5, 0.5} + 0.2 * velocity;
      std::string const state = gas_state(1.4, 1, velocity, dimension);
      CoupledCase c("end_time = 9\n" + grid(dimension, cells) + "ambient = " + state +
                    "\neuler = { order = 5, cfl = 0.5 }\n" + inflow_everywhere(state, dimension) + "[solid]\n" +
                    rigid_material(30) + convex_body(random, dimension, centre, random.between(0.15, 0.25)) +
                    "velocity = " + components(velocity, dimension, "m/s") +
                    "\n[coupling]\ncut_cells = { load = \"relative\" }\n");
      Real of_gas = 0, of_body = 0;
      c.run(100, [&] {
        of_gas = max(of_gas, deviation(c, 1.4, velocity, 1));
        of_body = max(of_body, norm(c.velocity() - velocity));
      });
      EXPECT_LE(max(of_gas, of_body), 1e-11)
          << dimension << "D, seed " << 2000 + seed << ": gas " << of_gas << ", body " << of_body;
      gas = max(gas, of_gas), body = max(body, of_body), mass = max(mass, c.conservation().mass);
    }
    std::string const variant =
        std::to_string(runs) + " random convex bodies that leave, " + std::to_string(dimension) + "D";
    EXPECT_TRUE(evidence::at_most("V2", "uniform translation", variant, "largest deviation of the gas", gas, 1e-11));
    EXPECT_TRUE(evidence::at_most("V2", "uniform translation", variant, "change of the body's velocity", body, 1e-11));
    EXPECT_TRUE(evidence::at_most("V2", "uniform translation", variant, "mass defect", mass, 1e-12));
  }
}

/// A wall of many particles that stretch and shear along it: the gas that flows along it sees nothing.
TEST(DeformingWall, AWallThatDeformsAlongItselfIsNotFelt) {
  for (int const dimension : {2, 3}) {
    Vec3 const normal = dimension == 2 ? Vec3{0, 1, 0} : normalized({0.3, 0.5, 0.8});
    Vec3 const along = dimension == 2 ? Vec3{1, 0, 0} : normalized(cross(normal, {0.2, 1, 0.1}));
    Vec3 const across = cross(normal, along);
    Vec3 const wind = 1.5 * along + (dimension == 3 ? 0.4 : 0.0) * across;
    std::string const state = gas_state(1.4, 1, wind, dimension);
    // v = (rate . x) along: along itself only, both stretched and sheared.
    Vec3 const rate = 0.4 * along + (dimension == 3 ? 0.3 : 0.0) * across;
    std::string gradient;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) gradient += (i + j > 0 ? ", " : "") + digits(along[i] * rate[j]);
    Vec3 const centre = Vec3{0.5, 0.5, 0.5} - 0.7 * normal;
    std::string body = dimension == 2
                           ? "low = [-0.7, -0.6]\nhigh = [1.7, 0.3171]\ncells = [17, 1]\n"
                           : "shape = \"plate\"\ncentre = " + vector(centre, "m") + "\naxis = " + vector(normal, "1") +
                                 "\nlength = 4\nwidth = 4\nthickness = 1.31\ncells = [19, 17, 1]\n";
    // So heavy that the gas does not move it, so soft that its links do not.
    CoupledCase c("end_time = 9\n" + grid(dimension, dimension == 2 ? 40 : 14) + "ambient = " + state +
                  "\neuler = { order = 11, cfl = 0.5 }\n" + inflow_everywhere(state, dimension) +
                  "[solid]\nlinks = {}\n[solid.material.dough]\ndensity = 1e15\nyoung_modulus = 1\n"
                  "[[solid.body]]\nmaterial = \"dough\"\n" +
                  body + "initial_velocity = [{ gradient = [" + gradient + "] }]\n[coupling]\ncut_cells = {}\n");
    Real largest = 0;
    c.run(dimension == 2 ? 100 : 40, [&] { largest = max(largest, deviation(c, 1.4, wind, 1)); });
    EXPECT_TRUE(evidence::at_most("V3", "parallel flow along a wall that deforms along itself",
                                  std::to_string(dimension) + "D", "largest deviation", largest, 1e-11));
  }
}

}  // namespace
}  // namespace brisance
