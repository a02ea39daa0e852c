#include "fluid/time_step.hpp"

#include <cmath>
#include <limits>

#include "fluid/flux/face.hpp"

namespace brisance::fluid {
namespace {

/// |u_d| + c per direction; 0 in vacuum. `V`: a double or a pack.
template <class V>
std::array<V, 3> cell_speeds(V const& density, V const& mx, V const& my, V const& mz, V const& energy, Gas const& gas) {
  V const zero(0.0);
  Mask<V> const some = density > V(gas.vacuum_density);
  V const r = V(1.0) / select(some, density, V(1.0));
  V const u = mx * r, v = my * r, w = mz * r;
  V internal = energy - V(0.5) * (mx * u + my * v + mz * w);
  if (!gas.curve.zero()) internal = internal - curve_at(density, gas.curve, V(gas.vacuum_density)).energy;
  Mask<V> const full = some && internal > V(gas.vacuum_energy);
  V square = V(gas.gamma * gas.kappa()) * internal * r;
  if (gas.curve.exponential()) square = square + curve_at(density, gas.curve, V(gas.vacuum_density)).slope;
  V const c = sqrt(select(full, square, zero));
  return {select(full, abs(u) + c, zero), select(full, abs(v) + c, zero), select(full, abs(w) + c, zero)};
}

struct RowMax {
  std::array<Pack, 3> pack{Pack(0.0), Pack(0.0), Pack(0.0)};
  std::array<Real, 3> scalar{};

  void row(std::array<Real const*, 5> const& u, Index n, Gas const& gas) {
    constexpr Index width = static_cast<Index>(Pack::size);
    Index i = 0;
    for (; i + width <= n; i += width) {
      auto const s = cell_speeds(load<Pack>(u[0] + i), load<Pack>(u[1] + i), load<Pack>(u[2] + i), load<Pack>(u[3] + i),
                                 load<Pack>(u[4] + i), gas);
      for (std::size_t d = 0; d < 3; ++d) pack[d] = max(pack[d], s[d]);
    }
    for (; i < n; ++i) cell(u, i, gas);
  }
  void cell(std::array<Real const*, 5> const& u, Index i, Gas const& gas) {
    auto const s = cell_speeds(u[0][i], u[1][i], u[2][i], u[3][i], u[4][i], gas);
    for (std::size_t d = 0; d < 3; ++d) scalar[d] = max(scalar[d], s[d]);
  }
  Real value(std::size_t d) const {
    alignas(Pack) std::array<Real, Pack::size> lanes;
    store(lanes.data(), pack[d]);
    Real best = scalar[d];
    for (Real const lane : lanes) best = max(best, lane);
    return best;
  }
};

}  // namespace

std::vector<int> directions(int dimension, std::int64_t step) {
  if (dimension == 1) return {0};
  bool const back = step % 2 != 0;
  if (dimension == 2) return back ? std::vector<int>{1, 0} : std::vector<int>{0, 1};
  int const turn = static_cast<int>(step / 2 % 3);
  std::vector<int> sequence{turn, (turn + 1) % 3, (turn + 2) % 3};
  if (back) std::swap(sequence[0], sequence[2]);
  return sequence;
}

namespace {

/// `row_speeds(best, block, row, j, k)` adds one row of cells.
template <class Row>
std::array<Real, 3> largest_speeds(Flow const& flow, Row const& row_speeds) {
  RowMax best;
  for (Block const& block : flow.blocks())
    for (Index k = 0; k < block.size()[2]; ++k)
      for (Index j = 0; j < block.size()[1]; ++j) {
        std::array<Real const*, 5> row;
        for (int q = 0; q < 5; ++q) row[static_cast<std::size_t>(q)] = block.component(q) + block.at(0, j, k);
        row_speeds(best, block, row, j, k);
      }
  std::array<Real, 3> speeds{};
  for (std::size_t d = 0; d < static_cast<std::size_t>(flow.grid().dimension); ++d) speeds[d] = best.value(d);
  return speeds;
}

}  // namespace

std::array<Real, 3> signal_speeds(Flow const& flow, CellMask const& skip) {
  return largest_speeds(flow, [&](RowMax& best, Block const& block, auto const& row, Index j, Index k) {
    auto const [nx, ny, nz] = block.size();
    std::uint8_t const* const mask = skip ? skip(block.id()) : nullptr;
    if (!mask) return best.row(row, nx, flow.gas());
    std::uint8_t const* const here = mask + std::ptrdiff_t{nx} * (j + std::ptrdiff_t{ny} * k);
    for (Index i = 0; i < nx; ++i)
      if (here[i] == 0) best.cell(row, i, flow.gas());
  });
}

std::array<Real, 3> signal_speeds(Flow const& flow, FluidVolume const& volume) {
  return largest_speeds(flow, [&](RowMax& best, Block const& block, auto const& row, Index j, Index k) {
    if (!volume.cuts(block.id())) return best.row(row, block.size()[0], flow.gas());
    CellIndex const first = block.first();
    for (Index i = 0; i < block.size()[0]; ++i)
      if (volume({first[0] + i, first[1] + j, first[2] + k}) > 0) best.cell(row, i, flow.gas());
  });
}

Real acoustic_time_step(Grid const& grid, std::array<Real, 3> const& speeds, Real cfl) {
  int const d = limiting_direction(grid, speeds);
  Real const speed = speeds[static_cast<std::size_t>(d)];
  return speed > 0 ? cfl * grid.spacing[d] / speed : std::numeric_limits<Real>::infinity();
}

Real side_time_step(Flow const& flow, Real time, Real cfl) {
  Grid const& grid = flow.grid();
  auto const step = [&](Real until) {
    std::array<Real, 3> speeds{};
    for (int d = 0; d < grid.dimension; ++d)
      speeds[static_cast<std::size_t>(d)] = flow.boundaries().signal_speed(d, time, until);
    return acoustic_time_step(grid, speeds, cfl);
  };
  // No pair is longer than the states of its first instant allow. The slack keeps a side that gives the state of the
  // cells from limiting by its rounding.
  return step(time + steps_per_pair(grid.dimension) * step(time)) * (1 + 1e-12);
}

int limiting_direction(Grid const& grid, std::array<Real, 3> const& speeds) {
  int worst = 0;
  for (int d = 1; d < grid.dimension; ++d)
    if (speeds[static_cast<std::size_t>(d)] / grid.spacing[d] >
        speeds[static_cast<std::size_t>(worst)] / grid.spacing[worst])
      worst = d;
  return worst;
}

Real courant_number(int dimension, std::int64_t step, Real nominal) {
  if (dimension == 1) return step < 5 ? min(0.3, nominal) : nominal;
  return step < 10 ? min(0.2, nominal) : nominal;
}

PairStep shorten(Real t, Real end, Real dt, int steps) {
  if (t + steps * dt < end) return {dt, false};
  return {(end - t) / steps, true};
}

bool Retry::reject() {
  ++rejected_;
  factor_ /= 2;
  return factor_ >= 1.0 / 1024;
}

std::string describe(std::uint64_t health) {
  struct Name {
    Health bit;
    char const* text;
  };
  constexpr Name names[] = {{Health::negative_density, "negative density"},
                            {Health::negative_energy, "negative internal energy"},
                            {Health::not_finite, "a value that is not finite"},
                            {Health::courant, "Courant number above 1"}};
  std::string text;
  for (Name const& name : names)
    if (health & static_cast<std::uint64_t>(name.bit)) text += (text.empty() ? "" : ", ") + std::string(name.text);
  return text;
}

}  // namespace brisance::fluid
