// The kernel's text on other values than packs: on a double it equals the packs bit for bit, on a counter it tells what
// a cell costs, the number `brisance bench` divides by.
#include <gtest/gtest.h>

#include "fluid/flux/pack.hpp"

namespace brisance::fluid {

/// A double that counts what is done to it: multiply-add 2; add, multiply, divide, root, min, max 1; signs and selects
/// 0.
struct Counted {
  Real x = 0;
  static inline long operations = 0;
  Counted() = default;
  Counted(Real v) : x(v) {}
};
inline Counted counted(Real x, int cost) {
  Counted::operations += cost;
  return x;
}
inline Counted operator+(Counted a, Counted b) { return counted(a.x + b.x, 1); }
inline Counted operator-(Counted a, Counted b) { return counted(a.x - b.x, 1); }
inline Counted operator*(Counted a, Counted b) { return counted(a.x * b.x, 1); }
inline Counted operator/(Counted a, Counted b) { return counted(a.x / b.x, 1); }
inline Counted operator-(Counted a) { return -a.x; }
inline bool operator>(Counted a, Counted b) { return a.x > b.x; }
inline bool operator<(Counted a, Counted b) { return a.x < b.x; }
inline bool operator>=(Counted a, Counted b) { return a.x >= b.x; }
inline Counted fma(Counted a, Counted b, Counted c) { return counted(fma(a.x, b.x, c.x), 2); }
inline Counted fnma(Counted a, Counted b, Counted c) { return counted(fnma(a.x, b.x, c.x), 2); }
inline Counted fms(Counted a, Counted b, Counted c) { return counted(fms(a.x, b.x, c.x), 2); }
inline Counted sqrt(Counted a) { return counted(sqrt(a.x), 1); }
inline Counted min(Counted a, Counted b) { return counted(min(a.x, b.x), 1); }
inline Counted max(Counted a, Counted b) { return counted(max(a.x, b.x), 1); }
inline Counted abs(Counted a) { return abs(a.x); }
inline bool negative(Counted a) { return negative(a.x); }
inline Counted select(bool m, Counted a, Counted b) { return m ? a : b; }
inline Counted flip(Counted a, Counted s) { return flip(a.x, s.x); }
/// Two bounds of magnitudes, a multiply-add, a min and a max.
inline Counted curvature(Counted a, Counted b) { return counted(curvature(a.x, b.x), 6); }
inline void store(Real* p, Counted v) { *p = v.x; }
template <>
struct PackTraits<Counted> {
  using Mask = bool;
  static constexpr int lanes = 1;
};

}  // namespace brisance::fluid

#include "fluid/flux/bench_sweep.hpp"
#include "fluid/flux/pencil.hpp"
#include "tests/support/flux_box.hpp"

namespace brisance::fluid {
namespace {

State wave(Index c, Gas const& gas) {
  return gas.conserved(1 + 0.3 * std::sin(0.4 * c), {0.5 * std::cos(0.3 * c), 0.1 * c / 20, -0.2},
                       1 + 0.4 * std::sin(0.2 * c + 1));
}

template <int Order, bool Smooth, class V>
std::vector<State> sweep_as(Index n, Real sigma, Gas const& gas, PencilReport<V>& report) {
  constexpr Index ghosts = Stencil<Order>::ghosts;
  std::vector<State> cells;
  for (Index c = -ghosts; c < n + ghosts; ++c) cells.push_back(wave(c, gas));
  PencilData data{n, {}, {}, 5, 5, 1, 1, 1};
  for (std::size_t q = 0; q < 5; ++q) data.in[q] = data.out[q] = cells[ghosts].data() + q;
  Pencil<Order, V, IdealCurve, false, Smooth> pencil;
  pencil.sweep(data, nullptr, sigma, gas, {}, report);
  return {cells.begin() + ghosts, cells.end() - ghosts};
}

template <int Order, bool Smooth>
void check_order() {
  Gas const gas{1.4, 1e-10, 1e-12};
  constexpr Index n = 24;
  Real const sigma = 0.4;
  PencilReport<Real> plain;
  auto const one = sweep_as<Order, Smooth, Real>(n, sigma, gas, plain);
  testing::FluxBox box({n, 3, 1}, 6);
  for (Index j = 0; j < 3; ++j)
    for (Index i = -6; i < n + 6; ++i) box.set(i, j, 0, wave(i, gas));
  SweepReport const report = sweep_box(Order, box.view(), 0, sigma, gas, {false, 0, Smooth});
  EXPECT_EQ(plain.signal, report.signal_max);
  for (Index i = 0; i < n; ++i) EXPECT_EQ(box.get(i, 1, 0), one[static_cast<std::size_t>(i)]) << Order << " " << i;

  PencilReport<Counted> counted;
  auto cost = [&](Index length) {
    Counted::operations = 0;
    sweep_as<Order, Smooth, Counted>(length, sigma, gas, counted);
    return Counted::operations;
  };
  EXPECT_EQ(cost(41) - cost(40), sweep_operations(Order, Smooth)) << "order " << Order << (Smooth ? " smooth" : "");
}

TEST(KernelText, EqualsThePacksOnADoubleAndCostsWhatBenchSays) {
  check_order<1, false>();
  check_order<3, false>();
  check_order<5, false>();
  check_order<7, false>();
  check_order<9, false>();
  check_order<11, false>();
  check_order<3, true>();
  check_order<5, true>();
  check_order<7, true>();
  check_order<9, true>();
  check_order<11, true>();
}

}  // namespace
}  // namespace brisance::fluid
