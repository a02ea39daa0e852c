#include "tests/support/hostile_cases.hpp"

#include <cmath>
#include <random>

#include "tests/support/flow_case.hpp"
#include "tests/support/gases.hpp"
#include "tests/support/regions.hpp"

namespace brisance::testing {

using fluid::CellIndex;
using fluid::Flow;
using fluid::FlowConfig;
using fluid::State;

namespace {

/// A unit box of one gas with the middle and a slanted direction of its dimension.
struct Box {
  int dimension, cells;
  Vec3 present(Vec3 v) const {
    for (int d = dimension; d < 3; ++d) v[d] = 0;
    return v;
  }
  Vec3 middle() const { return present({.5, .5, .5}); }
  Vec3 slanted() const { return normalized(present({1, .7, .4})); }
  FlowConfig config(fluid::GasState const& ambient, fluid::Gas const& gas = ideal_gas(1.4)) const {
    FlowConfig c = unit_box(dimension, cells);
    c.ambient = ambient;
    c.ambient.velocity = present(ambient.velocity);
    c.gas = gas_config(gas);
    return c;
  }
  HardCase named(std::string const& name, FlowConfig config, Real end) const {
    return {"hostile", name + " " + std::to_string(dimension) + "D", std::move(config), end};
  }

  /// Two halves of one gas part (-1) or meet (+1) at Mach 1000, oblique to the grid.
  HardCase halves(std::string const& name, Real sign, bool open, Real end) const {
    Vec3 const v = sign * 1000 * std::sqrt(1.4) * slanted();
    FlowConfig c = config({1, 1, -v});
    c.region = {half_space(middle(), -slanted(), 1, 1, v)};
    if (open) set_boundaries(c, "outflow");
    return named(name, c, end);
  }
  /// One region in an ambient gas.
  HardCase with(std::string const& name, FlowConfig c, fluid::RegionConfig const& r, Real end) const {
    c.region.push_back(r);
    return named(name, std::move(c), end);
  }
  fluid::RegionConfig cell(Vec3 low, Real density, Real pressure) const {
    Real const h = 1.0 / cells;
    return box(low, low + Vec3{h, h, h}, density, pressure);
  }
};

}  // namespace

std::vector<HardCase> hostile_cases(int dimension, int n) {
  Box const b{dimension, n};
  fluid::GasState const air{1, 1, {}}, nothing{0, 0, {}};
  fluid::Gas const water = water_gas(), tnt = tnt_products();
  Vec3 const centre{.5, .5, .5};
  // one cell of energy e reaches the walls after about (1 / e)^(1/2) times what it has to sweep along
  Real const crossing = dimension == 1 ? 1e-6 : dimension == 2 ? 3e-6 : 1e-5;

  std::vector<HardCase> cases;
  cases.push_back(b.halves("Mach 1000 collision", 1, true, 3e-4));
  cases.push_back(b.halves("Mach 1000 rarefaction", -1, true, 3e-4));
  cases.push_back(b.halves("Mach 1000 rarefaction between walls", -1, false, 2e-3));

  FlowConfig with_void = b.config(air);
  with_void.region = {box({0, 0, 0}, {.25, .25, .25}, 0, 0)};
  cases.push_back(
      b.with("pressure ratio 1e10 beside walls and vacuum", with_void, ball({.5, .55, .45}, .15, 1, 1e10), 1.2e-5));
  cases.push_back(b.with("one cell at pressure ratio 1e12", b.config(air), b.cell(centre, 1, 1e12), crossing));
  cases.push_back(
      b.with("one cell at 1e12 in a corner of vacuum", b.config(nothing), b.cell({0, 0, 0}, 1, 1e12), 1e-6));
  FlowConfig cold = b.config({1, 1e-12, {}});
  set_boundaries(cold, "periodic");
  cases.push_back(b.with("one thin cell over cold gas, pressure ratio 1e18", cold, b.cell(centre, 1e-6, 1e6), 2e-3));
  cases.push_back(b.with("cold cloud at Mach 1e5 hits walls", b.config(nothing),
                         ball(centre, .2, 1, 1e-6, b.present({100, 30, 20})), 2e-2));
  cases.push_back(b.with("collapse of a void", b.config(air), ball(centre, .3, 0, 0), 0.5));

  cases.push_back(b.named("water hammer", b.config({1000, 1e5, {-500, -200, -100}}, water), 1e-3));
  cases.push_back(b.with("water hammer with a void", b.config({1000, 1e5, {-3000, -2000, -1000}}, water),
                         box({.2, .2, .2}, {.5, .5, .5}, 0, 0), 2e-4));
  cases.push_back(b.with("drop of water in vacuum", b.config(nothing, water), ball(centre, .3, 1000, 1e5), 1e-4));
  cases.push_back(b.with("water beside gas a million times thinner", b.config({1e-3, 1e5, {}}, water),
                         ball(centre, .3, 1000, 1e9), 2e-6));

  cases.push_back(
      b.with("detonation products into vacuum", b.config(nothing, tnt), ball(centre, .2, 1630, 8.384e9), 6e-5));
  cases.push_back(
      b.with("detonation products into thin ones", b.config({1, 1e5, {}}, tnt), ball(centre, .2, 1630, 8.384e9), 1e-4));
  FlowConfig decades = b.config({1e-3, 1e-2, {}}, tnt);
  decades.region = {box({.5, .5, .5}, {1, 1, 1}, 0, 0)};
  cases.push_back(b.with("detonation products over 12 decades, walls, void", decades,
                         box({0, 0, 0}, {.25, .25, .25}, 1630, 5e10), 5e-5));
  cases.push_back(
      b.named("detonation products hit walls", b.config({1630, 8.384e9, {-5000, -3000, -2000}}, tnt), 5e-5));
  return cases;
}

HardCase random_box(int dimension, int n, unsigned seed, std::int64_t steps, fluid::Gas const& gas) {
  Box const b{dimension, n};
  bool const stiff = gas.curve.stiffness > 0, products = gas.curve.exponential();
  std::string const what = stiff ? "water" : products ? "detonation products" : "gas";
  // the state that sets what counts as vacuum
  fluid::GasState const ambient = gas.curve.zero() ? fluid::GasState{1, 1, {}} : fluid::GasState{1000, 1e10, {}};
  FlowConfig config = b.config(ambient, gas);
  set_boundaries(config, "periodic");
  HardCase c = b.named("random cells of " + what + ", seed " + std::to_string(seed), config,
                       std::numeric_limits<Real>::infinity());
  c.steps = steps;
  c.start = [=](Flow const& flow, CellIndex at) {
    std::mt19937_64 random(seed + 1000003u * static_cast<unsigned>(flow.grid().cell_id(at)));
    auto const uniform = [&](Real low, Real high) {
      return low + (high - low) * static_cast<Real>(random() >> 11) / 9007199254740992.0;
    };
    random.discard(10);
    fluid::Gas const& g = flow.gas();
    if (uniform(0, 1) < 0.1) return g.conserved(0, {}, 0);
    Real const density = std::pow(10, stiff ? uniform(0, 3.3) : products ? uniform(-2, 3.2) : uniform(-3, 3));
    Real const thermal = std::pow(10, g.curve.zero() ? uniform(-6, 6) : uniform(-2, 10));
    Real const pressure = g.reference_pressure(density) + thermal;
    Real const mach = std::pow(10, uniform(-3, g.curve.zero() ? 3 : 2));
    Real const speed = mach * g.sound_speed(g.conserved(density, {}, pressure));
    Vec3 const v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    return g.conserved(density, (speed / norm(v)) * v, pressure);
  };
  return c;
}

}  // namespace brisance::testing
