// F27c and F27d of theory/fluid.md 8.4: a shear wave and Taylor-Green vortices decay as they should.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fluid/initial_state.hpp"
#include "tests/support/evidence.hpp"
#include "tests/support/fluid_run.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::fluid {
namespace {

constexpr Real turn = 2 * std::numbers::pi;

FlowConfig periodic_box(int dimension, int cells, int order, Real viscosity) {
  FlowConfig config = testing::unit_box(dimension, cells);
  testing::set_boundaries(config, "periodic");
  config.euler->order = order;
  config.euler->cfl = 0.9;
  config.viscosity.emplace();
  config.viscosity->law = "constant";
  config.viscosity->dynamic_viscosity = viscosity;
  config.gas.gas_constant = 1;
  return config;
}

std::string variant(int order, int cells, std::string const& more = "") {
  return "order " + std::to_string(order) + ", " + std::to_string(cells) + " cells" + more;
}

/// F27d: v = 0.1 sin(2 pi x) carried by u = 0.5: amplitude at t = 1 over the exact one, minus 1.
Real shear_wave(int order, int cells, std::string const& time = "strang") {
  FlowConfig config = periodic_box(1, cells, order, 0.02);
  config.viscosity->time = time;
  testing::FluidRun run(config, 1, testing::comm());
  Gas const& gas = run.flow->gas();
  fill(*run.flow, [&](CellIndex c) {
    return testing::gauss_mean(run.flow->grid(), c, [&](Vec3 const& x) {
      return gas.conserved(1, {0.5, 0.1 * std::sin(turn * x.x), 0}, std::atof(std::getenv("PP")));
    });
  });
  run.run();
  Real sine = 0, cosine = 0;
  run.for_cells([&](CellIndex c, State const& u) {
    Real const x = run.flow->grid().centre(c).x;
    sine += u[2] * std::sin(turn * x), cosine += u[2] * std::cos(turn * x);
  });
  // Cell means of a sine are sinc(pi / N) times its values.
  Real const mean_factor = std::sin(0.5 * turn / cells) / (0.5 * turn / cells);
  Real const amplitude = 2.0 / cells * std::hypot(sine, cosine) / mean_factor;
  return amplitude / (0.1 * std::exp(-0.02 * turn * turn)) - 1;
}

TEST(ShearWave, Explore) {
  for (int order : {1, 3, 5, 11})
    for (int n : {16, 32, 64}) std::printf("F27d %d %d %.3e\n", order, n, shear_wave(order, n));
  for (int n : {16, 32, 64}) std::printf("F27d lie 5 %d %.3e\n", n, shear_wave(5, n, "lie"));
}

}  // namespace
}  // namespace brisance::fluid
