// S16 of theory/solid.md section 19: Lamb's problem, a vertical force on the surface of a half space.
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "core/solid/loads/history.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/solid_run.hpp"

namespace brisance::solid {
namespace {

/// Vertical displacement of the surface under a unit step force, in units of F0 (1 - nu) / (2 pi mu r), nu = 1/4.
/// Source: theory/solid.md section 19.  `tau` = c_s t / r.
struct LambStep {
  Real a2 = 1.0 / 3;  // (c_s / c_p)^2
  std::array<Real, 3> x;
  std::array<Real, 3> amplitude;
  LambStep() {
    // Roots of 16 (1 - a2) x^3 - 8 (3 - 2 a2) x^2 + 8 x - 1 = 0, all real for nu = 1/4.
    x = {(3 + std::sqrt(3.0)) / 4, (3 - std::sqrt(3.0)) / 4, 0.25};
    for (std::size_t j = 0; j < 3; ++j) {
      Real const k = x[(j + 1) % 3], l = x[(j + 2) % 3];
      amplitude[j] = (x[j] - 0.5) * (x[j] - 0.5) / ((x[j] - k) * (x[j] - l));
    }
  }
  Real pole() const { return std::sqrt(x[0]); }
  Real before_s(Real tau) const {
    Real sum = 0;
    for (std::size_t j = 0; j < 3; ++j)
      sum += amplitude[j] * std::sqrt(std::complex<Real>((a2 - x[j]) / (tau * tau - x[j]))).real();
    return 0.5 * (1 - sum);
  }
  /// Regular part times 1/sqrt(pole^2 - tau^2) left out: 1 - weight() / sqrt(pole^2 - tau^2) between S and Rayleigh.
  Real weight() const { return amplitude[0] * std::sqrt(x[0] - a2); }
};

TEST(Lamb, StepSolutionHasItsCheckValues) {
  LambStep const lamb;
  for (auto [tau, value] :
       {std::pair{0.6, -.018957}, {0.7, -.009578}, {0.8, -.010234}, {0.9, -.028501}, {0.95, -.049824}})
    EXPECT_NEAR(lamb.before_s(tau) * 0.375, value, 1e-6);
  for (auto [tau, value] : {std::pair{1.02, -.153468}, {1.05, -.328341}})
    EXPECT_NEAR((1 - lamb.weight() / std::sqrt(lamb.x[0] - tau * tau)) * 0.375, value, 1e-6);
}

/// Displacement at distance r and time t for a force F0 g(t) that rises over `rise`.
Real lamb_displacement(LambStep const& lamb, Real r, Real t, Real rise, Real cs, Real mu) {
  auto const slope = [&](Real tau) {  // dg/dt at the time that is left after tau
    Real const theta = (t - tau * r / cs) / rise;
    return theta <= 0 || theta >= 1 ? 0 : (1 - std::cos(2 * std::numbers::pi * theta)) / rise;
  };
  int const n = 4000;
  Real const a = std::sqrt(lamb.a2), g = lamb.pole(), last = t * cs / r;
  Real sum = 0;
  for (int i = 0; i < n; ++i) {  // midpoints; near P and S the integrand is smooth
    Real const tau = a + (1 - a) * (i + 0.5) / n;
    sum += lamb.before_s(tau) * slope(tau) * (1 - a) / n;
  }
  Real const edge = std::sqrt(1 - 1 / g);  // tau = g (1 - y^2), which takes the pole away
  for (int i = 0; i < n; ++i) {
    Real const y = edge * (i + 0.5) / n, tau = g * (1 - y * y);
    Real const regular = y - lamb.weight() / (g * std::sqrt(2 - y * y));  // (1 - weight / sqrt(g^2 - tau^2)) y
    sum += regular * slope(tau) * 2 * g * edge / n;
  }
  if (last > g)
    for (int i = 0; i < n; ++i) sum += slope(g + (last - g) * (i + 0.5) / n) * (last - g) / n;
  return 0.75 / (2 * std::numbers::pi * mu * r) * sum * r / cs;
}

/// Surface point above a particle: rigid motion and the extension of its upper face (section 7).
Real surface_displacement(Solid const& solid, Mesh const& mesh, GlobalId p, bool corrected) {
  auto const l = static_cast<std::size_t>(solid.local(p));
  Real u = solid.pose()[l].x.z - mesh.particle(p).centre.z;
  if (corrected) u += 0.5 / (2 * mesh.material(p).shear()) * (0 - solid.pressure()[l]);
  return u;
}

struct LambErrors {
  Real axis, diagonal, axis_rigid;
};

LambErrors run_lamb(Index r, Real source) {
  Real const nu = 0.25, mu = 0.4, cs = std::sqrt(mu);
  Index const width = 4 * r + 5 + 4 * (r % 2 == 0 ? 1 : 0), depth = 2 * r + 4;  // 129 x 129 x 64 for r = 30
  Index const half = width / 2;
  SolidConfig config = testing::one_material(1, 1, nu);
  config.body.push_back(testing::box({-half - 0.5, -half - 0.5, -Real(depth)}, {half + 0.5, half + 0.5, 0},
                                     {2 * half + 1, 2 * half + 1, depth}));
  TractionConfig force;
  Real const size = 1e-4;
  force.traction = {0, 0, -size};  // on one face of unit area
  force.low = Vec3{-0.5, -0.5, 0}, force.high = Vec3{0.5, 0.5, 0};
  force.pulse = PulseConfig{"smooth", 0, source / cs, {}};
  config.traction.push_back(force);
  auto const comm = parallel::serial();
  testing::SolidRun run(config, 3, (1.35 * r + source) / cs, *comm);
  run.start();
  Index const side = static_cast<Index>(std::lround(r / std::sqrt(2.0)));
  GlobalId axis = -1, diagonal = -1;
  for (GlobalId p = 0; p < run.mesh.size(); ++p) {
    Vec3 const c = run.mesh.particle(p).centre;
    if (c.z > -1 && std::abs(c.x - r) < 0.1 && std::abs(c.y) < 0.1) axis = p;
    if (c.z > -1 && std::abs(c.x - side) < 0.1 && std::abs(c.y - side) < 0.1) diagonal = p;
  }
  LambStep const lamb;
  Real wrong[3] = {}, all[3] = {};
  while (!run.simulation.finished()) {
    run.simulation.pair();
    Real const t = run.simulation.clock().time;
    Real const at_axis = -size * lamb_displacement(lamb, r, t, source / cs, cs, mu);
    Real const at_diagonal = -size * lamb_displacement(lamb, side * std::sqrt(2.0), t, source / cs, cs, mu);
    Real const exact[3] = {at_axis, at_diagonal, at_axis};
    Real const got[3] = {surface_displacement(run.solid, run.mesh, axis, true),
                         surface_displacement(run.solid, run.mesh, diagonal, true),
                         surface_displacement(run.solid, run.mesh, axis, false)};
    for (int g = 0; g < 3; ++g) {
      wrong[g] += (got[g] - exact[g]) * (got[g] - exact[g]);
      all[g] += exact[g] * exact[g];
    }
  }
  auto const error = [&](int g) { return std::sqrt(wrong[g] / all[g]); };
  return {error(0), error(1), error(2)};
}

TEST(Lamb, SurfaceDisplacementUnderAPointForce) {
  LambErrors const cheap = run_lamb(15, 8);
  EXPECT_TRUE(evidence::at_most("S16", "Lamb", "r = 15, axis", "L2 error, surface points", cheap.axis, 0.04));
  EXPECT_TRUE(evidence::at_most("S16", "Lamb", "r = 15, diagonal", "L2 error, surface points", cheap.diagonal, 0.04));
  if (!evidence::full()) return;
  LambErrors const fine = run_lamb(30, 16);
  EXPECT_TRUE(evidence::at_most("S16", "Lamb", "r = 30, axis", "L2 error, surface points", fine.axis, 0.015));
  EXPECT_TRUE(evidence::at_most("S16", "Lamb", "r = 30, diagonal", "L2 error, surface points", fine.diagonal, 0.015));
  EXPECT_TRUE(evidence::at_most("S16", "Lamb", "r = 30, axis", "L2 error, rigid motion alone", fine.axis_rigid, 0.035));
  EXPECT_GE(cheap.axis / fine.axis, 3.0);
}

}  // namespace
}  // namespace brisance::solid
