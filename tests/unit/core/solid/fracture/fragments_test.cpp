// Fragments and their census, on one rank.
#include <gtest/gtest.h>

#include "core/solid/fracture/fracture.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

using testing::Lone;

/// A rod of six bricks; its links by the x of their faces.
struct Rod : Lone {
  Fragments fragments;
  static SolidConfig config() {
    SolidConfig config = testing::one_material(2, 1, 0.3);
    config.body.push_back(testing::box({0, 0, 0}, {6, 1, 1}, {6, 1, 1}));
    config.body[0].spin = {0, 0, 0.01};
    config.body[0].velocity = {1, 0, 0};
    return config;
  }
  Rod() : Lone(config()) {
    solid.allow_damage();
    fragments.find(solid, *comm);
  }
  void cut(Real x, Real intact = 0) {
    for (std::size_t k = 0; k < solid.links(); ++k) {
      Link const& link = mesh.links[k];
      if (std::abs(mesh.particle(link.i).centre.x + mesh.face(link.i, link.face_i).centroid.x - x) < 0.1)
        solid.weaken(k, intact);
    }
  }
};

TEST(Fragments, FollowBrokenLinksAndRememberWhen) {
  Rod rod;
  for (std::int64_t n : rod.fragments.size()) EXPECT_EQ(n, 6);
  rod.cut(2);
  rod.fragments.update(rod.solid, *rod.comm, 1.5);
  rod.cut(4, 0.001);  // damaged is not broken
  rod.fragments.update(rod.solid, *rod.comm, 2.5);
  for (Index p = 0; p < 6; ++p) {
    auto const at = static_cast<std::size_t>(p);
    EXPECT_EQ(rod.fragments.size()[at], rod.mesh.particle(rod.solid.id(p)).centre.x < 2 ? 2 : 4);
    EXPECT_EQ(rod.fragments.separated()[at], 1.5);
  }
  rod.cut(5);
  rod.fragments.update(rod.solid, *rod.comm, 3.5);
  for (Index p = 0; p < 6; ++p) {
    Real const x = rod.mesh.particle(rod.solid.id(p)).centre.x;
    EXPECT_EQ(rod.fragments.separated()[static_cast<std::size_t>(p)], x < 2 ? 1.5 : 3.5);
  }
}

TEST(Fragments, CensusAddsUpToTheBody) {
  Rod rod;
  for (int n = 0; n < 20; ++n) rod.solid.step(0.2);
  rod.cut(2), rod.cut(5);
  rod.fragments.update(rod.solid, *rod.comm, 4);
  rod.solid.compute_forces();
  auto const census = take_census(rod.solid, rod.fragments, *rod.comm);
  ASSERT_EQ(census.size(), 3u);
  Measures const all = rod.measure();
  Real kinetic = 0, elastic = 0, mass = 0, volume = 0;
  Vec3 momentum{}, moment{};
  std::int64_t particles = 0;
  for (FragmentFigures const& f : census) {
    EXPECT_EQ(f.separated, 4);
    kinetic += f.kinetic, elastic += f.elastic, mass += f.mass, volume += f.volume, particles += f.particles;
    momentum += f.mass * f.velocity;
    moment += f.mass * f.centre;
  }
  EXPECT_EQ(particles, 6);
  EXPECT_NEAR(mass, 12, 1e-13);
  EXPECT_NEAR(volume, 6, 1e-13);
  EXPECT_NEAR(kinetic, all.value(Measures::kinetic), 1e-13);
  EXPECT_NEAR(elastic, all.value(Measures::elastic), 1e-15);
  EXPECT_NEAR(norm(momentum - all.vector(Measures::momentum)), 0, 1e-13);
  EXPECT_NEAR(norm(moment - all.vector(Measures::first_moment)), 0, 1e-12);
  EXPECT_EQ(census_row(census[0], rod.mesh, 20, 4).substr(0, 12), "20,4,0,body,");
}

TEST(Fragments, ParticlesAloneStillHaveTheirVolume) {
  // Everything broken: no strain, no force, and no particle without an effective volume.
  for (Real nu : {-0.9, 0.0, 0.49}) {
    SolidConfig config = testing::one_material(1, 1, nu);
    config.body.push_back(testing::box({0, 0, 0}, {2, 2, 2}, {2, 2, 2}));
    Lone body(config);
    body.solid.allow_damage();
    for (std::size_t k = 0; k < body.solid.links(); ++k) body.solid.weaken(k, 0);
    for (Pose& p : body.solid.pose()) p.x *= 1.5;
    body.solid.compute_forces();
    EXPECT_EQ(body.solid.broken(), body.solid.links());
    EXPECT_EQ(body.measure().value(Measures::elastic), 0);
    for (Wrench const& w : body.solid.internal()) EXPECT_EQ(norm(w.force), 0);
  }
}

}  // namespace
}  // namespace brisance::solid
