// Promises of the sweeps: they equal the scheme written plainly, their bits do not depend on blocks, lanes or
// directions, and uniform states stay as they are.
#include "fluid/flux/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "tests/support/flux_box.hpp"
#include "tests/support/plain_osmp.hpp"

namespace brisance::fluid {
namespace {

using testing::FluxBox;
using testing::PlainPencil;

constexpr int orders[] = {1, 3, 5, 7, 9, 11};
constexpr Index ghosts = 6, cells = 64;

enum class Data { smooth, strong, vacuum };

/// Cell c of pencil l: waves of all families; strong: jumps of 30 in pressure and of velocity; vacuum: holes besides.
State sample(Index c, int l, Data data, Gas const& gas) {
  double const x = 2 * std::numbers::pi * c / cells + 0.7 * l;
  double rho = 1 + 0.3 * std::sin(x) + 0.1 * std::sin(5 * x), u = 0.5 * std::sin(2 * x + 1) + 0.3 * (l % 8 - 4);
  double const v = 0.2 * std::cos(3 * x), w = 0.1 * std::sin(x);
  double p = 1 + 0.2 * std::cos(3 * x);
  if (data != Data::smooth && (c / 7 + l) % 3 == 0) p *= 30, rho *= 3;
  if (data != Data::smooth && (c + l + 40) % 17 < 3) u -= 2;
  if (data == Data::vacuum && (c + 3 * l + 40) % 13 < 4) return gas.conserved(0, {}, 0);
  // other gases: the same waves about a state of theirs
  if (!gas.curve.exponential()) p += gas.curve.stiffness * (0.1 + 0.02 * std::sin(x));
  if (gas.curve.exponential()) rho *= 0.4 * gas.curve.solid_density, p = gas.reference_pressure(rho) + p;
  return gas.conserved(rho, {u, v, w}, p);
}

double fastest(Data data, Gas const& gas, int pencils) {
  double signal = 0;
  for (int l = 0; l < pencils; ++l)
    for (Index c = -ghosts; c < cells + ghosts; ++c) {
      State const x = sample(c, l, data, gas);
      if (!gas.vacuum(x)) signal = std::max(signal, std::abs(x[1] / x[0]) + gas.sound_speed(x));
    }
  return signal;
}

bool same_bits(State const& a, State const& b) { return std::memcmp(a.data(), b.data(), sizeof a) == 0; }

Gas test_gas() { return {1.4, 1e-10, 1e-12}; }
/// Scaled so that all terms are of the size of one.
Gas stiffened_gas() { return {4.4, 1e-10, 1e-12, {3, 0, 0, 1, 1, 1}}; }
Gas jwl_gas() { return {1.3, 1e-10, 1e-12, {0, 60, 0.6, 4.15, 0.95, 2}}; }

enum class Substance { ideal, stiffened, jwl };
Gas gas_of(Substance s) {
  return s == Substance::ideal ? test_gas() : s == Substance::stiffened ? stiffened_gas() : jwl_gas();
}

struct Case {
  int order;
  Data data;
  Substance substance;
  SweepOptions options;
};
class SweepAgainstPlain : public ::testing::TestWithParam<Case> {};

TEST_P(SweepAgainstPlain, EqualsTheSchemeWrittenPlainly) {
  auto const [order, data, substance, options] = GetParam();
  Gas const gas = gas_of(substance);
  constexpr int pencils = 19;  // full bundles and a padded one
  // 0.98: some low-order fluxes are HLLE, some LLF
  double const courant = data == Data::smooth ? 0.8 : 0.98, sigma = courant / fastest(data, gas, pencils);
  FluxBox box({cells, pencils, 1}, ghosts);
  for (int l = 0; l < pencils; ++l)
    for (Index c = -ghosts; c < cells + ghosts; ++c) box.set(c, l, 0, sample(c, l, data, gas));
  auto const marked = [](Index c, int l) { return (c / 5 + l) % 3 == 0; };
  FluxBox marks({cells, pencils, 1}, ghosts);
  std::vector<std::uint8_t> mark(marks.u[0].size(), 0);
  for (int l = 0; l < pencils; ++l)
    for (Index c = -ghosts; c < cells + ghosts; ++c) mark[marks.at(c, l, 0)] = marked(c, l) ? 2 : 1;  // 1: its own x
  CellBox view = box.view();
  view.marks = mark.data() + marks.at(0, 0, 0), view.mark_stride = view.stride;
  SweepReport const report = sweep_box(order, view, 0, sigma, gas, options);
  double worst = 0, scale = 0;
  int limited = 0;
  State low{}, high{};
  for (int l = 0; l < pencils; ++l) {
    PlainPencil pencil{{}, ghosts, cells, {}, {}};
    for (Index c = -ghosts; c < cells + ghosts; ++c) {
      pencil.cells.push_back(sample(c, l, data, gas));
      if (options.shear_dissipation > 0) pencil.marked.push_back(marked(c, l));
    }
    auto const plain = testing::plain_sweep(pencil, order, sigma, gas, options);
    limited += plain.limited;
    for (std::size_t q = 0; q < 5; ++q) low[q] += plain.flux[0][q], high[q] += plain.flux[cells][q];
    for (Index c = 0; c < cells; ++c)
      for (std::size_t q = 0; q < 5; ++q) {
        double const expected = plain.cells[static_cast<std::size_t>(c)][q], got = box.get(c, l, 0)[q];
        worst = std::max(worst, std::abs(got - expected) / (1 + std::abs(expected)));
      }
  }
  EXPECT_LT(worst,
            data == Data::smooth ? 3e-15 : 2e-14);  // rounding of terms of size max |U|, 30 times 1 in the strong data
  EXPECT_EQ(report.fallback_faces + report.fallback_faces_high_end, limited);
  EXPECT_NEAR(report.signal_max * sigma, courant, 0.1);  // the fastest cell may be a ghost
  for (std::size_t q = 0; q < 5; ++q) {
    scale = 1 + std::abs(low[q]) + std::abs(high[q]);
    EXPECT_NEAR(report.flux_low[q], low[q], 1e-13 * scale);
    EXPECT_NEAR(report.flux_high[q], high[q], 1e-13 * scale);
  }
  EXPECT_EQ(report.health, 0u);
  if (data == Data::smooth) {
    EXPECT_EQ(limited, 0);
  }
}
std::vector<Case> all_cases() {
  std::vector<Case> list;
  for (int order : orders)
    for (Data data : {Data::smooth, Data::strong, Data::vacuum})
      for (Substance substance : {Substance::ideal, Substance::stiffened, Substance::jwl})
        for (SweepOptions const& options :
             {SweepOptions{}, {true, 0}, {false, 0.3}, {true, 1.2}, {false, 0, true}, {true, 1.2, true}})
          list.push_back({order, data, substance, options});
  return list;
}
INSTANTIATE_TEST_SUITE_P(AllOrders, SweepAgainstPlain, ::testing::ValuesIn(all_cases()));

/// Sweeps cells first..first+n-1 of pencil l as a block of its own and returns them.
std::vector<State> sweep_part(int order, Index first, Index n, int pencils, Data data, double sigma,
                              SweepOptions const& options) {
  Gas const gas = test_gas();
  FluxBox box({n, pencils, 1}, ghosts);
  for (int l = 0; l < pencils; ++l)
    for (Index c = -ghosts; c < n + ghosts; ++c) box.set(c, l, 0, sample(first + c, l, data, gas));
  sweep_box(order, box.view(), 0, sigma, gas, options);
  std::vector<State> result;
  for (Index c = 0; c < n; ++c) result.push_back(box.get(c, pencils - 1, 0));
  return result;
}

class SweepVariant : public ::testing::TestWithParam<SweepOptions> {};
INSTANTIATE_TEST_SUITE_P(Sweep, SweepVariant,
                         ::testing::Values(SweepOptions{}, SweepOptions{true, 0}, SweepOptions{true, 0, true}));

TEST_P(SweepVariant, BitsDoNotDependOnBlocksOrLanes) {
  SweepOptions const& options = GetParam();
  for (int order : orders)
    for (Data data : {Data::smooth, Data::strong, Data::vacuum}) {
      double const sigma = 0.9 / fastest(data, test_gas(), 11);
      for (int pencils : {1, 2, 8, 11}) {
        auto const whole = sweep_part(order, 0, cells, pencils, data, sigma, options);
        for (Index cut : {33, 1, 7, 32, 16}) {
          auto parts = sweep_part(order, 0, cut, pencils, data, sigma, options);
          auto const rest = sweep_part(order, cut, cells - cut, pencils, data, sigma, options);
          parts.insert(parts.end(), rest.begin(), rest.end());
          for (std::size_t c = 0; c < cells; ++c)
            ASSERT_TRUE(same_bits(parts[c], whole[c])) << order << " cut " << cut << " cell " << c;
        }
      }
      // the last pencil of 11 and the same alone: padded lanes and cut pencils do not change bits
      auto const among = sweep_part(order, 0, cells, 11, data, sigma, options);
      PlainPencil one;
      FluxBox box({cells, 1, 1}, ghosts);
      for (Index c = -ghosts; c < cells + ghosts; ++c) box.set(c, 0, 0, sample(c, 10, data, test_gas()));
      sweep_box(order, box.view(), 0, sigma, test_gas(), options);
      for (Index c = 0; c < cells; ++c)
        ASSERT_TRUE(same_bits(box.get(c, 0, 0), among[static_cast<std::size_t>(c)])) << order;
    }
}

TEST(Sweep, CountsDoNotDependOnTheCut) {
  Gas const gas = test_gas();
  auto stronger = [&](Index c) {
    State x = sample(c, 0, Data::strong, gas);
    if (((c + 40) / 5) % 2) x[4] *= 1000;
    return x;
  };
  double const sigma = 0.9 / (34 * fastest(Data::strong, gas, 1));
  for (int order : {5, 11}) {
    auto count = [&](Index first, Index n) {
      FluxBox box({n, 1, 1}, ghosts);
      for (Index c = -ghosts; c < n + ghosts; ++c) box.set(c, 0, 0, stronger(first + c));
      return sweep_box(order, box.view(), 0, sigma, gas);
    };
    auto const whole = count(0, cells);
    EXPECT_GT(whole.fallback_faces, 0);
    for (Index cut : {33, 1, 7, 30, 59}) {
      auto const a = count(0, cut), b = count(cut, cells - cut);
      EXPECT_EQ(a.fallback_faces + b.fallback_faces, whole.fallback_faces) << cut;
      EXPECT_EQ(b.fallback_faces_high_end, whole.fallback_faces_high_end);
      EXPECT_EQ(a.flux_low, whole.flux_low);
      EXPECT_EQ(b.flux_high, whole.flux_high);
      EXPECT_EQ(a.flux_high, b.flux_low);
    }
  }
}

TEST(Sweep, DirectionsGiveTheSameBits) {
  Gas const gas = test_gas();
  double const sigma = 0.9 / fastest(Data::strong, gas, 30);
  for (int order : orders)
    for (Data data : {Data::strong, Data::vacuum}) {
      constexpr Index a = 5, b = 11, n = 21;  // neither side a multiple of the lanes
      std::vector<State> expected;
      for (int d = 0; d < 3; ++d) {
        std::array<Index, 3> size{};
        std::size_t const along = static_cast<std::size_t>(d), fast = d == 0 ? 1 : 0, slow = d == 2 ? 1 : 2;
        size[along] = n, size[fast] = b, size[slow] = a;
        FluxBox box(size, ghosts);
        std::vector<std::uint8_t> mark(box.u[0].size(), 0);
        auto const component = sweep_components(d);
        auto place = [&](Index c, Index f, Index s) {
          std::array<Index, 3> at{};
          at[along] = c, at[fast] = f, at[slow] = s;
          return at;
        };
        for (Index s = 0; s < a; ++s)
          for (Index f = 0; f < b; ++f)
            for (Index c = -ghosts; c < n + ghosts; ++c) {
              State const x = sample(c, f + 5 * s, data, gas);
              State y{};
              for (std::size_t q = 0; q < 5; ++q) y[component[q]] = x[q];
              auto const at = place(c, f, s);
              box.set(at[0], at[1], at[2], y);
              bool const marked = (c / 4 + f + 5 * s + 9) % 3 == 0;
              mark[box.at(at[0], at[1], at[2])] = static_cast<std::uint8_t>(marked ? 7 & ~(1 << d) : 1 << d);
            }
        CellBox view = box.view();
        view.marks = mark.data() + box.at(0, 0, 0), view.mark_stride = view.stride;
        sweep_box(order, view, d, sigma, gas, {true, 1.2});
        std::size_t m = 0;
        for (Index s = 0; s < a; ++s)
          for (Index f = 0; f < b; ++f)
            for (Index c = 0; c < n; ++c, ++m) {
              auto const at = place(c, f, s);
              State const y = box.get(at[0], at[1], at[2]);
              State x;
              for (std::size_t q = 0; q < 5; ++q) x[q] = y[component[q]];
              if (d == 0)
                expected.push_back(x);
              else
                ASSERT_TRUE(same_bits(x, expected[m])) << "order " << order << " direction " << d;
            }
      }
    }
}

TEST_P(SweepVariant, UniformStatesKeepTheirBits) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> decade(-3, 3), mach(-1.5, 1.5);
  Gas const gas{1.4, 1e-13, 1e-15};
  for (int trial = 0; trial < 200; ++trial) {
    double const rho = std::pow(10, decade(random)), p = std::pow(10, decade(random)), c = std::sqrt(1.4 * p / rho);
    Vec3 v{};
    if (trial % 2) v = {c * mach(random), c * mach(random), c * mach(random)};
    State const state = gas.conserved(rho, v, p);
    for (int order : {1, 5, 11}) {
      FluxBox box({31 + trial % 5, 9, 1}, ghosts);
      for (Index j = 0; j < 9; ++j)
        for (Index i = -ghosts; i < box.size[0] + ghosts; ++i) box.set(i, j, 0, state);
      SweepReport const report = sweep_box(order, box.view(), 0, 0.9 / (std::abs(v.x) + c), gas, GetParam());
      EXPECT_EQ(report.fallback_faces, 0);
      for (Index j = 0; j < 9; ++j)
        for (Index i = 0; i < box.size[0]; ++i) ASSERT_TRUE(same_bits(box.get(i, j, 0), state)) << order;
    }
  }
}

TEST_P(SweepVariant, NothingPassesAWallAtRest) {
  Gas const gas = test_gas();
  for (int order : orders)
    for (Data data : {Data::smooth, Data::strong}) {
      constexpr Index n = 24, pencils = 9;
      FluxBox box({n, pencils, 1}, ghosts);
      for (Index l = 0; l < pencils; ++l)
        for (Index c = 0; c < n + ghosts; ++c) {
          State x = sample(c, l, data, gas);
          box.set(c, l, 0, x);
          x[1] = -x[1];
          if (c < ghosts) box.set(-1 - c, l, 0, x);
        }
      double const signal = fastest(data, gas, pencils);
      SweepReport const report = sweep_box(order, box.view(), 0, 0.9 / signal, gas, GetParam());
      // rounding of rho c and of p c, which reach 3 and 180
      EXPECT_NEAR(report.flux_low[0], 0, (data == Data::smooth ? 1e-15 : 1e-14) * pencils);
      EXPECT_NEAR(report.flux_low[4], 0, (data == Data::smooth ? 1e-14 : 1e-12) * pencils);
    }
}

TEST(Sweep, EmptySpaceStaysEmpty) {
  FluxBox box({16, 8, 1}, ghosts);
  for (int order : orders) {
    SweepReport const report = sweep_box(order, box.view(), 0, 1.0, test_gas());
    EXPECT_EQ(report.signal_max, 0);
    EXPECT_EQ(report.fallback_faces, 0);
    EXPECT_EQ(report.health, 0u);
  }
  for (auto const& values : box.u)
    for (double x : values) EXPECT_EQ(x, 0);
}

TEST(Sweep, HealthNamesTheFirstBadCell) {
  Gas const gas = test_gas();
  FluxBox box({16, 10, 1}, ghosts);
  auto fill = [&] {
    for (Index j = 0; j < 10; ++j)
      for (Index i = -ghosts; i < 16 + ghosts; ++i) box.set(i, j, 0, gas.conserved(1, {0, 0, 0}, 1));
  };
  fill();
  box.set(5, 9, 0, {1, 0, 0, 0, std::nan("")});
  SweepReport report = sweep_box(5, box.view(), 0, 0.5, gas);
  EXPECT_TRUE(report.health & static_cast<std::uint64_t>(Health::not_finite));
  EXPECT_EQ(report.where[1], 9);
  EXPECT_NEAR(report.where[0], 5, 1);
  fill();
  box.set(7, 8, 0, gas.conserved(1, {3, 0, 0}, 1));
  report = sweep_box(5, box.view(), 0, 0.5, gas);  // (3 + 1.18) / 2 > 1
  EXPECT_TRUE(report.health & static_cast<std::uint64_t>(Health::courant));
  EXPECT_EQ(report.where, (CellIndex{7, 8, 0}));
  fill();
  box.set(3, 2, 0, {1, 4, 0, 0, 5});  // kinetic energy 8 exceeds the total
  report = sweep_box(5, box.view(), 0, 0.1, gas);
  EXPECT_TRUE(report.health & static_cast<std::uint64_t>(Health::negative_energy));
  EXPECT_EQ(report.where[1], 2);
}

/// A bundle of runs cut from `sample`, all faces of the orders given.
struct Bundle {
  Index n;
  std::vector<Real> u, result, flux, pressure;
  std::vector<std::uint8_t> face_order;
  LineBundle view(int order) {
    return {
        n, u.data() + ghost_depth(order) * 5 * lanes(), result.data(), flux.data(), pressure.data(), face_order.data()};
  }
  Bundle(int order, Index n_, Data data, std::uint8_t order_everywhere) : n(n_) {
    auto const w = static_cast<std::size_t>(lanes());
    Index const g = ghost_depth(order);
    u.resize(static_cast<std::size_t>(n + 2 * g) * 5 * w);
    result.resize(static_cast<std::size_t>(n) * 5 * w), pressure.resize(static_cast<std::size_t>(n) * w);
    flux.resize(static_cast<std::size_t>(n + 1) * 5 * w);
    face_order.assign(static_cast<std::size_t>(n + 1) * w, order_everywhere);
    for (Index c = -g; c < n + g; ++c)
      for (std::size_t l = 0; l < w; ++l) {
        State const x = sample(c, static_cast<int>(l), data, test_gas());
        for (std::size_t q = 0; q < 5; ++q) u[(static_cast<std::size_t>(c + g) * 5 + q) * w + l] = x[q];
      }
  }
};

class SweepLines : public SweepVariant {};
INSTANTIATE_TEST_SUITE_P(Variants, SweepLines, ::testing::Values(SweepOptions{}, SweepOptions{true, 0, true}));

TEST_P(SweepLines, EqualsTheBoxAndGivesFluxesAndPressures) {
  Gas const gas = test_gas();
  int const w = lanes();
  for (int order : orders)
    for (Data data : {Data::smooth, Data::strong, Data::vacuum}) {
      constexpr Index n = 23;
      double const sigma = 0.9 / fastest(data, gas, w);
      Bundle bundle(order, n, data, static_cast<std::uint8_t>(order));
      std::uint32_t const valid = (1u << (w - 1)) - 1;  // all lanes but the last
      SweepReport const report = sweep_lines(order, bundle.view(order), valid, sigma, gas, GetParam());
      FluxBox box({n, w - 1, 1}, ghosts);
      for (int l = 0; l < w - 1; ++l)
        for (Index c = -ghosts; c < n + ghosts; ++c) box.set(c, l, 0, sample(c, l, data, gas));
      SweepReport const expected = sweep_box(order, box.view(), 0, sigma, gas, GetParam());
      EXPECT_EQ(report.fallback_faces, expected.fallback_faces);
      EXPECT_EQ(report.fallback_faces_high_end, expected.fallback_faces_high_end);
      EXPECT_EQ(report.signal_max, expected.signal_max);
      for (int l = 0; l < w - 1; ++l)
        for (Index c = 0; c < n; ++c) {
          State const before = sample(c, l, data, gas);
          EXPECT_NEAR(bundle.pressure[static_cast<std::size_t>(c * w + l)], gas.pressure(before),
                      1e-14 * (1 + gas.pressure(before)));
          for (int q = 0; q < 5; ++q) {
            ASSERT_EQ(bundle.result[static_cast<std::size_t>((c * 5 + q) * w + l)],
                      box.get(c, l, 0)[static_cast<std::size_t>(q)]);
            double const change = bundle.flux[static_cast<std::size_t>(((c + 1) * 5 + q) * w + l)] -
                                  bundle.flux[static_cast<std::size_t>((c * 5 + q) * w + l)];
            EXPECT_NEAR(before[static_cast<std::size_t>(q)] - sigma * change,
                        box.get(c, l, 0)[static_cast<std::size_t>(q)], 2e-13);
          }
        }
    }
}

TEST_P(SweepLines, AFaceOfLowerOrderIsThatOfTheLowerKernel) {
  Gas const gas = test_gas();
  int const w = lanes();
  constexpr Index n = 23;
  for (Data data : {Data::smooth, Data::strong}) {
    double const sigma = 0.9 / fastest(data, gas, w);
    for (int order : {7, 9, 11}) {
      std::vector<Bundle> pure;
      for (int lower = 5; lower <= order; lower += 2) {
        pure.emplace_back(lower, n, data, static_cast<std::uint8_t>(lower));
        sweep_lines(lower, pure.back().view(lower), ~0u, sigma, gas, GetParam());
      }
      Bundle mixed(order, n, data, 5);
      auto order_of = [&](Index f, int lane) { return 5 + 2 * ((f + lane) % ((order - 3) / 2)); };
      for (Index f = 0; f <= n; ++f)
        for (int l = 0; l < w; ++l)
          mixed.face_order[static_cast<std::size_t>(f * w + l)] = static_cast<std::uint8_t>(order_of(f, l));
      sweep_lines(order, mixed.view(order), ~0u, sigma, gas, GetParam());
      for (Index f = 0; f <= n; ++f)
        for (int l = 0; l < w; ++l)
          for (int q = 0; q < 5; ++q) {
            auto const at = static_cast<std::size_t>((f * 5 + q) * w + l);
            ASSERT_EQ(mixed.flux[at], pure[static_cast<std::size_t>((order_of(f, l) - 5) / 2)].flux[at])
                << order << " face " << f;
          }
    }
  }
}

TEST_P(SweepLines, WhatLiesBeyondThreeMirrorCellsDoesNotMatterAtOrderFive) {
  Gas const gas = test_gas();
  int const w = lanes();
  constexpr Index n = 4;
  double const sigma = 0.8 / fastest(Data::smooth, gas, w);
  Bundle good(11, n, Data::smooth, 5), junk(11, n, Data::smooth, 5);
  for (Index c : {-6, -5, -4, n + 3, n + 4, n + 5})
    for (int i = 0; i < 5 * w; ++i) junk.u[static_cast<std::size_t>((c + 6) * 5 * w + i)] = std::nan("");
  sweep_lines(11, good.view(11), ~0u, sigma, gas, GetParam());
  sweep_lines(11, junk.view(11), ~0u, sigma, gas, GetParam());
  EXPECT_EQ(good.flux, junk.flux);
  EXPECT_EQ(good.result, junk.result);
}

}  // namespace
}  // namespace brisance::fluid
