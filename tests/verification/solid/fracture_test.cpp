// S24 to S27 and S31 of theory/solid.md section 19, and the account of a complete break-up.
#include <gtest/gtest.h>

#include "tests/support/breaking_solid.hpp"
#include "tests/support/evidence.hpp"

namespace brisance::solid {
namespace {

using testing::BreakingSolid;
using testing::Lone;
using testing::Random;

std::string figure(Real x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

// S24: the first 8 m of a rod start at v0; the pulse, 16 m long, turns into tension at the far end.
TEST(Fracture, RodSpallsWhereTensionFirstReachesItsStrength) {
  struct Case {
    int dimension;
    Index per_metre;
    Real cells, late;  // tolerances: of the place in cells, of the time
  };
  for (Case const& c : {Case{1, 1, 1.5, 0.025}, Case{1, 2, 1, 0.02}, Case{3, 2, 1, 0.02}}) {
    Real const h = 1.0 / c.per_metre;
    SolidConfig config = testing::one_material(1, 1, 0);
    Vec3 const high = c.dimension == 1 ? Vec3{80, 0, 0} : Vec3{80, h, h};
    config.body.push_back(testing::box({0, 0, 0}, high, {80 * c.per_metre, 1, 1}));
    config.fracture.emplace().law.push_back(testing::stress_law(0.0075));
    auto const alone = parallel::serial();
    BreakingSolid rod(config, c.dimension, 120, *alone);
    for (Index p = 0; p < rod.solid.owned(); ++p)
      if (rod.mesh.particle(rod.solid.id(p)).centre.x < 8) rod.solid.motion()[static_cast<std::size_t>(p)].v.x = 0.02;
    rod.start();
    Real const momentum = rod.ledger().total(Entry::momentum_x);
    Real time = 0, place = 0;  // of the first breaks: the middle of those of one step
    while (!rod.simulation.finished()) {
      rod.simulation.pair();
      if (time > 0 || rod.broken() == 0) continue;
      time = rod.simulation.clock().time;
      for (std::size_t k = 0; k < rod.solid.links(); ++k) {
        Link const& link = rod.mesh.links[rod.solid.mesh_link(k)];
        if (rod.solid.intact(k) > 0) continue;
        place += rod.mesh.particle(link.i).centre.x + rod.mesh.face(link.i, link.face_i).centroid.x;
      }
      place /= rod.broken();
    }
    std::string const variant = figure(c.dimension) + "D h " + figure(h);
    Real const drift = std::abs(rod.ledger().total(Entry::momentum_x) - momentum) / momentum;
    EXPECT_TRUE(evidence::near("S24", "spall", variant, "distance of the first break from the far end", 80 - place, 8,
                               c.cells * h));
    EXPECT_TRUE(evidence::near("S24", "spall", variant, "time of the first break over exact, minus 1", time / 80 - 1,
                               c.late / 2, c.late / 2));
    EXPECT_TRUE(evidence::at_most("S24", "spall", variant, "change of momentum", drift, 1e-14));
  }
}

/// A block of bricks or Voronoi cells in a random state.
SolidConfig block(Real poisson_ratio, bool voronoi) {
  SolidConfig config = testing::one_material(1, 1, poisson_ratio);
  config.body.push_back(testing::box({0, 0, 0}, {3, 3, 3}, {3, 3, 3}));
  if (voronoi) {
    config.body[0].tessellation = "voronoi";
    config.body[0].particles = 27;
    config.body[0].lloyd = 3;
  }
  return config;
}

void scatter(Solid& solid, Random& random) {
  for (Pose& p : solid.pose()) {
    p.x += 0.3 * random.vector();
    p.q = testing::rotation(random.vector());
  }
  solid.compute_forces();
}

Real elastic(Lone& body) {
  body.solid.compute_forces();
  return body.measure().value(Measures::elastic);
}

// S25: what the account books for each of 40 breaks is the drop of the whole elastic energy at fixed positions.
TEST(Fracture, EveryBreakReleasesWhatTheAccountSays) {
  for (bool voronoi : {false, true})
    for (Real nu : {-0.95, -0.5, 0.0, 0.3, 0.49}) {
      Lone body(block(nu, voronoi));
      Random random(11);
      scatter(body.solid, random);
      body.solid.allow_damage();
      Real error = 0, smallest = 1e300, before = elastic(body);
      Real const start = before;
      parallel::ExactSum released;
      for (int n = 0; n < 40; ++n) {
        std::size_t k = 0;
        do k = static_cast<std::size_t>(0.5 * (random() + 1) * static_cast<Real>(body.solid.links()));
        while (body.solid.intact(k) == 0);
        Index const i = body.solid.link_store().end_i(k), j = body.solid.link_store().end_j(k);
        auto const local = [&] {
          return body.solid.link_energy(k) + body.solid.volumetric_energy(i) + body.solid.volumetric_energy(j);
        };
        Real const held = local();
        body.solid.weaken(k, 0);
        Real const after = elastic(body), drop = held - local();
        error = max(error, std::abs(drop - (before - after)) / start);
        smallest = min(smallest, drop / start);
        released.add(drop);
        before = after;
      }
      std::string const variant = (voronoi ? "voronoi nu " : "cartesian nu ") + figure(nu);
      EXPECT_TRUE(evidence::at_most("S25", "break ledger", variant, "drop of a link and its ends minus that of the body",
                                    error, 1e-14));
      EXPECT_TRUE(evidence::at_most("S25", "break ledger", variant, "sum of the drops minus the change",
                                    std::abs(released.value() - (start - before)) / start, 1e-14));
      EXPECT_TRUE(evidence::at_most("S25", "break ledger", variant, "minus the smallest drop", -smallest, 0));
    }
}

// The same for the effect: links that fail together, and those that fail after them, step by step to the last one.
TEST(Fracture, LinksThatFailTogetherReleaseTheDropOfTheBody) {
  for (Real nu : {-0.95, 0.0, 0.49}) {
    SolidConfig config = block(nu, true);
    LawConfig law = testing::stress_law(0.02, 0.7);
    law.weibull = Weibull{2, 1, 3};
    config.fracture.emplace().law.push_back(law);
    config.body[0].clamp.push_back({{0, 0, 0}, {0, 3, 3}});
    Lone body(config);
    Fracture fracture(*config.fracture, body.solid, *body.comm);
    fracture.start();
    Random random(17);
    scatter(body.solid, random);
    Real const start = elastic(body);
    std::int64_t rounds = 0, links = 0;
    while (fracture.judge(0)) {
      body.solid.compute_forces();
      fracture.book();
      Real const drop = start - body.measure().value(Measures::elastic);
      EXPECT_GT(fracture.links_broken(), links);
      EXPECT_TRUE(evidence::at_most("S25", "break ledger of the effect", "round " + figure(static_cast<Real>(rounds)) + " nu " + figure(nu),
                                    "booked minus the drop of the body",
                                    std::abs(fracture.dissipated().value() - drop) / start, 1e-14));
      links = fracture.links_broken();
      ++rounds;
    }
    EXPECT_GT(links, 40);
    EXPECT_LT(rounds, 20);
  }
}

// S26: Y = -dE/dd, by sixth-order differences of the energy in d.
TEST(Fracture, ReleaseIsTheDerivativeOfTheEnergy) {
  for (bool voronoi : {false, true})
    for (Real nu : {-0.95, -0.5, 0.0, 0.3, 0.49}) {
      Lone body(block(nu, voronoi));
      Random random(5);
      scatter(body.solid, random);
      body.solid.allow_damage();
      std::vector<GapBlock> gaps;
      Real error = 0;
      for (std::size_t k = 0; k < body.solid.links(); k += 3) {
        Real const d = 0.4, h = 0.005;
        auto energy = [&](Real damage) {
          body.solid.weaken(k, 1 - damage);
          return elastic(body);
        };
        Real const slope = -(45 * (energy(d + h) - energy(d - h)) - 9 * (energy(d + 2 * h) - energy(d - 2 * h)) +
                             (energy(d + 3 * h) - energy(d - 3 * h))) /
                           (60 * h);
        energy(d);
        body.solid.measure_gaps(gaps);
        GapBlock const& gap = gaps[k / lanes];
        Section const section = section_of(body.mesh, body.mesh.links[body.solid.mesh_link(k)]);
        auto const pressure = [&](Index p) { return body.solid.pressure()[static_cast<std::size_t>(p)]; };
        LinkState const s = link_state(section, gap.opened[k % lanes] / (1 - d), gap.squared[k % lanes],
                                       gap.flexure[k % lanes] / (1 - d), pressure(body.solid.link_store().end_i(k)),
                                       pressure(body.solid.link_store().end_j(k)));
        Real const formula = release(s).total() * section.area;
        error = max(error, std::abs(formula - slope) / formula);
        energy(0);
      }
      EXPECT_TRUE(evidence::at_most("S26", "release of a link", (voronoi ? "voronoi nu " : "cartesian nu ") + figure(nu),
                                    "Y against differences", error, 1e-7));
    }
}

}  // namespace
}  // namespace brisance::solid
