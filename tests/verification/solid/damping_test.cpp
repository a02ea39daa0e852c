// Damping towards rest (theory/solid.md section 10) and S29: static stretch of spinning bodies.
#include "core/solid/damping/damping.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/solid/gauges/probe.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

using testing::box;
using testing::Lone;
using testing::one_material;

DampingConfig viscous(Real rate) {
  DampingConfig damping;
  damping.rate = rate;
  return damping;
}

DampingConfig kinetic() {
  DampingConfig damping;
  damping.law = "kinetic";
  return damping;
}

/// A lone solid with damping, stepped as the plan does it.
struct Damped : Lone {
  Damping damping;
  bool decays;
  Damped(SolidConfig const& config, DampingConfig const& of, int dimension = 3)
      : Lone(config, dimension), damping(of, config, solid, *comm), decays(of.rate.has_value()) {}
  void step(Real dt) {
    if (decays) damping.half_decay(dt);
    solid.step(dt);
    if (decays)
      damping.half_decay(dt);
    else
      damping.stop_at_maximum();
  }
};

/// Hangs from a clamped face at x = 0 under gravity along x.
SolidConfig hanging(Real nu, Index cells) {
  SolidConfig config = one_material(1, 1, nu);
  config.body.push_back(box({0, 0, 0}, {10, 1, 1}, {cells, 1, 1}));
  if (nu == 0)
    config.body[0].clamp.push_back({{0, 0, 0}, {0, 1, 1}});
  else
    config.body[0].symmetry.push_back({{0, 0, 0}, {0, 1, 1}});  // the end may contract
  config.gravity = Vec3{1e-4, 0, 0};
  return config;
}

TEST(Damping, AHangingBarFindsItsStaticLength) {
  for (bool decay : {true, false}) {
    std::string const variant = decay ? "viscous" : "kinetic";
    Index const cells = 20;
    Real const h = 10.0 / cells, g = 1e-4, omega = std::numbers::pi / 20;
    Damped bar(hanging(0, cells), decay ? viscous(2 * omega) : kinetic());
    Real const dt = bar.solid.stable_step();
    auto shadow = [&] {  // theory/solid.md section 10: what Verlet adds to the energy of linear forces
      Real sum = 0;
      for (Index p = 0; p < bar.solid.owned(); ++p)
        sum += norm2(bar.solid.internal()[static_cast<std::size_t>(p)].force + Vec3{g * h, 0, 0}) / h;
      return dt * dt / 8 * sum;
    };
    auto potential = [&] { return -g * bar.measure().vector(Measures::first_moment).x; };
    Real const start = bar.energy() + potential() - shadow();
    for (int n = 0; n < (decay ? 1200 : 2000); ++n) bar.step(dt);
    Real const end = bar.energy() + potential() - shadow();
    // Every cell hangs on the half links above it; the weight below a face stretches half a cell on either side.
    Real worst = 0, exact_place = 0;
    for (Index c = 0; c < cells; ++c) {
      Real const below = g * (10 - c * h);
      exact_place += below * (c == 0 ? h / 2 : h);
      for (Index p = 0; p < cells; ++p)
        if (std::abs(bar.mesh.particle(p).centre.x - (c + 0.5) * h) < 1e-9)
          worst = max(worst, std::abs(bar.solid.pose()[static_cast<std::size_t>(p)].x.x -
                                      bar.mesh.particle(p).centre.x - exact_place));
    }
    Real const tip = exact_place + g * h * h / 8, exact = g * 100 / 2;
    EXPECT_TRUE(evidence::at_most("S29", "hanging bar", variant, "largest displacement error over the elongation",
                                  worst / exact, 1e-10));
    EXPECT_NEAR(tip / exact, 1, 1e-3);
    EXPECT_TRUE(evidence::at_most("S29", "hanging bar", variant, "energy left unaccounted over dissipated",
                                  std::abs(end - start + bar.damping.dissipated()) / bar.damping.dissipated(), 1e-11));
    // Half of the work of gravity; Verlet adds dt^2/8 sum |F|^2/m of the start, a thousandth.
    EXPECT_TRUE(evidence::near("S29", "hanging bar", variant, "dissipated over the elastic energy",
                               bar.damping.dissipated() / bar.energy(), 1, 2e-3));
  }
}

TEST(Damping, EndsAtTheResidualOrTheTime) {
  DampingConfig how = kinetic();
  how.residual = 1e-6;
  Damped bar(hanging(0.3, 8), how);
  Real const dt = bar.solid.stable_step();
  int steps = 0;
  for (; steps < 2000 && !bar.damping.over(0); ++steps) {
    bar.step(dt);
    bar.damping.watch_residual();
  }
  EXPECT_LT(steps, 1000);
  EXPECT_EQ(bar.measure().value(Measures::kinetic), 0);  // what comes next starts from rest
  for (Wrench const& w : bar.solid.internal()) EXPECT_LT(norm(w.force + Vec3{1e-4 * 1.25, 0, 0}), 1e-6 * 1e-3);
  DampingConfig timed = viscous(1);
  timed.until = 3.0;
  Damping const damping(timed, {}, bar.solid, *bar.comm);
  EXPECT_FALSE(damping.over(2.9));
  EXPECT_TRUE(damping.over(3.0));
}

TEST(Damping, ViscousDecayOfRigidMotionIsExact) {
  SolidConfig config = one_material(1, 1, 0.3);
  config.body.push_back(box({0, 0, 0}, {1, 1, 1}, {1, 1, 1}));
  config.body[0].velocity = {0.3, 0.2, 0.1};
  Damped cube(config, viscous(0.7));
  for (int n = 0; n < 50; ++n) cube.step(0.1);
  EXPECT_NEAR(norm(cube.solid.motion()[0].v - std::exp(-3.5) * Vec3{0.3, 0.2, 0.1}), 0, 1e-15);
  EXPECT_NEAR(cube.damping.dissipated() + cube.energy(), 0.07, 1e-15);
}

TEST(Damping, RelativeToBodiesKeepsTheirMomentum) {
  for (int dimension : {3, 2}) {
    SolidConfig config = one_material(1, 1, 0.3);
    config.body.push_back(box({0, 0, 0}, {4, 2, 1}, {4, 2, 1}));
    config.body[0].velocity = {0.02, -0.01, 0};
    config.body[0].spin = {0.01, 0, 0.03};
    config.body[0].initial_velocity.push_back({Vec3{2, 0, 0}, {}, {0.05, 0, 0}});
    DampingConfig how = viscous(0.5);
    how.relative_to = "bodies";
    Damped brick(config, how, dimension);
    auto const before = brick.measure();
    Real const energy = brick.energy();
    for (int n = 0; n < 400; ++n) brick.step(0.2);
    auto const after = brick.measure();
    Real const scale = before.value(Measures::momentum_scale);
    EXPECT_NEAR(norm(after.vector(Measures::momentum) - before.vector(Measures::momentum)) / scale, 0, 1e-14);
    EXPECT_NEAR(norm(after.vector(Measures::angular) - before.vector(Measures::angular)) / scale, 0, 1e-13);
    EXPECT_NEAR((brick.energy() - energy + brick.damping.dissipated()) / energy, 0, 1e-3);
    EXPECT_GT(after.value(Measures::kinetic), 1e-3);
  }
}

/// Stretch of a free rod that turns about its middle, over the exact value.
Real spinning_rod(Index cells) {
  Real const a = 5, omega = 1e-2 / a;
  SolidConfig config = one_material(1, 1, 0);
  config.body.push_back(box({-a, -0.05, -0.05}, {a, 0.05, 0.05}, {cells, 1, 1}));
  config.body[0].spin = {0, 0, omega};
  DampingConfig how = kinetic();
  how.relative_to = "bodies";
  Damped rod(config, how);
  Real const dt = rod.solid.stable_step();
  int const steps = static_cast<int>(12 * 2 * a / dt);
  for (int n = 0; n < steps; ++n) rod.step(dt);
  // Length between the end faces, which are free: u(a) = rho omega^2 a^3 / 3E with the omega that is left.
  Real lowest = 0, highest = 0, spin = 0;
  Vec3 left{}, right{};
  for (Index p = 0; p < rod.solid.owned(); ++p) {
    Real const x = rod.mesh.particle(p).centre.x;
    Pose const& pose = rod.solid.pose()[static_cast<std::size_t>(p)];
    if (x < lowest) lowest = x, left = pose.x - rotate(pose.q, {a / cells, 0, 0});
    if (x > highest) highest = x, right = pose.x + rotate(pose.q, {a / cells, 0, 0});
    spin = rod.solid.omega_of(p, rod.solid.motion()[static_cast<std::size_t>(p)].spin).z;
  }
  return (0.5 * norm(right - left) - a) / (spin * spin * a * a * a / 3);
}

/// Growth of the radius of a spinning ring in the plane, over the exact value.
Real spinning_ring(Index cells) {
  Real const omega = 1e-2;
  SolidConfig config = one_material(1, 1, 0);
  BodyConfig ring;
  ring.material = "m";
  ring.shape = "tube";
  ring.tessellation = "polar";
  ring.cells = {1, cells, 1};
  ring.centre = Vec3{0, 0, 0};
  ring.inner_radius = 0.98, ring.outer_radius = 1.02;
  ring.spin = {0, 0, omega};
  config.body.push_back(ring);
  DampingConfig how = kinetic();
  how.relative_to = "bodies";
  Damped body(config, how, 2);
  Real const dt = body.solid.stable_step();
  int const steps = static_cast<int>(20 / dt);
  for (int n = 0; n < steps; ++n) body.step(dt);
  Real radius = 0, before = 0, spin = 0;
  for (Index p = 0; p < body.solid.owned(); ++p) {
    Vec3 const now = body.solid.pose()[static_cast<std::size_t>(p)].x, then = body.mesh.particle(p).centre;
    radius += std::hypot(now.x, now.y) / cells;
    before += std::hypot(then.x, then.y) / cells;
    spin = body.solid.omega_of(p, body.solid.motion()[static_cast<std::size_t>(p)].spin).z;
  }
  return (radius / before - 1) / (spin * spin * before * before);
}

TEST(Damping, SpinningRodAndRingComeToTheirStaticStretch) {
  Real const rod10 = spinning_rod(20), rod20 = spinning_rod(40);
  EXPECT_TRUE(
      evidence::near("S29", "spinning rod", "20 cells per half", "u(a) 3E / (rho omega^2 a^3)", rod20, 1, 0.01));
  EXPECT_TRUE(evidence::at_most("S29", "spinning rod", "20 over 10 cells per half", "ratio of errors",
                                std::abs(rod20 - 1) / std::abs(rod10 - 1), 1 / 3.3));
  // A ring of equal wedges stretches exactly; what is left is its thickness, (t/R)^2/12 = 1.3e-4.
  for (Index const cells : {20, 40})
    EXPECT_TRUE(evidence::near("S29", "spinning ring", std::to_string(cells) + " cells", "u E / (rho omega^2 R^3)",
                               spinning_ring(cells), 1, 3e-4));
}

SolidGaugeConfig gauge(std::string const& watch) {
  SolidGaugeConfig g;
  g.name = "g";
  g.watch = watch;
  g.interval = 1;
  return g;
}

TEST(Probes, ReadAHangingBar) {
  Index const cells = 20;
  Damped bar(hanging(0.3, cells), kinetic());
  Real const dt = bar.solid.stable_step();
  for (int n = 0; n < 2500; ++n) bar.step(dt);
  Real const g = 1e-4;
  auto sums = [&](Probe const& probe) {
    std::array<parallel::ExactSum, 6> all;
    probe.add(bar.solid, all);
    return probe.columns(all, 3);
  };
  SolidGaugeConfig support = gauge("support");
  EXPECT_NEAR(sums(Probe(support, bar.solid))[0] / (-g * 10), 1, 1e-9);
  SolidGaugeConfig section = gauge("section");
  section.position = Vec3{4.1, 0.5, 0.5};
  section.normal = Vec3{2, 0, 0};
  EXPECT_NEAR(sums(Probe(section, bar.solid))[0] / (g * 6), 1, 1e-9);  // between the cells at 3.75 and 4.25
  section.normal = Vec3{-1, 0, 0};
  section.position = Vec3{4.1, -2, 0.5};
  auto const below = sums(Probe(section, bar.solid));  // of the part above on the part below, and its arm of 2.5
  EXPECT_NEAR(below[0] / (-g * 6), 1, 1e-9);
  EXPECT_NEAR(below[5] / (2.5 * g * 6), 1, 1e-9);

  SolidGaugeConfig particle = gauge("particle");
  particle.position = Vec3{4.3, 0.5, 0.5};
  auto const values = Probe(particle, bar.solid).values(bar.solid);
  auto const names = columns(particle, 3);
  ASSERT_EQ(values.size(), names.size());
  auto of = [&](std::string const& name) {
    return values[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
  };
  EXPECT_NEAR(of("stress_xx") / (g * 5.75), 1, 1e-9);
  EXPECT_NEAR(of("stress_yy") / (g * 5.75), 0, 1e-9);
  EXPECT_NEAR(of("strain_xx") / (g * 5.75), 1, 1e-9);
  EXPECT_NEAR(of("strain_yy") / (g * 5.75), -0.3, 1e-9);
  EXPECT_NEAR(of("rotation_x"), 0, 1e-12);
  EXPECT_NEAR(of("displacement_x") / (g * (10 * 4.25 - 4.25 * 4.25 / 2)), 1, 2e-3);

  SolidGaugeConfig surface = gauge("surface");
  surface.position = Vec3{4.25, 1.2, 0.5};
  auto const side = Probe(surface, bar.solid).values(bar.solid);
  EXPECT_NEAR(side[1] / (-0.3 * g * 5.75 * 0.5), 1, 1e-9);  // the side moves in although the particle does not
}

TEST(Probes, SurfaceOfALoadedPatch) {
  // S4: uniaxial stress; the centre of every face moves as the continuum does.
  SolidConfig config = one_material(1, 1, 0.45);
  config.body.push_back(box({0, 0, 0}, {3, 2, 2}, {3, 2, 2}));
  config.body[0].symmetry = {{{0, 0, 0}, {0, 2, 2}}, {{0, 0, 0}, {3, 0, 2}}, {{0, 0, 0}, {3, 2, 0}}};
  Lone patch(config);
  Real const stress = 1e-3;
  std::vector<FaceLoad> loads;
  for (FreeFace const& f : patch.mesh.free_faces)
    if (!f.clamped && patch.mesh.face(f.particle, f.face).normal.x > 0.5)
      loads.push_back({f.particle, f.face, {stress, 0, 0}});
  patch.solid.load_faces(loads);
  for (Index p = 0; p < patch.solid.owned(); ++p) {
    Vec3 const x = patch.mesh.particle(p).centre;
    patch.solid.pose()[static_cast<std::size_t>(p)].x = x + stress * Vec3{x.x, -0.45 * x.y, -0.45 * x.z};
  }
  patch.solid.compute_forces();
  for (Wrench const& w : patch.solid.internal()) EXPECT_NEAR(norm(w.force) / stress, 0, 1e-11);
  for (Vec3 const& place : {Vec3{3, 0.5, 1.5}, Vec3{1.5, 2, 0.5}, Vec3{0.5, 1.5, 2}}) {
    SolidGaugeConfig surface = gauge("surface");
    surface.position = place;
    auto const u = Probe(surface, patch.solid).values(patch.solid);
    EXPECT_NEAR(norm(Vec3{u[0], u[1], u[2]} - stress * Vec3{place.x, -0.45 * place.y, -0.45 * place.z}) / stress, 0,
                1e-11);
  }
  SolidGaugeConfig particle = gauge("particle");
  particle.position = Vec3{2.5, 1.5, 1.5};
  particle.quantities = {"strain", "stress"};
  auto const v = Probe(particle, patch.solid).values(patch.solid);
  std::array<Real, 6> const exact{stress, -0.45 * stress, -0.45 * stress, 0, 0, 0};
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR((v[c] - exact[c]) / stress, 0, 1e-11);
  EXPECT_NEAR(v[6] / stress, 1, 1e-11);
  EXPECT_NEAR(v[7] / stress, 0, 1e-11);
}

}  // namespace
}  // namespace brisance::solid
