#include "core/solid/meshes/quality.hpp"
#include "core/solid/meshes/layers.hpp"

#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/solids.hpp"
#include "tests/support/surfaces.hpp"

namespace brisance::solid {
namespace {

SolidConfig box(std::array<Index, 3> const& cells, Real nu) {
  SolidConfig config = testing::one_material(1, 1, nu);
  config.body.push_back(testing::box({0, 0, 0}, {Real(cells[0]), Real(cells[1]), Real(cells[2])}, cells));
  return config;
}

SolidConfig from_file(std::string const& path, Real nu) {
  SolidConfig config = testing::one_material(1, 1, nu);
  BodyConfig b;
  b.material = "m";
  b.shape = "mesh";
  b.mesh.emplace();
  b.mesh->file = path;
  config.body.push_back(b);
  return config;
}

bool warns(MeshQuality const& q, Mesh const& mesh, std::string const& of) {
  for (std::string const& w : warnings(q, mesh))
    if (w.find(of) != std::string::npos) return true;
  return false;
}

TEST(MeshQuality, BricksAreExact) {
  Mesh const mesh = build_mesh(box({4, 3, 3}, 0.3), 3);
  MeshQuality const q = measure_quality(mesh)[0];
  EXPECT_EQ(q.parts, 1);
  EXPECT_LT(q.angle.value, 1e-9);
  EXPECT_LT(q.offset, 1e-12);
  EXPECT_NEAR(q.aspect.value, 1, 1e-12);
  EXPECT_FALSE(q.moduli.has_value());
  EXPECT_TRUE(warnings(q, mesh).empty());
  // Measured all the same: the patch is as exact as the solution of its equations.
  for (Real nu : {-0.9, 0.0, 0.3, 0.49}) {
    PatchModuli const m = measure_moduli(Patch(mesh, 0, 1000), nu, 1e-12);
    EXPECT_TRUE(m.converged);
    EXPECT_LT(std::abs(m.young), 1e-9) << nu;
    EXPECT_LT(std::abs(m.shear), 1e-9) << nu;
    EXPECT_LT(std::abs(m.poisson), 1e-9) << nu;
    EXPECT_LT(m.scatter, 1e-9) << nu;
  }
  PatchModuli const plane = measure_moduli(Patch(build_mesh(box({4, 3, 1}, 0.3), 2), 0, 1000), 0.3, 1e-12);
  EXPECT_LT(std::abs(plane.young) + std::abs(plane.shear) + std::abs(plane.poisson), 1e-9);
}

TEST(MeshQuality, SingleLayersWithAPoissonRatioAreWarnedAbout) {
  Mesh const plate = build_mesh(box({6, 6, 1}, 0.3), 3), two = build_mesh(box({6, 6, 2}, 0.3), 3),
             rod = build_mesh(box({6, 1, 1}, 0.3), 3), none = build_mesh(box({6, 6, 1}, 0), 3);
  EXPECT_TRUE(warns(measure_quality(plate)[0], plate, "one layer"));
  EXPECT_FALSE(warns(measure_quality(two)[0], two, "one layer"));
  EXPECT_FALSE(warns(measure_quality(rod)[0], rod, "one layer"));  // exact
  EXPECT_FALSE(warns(measure_quality(none)[0], none, "one layer"));
}

TEST(MeshQuality, LayeredRodsThatPoissonsEffectStiffensAreWarnedAbout) {
  auto const warned = [](std::array<Index, 3> const& cells, Real nu) {
    Mesh const mesh = build_mesh(box(cells, nu), 3);
    return warns(measure_quality(mesh)[0], mesh, "too stiff in bending");
  };
  EXPECT_TRUE(warned({20, 2, 2}, -0.9));
  EXPECT_TRUE(warned({4, 30, 4}, -0.9));
  EXPECT_TRUE(warned({20, 2, 2}, 0.49));
  EXPECT_FALSE(warned({20, 2, 2}, 0.3));  // 4 %
  EXPECT_FALSE(warned({20, 2, 2}, 0));
  EXPECT_FALSE(warned({20, 1, 1}, -0.9));  // exact
  EXPECT_FALSE(warned({6, 6, 6}, -0.9));   // no rod
  EXPECT_FALSE(warned({12, 12, 2}, -0.9));
  // Measured: 210, 100 and 54 % of two, four and six layers.
  EXPECT_NEAR(stiffening_of_a_rod(-0.9, 2), 2.1, 0.1);
  EXPECT_NEAR(stiffening_of_a_rod(-0.9, 4), 1.0, 0.05);
  EXPECT_NEAR(stiffening_of_a_rod(-0.9, 6), 0.54, 0.03);
  EXPECT_NEAR(stiffening_of_a_rod(0.3, 2), 0.039, 0.002);
}

TEST(MeshQuality, StairsAndPartsAndAnglesAreWarnedAbout) {
  // A ball of cubes.
  testing::Msh m;
  testing::Grid const grid{10, 10, 10};
  m.nodes = grid.nodes();
  for (int k = 0; k < 10; ++k)
    for (int j = 0; j < 10; ++j)
      for (int i = 0; i < 10; ++i)
        if (norm(Vec3{i - 4.5, j - 4.5, k - 4.5}) < 5) m.add(5, 3, 1, grid.corners(i, j, k));
  Mesh const ball = build_mesh(from_file(m.write("stairs", "2.2", true), 0.3), 3);
  EXPECT_TRUE(warns(measure_quality(ball)[0], ball, "staircase"));
  // An angle of bricks is none.
  m.elements.clear();
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 10; ++j)
      for (int i = 0; i < 10; ++i)
        if (i < 3 || j < 3) m.add(5, 3, 1, grid.corners(i, j, k));
  Mesh const angle = build_mesh(from_file(m.write("steps", "2.2", true), 0.3), 3);
  EXPECT_TRUE(warnings(measure_quality(angle)[0], angle).empty());
  // Two cubes that share an edge.
  m.elements.clear();
  m.add(5, 3, 1, grid.corners(0, 0, 0));
  m.add(5, 3, 1, grid.corners(1, 1, 0));
  Mesh const parts = build_mesh(from_file(m.write("parts", "2.2", true), 0.3), 3);
  EXPECT_EQ(measure_quality(parts)[0].parts, 2);
  EXPECT_TRUE(warns(measure_quality(parts)[0], parts, "2 parts"));
  Mesh const kuhn = build_mesh(from_file(testing::brick_mesh({3, 3, 3}, true).write("kuhn", "2.2", true), 0.3), 3);
  EXPECT_TRUE(warns(measure_quality(kuhn)[0], kuhn, "degrees off the line of poles"));
}

TEST(MeshQuality, TheParticleThatLimitsTheStepIsNamed) {
  SolidConfig config = box({4, 3, 3}, 0.3);
  config.body.push_back(testing::box({10, 0, 0}, {10.5, 1, 1}, {2, 1, 1}));
  config.body[1].name = "thin";
  testing::Lone const body(config);
  StepLimit const limit = describe_step_limit(body.solid);
  EXPECT_NE(limit.text.find("of \"thin\" at (10."), std::string::npos) << limit.text;
  EXPECT_LT(limit.share_of_median, 0.6);
}

/// Deviations of moduli on tetrahedra and fitted Voronoi cells, basic volumetric term (theory/solid.md section 9).
TEST(PatchTest, TetrahedraAndFittedVoronoiCells) {
  std::string const tets = testing::write_off("patch-box", testing::box_surface({4, 1, 1}));
  for (bool voronoi : {true, false}) {
    SolidConfig config = voronoi ? box({4, 1, 1}, 0) : from_file(tets, 0);
    config.body[0].tessellation = voronoi ? "voronoi" : "tetrahedra";
    config.body[0].particles = 250;
    Mesh const mesh = build_mesh(config, 3);
    Patch const patch(mesh, 0, mesh.size());
    Mat3 pull{};
    pull[0].x = 1;
    for (Real nu : {-0.9, -0.5, 0.0, 0.3, 0.45, 0.49}) {
      auto const r = patch.respond(pull, nu, 1e-12);
      ASSERT_TRUE(r.converged);
      Real const along = r.gradient[0].x - 1, across = nu == 0 ? 0 : r.gradient[1].y / (-nu * r.gradient[0].x) - 1;
      std::string const variant =
          (voronoi ? "250 fitted Voronoi cells nu " : "tetrahedra nu ") + std::to_string(nu).substr(0, 5);
      std::string const name = voronoi ? "patch test, Voronoi" : "patch test, tetrahedra";
      // Theory: -0.13 % (nu = 0.3), -0.45 % (0.45) for its own 250 cells, twice that allowed. Tetrahedra: figures to
      // be reported, for which the theory has no limit; up to 18 % were met at nu = 0.49, and other meshes differ.
      if (!voronoi) {
        EXPECT_TRUE(evidence::at_most("S5", name, variant, "|e_xx E / sigma - 1|", std::abs(along), 0.2));
        EXPECT_TRUE(evidence::at_most("S5", name, variant, "|e_yy / (-nu e_xx) - 1|", std::abs(across), 0.2));
        continue;
      }
      Real const limit = nu == 0 ? 1e-11 : std::abs(nu) < 0.4 ? 0.0026 : 0.009;
      // Of the poles, over the elongation of the box; rms |strain x| of a box 4 x 1 x 1 is e sqrt(4/3 + nu^2/6).
      Real const scatter = r.scatter * std::sqrt(4.0 / 3 + nu * nu / 6) / 4;
      EXPECT_TRUE(evidence::at_most("S5", name, variant, "|e_xx E / sigma - 1|", std::abs(along), limit));
      EXPECT_TRUE(evidence::at_most("S5", name, variant, "|e_yy / (-nu e_xx) - 1|", std::abs(across), limit));
      EXPECT_TRUE(evidence::at_most("S5", name, variant, "rms scatter about the affine fit over the elongation",
                                    scatter, nu == 0 ? 1e-11 : 3e-3));
    }
  }
}

}  // namespace
}  // namespace brisance::solid
