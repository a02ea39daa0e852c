// V2: bodies that move with a uniform flow leave it, and themselves, alone (theory/coupling.md sections 1.5, 7).
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

constexpr Real density = 1.4, pressure = 1;
constexpr int cells_2d = 40;
constexpr Real h = 1.0 / cells_2d;

struct Body {
  std::string name, text;
  Vec3 velocity;
  Real density = 3;
};
/// Slivers must weigh more per wetted area than the gas of a cell, or the explicit exchange of pressure is unstable
/// (1.8).
constexpr Real heavy = 30;

std::string square(std::vector<Real> const& low, Real side) {
  return "[[solid.body]]\nmaterial = \"rigid\"\nlow = " + quantities(low, "m") +
         "\nhigh = " + quantities({low[0] + side, low[1] + side}, "m") + "\n";
}

/// Bodies of the case. Those that move along x only keep two sides on grid lines, or at their half-cell places.
std::vector<Body> bodies() {
  Vec3 const generic{0.61, 0.37, 0}, along_x{0.7, 0, 0}, diagonal{0.5, 0.5, 0};
  return {
      {"disk polygon", polygon_body(regular_polygon(60, 0.13, {0.27, 0.31, 0}, 0.1)), generic},
      {"square on grid lines", square({8 * h, 8 * h}, 8 * h), generic},
      {"square on grid lines along x", square({8 * h, 8 * h}, 8 * h), along_x},
      {"square at half cells", square({8.5 * h, 8.5 * h}, 8 * h), generic},
      {"square at half cells along x", square({8.5 * h, 8.5 * h}, 8 * h), along_x},
      {"square at a generic place", square({8.371 * h, 9.113 * h}, 7.77 * h), generic},
      {"upright sliver of 0.3 cell", polygon_body(rectangle({0.3, 0.3, 0}, {0.15 * h, 0.15, 0}, 0)), generic, heavy},
      {"oblique sliver of 0.3 cell", polygon_body(rectangle({0.3, 0.3, 0}, {0.15, 0.15 * h, 0}, 0.6)), generic, heavy},
      {"needle", polygon_body({0.2, 0.25, 0.45, 0.25 + 0.02 * h, 0.2, 0.25 + 0.3 * h}), generic, heavy},
      {"sliver on a grid line along x", polygon_body(rectangle({0.3, 12.15 * h, 0}, {0.15, 0.15 * h, 0}, 0)), along_x,
       heavy},
      {"square on grid lines along the diagonal", square({8 * h, 8 * h}, 8 * h), diagonal},
      {"diamond with its corners on nodes along the diagonal",
       polygon_body({16 * h, 12 * h, 12 * h, 16 * h, 8 * h, 12 * h, 12 * h, 8 * h}), diagonal},
  };
}

std::string scene(Body const& body, bool periodic, int order) {
  std::string const state = gas_state(density, pressure, body.velocity);
  std::string const sides = periodic ? "boundary = { x_low = \"periodic\", x_high = \"periodic\", y_low = "
                                       "\"periodic\", y_high = \"periodic\" }\n"
                                     : inflow_everywhere(state);
  return "end_time = \"1 s\"\n[fluid]\nlow = [\"0 m\", \"0 m\"]\nhigh = [\"1 m\", \"1 m\"]\ncells = [40, 40]\n"
         "ambient = " +
         state + "\neuler = { order = " + std::to_string(order) + ", cfl = 0.5 }\n" + sides + "[solid]\n" +
         rigid_material(body.density) + body.text + "velocity = " + vector(body.velocity, "m/s") +
         "\n[coupling]\ncut_cells = { wall_pressure = \"half_riemann\" }\n";
}

void check(Body const& body, bool periodic, int order) {
  CoupledCase c(scene(body, periodic, order));
  Real largest = 0, solid = 0;
  c.run(100, [&] {
    largest = max(largest, deviation(c, density, body.velocity, pressure));
    solid = max(solid, norm(c.velocity() - body.velocity));
  });
  ASSERT_EQ(c.step(), 100);
  std::string const variant =
      body.name + "; order " + std::to_string(order) + (periodic ? "; periodic sides" : "; inflow sides");
  EXPECT_TRUE(evidence::at_most("V2", "uniform translation", variant, "largest deviation of the gas", largest, 1e-11));
  EXPECT_TRUE(evidence::at_most("V2", "uniform translation", variant, "change of the body's velocity", solid, 1e-11));
}

TEST(UniformMotion, OrderEleven) {
  for (Body const& body : bodies()) check(body, false, 11);
}

/// A body must keep away from periodic sides by what a sweep reaches over.
TEST(UniformMotion, PeriodicSides) {
  check({"small disk polygon", polygon_body(regular_polygon(60, 0.09, {0.33, 0.33, 0}, 0.1)), {0.31, 0.27, 0}}, true,
        11);
}

TEST(UniformMotion, LowerOrders) {
  std::vector<Body> const all = bodies();
  for (int const order : {1, 5})
    for (std::size_t b = 0; b < (evidence::full() ? all.size() : 1); ++b) check(all[b], false, order);
}

/// In three dimensions: bricks on grid planes and turned, which are free, and a sphere of facets. The sphere is many
/// particles under links, which the pressure would deform: it moves as prescribed.
TEST(UniformMotion, InThreeDimensions) {
  Vec3 const velocity{0.41, 0.23, -0.31};
  std::string const state = gas_state(density, pressure, velocity, 3);
  std::string const free = "velocity = " + vector(velocity, "m/s") + "\n";
  std::string const prescribed =
      "prescribed = [{ low = [\"-1 m\", \"-1 m\", \"-1 m\"], high = [\"2 m\", \"2 m\", \"2 m\"], velocity = " +
      vector(velocity, "m/s") + " }]\n";
  std::vector<Body> bodies{
      {"brick on grid planes",
       "low = [\"0.3 m\", \"0.3 m\", \"0.4 m\"]\nhigh = [\"0.5 m\", \"0.6 m\", \"0.6 m\"]\n" + free, velocity},
      {"turned brick",
       "shape = \"plate\"\ncentre = [\"0.45 m\", \"0.43 m\", \"0.53 m\"]\naxis = [0.3, 0.5, 0.8]\n"
       "length = \"0.31 m\"\nwidth = \"0.22 m\"\nthickness = \"0.11 m\"\n" +
           free,
       velocity},
      {"sphere of facets",
       "shape = \"sphere\"\ntessellation = \"polar\"\ncentre = [\"0.45 m\", \"0.45 m\", \"0.52 m\"]\n"
       "radius = \"0.17 m\"\ncells = [1, 12, 6]\n" +
           prescribed,
       velocity}};
  for (Body const& body : bodies) {
    CoupledCase c(
        "end_time = \"1 s\"\n[fluid]\nlow = [\"0 m\", \"0 m\", \"0 m\"]\nhigh = [\"1 m\", \"1 m\", \"1 m\"]\n"
        "cells = [30, 30, 30]\nambient = " +
        state + "\neuler = { order = 5, cfl = 0.5 }\n" + inflow_everywhere(state, 3) + "[solid]\nlinks = {}\n" +
        rigid_material(body.density) + "[[solid.body]]\nmaterial = \"rigid\"\n" + body.text +
        "[coupling]\ncut_cells = {}\n");
    Real largest = 0, solid = 0;
    c.run(20, [&] {
      largest = max(largest, deviation(c, density, velocity, pressure));
      for (Index p = 0; p < c.world->solid->owned(); ++p) solid = max(solid, norm(c.velocity(p) - velocity));
    });
    ASSERT_EQ(c.step(), 20);
    std::string const variant = "3D " + body.name + "; order 5";
    EXPECT_TRUE(
        evidence::at_most("V2", "uniform translation", variant, "largest deviation of the gas", largest, 1e-11));
    EXPECT_TRUE(evidence::at_most("V2", "uniform translation", variant, "change of the body's velocity", solid, 1e-11));
  }
}

}  // namespace
}  // namespace brisance
