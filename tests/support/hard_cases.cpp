#include "tests/support/hard_cases.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "fluid/flux/positivity.hpp"
#include "fluid/initial_state.hpp"
#include "fluid/totals.hpp"
#include "tests/support/quadrature.hpp"
#include "tests/support/test_main.hpp"

namespace brisance::testing {

using fluid::CellIndex;
using fluid::Flow;
using fluid::FlowConfig;
using fluid::Grid;
using fluid::RegionConfig;
using fluid::State;

namespace {

fluid::GasConfig gas_config(fluid::Gas const& gas) {
  fluid::GasConfig config;
  config.gamma = gas.gamma;
  if (gas.curve.stiffness > 0) config.law = "stiffened", config.stiffness = gas.curve.stiffness;
  if (gas.curve.exponential()) config.law = "jwl";  // its defaults are the products of TNT
  return config;
}

RegionConfig region(std::string shape, Real density, Real pressure, Vec3 velocity = {}) {
  RegionConfig r;
  r.shape = std::move(shape), r.density = density, r.pressure = pressure, r.velocity = velocity;
  return r;
}
RegionConfig ball(Vec3 centre, Real radius, Real density, Real pressure, Vec3 velocity = {}) {
  RegionConfig r = region("ball", density, pressure, velocity);
  r.centre = centre, r.radius = radius;
  return r;
}
RegionConfig box(Vec3 low, Vec3 high, Real density, Real pressure, Vec3 velocity = {}) {
  RegionConfig r = region("box", density, pressure, velocity);
  r.low = low, r.high = high;
  return r;
}

/// Radius in the present directions.
Real radius(Grid const& grid, CellIndex c) {
  Vec3 x = grid.centre(c);
  for (int d = grid.dimension; d < 3; ++d) x[d] = 0;
  return norm(x);
}

}  // namespace

HardCase tube_case(Shock const& s, int n) {
  FlowConfig config = unit_box(1, n, s.length);
  config.gas = gas_config(s.gas);
  config.ambient = {s.right.density, s.right.pressure, {s.right.velocity, 0, 0}};
  config.region = {box({-1, 0, 0}, {s.x0, 0, 0}, s.left.density, s.left.pressure, {s.left.velocity, 0, 0})};
  config.boundary.x_low = config.boundary.x_high = "outflow";
  return {s.id, s.name, config, s.end_time};
}

HardCase shu_osher_case(int n) {
  FlowConfig config = unit_box(1, n, 10);
  config.boundary.x_low = config.boundary.x_high = "outflow";
  return {"F19", "Shu-Osher", config, 1.8, [](Flow const& flow, CellIndex c) {
            Real const h = flow.grid().spacing.x, low = c[0] * h - 5;
            if (low + h / 2 < -4) return flow.gas().conserved(3.857143, {2.629369, 0, 0}, 10.33333);
            Real const wave = integral([](double x) { return std::sin(5 * x); }, low, low + h) / h;
            return flow.gas().conserved(1 + 0.2 * wave, {}, 1);
          }};
}

HardCase blast_waves_case(int n) {
  FlowConfig config = unit_box(1, n);
  config.ambient = {1, 0.01, {}};
  config.region = {box({0, 0, 0}, {0.1, 0, 0}, 1, 1000), box({0.9, 0, 0}, {1, 0, 0}, 1, 100)};
  return {"F20", "interacting blasts", config, 0.038};
}

HardCase sedov(int dimension, int n) {
  FlowConfig config = unit_box(dimension, n, 1.2);
  config.ambient = {1, 0.4e-5, {}};
  // energy of the whole blast that reaches radius 1 at time 1, shared by four quadrants or eight octants
  Real const energy = dimension == 2 ? 0.244816 : 0.851072 / 8;
  return {"F23", "Sedov " + std::to_string(dimension) + "D", config, 1, [=](Flow const& flow, CellIndex c) {
            State u = flow.gas().conserved(1, {}, 0.4e-5);
            if (c == CellIndex{0, 0, 0}) u[4] = energy / flow.grid().cell_volume();
            return u;
          }};
}

HardCase noh(int dimension, int n, int order) {
  int const g = fluid::ghost_depth(order);
  FlowConfig config = unit_box(dimension, n + g, 1 + static_cast<Real>(g) / n);
  config.gas.gamma = 5. / 3;
  config.ambient = {1, 1e-6, {}};
  config.boundary.x_high = config.boundary.y_high = config.boundary.z_high = "outflow";
  auto const exact = [](Flow const& flow, CellIndex c, Real t) {
    Real const r = radius(flow.grid(), c);
    Vec3 inwards = (-1 / r) * flow.grid().centre(c);
    for (int d = flow.grid().dimension; d < 3; ++d) inwards[d] = 0;
    return flow.gas().conserved(std::pow(1 + t / r, flow.grid().dimension - 1), inwards, 1e-6);
  };
  return {"F23b",
          "Noh " + std::to_string(dimension) + "D",
          config,
          2,
          [exact](Flow const& flow, CellIndex c) { return exact(flow, c, 0); },
          Held{[n](Grid const&, CellIndex c) { return c[0] >= n || c[1] >= n || c[2] >= n; }, exact}};
}

HardCase implosion(int n) {
  FlowConfig config = unit_box(2, n, 0.3);
  RegionConfig corner = region("half_space", 0.125, 0.14);
  corner.point = Vec3{0.15, 0, 0}, corner.normal = Vec3{-1, -1, 0};
  config.region = {corner};
  return {"F24b", "implosion", config, 2.5};
}

HardCase riemann_2d(int n) {
  FlowConfig config = unit_box(2, n);
  config.ambient = {1.5, 1.5, {}};
  config.region = {box({0, .8, 0}, {.8, 1, 0}, .5323, .3, {1.206, 0, 0}),
                   box({0, 0, 0}, {.8, .8, 0}, .138, .029, {1.206, 1.206, 0}),
                   box({.8, 0, 0}, {1, .8, 0}, .5323, .3, {0, 1.206, 0})};
  set_boundaries(config, "outflow");
  return {"F24a", "2D Riemann problem 3", config, 0.8};
}

HardCase double_mach(int n, int order) {
  int const g = fluid::ghost_depth(order);
  FlowConfig config = unit_box(2, 4 * n, 4);
  config.cells[1] = n + 2 * g;
  Real const h = 1.0 / n;
  config.low.y = -g * h, config.high.y = 1 + g * h;
  config.ambient = {1.4, 1, {}};
  config.block = 4 * n;
  config.boundary.x_low = config.boundary.x_high = "outflow";
  config.boundary.y_low = config.boundary.y_high = "outflow";
  Real const sixty = std::numbers::pi / 3;
  auto const behind = [=](Flow const& flow) {
    return flow.gas().conserved(8, {8.25 * std::sin(sixty), -8.25 * std::cos(sixty), 0}, 116.5);
  };
  // the front y = tan(60) (x - 1/6), moving at 10 along its normal
  auto const exact = [=](Flow const& flow, CellIndex c, Real t) {
    Vec3 const x = flow.grid().centre(c);
    bool const shocked = x.x < 1. / 6 + x.y / std::tan(sixty) + 10 * t / std::sin(sixty);
    return shocked ? behind(flow) : flow.gas().conserved(1.4, {}, 1);
  };
  return {"F23c",
          "double Mach reflection",
          config,
          0.2,
          [exact](Flow const& flow, CellIndex c) { return exact(flow, c, 0); },
          Held{[=](Grid const&, CellIndex c) { return c[1] < g || c[1] >= n + g; },
               [=](Flow const& flow, CellIndex c, Real t) {
                 if (c[1] >= n + g) return exact(flow, c, t);
                 if (flow.grid().centre(c).x < 1. / 6) return behind(flow);
                 State u = load(flow, {c[0], 2 * g - 1 - c[1], c[2]});
                 u[2] = -u[2];
                 return u;
               }}};
}

HardCase jet(int dimension, int n, int order, Real cfl) {
  int const g = fluid::ghost_depth(order);
  FlowConfig config = unit_box(dimension, n, 0.5);
  Real const h = 0.5 / n;
  config.cells[0] = 2 * n + g;
  config.low = {-g * h, -0.25, dimension == 3 ? -0.25 : 0};
  config.high = {1, 0.25, dimension == 3 ? 0.25 : 0};
  config.block = 2 * n + g;
  config.gas.gamma = 5. / 3;
  config.ambient = {0.5, 0.4127, {}};
  set_boundaries(config, "outflow");
  HardCase c{"F23d",
             "Mach 2000 jet " + std::to_string(dimension) + "D",
             config,
             0.001,
             {},
             Held{[g](Grid const&, CellIndex at) { return at[0] < g; },
                  [g](Flow const& flow, CellIndex at, Real) {
                    Vec3 x = flow.grid().centre(at);
                    if (flow.grid().dimension < 3) x.z = 0;
                    if (std::hypot(x.y, x.z) < 0.05) return flow.gas().conserved(5, {800, 0, 0}, 0.4127);
                    return load(flow, {g, at[1], at[2]});
                  }}};
  c.dt_max = cfl * h / 850;
  return c;
}

HardCase odd_even(int n) {
  FlowConfig config = unit_box(2, n);
  config.cells[0] = 20 * n;
  config.high.x = 20;
  config.boundary.x_low = config.boundary.x_high = "outflow";
  config.boundary.y_low = config.boundary.y_high = "periodic";
  return {"F21", "odd-even", config, 2.667, [](Flow const& flow, CellIndex c) {
            Real const noise = (c[0] + c[1]) % 2 == 0 ? 1e-6 : -1e-6;
            // Mach 6 into (1.4, 0, 1): Rankine and Hugoniot
            Real const jump = 2.4 * 36 / (0.4 * 36 + 2), pressure = 1 + 7. / 6 * 35;
            return flow.grid().centre(c).x < 1
                       ? flow.gas().conserved(1.4 * jump * (1 + noise), {6 * (1 - 1 / jump), 0, 0}, pressure)
                       : flow.gas().conserved(1.4 * (1 + noise), {}, 1);
          }};
}

HardCase steady_shock(int order) {
  constexpr Real mach = 7, gamma = 1.4, ahead = 1 / (gamma * mach * mach);
  constexpr Real jump = (gamma + 1) * mach * mach / ((gamma - 1) * mach * mach + 2);
  constexpr Real behind = ahead * (1 + 2 * gamma / (gamma + 1) * (mach * mach - 1));
  int const g = fluid::ghost_depth(order), n = 50;
  FlowConfig config = unit_box(2, 25, 25);
  config.cells[0] = n + g;
  config.high.x = n + g;
  config.block = n + g;
  config.ambient = {1, ahead, {1, 0, 0}};
  config.boundary.x_low = "inflow", config.boundary.x_high = "outflow";
  config.inflow.x_low = fluid::GasState{1, ahead, {1, 0, 0}};
  config.boundary.y_low = config.boundary.y_high = "periodic";
  auto const noise = std::make_shared<std::mt19937>(7u);
  return {"F22",
          "steady shock",
          config,
          400,
          [=](Flow const& flow, CellIndex c) {
            Real const factor = 1 + 1e-6 * (static_cast<Real>((*noise)()) / 4294967296.0 - 0.5);
            return c[0] < 25 ? flow.gas().conserved(factor, {1, 0, 0}, ahead)
                             : flow.gas().conserved(jump * factor, {1 / (jump * factor), 0, 0}, behind);
          },
          Held{[n](Grid const&, CellIndex c) { return c[0] >= n; },
               [n](Flow const& flow, CellIndex c, Real) {
                 Real const density = load(flow, {n - 1, c[1], 0})[0];
                 return flow.gas().conserved(density, {1 / density, 0, 0}, behind);
               }}};
}

HardCase vacuum_ball(int dimension, int n) {
  FlowConfig config = unit_box(dimension, n);
  config.ambient = {0, 0, {}};
  config.region = {ball({.5, .5, .5}, .15, 1, 1)};
  return {"F25", "ball in true vacuum " + std::to_string(dimension) + "D", config, 0.06};
}

HardCase collision(int dimension, int n) {
  FlowConfig config = unit_box(dimension, n);
  Vec3 normal{1, 0.7, dimension == 3 ? 0.4 : 0};
  normal = normalized(normal);
  Real const speed = 1000 * std::sqrt(1.4);
  config.ambient = {1, 1, -speed * normal};
  RegionConfig half = region("half_space", 1, 1, speed * normal);
  half.point = Vec3{.5, .5, dimension == 3 ? .5 : 0}, half.normal = -normal;
  config.region = {half};
  set_boundaries(config, "outflow");
  return {"8.4", "Mach 1000 collision, oblique " + std::to_string(dimension) + "D", config, 3e-4};
}

HardCase hot_ball(int dimension, int n, Real ratio) {
  FlowConfig config = unit_box(dimension, n);
  config.region = {box({0, 0, 0}, {.25, .25, .25}, 0, 0), ball({.5, .55, .45}, .15, 1, ratio)};
  // until the front has met walls and void
  char name[64];
  std::snprintf(name, sizeof name, "pressure ratio %.0e beside walls and vacuum %dD", ratio, dimension);
  return {"8.4", name, config, 1.5 / std::sqrt(1.4 * ratio)};
}

HardCase random_box(int dimension, int n, unsigned seed, std::int64_t steps) {
  FlowConfig config = unit_box(dimension, n);
  set_boundaries(config, "periodic");
  HardCase c{"8.4", "random cells " + std::to_string(dimension) + "D, seed " + std::to_string(seed), config,
             std::numeric_limits<Real>::infinity(), [seed](Flow const& flow, CellIndex c) {
               std::mt19937_64 random(seed + 1000003u * static_cast<unsigned>(flow.grid().cell_id(c)));
               auto const uniform = [&](Real low, Real high) {
                 return low + (high - low) * static_cast<Real>(random() >> 11) / 9007199254740992.0;
               };
               random.discard(10);
               if (uniform(0, 1) < 0.1) return State{};
               Real const density = std::pow(10, uniform(-3, 3)), pressure = std::pow(10, uniform(-6, 6));
               Real const mach = std::pow(10, uniform(-3, 3)),
                          speed = mach * std::sqrt(flow.gas().gamma * pressure / density);
               Vec3 v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
               return flow.gas().conserved(density, (speed / norm(v)) * v, pressure);
             }};
  c.steps = steps;
  return c;
}

HardRun::HardRun(HardCase const& c, int order) : scene(c) {
  scene.config.euler->order = order;
  flow = make_flow(scene.config, comm());
  if (scene.start)
    fluid::fill(*flow, [&](CellIndex at) { return scene.start(*flow, at); });
  else
    fluid::fill(*flow, scene.config);
  if (scene.held) held = std::make_unique<HeldCells>(*flow, clock, *scene.held);
  density_min = pressure_min = std::numeric_limits<Real>::infinity();
  judge_cells();
}

void HardRun::judge_cells() {
  for_cells(*this, [&](CellIndex, State const& u) {
    health |= fluid::judge(u, flow->gas());
    density_min = min(density_min, u[0]);
    pressure_min = min(pressure_min, flow->gas().pressure(u));
  });
}

/// Many times the steps of the longest case: a run that needs more is stuck in ever smaller ones.
constexpr std::int64_t endless = 100000;

void HardRun::run(Real cfl) {
  fluid::Totals const before = totals(*flow);
  try {
    while (scene.steps > 0 ? clock.step < scene.steps : clock.time < scene.end) {
      advance(*flow, clock, {.end = scene.end, .cfl = cfl, .steps = clock.step + 1, .dt_max = scene.dt_max});
      judge_cells();
      if (clock.step > endless) {
        failure = "not at the end after " + std::to_string(clock.step) + " steps";
        break;
      }
    }
  } catch (std::exception const& e) {
    failure = e.what();
  }
  fluid::Totals const after = totals(*flow);
  fluid::BoundaryLedger::Totals const crossed = flow->ledger().totals(flow->comm());
  State gained = crossed.gained;
  if (held) {
    State const added = held->added();
    for (std::size_t q = 0; q < 5; ++q) gained[q] += added[q];
  }
  auto const defect = [&](Real now, Real then, std::size_t q, Real scale) {
    Real const d = std::abs(now - then - gained[q]) / scale;
    conservation = d >= 0 ? max(conservation, d) : std::numeric_limits<Real>::infinity();
  };
  defect(after.mass, before.mass, 0, max(before.mass, after.mass));
  defect(after.energy, before.energy, 4, max(before.energy, after.energy));
  // where nothing has moved nothing is to be compared
  if (Real const size = max(before.momentum_size, after.momentum_size) + crossed.impulse; size > 0)
    for (int d = 0; d < 3; ++d) defect(after.momentum[d], before.momentum[d], 1 + static_cast<std::size_t>(d), size);
}

void for_cells(HardRun const& run, std::function<void(CellIndex, State const&)> const& visit) {
  for (fluid::Block const& block : run.flow->blocks())
    for (Index k = 0; k < block.size()[2]; ++k)
      for (Index j = 0; j < block.size()[1]; ++j)
        for (Index i = 0; i < block.size()[0]; ++i) {
          CellIndex const first = block.first(), c{first[0] + i, first[1] + j, first[2] + k};
          if (!run.held || !run.held->holds(c)) visit(c, block.load(i, j, k));
        }
}

}  // namespace brisance::testing
