#include "fluid/boundary/boundaries.hpp"

#include <cmath>

#include "fluid/boundary/boundary_config.hpp"

namespace brisance::fluid {
namespace {

/// |u_d| + c, m/s.
Real signal(State const& u, int direction, Gas const& gas) {
  if (gas.vacuum(u)) return 0;
  return std::abs(u[1 + static_cast<std::size_t>(direction)] / u[0]) + gas.sound_speed(u);
}

State state_of(GasState const& s, Gas const& gas) { return gas.conserved(s.density, s.velocity, s.pressure); }

InflowHistory history_of(InflowState const& state, Gas const& gas) {
  InflowHistory history{{}, gas};
  for (TimedState const& s : state.history) {
    history.table.times.push_back(s.time);
    history.table.values.push_back({s.density, s.velocity.x, s.velocity.y, s.velocity.z, s.pressure});
  }
  return history;
}

MovingFront front_of(InflowState const& state, Gas const& gas, Grid const& grid) {
  FrontConfig const& front = *state.front;
  Vec3 normal = front.normal;
  for (int d = grid.dimension; d < 3; ++d) normal[d] = 0;
  return {{&grid, front.point, normalized(normal), state_of(state, gas),
           gas.conserved(front.density, front.velocity, front.pressure)},
          front.speed};
}

}  // namespace

template <class Where>
Boundaries::Law Boundaries::make(LawOfSide const& given, FlowConfig const& config, Gas const& gas, Grid const& grid,
                                 Where const& where) {
  auto const constant = [&where](auto const& law) {
    return [law, where](Block& block, int d, int s, Real, GhostRange const& range) {
      fill_ghosts(law, block, d, s, range, where);
    };
  };
  auto const changing = [&where](auto const& law) {
    return [law, where](Block& block, int d, int s, Real time, GhostRange const& range) {
      fill_ghosts(law.at(time), block, d, s, range, where);
    };
  };
  if (given.name == Reflecting::name) return {given.name, constant(Reflecting{}), {}};
  if (given.name == Outflow::name) return {given.name, constant(Outflow{}), {}};
  if (given.name == FarField::name)
    return {
        given.name, constant(FarField{gas, state_of(given.far_field ? *given.far_field : config.ambient, gas)}), {}};
  if (given.name == MovingWall::name) {
    if (given.wall->history.empty()) return {given.name, constant(MovingWall{given.wall->speed}), {}};
    return {given.name, changing(wall_history(*given.wall)), {}};
  }
  if (given.name != Inflow::name) return {given.name, {}, {}};  // periodic: never asked
  if (given.inflow->front) {
    MovingFront const front = front_of(*given.inflow, gas, grid);
    return {given.name, changing(front),
            [front, gas](int d, Real, Real) {
              return max(signal(front.start.ahead, d, gas), signal(front.start.behind, d, gas));
            },
            false};
  }
  if (!given.inflow->history.empty()) {
    InflowHistory const history = history_of(*given.inflow, gas);
    return {given.name, changing(history), [history](int d, Real from, Real to) {
              Real largest =
                  max(signal(history.at(from).given, d, history.gas), signal(history.at(to).given, d, history.gas));
              for (Real const t : history.table.times)
                if (t > from && t < to) largest = max(largest, signal(history.at(t).given, d, history.gas));
              return largest;
            }};
  }
  State const state = state_of(*given.inflow, gas);
  return {given.name, constant(Inflow{state}), [state, gas](int d, Real, Real) { return signal(state, d, gas); }};
}

Boundaries::Boundaries(FlowConfig const& config, Gas const& gas, Grid const& grid) {
  for (int d = 0; d < grid.dimension; ++d)
    for (int s = 0; s < 2; ++s)
      at(d, s).whole = make(law_of(config, d, s), config, gas, grid, [](CellIndex const&) { return true; });
  for (PatchConfig const& patch : config.patch) {
    int const direction = side_index(patch.side) / 2, side = side_index(patch.side) % 2;
    auto const where = [patch, direction, &grid](CellIndex const& c) { return covers(patch, grid, direction, c); };
    at(direction, side).patches.push_back(make(law_of(patch), config, gas, grid, where));
    at(direction, side).patched.push_back(where);
  }
}

void Boundaries::fill(Block& block, int direction, int side, Real time, GhostRange const& range) const {
  Side const& here = at(direction, side);
  here.whole.fill(block, direction, side, time, range);
  for (Law const& patch : here.patches) patch.fill(block, direction, side, time, range);
}

bool Boundaries::patched(int direction, int side, CellIndex const& c) const {
  for (auto const& patch : at(direction, side).patched)
    if (patch(c)) return true;
  return false;
}

Real Boundaries::signal_speed(int direction, Real from, Real to) const {
  Real largest = 0;
  for (int side = 0; side < 2; ++side) {
    Side const& here = at(direction, side);
    if (here.whole.signal) largest = max(largest, here.whole.signal(direction, from, to));
    for (Law const& patch : here.patches)
      if (patch.signal) largest = max(largest, patch.signal(direction, from, to));
  }
  return largest;
}

}  // namespace brisance::fluid
