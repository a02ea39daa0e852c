// Supports of theory/solid.md section 7: prescribed motion, walls, planes of symmetry, periodic bodies.
#include "core/solid/supports/moving_supports.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/evidence.hpp"
#include "tests/support/solids.hpp"

namespace brisance::solid {
namespace {

using testing::box;
using testing::Lone;
using testing::one_material;
using testing::Random;

constexpr Real pi = std::numbers::pi;

/// A lone solid with its moving supports.
struct Driven : Lone {
  MovingSupports supports{solid};
  Real time = 0;
  explicit Driven(SolidConfig const& config, int dimension = 3) : Lone(config, dimension) {}
  void step(Real dt) {
    supports.set_off(time, dt);
    solid.step(dt);
    supports.arrive(time += dt);
  }
};

DrivenConfig driven(Vec3 const& low, Vec3 const& high, std::vector<TimedMotion> history, Vec3 const& centre = {}) {
  DrivenConfig box{low, high};
  box.history = std::move(history);
  box.centre = centre;
  return box;
}

TEST(RigidMotion, IsTheIntegralOfItsHistory) {
  DrivenConfig const config = driven({}, {},
                                     {{-0.5, {9, 9, 9}, {0.2, 0, 0}},
                                      {0.25, {1, 2, 0}, {0.5, 1, 0}},
                                      {1, {0, 1, -1}, {-1, 0.3, 2}},
                                      {1.2, {0, 0, 3}, {0, 0, -0.4}}},
                                     {1, 1, 2});
  RigidMotion const motion(config, 3);
  RigidMotion::State const start = motion.at(0);
  EXPECT_EQ(start.x, (Vec3{1, 1, 2}));
  EXPECT_EQ(start.q, Quaternion{});
  Vec3 x = start.x;
  Quaternion q;
  int const n = 60000;
  Real const dt = 1.8 / n;
  for (int k = 0; k < n; ++k) {
    RigidMotion::State const middle = motion.at((k + 0.5) * dt);
    x += dt * middle.v;
    q = testing::rotation(dt * middle.omega) * q;
  }
  RigidMotion::State const end = motion.at(1.8);
  EXPECT_NEAR(norm(end.x - x), 0, 1e-8);
  EXPECT_NEAR(norm((conjugate(end.q) * q).v), 0, 1e-9);
  EXPECT_EQ(end.v, (Vec3{0, 0, 3}));
}

TEST(MovingSupports, LeadParticlesToTheirPoseAndBalance) {
  SolidConfig config = one_material(1, 1, 0.3);
  config.body.push_back(box({0, 0, 0}, {5, 2, 2}, {5, 2, 2}));
  std::vector<TimedMotion> const twist{{0, {}, {}}, {4, {0.01, 0, 0.02}, {0.03, 0.01, 0}}, {9, {0, 0.01, 0}, {}}};
  config.body[0].prescribed.push_back(driven({4, 0, 0}, {5, 2, 2}, twist, {4, 1, 1}));
  config.body[0].clamp.push_back(
      driven({0, 0, 0}, {0, 2, 2}, {{0, {}, {}}, {5, {0, 0, 0.01}, {0, 0.02, 0}}}, {0, 1, 1}));
  auto defects = [&](Real dt) {
    Driven bar(config);
    auto const before = bar.measure();
    Real const energy = bar.energy();
    for (int n = 0; n < static_cast<int>(10 / dt + 0.5); ++n) bar.step(dt);
    auto const after = bar.measure();
    Reactions const support = bar.solid.take_reactions();
    Real const scale = after.value(Measures::momentum_scale);
    EXPECT_LT(norm(after.vector(Measures::momentum) - before.vector(Measures::momentum) - support.impulse()),
              1e-14 * scale);
    for (Index const p : bar.solid.held()) {
      Particle const& particle = bar.mesh.particle(bar.solid.id(p));
      RigidMotion const& motion = bar.mesh.motions[static_cast<std::size_t>(particle.motion)];
      RigidMotion::State const now = motion.at(bar.time);
      Pose const& pose = bar.solid.pose()[static_cast<std::size_t>(p)];
      EXPECT_NEAR(norm(pose.x - now.place(particle.centre - motion.centre())), 0, 1e-14);
      EXPECT_NEAR(norm((conjugate(pose.q) * now.q).v), 0, 1e-14);
    }
    return std::abs(bar.energy() - energy - support.work()) / support.work();
  };
  Real const coarse = defects(0.2), fine = defects(0.1);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_NEAR(coarse / fine, 4, 0.6);
}

TEST(MovingSupports, WorkBalancesToRoundingWhereForcesAreLinear) {
  // H - work = dt^2/8 sum |F|^2/m of free particles, exactly (theory/solid.md section 10).
  for (bool wall : {false, true}) {
    SolidConfig config = one_material(1, 1, 0.3);
    config.body.push_back(box({0, 0, 0}, {12, 1, 1}, {12, 1, 1}));
    std::vector<TimedMotion> const push{{0, {}, {}}, {2, {0.02, 0, 0}, {}}, {5, {-0.01, 0, 0}, {}}, {7, {}, {}}};
    if (wall)
      config.body[0].clamp.push_back(driven({0, 0, 0}, {0, 1, 1}, push));
    else
      config.body[0].prescribed.push_back(driven({0, 0, 0}, {1, 1, 1}, push));
    Driven rod(config);
    Real const dt = 0.3;
    auto shadow = [&] {
      Real sum = 0;
      for (Index p = 0; p < rod.solid.owned(); ++p)
        sum += rod.solid.motion()[static_cast<std::size_t>(p)].inverse_mass *
               norm2(rod.solid.internal()[static_cast<std::size_t>(p)].force);
      return dt * dt / 8 * sum;
    };
    Real const before = rod.energy() - shadow();
    for (int n = 0; n < 100; ++n) rod.step(dt);
    Real const work = rod.solid.take_reactions().work();
    EXPECT_GT(work, 1e-5);
    EXPECT_NEAR((rod.energy() - shadow() - before) / work, 1, 1e-11) << wall;
  }
}

/// L2 error of the velocity of a rod whose end moves by a history, against v(t - x/c).
Real wave_error(Index cells, bool wall) {
  SolidConfig config = one_material(1, 1, 0);
  config.body.push_back(box({0, 0, 0}, {40, 1, 1}, {cells, 1, 1}));
  auto velocity = [](Real t) { return t <= 0 || t >= 20 ? 0.0 : 1e-4 * square(std::sin(pi * t / 20)); };
  std::vector<TimedMotion> history;
  for (int k = 0; k <= 400; ++k) history.push_back({k * 0.05, {velocity(k * 0.05), 0, 0}, {}});
  Real const h = 40.0 / cells;
  if (wall)
    config.body[0].clamp.push_back(driven({0, 0, 0}, {0, 1, 1}, history));
  else
    config.body[0].prescribed.push_back(driven({0, 0, 0}, {h, 1, 1}, history));
  Driven rod(config);
  int const steps = static_cast<int>(std::ceil(32 / rod.solid.stable_step()));
  for (int n = 0; n < steps; ++n) rod.step(32.0 / steps);
  Real error = 0, size = 0;
  for (Index p = 0; p < rod.solid.owned(); ++p) {
    Real const x = rod.mesh.particle(rod.solid.id(p)).centre.x - (wall ? 0 : 0.5 * h);
    Real const exact = velocity(32 - x), got = rod.solid.motion()[static_cast<std::size_t>(p)].v.x;
    error += square(got - exact);
    size += square(exact);
  }
  return std::sqrt(error / size);
}

TEST(MovingSupports, DriveTheExactWaveIntoARod) {
  for (bool wall : {false, true}) {
    std::string const variant = wall ? "clamped face" : "first particle";
    Real const coarse = wave_error(40, wall), fine = wave_error(80, wall);
    EXPECT_TRUE(evidence::at_most("S8", "driven rod", variant, "L2 error of the velocity, 80 cells", fine, 5e-3));
    EXPECT_TRUE(evidence::at_most("S8", "driven rod", variant, "error of 80 over 40 cells", fine / coarse, 1 / 3.3));
  }
}

/// -dE/ds of a change, by sixth-order differences.
template <class Change>
Real slope(Lone& body, Change change) {
  Real const h = 2e-3;
  Solid::Saved saved;
  body.solid.save(saved);
  auto energy = [&](Real s) {
    body.solid.restore(saved);
    change(s);
    body.solid.compute_forces();
    return body.measure().value(Measures::elastic);
  };
  Real const value =
      -(45 * (energy(h) - energy(-h)) - 9 * (energy(2 * h) - energy(-2 * h)) + (energy(3 * h) - energy(-3 * h))) /
      (60 * h);
  body.solid.restore(saved);
  return value;
}

TEST(Supports, ForcesAreTheGradientAtMirrorsWallsAndPeriodicSides) {
  SolidConfig config = one_material(1, 1, 0.3);
  BodyConfig body = box({0, 0, 0}, {2, 2, 2}, {2, 2, 2});
  body.periodic = {"x"};
  body.symmetry.push_back({{0, 0, 0}, {2, 0, 2}});
  body.symmetry.push_back({{0, 0, 0}, {2, 2, 0}});
  body.clamp.push_back(driven({0, 0, 2}, {2, 2, 2}, {{0, {0.1, 0.05, -0.1}, {0.2, 0.1, 0.3}}}, {1, 1, 2}));
  config.body.push_back(body);
  BodyConfig pebble = box({5, 0, 0}, {7, 2, 2}, {1, 1, 1});  // poles beside the mass centres
  pebble.name = "pebble";
  pebble.tessellation = "voronoi";
  pebble.particles = 8;
  pebble.symmetry.push_back({{5, 0, 0}, {5, 2, 2}});
  config.body.push_back(pebble);
  BodyConfig oblique;  // a plane of symmetry along no axis
  oblique.name = "oblique";
  oblique.material = "m";
  oblique.shape = "plate";
  oblique.centre = Vec3{6, 5, 5};
  oblique.axis = {0, 1, 1};
  oblique.length = 1.0, oblique.width = 1.0, oblique.thickness = 2.0;
  oblique.cells = {1, 1, 2};
  oblique.symmetry.push_back({{5, 5.2, 5.2}, {7, 6.3, 6.3}});
  config.body.push_back(oblique);
  Lone solid(config);
  EXPECT_LT(solid.measure().value(Measures::elastic), 1e-20);
  EXPECT_EQ(std::count_if(solid.mesh.far_sides.begin(), solid.mesh.far_sides.end(),
                          [](FarSide const& side) { return std::abs(side.vector.y * side.vector.z) > 0.4; }),
            1);
  MovingSupports(solid.solid).place_walls(0.7);
  Random random(5);
  for (Pose& p : solid.solid.pose()) {
    p.x += 0.3 * random.vector();
    p.q = testing::rotation(0.5 * random.vector());
  }
  solid.solid.compute_forces();
  std::vector<Wrench> const exact(solid.solid.internal().begin(), solid.solid.internal().end());
  Real error = 0, scale = 0;
  for (Index p = 0; p < solid.solid.owned(); ++p) {
    auto const at = static_cast<std::size_t>(p);
    for (int d = 0; d < 3; ++d) {
      Vec3 unit{};
      unit[d] = 1;
      Real const f = slope(solid, [&](Real s) { solid.solid.pose()[at].x += s * unit; });
      Real const m = slope(solid, [&](Real s) {
        Quaternion& q = solid.solid.pose()[at].q;
        q = testing::rotation(s * unit) * q;
      });
      error = max(error, max(std::abs(f - exact[at].force[d]), std::abs(m - exact[at].torque[d])));
      scale = max(scale, max(std::abs(exact[at].force[d]), std::abs(exact[at].torque[d])));
    }
  }
  EXPECT_TRUE(evidence::at_most("S1", "gradient", "mirrors, moving wall, periodic", "max |F + grad E| / max |F|",
                                error / scale, 1e-8));
}

TEST(Symmetry, APartMovesAsTheWholeBody) {
  for (int dimension : {2, 3}) {
    bool const deep = dimension == 3;
    auto config_of = [&](bool whole) {
      SolidConfig config = one_material(1, 1, 0.35);
      Index const across = whole ? 4 : 2;
      BodyConfig b = box({0, whole ? -2.0 : 0, whole ? -2.0 : 0}, {5, 2, 2}, {5, across, deep ? across : 1});
      b.clamp.push_back({{0, -2, -2}, {0, 2, 2}});
      b.initial_velocity.push_back({Vec3{3, -9, -9}, Vec3{9, 9, 9}, {0.04, 0, 0}});
      b.initial_velocity.push_back({Vec3{1, 0, -9}, Vec3{9, 9, 9}, {0, 0.05, 0}});
      b.initial_velocity.push_back({Vec3{1, -9, -9}, Vec3{9, 0, 9}, {0, -0.05, 0}});
      b.initial_velocity.push_back({{}, {}, {}, {}, {0, 0, 0, 0, 0, 0, 0, 0, -0.03}});
      if (!whole) b.symmetry.push_back({{0, 0, 0}, {5, 0, 2}});
      if (!whole && deep) b.symmetry.push_back({{0, 0, 0}, {5, 2, 0}});
      config.body.push_back(b);
      return config;
    };
    Real const parts = deep ? 4 : 2;
    Lone whole(config_of(true), dimension), part(config_of(false), dimension);
    Real const dt = whole.solid.stable_step();
    EXPECT_NEAR(part.solid.stable_step() / dt, 1, 1e-12);
    Vec3 const start = part.measure().vector(Measures::momentum);
    for (int n = 0; n < 200; ++n) whole.solid.step(dt), part.solid.step(dt);
    Real largest = 0, turned = 0;
    for (Index p = 0; p < part.solid.owned(); ++p) {
      Vec3 const x = part.mesh.particle(part.solid.id(p)).centre;
      for (Index q = 0; q < whole.solid.owned(); ++q) {
        if (norm(whole.mesh.particle(whole.solid.id(q)).centre - x) > 1e-9) continue;
        Pose const &a = part.solid.pose()[static_cast<std::size_t>(p)],
                   &b = whole.solid.pose()[static_cast<std::size_t>(q)];
        largest = max(largest, max(norm(a.x - b.x), norm((conjugate(a.q) * b.q).v)));
        turned = max(turned, norm(a.q.v));
      }
    }
    EXPECT_GT(turned, 1e-2);  // a case that bends
    EXPECT_LT(largest, 1e-12);
    auto const of_part = part.measure(), of_whole = whole.measure();
    for (auto const item : {Measures::elastic, Measures::kinetic})
      EXPECT_NEAR(of_part.value(item) * parts / of_whole.value(item), 1, 1e-12);
    Reactions const support = part.solid.take_reactions(), all = whole.solid.take_reactions();
    EXPECT_NEAR(parts * support.impulse().x / all.impulse().x, 1, 1e-12);
    EXPECT_LT(norm(of_part.vector(Measures::momentum) - start - support.impulse()), 1e-13);
    EXPECT_EQ(support.work(), 0);
  }
}

/// Frequencies of a standing plane wave in a periodic box, lowest first, with the time error of Verlet taken out.
/// `along`: wave vector in waves per box; `sway`: direction of the motion.
std::array<Real, 2> wave_frequencies(Real nu, Index cells, Vec3 const& along, Vec3 const& sway) {
  SolidConfig config = one_material(1, 1, nu);
  Real const length = cells;
  std::array<Index, 3> n{};
  for (int d = 0; d < 3; ++d) n[static_cast<std::size_t>(d)] = along[d] > 0 ? cells : 2;
  config.body.push_back(box({0, 0, 0}, {Real(n[0]), Real(n[1]), Real(n[2])}, n));
  config.body[0].periodic = {"x", "y", "z"};
  Lone solid(config);
  Vec3 const k = (2 * pi / length) * along, unit = normalized(sway);
  Real const dt = 0.5 * solid.solid.stable_step(), size = 1e-4;
  auto phase = [&](Index p) { return dot(k, solid.mesh.particle(solid.solid.id(p)).centre); };
  for (Index p = 0; p < solid.solid.owned(); ++p) {
    Motion& m = solid.solid.motion()[static_cast<std::size_t>(p)];
    m.v = size * std::cos(phase(p)) * unit;  // starts both branches: a wave and particles that turn on their own
  }
  // The amplitudes a of velocity and spin obey a(n+1) + a(n-1) = T a(n); T has the eigenvalues 2 cos(w_num dt).
  Vec3 const axis = cross(k, unit);
  std::vector<std::array<Real, 2>> a;
  for (int step = 0; step <= 60; ++step) {
    if (step > 0) solid.solid.step(dt);
    std::array<Real, 2> sum{};
    for (Index p = 0; p < solid.solid.owned(); ++p) {
      Motion const& m = solid.solid.motion()[static_cast<std::size_t>(p)];
      sum[0] += dot(m.v, unit) * std::cos(phase(p));
      sum[1] += dot(m.spin, axis) * std::sin(phase(p));
    }
    a.push_back(sum);
  }
  Real xx = 0, xy = 0, yy = 0, ux = 0, uy = 0, vx = 0, vy = 0;
  for (std::size_t i = 1; i + 1 < a.size(); ++i) {
    Real const x = a[i][0], y = a[i][1], u = a[i + 1][0] + a[i - 1][0], v = a[i + 1][1] + a[i - 1][1];
    xx += x * x, xy += x * y, yy += y * y, ux += u * x, uy += u * y, vx += v * x, vy += v * y;
  }
  auto frequency = [&](Real t) { return std::sqrt(max(0, 2 - t)) / dt; };  // sin(w_num dt/2) = w dt/2
  if (norm2(axis) == 0) return {frequency(ux / xx), 0};
  Real const det = xx * yy - xy * xy;
  Real const t11 = (ux * yy - uy * xy) / det, t12 = (uy * xx - ux * xy) / det, t21 = (vx * yy - vy * xy) / det,
             t22 = (vy * xx - vx * xy) / det;
  Real const mean = 0.5 * (t11 + t22), half = std::sqrt(0.25 * square(t11 - t22) + t12 * t21);
  return {frequency(mean + half), frequency(mean - half)};
}

TEST(Periodic, WavesAlongAnAxisHaveTheFrequencyOfTheLattice) {
  for (Real nu : {0.0, 0.25, 0.3, 0.45}) {
    std::vector<Index> const sizes = evidence::full() ? std::vector<Index>{10, 20, 40} : std::vector<Index>{10};
    for (Index const cells : sizes) {
      Real const g = 1 / (2 * (1 + nu)), lame = 2 * g * nu / (1 - 2 * nu);
      Real const s = std::sin(pi / cells), c = std::cos(pi / cells);
      std::string const variant = "nu " + std::to_string(nu).substr(0, 4) + ", " + std::to_string(cells) + " cells";
      Real const p = 2 * s * std::sqrt(2 * g + lame * c * c);
      EXPECT_TRUE(evidence::near("S6", "P wave [100]", variant, "omega over that of the lattice - 1",
                                 wave_frequencies(nu, cells, {1, 0, 0}, {1, 0, 0})[0] / p - 1, 0, 1e-6));
      // Roots of (8 G s^2 - w2)(b - w2/6) = (4 G s c)^2.
      Real const a = 8 * g * s * s, b = 2 * g * (1 + c * c) + s * s / 3, m = 4 * g * s * c;
      Real const sum = a + 6 * b, root = std::sqrt(sum * sum - 24 * (a * b - m * m));
      auto const got = wave_frequencies(nu, cells, {1, 0, 0}, {0, 1, 0});
      EXPECT_TRUE(evidence::near("S7", "S wave [100]", variant, "omega over that of the lattice - 1",
                                 got[0] / std::sqrt(0.5 * (sum - root)) - 1, 0, 1e-6));
      EXPECT_TRUE(evidence::near("S7", "turning mode [100]", variant, "omega over that of the lattice - 1",
                                 got[1] / std::sqrt(0.5 * (sum + root)) - 1, 0, 1e-6));
    }
  }
}

TEST(Periodic, WavesInAllDirectionsHaveTheDispersionOfTheTheory) {
  // c_num/c - 1 = a (kh)^2 + O(kh)^4: from two resolutions, so that the next term drops out.
  struct Case {
    char const* id;
    char const* name;
    Vec3 along, sway;
    bool shear;
    Real nu, a;
  };
  auto p = [](Real nu) { return -1.0 / 24 - nu / (8 * (1 - nu)); };
  std::vector<Case> const cases{{"S6", "P wave [100]", {1, 0, 0}, {1, 0, 0}, false, 0.3, p(0.3)},
                                {"S6", "P wave [110]", {1, 1, 0}, {1, 1, 0}, false, 0.3, p(0.3) / 2},
                                {"S6", "P wave [111]", {1, 1, 1}, {1, 1, 1}, false, 0.3, p(0.3) / 3},
                                {"S7", "S wave [100]", {1, 0, 0}, {0, 1, 0}, true, 0.25, 1.25 / 48},
                                {"S7", "S wave [110], in the plane", {1, 1, 0}, {1, -1, 0}, true, 0.25, -0.0156},
                                {"S7", "S wave [110], out of it", {1, 1, 0}, {0, 0, 1}, true, 0.25, 0.0130},
                                {"S7", "S wave [111]", {1, 1, 1}, {1, -1, 0}, true, 0.25, -0.0104}};
  for (Case const& of : cases) {
    Real const g = 1 / (2 * (1 + of.nu)), lame = 2 * g * of.nu / (1 - 2 * of.nu);
    Real const speed = std::sqrt(of.shear ? g : lame + 2 * g);
    auto coefficient = [&](Index cells) {
      Real const k = 2 * pi * norm(of.along) / cells;
      return (wave_frequencies(of.nu, cells, of.along, of.sway)[0] / (k * speed) - 1) / (k * k);
    };
    Index const n = evidence::full() ? 20 : 12;
    Real const a = (4 * coefficient(2 * n) - coefficient(n)) / 3;
    // 1 %; the theory prints some of them to three figures.
    EXPECT_TRUE(evidence::near(of.id, of.name, "nu " + std::to_string(of.nu).substr(0, 4), "coefficient of (kh)^2", a,
                               of.a, 0.01 * std::abs(of.a)));
  }
}

TEST(InitialVelocity, OfPartsAndLinearInSpace) {
  SolidConfig config = one_material(1, 1, 0);
  config.body.push_back(box({0, 0, 0}, {4, 1, 1}, {4, 1, 1}));
  config.body[0].velocity = {1, 0, 0};
  config.body[0].initial_velocity.push_back({Vec3{0, 0, 0}, Vec3{2, 1, 1}, {0.5, 0, 0}});
  // Turn about z with 2 rad/s and stretch along x with 3 1/s, about (1, 0.5, 0.5).
  config.body[0].initial_velocity.push_back(
      {Vec3{2, 0, 0}, Vec3{4, 1, 1}, {}, {1, 0.5, 0.5}, {3, -2, 0, 2, 0, 0, 0, 0, 0}});
  Lone rod(config);
  for (Index p = 0; p < 4; ++p) {
    Particle const& of = rod.mesh.particle(p);
    bool const first = of.centre.x < 2;
    Real const arm = of.centre.x - 1;
    EXPECT_NEAR(norm(of.velocity - (first ? Vec3{1.5, 0, 0} : Vec3{1 + 3 * arm, 2 * arm, 0})), 0, 1e-14);
    EXPECT_EQ(of.spin, (first ? Vec3{} : Vec3{0, 0, 2}));
  }
}

}  // namespace
}  // namespace brisance::solid
