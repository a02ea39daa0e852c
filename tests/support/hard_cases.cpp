#include "tests/support/hard_cases.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/flow_case.hpp"
#include "tests/support/quadrature.hpp"
#include "tests/support/regions.hpp"

namespace brisance::testing {

using fluid::CellIndex;
using fluid::Flow;
using fluid::FlowConfig;
using fluid::Grid;
using fluid::State;

namespace {

std::string named(std::string const& name, int dimension) { return name + " " + std::to_string(dimension) + "D"; }

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
  return {"F23", named("Sedov", dimension), config, 1, [=](Flow const& flow, CellIndex c) {
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
    Real const density = std::pow(1 + t / r, flow.grid().dimension - 1);
    return flow.gas().conserved(density, inwards, 1e-6 * std::pow(density, flow.gas().gamma));
  };
  return {"F23b",
          named("Noh", dimension),
          config,
          2,
          [exact](Flow const& flow, CellIndex c) { return exact(flow, c, 0); },
          Held{[n](Grid const&, CellIndex c) { return c[0] >= n || c[1] >= n || c[2] >= n; }, exact}};
}

HardCase implosion(int n) {
  FlowConfig config = unit_box(2, n, 0.3);
  config.region = {half_space({0.15, 0, 0}, {-1, -1, 0}, 0.125, 0.14)};
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
             named("Mach 2000 jet", dimension),
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

HardCase odd_even(int dimension, int n) {
  FlowConfig config = unit_box(dimension, n);
  config.cells[0] = 20 * n;
  config.high.x = 20;
  set_boundaries(config, "periodic");
  config.boundary.x_low = config.boundary.x_high = "outflow";
  return {"F21", named("odd-even", dimension), config, 2.667, [](Flow const& flow, CellIndex c) {
            Real const noise = (c[0] + c[1] + c[2]) % 2 == 0 ? 1e-6 : -1e-6;
            // Mach 6 into (1.4, 0, 1): Rankine and Hugoniot
            Real const jump = 2.4 * 36 / (0.4 * 36 + 2), pressure = 1 + 7. / 6 * 35;
            return flow.grid().centre(c).x < 1
                       ? flow.gas().conserved(1.4 * jump * (1 + noise), {6 * (1 - 1 / jump), 0, 0}, pressure)
                       : flow.gas().conserved(1.4 * (1 + noise), {}, 1);
          }};
}

HardCase steady_shock(int dimension, int order, unsigned seed) {
  constexpr Real mach = 7, gamma = 1.4, ahead = 1 / (gamma * mach * mach);
  constexpr Real jump = (gamma + 1) * mach * mach / ((gamma - 1) * mach * mach + 2);
  constexpr Real behind = ahead * (1 + 2 * gamma / (gamma + 1) * (mach * mach - 1));
  int const g = fluid::ghost_depth(order), n = 50, across = dimension == 2 ? 25 : 12;
  FlowConfig config = unit_box(dimension, across, across);
  config.cells[0] = n + g;
  config.high.x = n + g;
  config.block = n + g;
  config.ambient = {1, ahead, {1, 0, 0}};
  set_boundaries(config, "periodic");
  config.boundary.x_low = "inflow", config.boundary.x_high = "outflow";
  config.inflow.x_low = fluid::GasState{1, ahead, {1, 0, 0}};
  auto const noise = std::make_shared<std::mt19937>(seed);
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
                 State const inside = load(flow, {n - 1, c[1], c[2]});
                 Real const density = inside[0];
                 return flow.gas().conserved(density, {1 / density, inside[2] / density, inside[3] / density}, behind);
               }}};
}

HardCase vacuum_ball(int dimension, int n) {
  FlowConfig config = unit_box(dimension, n);
  config.ambient = {0, 0, {}};
  config.region = {ball({.5, .5, .5}, .15, 1, 1)};
  return {"F25", named("ball in true vacuum", dimension), config, 0.06};
}

}  // namespace brisance::testing
