// V11: an elastic shell between hot and cold gas: the error of the energy is of second order in the step and does not
// drift (theory/coupling.md sections 1.7, 7).
#include <gtest/gtest.h>

#include "tests/support/evidence.hpp"
#include "tests/support/nd_scene.hpp"

namespace brisance {
namespace {

using namespace testing;

std::string scene(Real end_time, Real motion_cfl, std::string const& wall_pressure, std::string const& of_body = "") {
  return "end_time = " + quantity(end_time, "s") +
         "\n[fluid]\nlow = [\"-0.5 m\", \"-0.5 m\"]\nhigh = [\"0.5 m\", \"0.5 m\"]\ncells = [60, 60]\nambient = " +
         gas_state(1.4, 1, {}) +
         "\neuler = { order = 11, cfl = 0.5 }\n[[fluid.region]]\nshape = \"ball\"\ncentre = [\"0.13 m\", \"0.05 m\"]\n"
         "radius = \"0.1 m\"\ndensity = \"11.2 kg/m3\"\npressure = \"8 Pa\"\n[solid]\nlinks = {}\nmotion = { cfl = " +
         digits(motion_cfl) +
         " }\n[solid.material.shell]\ndensity = \"50 kg/m3\"\nyoung_modulus = \"2500 Pa\"\npoisson_ratio = 0.0\n"
         "[[solid.body]]\nmaterial = \"shell\"\nshape = \"tube\"\ntessellation = \"polar\"\ncentre = [\"0 m\", \"0 "
         "m\"]\n"
         "inner_radius = \"0.25 m\"\nouter_radius = \"0.28 m\"\ncells = [1, 50]\nphase = \"0.013 rad\"\n" +
         of_body +
         "[coupling]\nsub_steps = 1\n"
         "cut_cells = { wall_pressure = \"" +
         wall_pressure + "\" }\n";
}

/// The fraction of the solid's stable step that makes the step of the run `dt`: the solid limits it, so it is constant.
Real cfl_for(Real dt) {
  CoupledCase c(scene(1, 1, "half_riemann"));
  return dt / c.world->solid->stable_step();
}

constexpr Real step = 1.4e-3;

/// Runs 500 steps of 1.4e-3, and as long with shorter ones; returns the largest energy defect of each run.
std::vector<Real> defects(std::string const& wall_pressure) {
  Real const cfl = cfl_for(step);
  std::vector<Real> defect;
  for (Real const part : evidence::full() ? std::vector<Real>{1, 2, 4} : std::vector<Real>{1, 2}) {
    CoupledCase c(scene(500 * step, cfl / part, wall_pressure));
    c.run();
    EXPECT_NEAR(c.simulation().statistics().dt_max, step / part, 1e-3 * step);
    defect.push_back(c.conservation().energy);
    EXPECT_TRUE(evidence::at_most("V11", "elastic shell", wall_pressure + "; dt = 1.4e-3/" + digits(part),
                                  "exchange energy defect", c.conservation().exchange_energy, 1e-12));
  }
  for (std::size_t i = 1; i < defect.size(); ++i)
    EXPECT_TRUE(evidence::near("V11", "elastic shell", wall_pressure + "; halved step " + std::to_string(i),
                               "order of the energy defect", std::log2(defect[i - 1] / defect[i]), 2, 0.3));
  return defect;
}

TEST(ElasticShell, EnergyErrorFallsAsTheSquareOfTheStep) {
  std::vector<Real> const defect = defects("half_riemann");
  for (std::size_t i = 0; i < defect.size(); ++i) {
    Real const part = static_cast<Real>(1 << i);
    EXPECT_TRUE(evidence::at_most("V11", "elastic shell", "half_riemann; dt = 1.4e-3/" + digits(part),
                                  "largest energy defect", defect[i], 2.3e-7 / (part * part)));
  }
}

TEST(ElasticShell, CellPressureHasTheSameOrder) {
  if (!evidence::full()) GTEST_SKIP() << "full suite only";
  defects("cell");
}

TEST(ElasticShell, EnergyDoesNotDrift) {
  std::int64_t const steps = evidence::full() ? 100000 : 4254;
  // In the long run one particle is held, so that the shell does not drift out of the domain.
  CoupledCase c(scene(1.01 * step * static_cast<Real>(steps), cfl_for(step), "half_riemann",
                      evidence::full() ? "hold = [{ low = [0.24, -0.02], high = [0.29, 0.02] }]\n" : ""));
  // Means of the energy defect over ten windows of the run.
  std::vector<Real> sum(10, 0), count(10, 0);
  c.run(steps, [&] {
    auto const window = static_cast<std::size_t>(std::min<std::int64_t>(9, 10 * c.step() / steps));
    sum[window] += c.conservation().energy_final;
    count[window] += 1;
  });
  Real early = 0;
  for (std::size_t w = 0; w < 5; ++w) early = max(early, std::abs(sum[w] / count[w]));
  std::string const variant = "half_riemann; " + std::to_string(steps) + " steps";
  EXPECT_TRUE(
      evidence::at_most("V11", "elastic shell", variant, "largest energy defect", c.conservation().energy, 3.8e-7));
  EXPECT_TRUE(evidence::at_most("V11", "elastic shell", variant,
                                "mean defect of the last tenth over the largest of the first five",
                                std::abs(sum[9] / count[9]) / early, 1));
}

}  // namespace
}  // namespace brisance
