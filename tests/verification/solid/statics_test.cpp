// S1 to S4 of theory/solid.md section 19: exact gradient, objectivity, sums of forces, patch test.
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/scattered_block.hpp"

namespace brisance::solid {
namespace {

using testing::Lone;
using testing::Random;
using testing::scatter;
using testing::slope;

TEST(ElasticLinks, ForcesAreTheGradientOfTheEnergyAndBalance) {
  for (bool voronoi : {false, true})
    for (Real nu : {-0.6, 0.3, 0.48}) {
      Lone body(testing::block_of_cells(2, nu, voronoi));
      Random random(7);
      scatter(body.solid, random);
      std::vector<Wrench> const exact(body.solid.internal().begin(), body.solid.internal().end());
      Real error = 0, scale = 0, force_scale = 0;
      Vec3 force{}, torque{};
      for (Index p = 0; p < body.solid.owned(); ++p) {
        auto const at = static_cast<std::size_t>(p);
        for (int d = 0; d < 3; ++d) {
          Vec3 unit{};
          unit[d] = 1;
          Real const f = slope(body, [&](Real s) { body.solid.pose()[at].x += s * unit; });
          Real const m = slope(body, [&](Real s) {
            Quaternion& q = body.solid.pose()[at].q;
            q = testing::rotation(s * unit) * q;
          });
          error = max(error, max(std::abs(f - exact[at].force[d]), std::abs(m - exact[at].torque[d])));
          scale = max(scale, max(std::abs(exact[at].force[d]), std::abs(exact[at].torque[d])));
        }
        force += exact[at].force;
        torque += exact[at].torque + cross(body.solid.pose()[at].x, exact[at].force);
        force_scale = max(force_scale, norm(exact[at].force) * max(1, norm(body.solid.pose()[at].x)));
      }
      std::string const variant = (voronoi ? "voronoi nu " : "cartesian nu ") + std::to_string(nu).substr(0, 5);
      EXPECT_TRUE(evidence::at_most("S1", "gradient", variant, "max |F + grad E| / max |F|", error / scale, 1e-8));
      EXPECT_TRUE(evidence::at_most("S3", "balance", variant, "|sum F| / max |F|", norm(force) / force_scale, 1e-13));
      EXPECT_TRUE(
          evidence::at_most("S3", "balance", variant, "|sum x x F + M| / max |F|", norm(torque) / force_scale, 1e-13));
    }
}

void move_rigidly(Solid& solid, Quaternion const& turn, Vec3 const& shift) {
  for (Pose& p : solid.pose()) {
    p.x = rotate(turn, p.x) + shift;
    p.q = turn * p.q;
  }
}

TEST(ElasticLinks, EnergyIsObjective) {
  for (bool voronoi : {false, true}) {
    std::string const variant = voronoi ? "voronoi" : "cartesian";
    Lone body(testing::block_of_cells(2, 0.3, voronoi));
    Quaternion const quarter = testing::rotation({0, 0, std::acos(-1.0) / 2});
    move_rigidly(body.solid, quarter, {1, 2, 3});
    EXPECT_TRUE(
        evidence::at_most("S2", "objectivity", variant, "E / EV after a rigid motion", elastic(body) / 18, 1e-26));
    Random random(3);
    scatter(body.solid, random);
    Real const before = elastic(body);
    move_rigidly(body.solid, testing::rotation({0.3, -1.1, 0.7}), {0.5, -2, 1});
    EXPECT_TRUE(evidence::at_most("S2", "objectivity", variant, "relative change of E of a turned deformed body",
                                  std::abs(elastic(body) - before) / before, 1e-13));
  }
}

TEST(ElasticLinks, UniaxialPatchTest) {
  struct Bar {
    std::array<Index, 3> cells;
  };
  Vec3 const h{1, 1.3, 0.8};
  Real const stress = 1e-2;  // rounding of positions of size 10 must stay below 1e-11 of the strain
  for (Bar const& bar : {Bar{{10, 1, 1}}, Bar{{10, 3, 2}}, Bar{{8, 4, 4}}})
    for (Real nu : {-0.9, -0.5, 0.0, 0.3, 0.45, 0.49}) {
      SolidConfig config = testing::one_material(1, 1, nu);
      Vec3 const size{h.x * bar.cells[0], h.y * bar.cells[1], h.z * bar.cells[2]};
      config.body.push_back(testing::box({0, 0, 0}, size, bar.cells));
      Lone body(config);
      std::vector<FaceLoad> loads;
      for (FreeFace const& f : body.mesh.free_faces) {
        Vec3 const n = body.mesh.face(f.particle, f.face).normal;
        if (std::abs(n.x) > 0.5) loads.push_back({f.particle, f.face, {stress * n.x, 0, 0}});
      }
      body.solid.load_faces(loads);
      for (Pose& p : body.solid.pose())
        p.x = {(1 + stress) * p.x.x, (1 - nu * stress) * p.x.y, (1 - nu * stress) * p.x.z};
      body.solid.compute_forces();
      Real residual = 0;
      for (Wrench const& w : body.solid.internal()) residual = max(residual, max(norm(w.force), norm(w.torque)));
      std::string const variant = std::to_string(bar.cells[0]) + "x" + std::to_string(bar.cells[1]) + "x" +
                                  std::to_string(bar.cells[2]) + " nu " + std::to_string(nu).substr(0, 5);
      // The exact strains are put in; residual forces over sigma S measure by how much they are not the equilibrium.
      EXPECT_TRUE(evidence::at_most("S4", "patch test", variant, "residual / (sigma S)",
                                    residual / (stress * h.y * h.z), 1e-11));
    }
}

}  // namespace
}  // namespace brisance::solid
