// S25 and S26 of theory/solid.md section 19: what breaks release, one by one and through a complete break-up.
#include <gtest/gtest.h>

#include "tests/support/breaking_solid.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/scattered_block.hpp"

namespace brisance::solid {
namespace {

using testing::BreakingSolid;
using testing::elastic;
using testing::figure;
using testing::Lone;
using testing::Random;
using testing::scatter;

// S25: what the account books for each of 40 breaks is the drop of the whole elastic energy at fixed positions.
TEST(Fracture, EveryBreakReleasesWhatTheAccountSays) {
  for (bool voronoi : {false, true})
    for (Real nu : {-0.95, -0.5, 0.0, 0.3, 0.49}) {
      Lone body(testing::block_of_cells(3, nu, voronoi));
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
      EXPECT_TRUE(evidence::at_most("S25", "break ledger", variant,
                                    "drop of a link and its ends minus that of the body", error, 1e-14));
      EXPECT_TRUE(evidence::at_most("S25", "break ledger", variant, "sum of the drops minus the change",
                                    std::abs(released.value() - (start - before)) / start, 1e-14));
      EXPECT_TRUE(evidence::at_most("S25", "break ledger", variant, "minus the smallest drop", -smallest, 0));
    }
}

// The same for the effect: links that fail together, and those that fail after them, step by step to the last one.
TEST(Fracture, LinksThatFailTogetherReleaseTheDropOfTheBody) {
  for (Real nu : {-0.95, 0.0, 0.49}) {
    SolidConfig config = testing::block_of_cells(3, nu, true);
    LawConfig law = testing::stress_law(0.35, 0.7);
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
      EXPECT_TRUE(evidence::at_most(
          "S25", "break ledger of the effect", "round " + figure(static_cast<Real>(rounds)) + " nu " + figure(nu),
          "booked minus the drop of the body", std::abs(fracture.dissipated().value() - drop) / start, 1e-14));
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
      Lone body(testing::block_of_cells(3, nu, voronoi));
      Random random(5);
      scatter(body.solid, random);
      body.solid.allow_damage();
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
        GapBlock const& gap = body.solid.gaps()[k / lanes];
        Section const section = section_of(body.mesh, body.mesh.links[body.solid.mesh_link(k)]);
        auto const pressure = [&](Index p) { return body.solid.pressure()[static_cast<std::size_t>(p)]; };
        LinkState const s = link_state(section, gap.opened[k % lanes] / (1 - d), gap.squared[k % lanes],
                                       gap.flexure[k % lanes] / (1 - d), pressure(body.solid.link_store().end_i(k)),
                                       pressure(body.solid.link_store().end_j(k)));
        Real const formula = release(s).total() * section.area;
        error = max(error, std::abs(formula - slope) / formula);
        energy(0);
      }
      EXPECT_TRUE(evidence::at_most("S26", "release of a link",
                                    (voronoi ? "voronoi nu " : "cartesian nu ") + figure(nu), "Y against differences",
                                    error, 1e-7));
    }
}

/// Largest |H + D - H_0| / H_0 while a body that expands breaks up and after, how its means differ after, and how many
/// of its links broke.
struct BreakUp {
  Real defect = 0, drift = 0, broken = 0, links = 0;
};
BreakUp break_up(LawConfig const& law, Real poisson_ratio, bool voronoi, Real cfl) {
  SolidConfig config = testing::one_material(1, 1, poisson_ratio);
  config.body.push_back(testing::box({-2, -2, -2}, {2, 2, 2}, {4, 4, 4}));
  if (voronoi) {
    config.body[0].tessellation = "voronoi";
    config.body[0].particles = 64;
    config.body[0].lloyd = 5;
  }
  config.body[0].spin = {0.01, 0.02, 0.03};
  config.motion.cfl = cfl;
  config.fracture.emplace().law.push_back(law);
  auto const alone = parallel::serial();
  constexpr std::size_t windows = 6;
  Real const span = 80;
  BreakingSolid body(config, 3, windows * span, *alone);
  for (Index p = 0; p < body.solid.owned(); ++p) {
    Vec3 const x = body.mesh.particle(body.solid.id(p)).centre;
    body.solid.motion()[static_cast<std::size_t>(p)].v += Vec3{0.03 * x.x, 0.04 * x.y, 0.05 * x.z};
  }
  body.start();
  Real mean[windows] = {}, steps[windows] = {};
  while (!body.simulation.finished()) {
    body.simulation.pair();
    auto const window = static_cast<std::size_t>(min(body.simulation.clock().time / span, windows - 1));
    mean[window] += body.ledger().conservation().energy_final;
    ++steps[window];
  }
  Real low = 1e300, high = -1e300;  // after the first window, in which the body breaks up
  for (std::size_t w = 1; w < windows; ++w) low = min(low, mean[w] / steps[w]), high = max(high, mean[w] / steps[w]);
  return {body.ledger().conservation().energy, high - low, body.broken(), static_cast<Real>(body.solid.links())};
}

TEST(Fracture, BreakUpKeepsTheAccountToTheOscillationOfVerlet) {
  LawConfig brittle = testing::stress_law(0.02, 0.8);
  brittle.weibull = Weibull{6, 1, 9};
  LawConfig soft;
  soft.cohesive.emplace();
  soft.cohesive->tensile_strength = 0.02;
  soft.cohesive->toughness = 5e-4;
  soft.weibull = Weibull{6, 1, 9};
  struct Case {
    char const* name;
    LawConfig law;
    Real nu;
    bool voronoi;
  };
  for (Case const& c : {Case{"brittle", brittle, 0.3, false}, Case{"brittle voronoi", brittle, 0.45, true},
                        Case{"cohesive voronoi", soft, 0.2, true}}) {
    // Breaks fall on other instants with another step, so the defects follow dt^2 within a factor.
    for (Real cfl : {0.4, 0.2, 0.1}) {
      if (cfl < 0.2 && !evidence::full()) break;
      BreakUp const now = break_up(c.law, c.nu, c.voronoi, cfl);
      std::string const variant = std::string(c.name) + " cfl " + figure(cfl);
      EXPECT_GT(now.broken, 0.9 * now.links);
      EXPECT_TRUE(evidence::at_most("S25", "account of a break-up", variant, "largest |H + D - H_0| / H_0 over cfl^2",
                                    now.defect / (cfl * cfl), 0.012));
      EXPECT_TRUE(evidence::at_most("S25", "account of a break-up", variant,
                                    "spread of five later means over the largest", now.drift / now.defect, 0.01));
    }
  }
}

}  // namespace
}  // namespace brisance::solid
