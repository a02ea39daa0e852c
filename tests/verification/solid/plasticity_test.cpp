// S30 of theory/solid.md section 19, and the gradient, the balance and the account with plastic strain.
#include <gtest/gtest.h>

#include "tests/support/ductile_solid.hpp"
#include "tests/support/evidence.hpp"

namespace brisance::solid {
namespace {

using testing::DuctileSolid;
using testing::Random;

SolidConfig bar(std::array<Index, 3> const& cells, Real nu, PlasticityConfig const& plasticity) {
  SolidConfig config = testing::one_material(1, 1, nu);
  config.material["m"].plasticity = plasticity;
  config.body.push_back(testing::box({0, 0, 0}, {1.0 * cells[0], 1.0 * cells[1], 1.0 * cells[2]}, cells));
  return config;
}

/// Distance of the outermost particles along x over that of the reference state, less 1.
Real elongation(DuctileSolid const& body) {
  Real low = 1e300, high = -1e300, first = 1e300, last = -1e300;
  for (Index p = 0; p < body.solid.owned(); ++p) {
    Real const x = body.solid.pose()[static_cast<std::size_t>(p)].x.x, start = body.mesh.particle(p).centre.x;
    low = min(low, x), high = max(high, x), first = min(first, start), last = max(last, start);
  }
  return (high - low) / (last - first) - 1;
}

TEST(Plasticity, UniaxialBarHardensAndUnloads) {
  Real const yield = 1e-3, saturation = 1e-3, b = 200, pull = 3000, largest = 0.018;
  PlasticityConfig plasticity;
  plasticity.yield_stress = yield;
  plasticity.voce = {saturation, b};
  for (auto const& cells : {std::array<Index, 3>{6, 1, 1}, {6, 2, 2}, {6, 3, 2}})
    for (Real nu : {0.0, 0.3, 0.45}) {
      auto const comm = parallel::serial();
      DuctileSolid body(bar(cells, nu, plasticity), 3, 1e9, *comm);
      body.start();
      auto const stress_of = [&](Real p) { return yield - saturation * std::expm1(-b * p); };
      auto const load_until = [&](Real duration, auto const& stress) {
        Real const from = body.simulation.clock().time;
        while (body.simulation.clock().time - from < duration) {
          Real const s = (body.simulation.clock().time - from) / duration;
          body.pull(stress(s * s * (3 - 2 * s)));  // a sudden end of the ramp would make the bar flow on
          body.simulation.pair();
          body.slow(0.01);
        }
      };
      std::string const variant = std::to_string(cells[0]) + "x" + std::to_string(cells[1]) + "x" +
                                  std::to_string(cells[2]) + " nu " + std::to_string(nu).substr(0, 4);
      load_until(150, [&](Real s) { return s * yield; });
      Real worst = 0;
      for (int part = 1; part <= 4; ++part) {
        Real const from = largest * (part - 1) / 4, to = largest * part / 4;
        load_until(pull / 4, [&](Real s) { return stress_of(from + s * (to - from)); });
        load_until(400, [&](Real) { return stress_of(to); });
        worst = max(worst, std::abs(elongation(body) / (stress_of(to) + to) - 1));
      }
      EXPECT_TRUE(evidence::at_most("S30", "plastic bar", variant, "relative error of e(sigma)", worst, 5e-3));
      Real const top = stress_of(largest), stretched = elongation(body);
      load_until(150, [&](Real s) { return top * (1 - 0.75 * s); });
      load_until(300, [&](Real) { return 0.25 * top; });
      Real const slope = 0.75 * top / (stretched - elongation(body));
      EXPECT_TRUE(evidence::near("S30", "plastic bar", variant, "unloading slope / E", slope, 1, 5e-3));
      // Every particle has seen the same.
      Real spread = 0;
      for (PlasticState const& s : body.plasticity().state()) spread = max(spread, std::abs(s.p / largest - 1));
      EXPECT_TRUE(evidence::at_most("S30", "plastic bar", variant, "spread of p over particles", spread, 5e-3));
    }
}

/// A quarter of a bar with two planes of symmetry flows as the whole bar does.
TEST(Plasticity, AQuarterBetweenMirrorsFlowsAsTheWhole) {
  PlasticityConfig linear;
  linear.yield_stress = 1e-3;
  linear.linear = {0.03};
  auto const comm = parallel::serial();
  SolidConfig const whole = bar({6, 4, 4}, 0.3, linear);
  SolidConfig quarter = bar({6, 2, 2}, 0.3, linear);
  quarter.body[0].symmetry = {{{-1, 2, -1}, {7, 2, 5}}, {{-1, -1, 2}, {7, 5, 2}}};
  DuctileSolid a(whole, 3, 1e9, *comm), b(quarter, 3, 1e9, *comm);
  a.start();
  b.start();
  for (int n = 0; n < 400; ++n)
    for (DuctileSolid* body : {&a, &b}) {
      body->pull(1.4e-3 * min(1.0, n / 100.0));
      body->simulation.pair();
    }
  EXPECT_EQ(a.simulation.clock().time, b.simulation.clock().time);
  Real worst = 0, flowed = 0;
  for (Index q = 0; q < b.solid.owned(); ++q)
    for (Index p = 0; p < a.solid.owned(); ++p) {
      if (norm(a.mesh.particle(p).centre - b.mesh.particle(q).centre) > 1e-9) continue;
      auto const i = static_cast<std::size_t>(p), j = static_cast<std::size_t>(q);
      worst = max(worst, norm(a.solid.pose()[i].x - b.solid.pose()[j].x));
      worst = max(worst, std::abs(a.plasticity().state()[i].p - b.plasticity().state()[j].p));
      flowed = max(flowed, a.plasticity().state()[i].p);
    }
  EXPECT_GT(flowed, 1e-3);
  EXPECT_TRUE(evidence::at_most("S30", "quarter of a bar between mirrors", "nu 0.3",
                                "largest difference from the whole", worst, 1e-11));
}

/// A bar one cell wide, brought slowly from one stress to the next.
class Testing {
 public:
  explicit Testing(PlasticityConfig const& plasticity, Real nu)
      : body_(bar({6, 1, 1}, nu, plasticity), 3, 1e9, *comm_) {
    body_.start();
  }
  void load(Real stress, Real duration = 1500) {
    Real const from = body_.simulation.clock().time, before = stress_;
    while (body_.simulation.clock().time - from < duration + 300) {
      Real const s = min((body_.simulation.clock().time - from) / duration, 1);
      body_.pull(stress_ = before + s * s * (3 - 2 * s) * (stress - before));
      body_.simulation.pair();
      body_.slow(0.01);
    }
  }
  Real strain() const { return elongation(body_); }
  Real p() { return body_.plasticity().state()[3].p; }

 private:
  std::unique_ptr<parallel::Comm> comm_ = parallel::serial();
  DuctileSolid body_;
  Real stress_ = 0;
};

TEST(Plasticity, BackStressGivesClosedLoops) {
  PlasticityConfig prager;
  prager.yield_stress = 1e-3;
  prager.kinematic_modulus = 0.02;
  Testing bar(prager, 0.3);
  Real const top = 1.6e-3, plastic = (top - 1e-3) / (1.5 * 0.02);
  bar.load(top);
  EXPECT_TRUE(evidence::near("S30", "cyclic bar, Prager", "first pull", "e over exact", bar.strain() / (top + plastic),
                             1, 5e-3));
  Real const once = bar.p();
  bar.load(top - 1.98e-3);  // the way back is elastic for twice the yield stress, wherever it begins
  EXPECT_TRUE(
      evidence::near("S30", "cyclic bar, Prager", "unloading", "p over that of the pull", bar.p() / once, 1, 1e-12));
  for (int half = 1; half <= 4; ++half) {
    Real const sign = half % 2 ? -1 : 1;
    bar.load(sign * top);
    std::string const variant = "half cycle " + std::to_string(half);
    EXPECT_TRUE(evidence::near("S30", "cyclic bar, Prager", variant, "e over exact",
                               bar.strain() / (sign * (top + plastic)), 1, 5e-3));
    EXPECT_TRUE(evidence::near("S30", "cyclic bar, Prager", variant, "p over exact",
                               bar.p() / (plastic * (1 + 2 * half)), 1, 5e-3));
  }
}

TEST(Plasticity, IsotropicHardeningKeepsWhatItGained) {
  PlasticityConfig linear;
  linear.yield_stress = 1e-3;
  linear.linear = {0.03};
  Testing bar(linear, 0.3);
  bar.load(1.6e-3);
  Real const once = bar.p();
  bar.load(-1.58e-3, 3000);
  EXPECT_TRUE(
      evidence::near("S30", "cyclic bar, isotropic", "way back", "p over that of the pull", bar.p() / once, 1, 1e-12));
}

/// The middle of a heavy block that is stretched in one direction at a given rate.
struct Middle {
  Real stress, p, rate, temperature;
};
Middle stretch_fast(Real rate, bool hot) {
  PlasticityConfig cook;
  cook.yield_stress = 1e-3;
  cook.johnson_cook = {1e-3, 0.5, 0.1, 1e-3, 1, 300, 1300};
  if (hot) cook.heating = {2e-19, 0.9, 300};
  SolidConfig config = bar({5, 5, 5}, 0.3, cook);
  config.material["m"].density = 1e12;  // waves have no time to leave
  auto const comm = parallel::serial();
  Real const duration = 0.05 / rate;
  DuctileSolid body(config, 3, duration, *comm, std::vector<int>(125, 0), duration / 2000);
  Index middle = 0;
  for (Index p = 0; p < body.solid.owned(); ++p) {
    Vec3 const x = body.mesh.particle(p).centre;
    body.solid.motion()[static_cast<std::size_t>(p)].v.x = rate * x.x;
    if (norm(x - Vec3{2.5, 2.5, 2.5}) < 0.1) middle = p;
  }
  body.start();
  PlasticState const& state = body.plasticity().state()[static_cast<std::size_t>(middle)];
  Real before = 0, then = 0;
  while (!body.simulation.finished()) {
    if (body.simulation.clock().time < 0.98 * duration) before = state.p, then = body.simulation.clock().time;
    body.simulation.pair();
  }
  return {equivalent(body.plasticity().stress(middle)), state.p, (state.p - before) / (duration - then),
          state.temperature};
}

TEST(Plasticity, FastFlowIsHarderAndHeatsItself) {
  for (bool hot : {false, true})
    for (Real rate : {1e-3, 1.0, 1e3}) {
      if (hot && rate != 1) continue;
      Middle const middle = stretch_fast(rate, hot);
      Real const law = (1e-3 + 1e-3 * std::sqrt(middle.p)) * (1 + 0.1 * std::log(std::max(middle.rate / 1e-3, 1.0))) *
                       (hot ? 1 - (middle.temperature - 300) / 1000 : 1);
      std::string const variant = (hot ? "heated, rate " : "rate ") + std::to_string(rate).substr(0, 8);
      EXPECT_TRUE(evidence::near("S30", "block at a rate, Johnson-Cook", variant, "stress over law",
                                 middle.stress / law, 1, 5e-3));
      EXPECT_GT(middle.p, 0.02);
      if (hot) {
        EXPECT_GT(middle.temperature, 400);
      }
    }
}

/// Plastic strains of a few per cent, poses off by 0.3 h and 1 rad.
void scatter(Solid& solid, Random& random) {
  for (Pose& p : solid.pose()) {
    p.x += 0.3 * random.vector();
    p.q = testing::rotation(random.vector());
  }
  for (Index p = 0; p < solid.count(); ++p) {
    Symmetric e;
    for (double& c : e.c) c = 0.05 * random();
    solid.plastic().set_strain(p, deviator(e));
  }
  solid.plastic().follow();
}

SolidConfig block(Real nu, bool voronoi) {
  PlasticityConfig plasticity;
  plasticity.yield_stress = 1e-3;
  SolidConfig config = bar({3, 3, 2}, nu, plasticity);
  if (voronoi) {
    config.body[0].tessellation = "voronoi";
    config.body[0].particles = 18;
    config.body[0].lloyd = 3;
  }
  config.body[0].clamp.push_back({{0, -1, -1}, {0, 4, 4}});
  return config;
}

Real elastic(DuctileSolid& body) {
  body.solid.compute_forces();
  Measures m;
  body.solid.measure(m);
  return m.value(Measures::elastic);
}

/// -dE/ds by sixth-order differences; `change` must be able to go back.
template <class Change>
Real slope(DuctileSolid& body, Change change) {
  Real const h = 2e-3;
  Solid::Saved saved;
  body.solid.save(saved);
  std::vector<Symmetric> const strain(body.solid.plastic().strain().begin(), body.solid.plastic().strain().end());
  auto back = [&] {
    body.solid.restore(saved);
    for (Index p = 0; p < body.solid.count(); ++p)
      body.solid.plastic().set_strain(p, strain[static_cast<std::size_t>(p)]);
    body.solid.plastic().follow();
  };
  auto at = [&](Real s) {
    back();
    change(s);
    body.solid.plastic().follow();
    return elastic(body);
  };
  Real const value = -(45 * (at(h) - at(-h)) - 9 * (at(2 * h) - at(-2 * h)) + (at(3 * h) - at(-3 * h))) / (60 * h);
  back();
  return value;
}

/// What stands around the block of the test of the gradient.
enum class Around { nothing, wall_and_damage, symmetry, period };

TEST(Plasticity, ForcesAndDrivingStressAreTheGradientOfTheEnergy) {
  for (bool voronoi : {false, true})
    for (Real nu : {-0.6, 0.3, 0.48})
      for (Around around : {Around::nothing, Around::wall_and_damage, Around::symmetry, Around::period}) {
        bool const damaged = around == Around::wall_and_damage;
        if (voronoi && around == Around::period) continue;
        auto const comm = parallel::serial();
        SolidConfig config = block(nu, voronoi);
        BodyConfig& box = config.body[0];
        if (!damaged) box.clamp.clear();  // so that the sums vanish
        if (around == Around::symmetry) box.symmetry = {{{0, -1, -1}, {0, 4, 4}}, {{-1, 0, -1}, {4, 0, 4}}};
        if (around == Around::period) box.periodic = {"y", "z"};
        DuctileSolid body(config, 3, 1, *comm);
        Solid& solid = body.solid;
        Random random(11);
        scatter(solid, random);
        body.pull(0.02);
        if (damaged) {
          solid.allow_damage();
          for (std::size_t k = 0; k < solid.links(); k += 3) solid.weaken(k, 0.5 + 0.5 * random());
        }
        solid.compute_forces();
        std::vector<Wrench> const exact(solid.internal().begin(), solid.internal().end());
        std::vector<Symmetric> driving(static_cast<std::size_t>(solid.owned()));
        solid.driving_stress(driving);
        std::vector<Wrench> loads(exact.size());
        for (FreeFace const& f : body.mesh.free_faces) {
          FaceGeometry const& face = body.mesh.face(f.particle, f.face);
          if (std::abs(face.normal.x) < 0.5 || f.clamped) continue;
          auto const at = static_cast<std::size_t>(f.particle);
          Vec3 const force = rotate(solid.pose()[at].q, Vec3{0.02 * face.area * face.normal.x, 0, 0});
          loads[at].force += force;
          loads[at].torque += cross(rotate(solid.pose()[at].q, face.centroid), force);
        }
        Real error = 0, scale = 0, stress_error = 0, stress_scale = 0;
        Vec3 force{}, torque{};
        for (Index p = 0; p < solid.owned(); ++p) {
          auto const at = static_cast<std::size_t>(p);
          for (int d = 0; d < 3; ++d) {
            Vec3 unit{};
            unit[d] = 1;
            Real const f = slope(body, [&](Real s) { solid.pose()[at].x += s * unit; });
            Real const m = slope(body, [&](Real s) {
              Quaternion& q = solid.pose()[at].q;
              q = testing::rotation(s * unit) * q;
            });
            error = max(error, max(std::abs(f + loads[at].force[d] - exact[at].force[d]),
                                   std::abs(m + loads[at].torque[d] - exact[at].torque[d])));
            scale = max(scale, max(std::abs(exact[at].force[d]), std::abs(exact[at].torque[d])));
          }
          for (std::size_t c = 0; c < 6; ++c) {
            Real const s = slope(body, [&](Real ds) {
              Symmetric e = solid.plastic().strain()[at];
              e.c[c] += ds;
              solid.plastic().set_strain(p, e);
            });
            Real const got = (c < 3 ? 1 : 2) * driving[at].c[c];
            stress_error = max(stress_error, std::abs(s - got));
            stress_scale = max(stress_scale, std::abs(got));
          }
          force += exact[at].force - loads[at].force;
          torque += exact[at].torque - loads[at].torque + cross(solid.pose()[at].x, exact[at].force - loads[at].force);
        }
        std::string const with = damaged                      ? "damaged "
                                 : around == Around::symmetry ? "two mirrors "
                                 : around == Around::period   ? "periodic "
                                                              : "";
        std::string const variant =
            "plastic " + with + (voronoi ? "voronoi nu " : "cartesian nu ") + std::to_string(nu).substr(0, 5);
        EXPECT_TRUE(evidence::at_most("S1", "gradient", variant, "max |F + grad E| / max |F|", error / scale, 1e-8));
        EXPECT_TRUE(evidence::at_most("S1", "gradient", variant, "max |V s + dE/de| / max |V s|",
                                      stress_error / stress_scale, 1e-8));
        if (around != Around::nothing) continue;
        EXPECT_TRUE(evidence::at_most("S3", "balance", variant, "|sum F| / max |F|", norm(force) / scale, 1e-13));
        EXPECT_TRUE(
            evidence::at_most("S3", "balance", variant, "|sum x x F + M| / max |F|", norm(torque) / scale / 3, 1e-13));
      }
}

/// Links that break give up what the energy loses at fixed positions, and every one something.
TEST(Plasticity, DuctileBreaksReleaseEnergy) {
  for (Real nu : {-0.9, 0.0, 0.3, 0.48}) {
    PlasticityConfig brittle;
    brittle.yield_stress = 1e-3;
    brittle.failure.emplace();
    brittle.failure->d1 = 1e-6, brittle.failure->d2 = 0.5, brittle.failure->d3 = -3;
    SolidConfig config = block(nu, true);
    config.material["m"].plasticity = brittle;
    auto const comm = parallel::serial();
    DuctileSolid body(config, 3, 1, *comm);
    body.start();
    Random random(5);
    for (Index p = 0; p < body.solid.owned(); ++p) {
      Pose& pose = body.solid.pose()[static_cast<std::size_t>(p)];
      pose.x += 0.02 * random.vector();
      pose.q = testing::rotation(0.02 * random.vector());
    }
    int breaks = 0;
    Real worst = 0;
    for (int n = 0; n < 20; ++n) {
      for (Pose& p : body.solid.pose().first(static_cast<std::size_t>(body.solid.owned())))
        p.x += 2e-3 * random.vector();
      body.plasticity().flow(0.1);
      body.solid.compute_forces();
      body.plasticity().settle();
      Real const before = elastic(body), lost = body.plasticity().dissipated().value();
      if (!body.plasticity().fail()) continue;
      ++breaks;
      Real const released = body.plasticity().dissipated().value() - lost, after = elastic(body);
      EXPECT_GT(released, 0);
      worst = max(worst, std::abs(before - after - released) / before);
      body.plasticity().settle();
    }
    EXPECT_GT(breaks, 2);
    EXPECT_TRUE(evidence::at_most("S25", "ductile breaks", "nu " + std::to_string(nu).substr(0, 4),
                                  "|released - change of E| / E", worst, 1e-13));
  }
}

/// In the plane the limit load of a perfectly plastic bar is 2/sqrt(3) of its yield stress: the sides of the slab hold.
TEST(Plasticity, LimitLoadInPlaneStrain) {
  PlasticityConfig perfect;
  perfect.yield_stress = 1e-3;
  for (Real share : {0.98, 1.02}) {
    auto const comm = parallel::serial();
    SolidConfig config = bar({6, 2, 1}, 0.3, perfect);
    DuctileSolid body(config, 2, 3000, *comm);
    body.start();
    Real const top = share * 2 / std::sqrt(3.0) * 1e-3;
    while (!body.simulation.finished()) {
      Real const s = min(body.simulation.clock().time / 1500, 1);
      body.pull(top * s * s * (3 - 2 * s));
      body.simulation.pair();
      body.slow(0.02);
    }
    Real const elastic_strain = top * (1 - 0.09);
    if (share < 1) {
      EXPECT_TRUE(evidence::at_most("S30", "bar in plane strain", "0.98 of the limit load", "e over its elastic part",
                                    elongation(body) / elastic_strain, 3));
    } else {
      EXPECT_GT(elongation(body) / elastic_strain, 10);
    }
  }
}

TEST(Plasticity, TurningABodyTurnsNothingElse) {
  auto const comm = parallel::serial();
  SolidConfig config = block(0.3, true);
  config.body[0].clamp.clear();  // its wall does not turn
  DuctileSolid a(config, 3, 1, *comm), b(config, 3, 1, *comm);
  Quaternion const turn = testing::rotation({0.3, -1.1, 0.7});
  Random random(5);
  a.start(), b.start();
  for (Index p = 0; p < a.solid.owned(); ++p) {
    auto const at = static_cast<std::size_t>(p);
    Pose& pose = a.solid.pose()[at];
    pose.x += 0.02 * random.vector();
    pose.q = testing::rotation(0.02 * random.vector());
    b.solid.pose()[at] = {rotate(turn, pose.x) + Vec3{0.5, -2, 1}, 0, turn * pose.q};
  }
  for (DuctileSolid* s : {&a, &b}) {
    s->plasticity().flow(0.1);
    s->solid.compute_forces();
    s->plasticity().settle();
  }
  Real error = 0, scale = 0;
  for (Index p = 0; p < a.solid.owned(); ++p) {
    auto const at = static_cast<std::size_t>(p);
    error = max(error, std::abs(a.plasticity().state()[at].p - b.plasticity().state()[at].p));
    scale = max(scale, a.plasticity().state()[at].p);
  }
  EXPECT_GT(scale, 1e-3);
  EXPECT_TRUE(
      evidence::at_most("S2", "objectivity", "plastic", "relative change of p of a turned body", error / scale, 1e-12));
}

/// Largest |change of kinetic + elastic + stored - in + dissipated| over the initial energy.
Real impact_defect(Real cfl, Real& plastic, Real& dissipated, Real& stored) {
  PlasticityConfig plasticity;
  plasticity.yield_stress = 2e-3;
  plasticity.linear = {0.02};
  plasticity.kinematic_modulus = 0.02;
  SolidConfig config = bar({12, 3, 3}, 0.3, plasticity);
  config.motion.cfl = cfl;
  config.body[0].velocity = {-0.01, 0, 0};
  config.body[0].clamp.push_back({{0, -1, -1}, {0, 4, 4}});
  auto const comm = parallel::serial();
  DuctileSolid body(config, 3, 120, *comm);
  body.start();
  while (!body.simulation.finished()) body.simulation.pair();
  plastic = 0;
  for (PlasticState const& s : body.plasticity().state()) plastic = max(plastic, s.p);
  Real const initial = 0.5 * 12 * 9 * 1e-4;
  dissipated = body.ledger().received(Entry::dissipated) / initial;
  stored = body.ledger().total(Entry::solid_stored) / initial;
  return body.ledger().conservation().energy;
}

TEST(Plasticity, ImpactOnAWallKeepsItsAccount) {
  Real plastic, dissipated, stored;
  Real const coarse = impact_defect(0.8, plastic, dissipated, stored);
  EXPECT_GT(plastic, 5e-3);
  EXPECT_GT(dissipated, 0.3);
  EXPECT_GT(stored, 0.02);
  Real const fine = impact_defect(0.4, plastic, dissipated, stored);
  EXPECT_TRUE(evidence::at_most("S30", "impact of a bar on a wall", "cfl 0.8", "energy defect", coarse, 2e-2));
  EXPECT_TRUE(
      evidence::at_most("S30", "impact of a bar on a wall", "cfl 0.4 over 0.8", "energy defect", fine / coarse, 0.35));
}

}  // namespace
}  // namespace brisance::solid
