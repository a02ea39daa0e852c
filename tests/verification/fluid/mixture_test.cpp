// Detonation products beside air: contacts that must stay silent, a strong tube against the exact solution, sound
// speeds, conservation (theory/fluid.md 1.4, F29).
#include <gtest/gtest.h>

#include <cmath>

#include "fluid/advance.hpp"
#include "fluid/cell_state.hpp"
#include "fluid/flux/mixture_cell.hpp"
#include "fluid/totals.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/flow_case.hpp"
#include "tests/support/mixture_tube.hpp"
#include "tests/support/riemann.hpp"

namespace brisance::testing {
namespace {

using fluid::Mixture;
using fluid::MixtureState;

std::string variant(int order) { return "order " + std::to_string(order); }

struct Contact {
  char const* name;
  Mixture mixture;
  double density1, density2, velocity, pressure, end_time;
  double limit;  // of |p/p0 - 1|: the theory's figures with blending
};

TEST(MixtureContact, KeepsPressureAndMasses) {
  Contact const contacts[] = {
      {"Gamma 0.3/0.4", ideal_pair(0.3, 0.4), 10, 1, 1, 1, 1, 9e-13},
      {"JWL/air", tnt_in(1.4, 1.2, 1e5), 100, 1.2, 1000, 1e6, 1e-3, 9e-13},
      {"Gamma 0.667/0.4", ideal_pair(0.667, 0.4), 1, 0.1, 1, 1, 1, 9e-13},
      // "grows from rounding" to 0.8 with an average that is not an exact Roe average in alpha
      {"Gamma 0.667/0.2", ideal_pair(0.667, 0.2), 1, 0.1, 1, 1, 1, 9e-13},
  };
  for (Contact const& c : contacts)
    for (int const order : {1, 5, 11}) {
      MixtureTube tube(100, c.mixture, true);
      for (int i = 0; i < tube.size(); ++i)
        tube.cell(i) = c.mixture.conserved(i >= 25 && i < 75, c.density1, c.density2, {c.velocity, 0, 0}, c.pressure);
      MixtureState const before = tube.total();
      tube.pressure_scale = c.pressure;
      tube.run(order, c.end_time, 0.8);
      MixtureState const after = tube.total();
      EXPECT_EQ(tube.health, 0u);
      EXPECT_TRUE(evidence::at_most("F29", c.name, variant(order), "largest |p/p0 - 1|", tube.pressure_error, c.limit));
      double worst = 0;
      for (std::size_t const q : {0, 1, 4, 5}) worst = std::max(worst, std::abs(after[q] / before[q] - 1));
      EXPECT_TRUE(evidence::at_most("F29", c.name, variant(order), "conservation", worst, 1e-14));
    }
}

struct Strong {
  char const *id, *name;
  Primitive products, air;
  double x0, end_time;
};

struct TubeResult {
  double error, conservation;
};

TubeResult run_tube(Strong const& s, int n, int order) {
  Mixture const mixture = tnt_in(1.4, s.air.density, s.air.pressure);
  RiemannProblem const exact(s.products, s.air, mixture.products, mixture.ambient);
  MixtureTube tube(n, mixture, false);
  for (int i = 0; i < n; ++i)
    tube.cell(i) = (i + 0.5) * tube.h() < s.x0 ? mixture.conserved(1, s.products.density, 1, {}, s.products.pressure)
                                               : mixture.conserved(0, 1, s.air.density, {}, s.air.pressure);
  MixtureState const before = tube.total();
  tube.run(order, s.end_time, 0.8, {.hybrid = true});
  EXPECT_EQ(tube.health, 0u);
  MixtureState const after = tube.total();
  TubeResult result{0, 0};
  for (int i = 0; i < n; ++i) {
    MixtureState const& x = tube.cell(i);
    EXPECT_GE(x[6], -1e-11);
    EXPECT_LE(x[6], 1 + 1e-11);
    EXPECT_GE(x[5], -1e-11 * x[0]);
    EXPECT_GE(x[0] - x[5], -1e-11 * x[0]);
    EXPECT_GT(mixture.thermal_energy(x), 0);
    result.error +=
        tube.h() * std::abs(x[0] - exact.mean_density(i * tube.h() - s.x0, (i + 1) * tube.h() - s.x0, s.end_time));
  }
  for (std::size_t const q : {0, 4, 5})
    result.conservation = std::max(result.conservation, std::abs(after[q] / before[q] - 1));
  return result;
}

Strong const f29b{"F29b", "JWL 1630 kg/m3 | air", {1630, 0, 8.3837e9}, {1.1845467, 0, 101325}, 0.3, 4e-5};

TEST(StrongTube, HasTheStarStateOfTheory) {
  Mixture const mixture = tnt_in(1.4, 1.2, 1e5);
  RiemannProblem const exact(f29b.products, f29b.air, mixture.products, mixture.ambient);
  EXPECT_NEAR(exact.star_pressure(), 2.513177e7, 10);
  EXPECT_NEAR(exact.star_velocity(), 4186.44, 0.01);
}

TEST(StrongTube, IsBetterThanTheTable) {
  // The theory's own scheme: L1 5.79, 4.96, 4.95 at 400 cells, 2.52, 2.23, 2.27 at 1600, first order whatever the
  // order. Levels: measured, plus 10 %.
  struct Row {
    int order;
    double at400, at1600;
  };
  for (Row const& row : {Row{1, 6.5, 2.8}, {5, 1.49, 0.48}, {11, 1.4, 0.48}})
    for (int const n : evidence::full() ? std::vector<int>{400, 1600} : std::vector<int>{400}) {
      TubeResult const result = run_tube(f29b, n, row.order);
      EXPECT_TRUE(evidence::at_most(f29b.id, f29b.name, variant(row.order), "L1 density N=" + std::to_string(n),
                                    result.error, n == 400 ? row.at400 : row.at1600));
      EXPECT_TRUE(evidence::at_most(f29b.id, f29b.name, variant(row.order), "conservation N=" + std::to_string(n),
                                    result.conservation, 2e-14));
    }
}

/// One substance alone is as good as in the kernel of one gas: the figures of theory/fluid.md 8.2.
TEST(OneSubstance, IsAsGoodAsTheTable) {
  struct Row {
    Strong tube;
    bool products;
    double table[3];
  };
  Row const rows[] = {
      {{"F18c", "air blast; as a mixture", {99.9, 0, 50662500}, {1.1845467, 0, 101325}, .5, 3e-4},
       false,
       {.905, .179, .168}},
      {{"F17a", "JWL TNT; as a mixture", {1630, 0, 8e9}, {100, 0, 1e7}, .5, 4e-5}, true, {6.93, 1.89, 1.68}},
  };
  for (Row const& row : rows)
    for (int o = 0; o < 3; ++o) {
      int const order = o == 0 ? 1 : o == 1 ? 5 : 11, n = 200;
      Strong const& s = row.tube;
      Mixture const mixture = tnt_in(1.4, s.air.density, s.air.pressure);
      fluid::Gas const& gas = row.products ? mixture.products : mixture.ambient;
      RiemannProblem const exact(s.products, s.air, gas);
      MixtureTube tube(n, mixture, false);
      for (int i = 0; i < n; ++i) {
        Primitive const& side = (i + 0.5) * tube.h() < s.x0 ? s.products : s.air;
        tube.cell(i) = mixture.conserved(row.products, side.density, side.density, {}, side.pressure);
      }
      tube.run(order, s.end_time, 0.9, {.hybrid = true});
      EXPECT_EQ(tube.health, 0u);
      double error = 0;
      for (int i = 0; i < n; ++i)
        error += tube.h() * std::abs(tube.cell(i)[0] -
                                     exact.mean_density(i * tube.h() - s.x0, (i + 1) * tube.h() - s.x0, s.end_time));
      EXPECT_TRUE(evidence::at_most(s.id, s.name, variant(order), "L1 density N=200", error, 1.1 * row.table[o]));
    }
}

/// Products that have expanded, as they meet air a few radii away from a charge.
TEST(ModerateTube, ConvergesToTheExactSolution) {
  Strong const s{"F29c", "JWL 100 kg/m3 | air", {100, 0, 3e7}, {1.1845467, 0, 101325}, 0.4, 2e-4};
  for (int const order : {1, 5, 11}) {
    double const coarse = run_tube(s, 100, order).error, fine = run_tube(s, 400, order).error;
    EXPECT_TRUE(evidence::at_most(s.id, s.name, variant(order), "L1 density N=400", fine,
                                  order == 1   ? 0.55
                                  : order == 5 ? 0.13
                                               : 0.117));
    EXPECT_TRUE(evidence::at_most(s.id, s.name, variant(order), "L1 N=400 over N=100", fine / coarse,
                                  order == 1 ? 0.52 : 0.34));
  }
}

MixtureState const samples[] = {
    tnt_in(1.4, 1, 1e5).conserved(0.3, 120, 5, {300, -20, 7}, 2e7),
    tnt_in(1.4, 1, 1e5).conserved(1, 1630, 1, {0, 0, 0}, 8.38e9),
    tnt_in(1.4, 1, 1e5).conserved(0, 1, 1.2, {0, 0, 0}, 1e5),
    tnt_in(1.4, 1, 1e5).conserved(0.9, 900, 20, {-1500, 0, 3}, 3e9),
};

TEST(MixtureState, SoundSpeedIsTheSlopeOfPressureAtFrozenFraction) {
  Mixture const mixture = tnt_in(1.4, 1, 1e5);
  for (MixtureState const& x : samples) {
    double const p = mixture.pressure(x), c = mixture.sound_speed(x);
    // both densities change by the same share, and dp does work on both: d(rho e) = (rho e + p) d(rho)/rho
    auto const compressed = [&](double share) {
      MixtureState y = x;
      double const internal = mixture.internal_energy(x), kinetic = x[4] - internal;
      for (std::size_t const q : {0, 1, 2, 3, 5}) y[q] *= 1 + share;
      y[4] = internal + (internal + p) * share + kinetic * (1 + share);
      return mixture.pressure(y);
    };
    double const step = 1e-5, slope = (compressed(step) - compressed(-step)) / (2 * step * x[0]);
    EXPECT_TRUE(
        evidence::near("F29", "sound speed", "frozen fraction", "c^2 over its difference", c * c / slope, 1, 1e-7));
  }
}

TEST(MixtureState, TheSweepSeesTheSamePressureAndSoundSpeed) {
  Mixture const mixture = tnt_in(1.4, 1, 1e5);
  for (MixtureState const& x : samples) {
    fluid::MixtureCell<double> one;
    fluid::MixtureCell<fluid::Pack> many;
    for (std::size_t q = 0; q < 7; ++q) one.state[q] = x[q], many.state[q] = fluid::Pack(x[q]);
    primitives(one, fluid::MixtureConstants<double>(mixture, 1));
    primitives(many, fluid::MixtureConstants<fluid::Pack>(mixture, 1));
    double const p = mixture.pressure(x), c = mixture.sound_speed(x);
    EXPECT_NEAR(one.pressure, p, 1e-12 * p);
    EXPECT_NEAR(one.sound, c, 1e-12 * c);
    EXPECT_NEAR(many.pressure.get(3), p, 1e-12 * p);
    EXPECT_NEAR(many.sound.get(3), c, 1e-12 * c);
  }
}

/// The state of theory/fluid.md 1.2 for a given pressure is found again.
TEST(MixtureState, PressureIsInvertedExactly) {
  Mixture const mixture = tnt_in(1.4, 1, 1e5);
  for (double const fraction : {0.0, 1e-6, 0.5, 1.0})
    for (double const p : {1e5, 3e6, 9e9})
      EXPECT_NEAR(mixture.pressure(mixture.conserved(fraction, 100, 4, {100, 0, 0}, p)), p,
                  1e-12 * p + 1e-15 * mixture.conserved(fraction, 100, 4, {100, 0, 0}, p)[4]);
}

fluid::FlowConfig products_box(int dimension, int cells) {
  fluid::FlowConfig config = unit_box(dimension, cells);
  config.products.emplace();
  config.ambient.density = 1.2;
  config.ambient.pressure = 1e6;
  config.euler->cfl = 0.8;
  return config;
}

TEST(DiagonalContact, KeepsPressureInThreeDimensions) {
  auto const alone = parallel::serial();
  for (int const order : {1, 5, 11}) {
    fluid::FlowConfig config = products_box(3, 16);
    config.euler->order = order;
    config.block = 8;
    set_boundaries(config, "periodic");
    auto const flow = make_flow(config, *alone);
    Mixture const& mixture = *flow->mixture();
    for (fluid::Block& block : flow->blocks())
      for (Index k = 0; k < block.size()[2]; ++k)
        for (Index j = 0; j < block.size()[1]; ++j)
          for (Index i = 0; i < block.size()[0]; ++i) {
            fluid::CellIndex const c = block.first();
            Vec3 const x = flow->grid().centre({c[0] + i, c[1] + j, c[2] + k}) - Vec3{0.45, 0.5, 0.55};
            block.store_mixture(i, j, k, mixture.conserved(norm(x) < 0.3, 100, 1.2, {700, -900, 1000}, 1e6));
          }
    double const mass = totals(*flow).products;
    fluid::FlowClock clock;
    advance(*flow, clock, {.end = 1e-3, .cfl = 0.8, .steps = 40});
    double worst = 0;
    for (fluid::Block const& block : flow->blocks())
      for (Index k = 0; k < block.size()[2]; ++k)
        for (Index j = 0; j < block.size()[1]; ++j)
          for (Index i = 0; i < block.size()[0]; ++i)
            worst = std::max(worst, std::abs(fluid::CellState(*flow, block, i, j, k).pressure() / 1e6 - 1));
    EXPECT_TRUE(evidence::at_most("F29", "JWL/air; 3D diagonal", variant(order), "largest |p/p0 - 1|", worst, 1e-11));
    EXPECT_NEAR(totals(*flow).products, mass, 1e-13 * mass);
  }
}

}  // namespace
}  // namespace brisance::testing
