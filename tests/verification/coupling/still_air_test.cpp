// Loads relative to the ambient pressure, and what bodies receive (theory/coupling.md sections 1.6, 1.7).
#include <gtest/gtest.h>

#include "parallel/error.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

/// An elastic frame on the ground and a free block turned out of the grid, in air.
std::string structure(int dimension, std::string const& load, std::string const& more) {
  std::string const z = dimension == 3 ? ", \"0.3 m\"" : "", zh = dimension == 3 ? ", \"0.63 m\"" : "";
  return "end_time = \"1 s\"\n[fluid]\nhigh = " +
         quantities(std::vector<Real>(static_cast<std::size_t>(dimension), 1), "m") +
         "\ncells = " + (dimension == 2 ? "[50, 50]" : "[16, 16, 16]") +
         "\nambient = { density = \"1.1845467 kg/m3\", pressure = \"101325 Pa\" }\neuler = { order = 5, cfl = 0.5 }\n" +
         more +
         "[solid]\nlinks = {}\n[solid.material.steel]\ndensity = \"7860 kg/m3\"\nyoung_modulus = \"210 GPa\"\n"
         "[[solid.body]]\nname = \"mast\"\nmaterial = \"steel\"\nlow = [\"0.313 m\", \"-0.1 m\"" +
         z + "]\nhigh = [\"0.357 m\", \"0.611 m\"" + zh + "]\ncells = " + (dimension == 2 ? "[2, 9]" : "[1, 5, 2]") +
         "\nhold = [{ low = [\"0 m\", \"-1 m\", \"-1 m\"], high = [\"1 m\", \"0 m\", \"2 m\"] }]\n"
         "[[solid.body]]\nname = \"block\"\nmaterial = \"steel\"\nshape = \"prism\"\nlow = [0, 0, \"0.31 m\"]\nhigh = "
         "[0, 0, "
         "\"0.6 m\"]\ncorners = " +
         quantities(rectangle({0.68, 0.47, 0}, {0.1, 0.07, 0}, 0.4), "m") +
         "\n[coupling]\nbody_loads = {}\ncut_cells = { load = \"" + load + "\" }\n";
}

TEST(StillAir, LeavesAStructureExactlyAtRest) {
  struct Variant {
    int dimension;
    std::string scheme;
  };
  for (auto const& [dimension, scheme] : {Variant{2, "lag"}, Variant{3, "lag"}, Variant{2, "explicit"}}) {
    CoupledCase c(structure(dimension, "relative", ""), {"coupling.scheme=\"" + scheme + "\""});
    std::vector<solid::Pose> const start(c.world->solid->pose().begin(), c.world->solid->pose().end());
    int moved = 0;
    c.run(dimension == 2 ? 400 : 60, [&] {
      for (Index p = 0; p < c.world->solid->owned(); ++p) {
        auto const at = static_cast<std::size_t>(p);
        solid::Pose const& pose = std::as_const(*c.world->solid).pose()[at];
        moved += !(pose.x == start[at].x && pose.q.w == start[at].q.w && pose.q.v == start[at].q.v) ||
                 !(c.world->solid->motion()[at].v == Vec3{});
      }
    });
    std::string const variant = std::to_string(dimension) + "D" + (scheme == "lag" ? "" : ", " + scheme);
    EXPECT_TRUE(evidence::at_most("V2", "structure in still air", variant, "particles that ever moved", moved, 0));
    EXPECT_TRUE(evidence::at_most("V2", "structure in still air", variant, "largest deviation of the gas over p",
                                  deviation(c, 1.1845467, {}, 101325) / 101325, 1e-9));
    EXPECT_TRUE(
        evidence::at_most("V2", "structure in still air", variant, "energy defect", c.conservation().energy, 1e-13));
  }
}

TEST(BodyLoads, NeedAFluidThatActs) {
  std::string scene = structure(2, "relative", "");
  scene.resize(scene.find("cut_cells"));
  try {
    CoupledCase c(scene);
    FAIL() << "accepted";
  } catch (Error const& error) {
    EXPECT_EQ(error.kind(), Failure::scene);
    EXPECT_NE(std::string(error.what()).find("coupling.body_loads needs coupling.cut_cells"), std::string::npos)
        << error.what();
  }
}

/// A blast on the same structure: the account closes with what lies between, and the loads of the bodies are their
/// impulse.
std::string const blast =
    "boundary = { x_low = \"outflow\", x_high = \"outflow\", y_high = \"outflow\" }\n[[fluid.region]]\nshape = "
    "\"ball\"\ncentre "
    "= [\"0.12 m\", \"0.3 m\"]\nradius = \"0.08 m\"\ndensity = \"12 kg/m3\"\npressure = \"3 MPa\"\n";

TEST(RelativeLoad, BalancesUnderABlast) {
  struct Variant {
    std::string load, scheme;
  };
  for (auto const& [load, scheme] :
       {Variant{"relative", "lag"}, Variant{"absolute", "lag"}, Variant{"relative", "explicit"}}) {
    CoupledCase c(structure(2, load, blast), {"coupling.scheme=\"" + scheme + "\""});
    c.run(300);
    Conservation const& k = c.conservation();
    std::string const variant = load + " load" + (scheme == "lag" ? "" : ", " + scheme);
    EXPECT_TRUE(evidence::at_most("V11", "blast on a mast", variant, "mass defect", k.mass, 1e-12));
    EXPECT_TRUE(evidence::at_most("V11", "blast on a mast", variant, "momentum defect", max(k.momentum.x, k.momentum.y),
                                  1e-12));
    EXPECT_TRUE(
        evidence::at_most("V11", "blast on a mast", variant, "exchange energy defect", k.exchange_energy, 1e-12));
    EXPECT_LT(k.energy, 1e-6) << load;
    // The block is free: its momentum is the impulse it received, its energy what the gas has spent on it.
    std::vector<coupling::BodyLoads::Row> const rows = c.world->body_loads->rows();
    ASSERT_EQ(rows.size(), 2u);
    for (Index p = 0; p < c.world->solid->owned(); ++p) {
      solid::Particle const& particle = c.world->mesh->particle(c.world->solid->id(p));
      if (particle.body != 1) continue;
      Vec3 const momentum = particle.mass * c.velocity(p);
      EXPECT_TRUE(evidence::at_most("V11", "blast on a mast", variant, "impulse of the block less its momentum",
                                    norm(rows[1].impulse - momentum) / norm(momentum), 1e-12));
      EXPECT_GT(rows[1].energy, 0.5 * particle.mass * square(norm(c.velocity(p))) * (1 - 1e-12));
    }
  }
}

}  // namespace
}  // namespace brisance
