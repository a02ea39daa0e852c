#include "fluid/time_step.hpp"

#include <cmath>
#include <limits>

#include "fluid/survey.hpp"

namespace brisance::fluid {

std::vector<Sweep> sweeps(int dimension, std::int64_t step, Splitting splitting) {
  if (dimension == 1) return {{0}};
  bool const back = step % 2 != 0;
  int const turn = static_cast<int>(step / 2 % dimension);
  if (splitting == Splitting::pair) {
    if (dimension == 2) return back ? std::vector<Sweep>{{1}, {0}} : std::vector<Sweep>{{0}, {1}};
    std::vector<Sweep> sequence{{turn}, {(turn + 1) % 3}, {(turn + 2) % 3}};
    if (back) std::swap(sequence[0], sequence[2]);
    return sequence;
  }
  int const a = turn, b = (turn + 1) % dimension, c = (turn + 2) % dimension;
  // What a step does between the half sweeps of its first direction.
  std::vector<Sweep> inner{{b}};
  if (dimension == 3) inner = {{b, 0.5, 0.25}, {c}, {b, 0.5, 0.75}};
  std::vector<Sweep> sequence;
  if (!back) sequence.push_back({a, 0.5, 0.25});
  sequence.insert(sequence.end(), inner.begin(), inner.end());
  sequence.push_back(back ? Sweep{a, 0.5, 0.75} : Sweep{a, 1, 1});
  return sequence;
}

int most_sweeps(int dimension, Splitting splitting) { return static_cast<int>(sweeps(dimension, 0, splitting).size()); }

namespace {

/// `part(best, block)` adds the largest speeds of a block that is not whole and tells so.
template <class Part>
std::array<Real, 3> largest_speeds(Flow const& flow, Part const& part) {
  std::array<Real, 3> best{};
  for (std::size_t b = 0; b < flow.blocks().size(); ++b)
    if (!part(best, flow.blocks()[b])) {
      Survey const& seen = flow.survey(b);
      for (std::size_t d = 0; d < 3; ++d) best[d] = max(best[d], seen.speed[d]);
    }
  for (std::size_t d = static_cast<std::size_t>(flow.grid().dimension); d < 3; ++d) best[d] = 0;
  return best;
}

/// Adds the cells (i, j, k) of a block for which `counts` is true.
template <class Counts>
void add_cells(std::array<Real, 3>& best, Block const& block, Gas const& gas, Counts const& counts) {
  auto const [nx, ny, nz] = block.size();
  for (Index k = 0; k < nz; ++k)
    for (Index j = 0; j < ny; ++j)
      for (Index i = 0; i < nx; ++i) {
        if (!counts(i, j, k)) continue;
        std::array<Real, 3> const s = signal_speeds(block.load(i, j, k), gas);
        for (std::size_t d = 0; d < 3; ++d) best[d] = max(best[d], s[d]);
      }
}

}  // namespace

std::array<Real, 3> signal_speeds(Flow const& flow, CellMask const& skip) {
  return largest_speeds(flow, [&](std::array<Real, 3>& best, Block const& block) {
    std::uint8_t const* const mask = skip ? skip(block.id()) : nullptr;
    if (!mask) return false;
    auto const [nx, ny, nz] = block.size();
    std::ptrdiff_t const row = nx, plane = row * ny;
    add_cells(best, block, flow.gas(), [=](Index i, Index j, Index k) { return mask[i + row * j + plane * k] == 0; });
    return true;
  });
}

std::array<Real, 3> signal_speeds(Flow const& flow, FluidVolume const& volume) {
  return largest_speeds(flow, [&](std::array<Real, 3>& best, Block const& block) {
    if (!volume.cuts(block.id())) return false;
    CellIndex const first = block.first();
    add_cells(best, block, flow.gas(), [&](Index i, Index j, Index k) {
      return volume({first[0] + i, first[1] + j, first[2] + k}) > 0;
    });
    return true;
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
