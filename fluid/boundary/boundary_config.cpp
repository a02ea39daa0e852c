#include "fluid/boundary/boundary_config.hpp"

#include <cstdio>

#include "core/base/errors.hpp"
#include "fluid/boundary/laws.hpp"

namespace brisance::fluid {
namespace {

std::string number(Real x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

template <class Entry>
void check_times(std::vector<Entry> const& history, std::string const& name) {
  for (std::size_t i = 1; i < history.size(); ++i)
    require(history[i].time > history[i - 1].time, history[i].at,
            name + ".history: its times must ascend, but " + number(history[i].time) + " s comes after " +
                number(history[i - 1].time) + " s.");
}

void check_state(Gas const& gas, Location const& at, std::string const& name, Real density, Real pressure) {
  if (!(density > 0) || gas.curve.zero()) return;
  Real const least = gas.reference_pressure(density);
  require(pressure > least, at,
          name + ": a pressure of " + number(pressure) + " Pa is below the reference curve of the gas at " +
              number(density) + " kg/m3; it must exceed " + number(least) + " Pa.");
}

void check_inflow(InflowState const& state, Gas const& gas, std::string const& name) {
  GasState const none;
  bool const constant = state.density != none.density || state.pressure != none.pressure || norm2(state.velocity) != 0;
  require(state.history.empty() || !constant, state.at,
          name + ": give either a constant density, pressure and velocity or a `history` of them.");
  require(state.history.empty() || !state.front, state.at,
          name + ": a `front` separates two constant states; it cannot be joined to a `history`.");
  check_times(state.history, name);
  check_state(gas, state.at, name, state.density, state.pressure);
  for (TimedState const& s : state.history) check_state(gas, s.at, name + ".history", s.density, s.pressure);
  if (state.front) {
    require(norm2(state.front->normal) > 0, state.front->at,
            name + ".front: its `normal` is zero; give the direction in which the front runs.");
    check_state(gas, state.front->at, name + ".front", state.front->density, state.front->pressure);
  }
}

/// What one law of one side or patch needs.
void check_law(LawOfSide const& law, Gas const& gas, Location const& at, std::string const& what,
               std::string const& inflow, std::string const& wall) {
  require(law.name != Inflow::name || law.inflow, at,
          what + " is an inflow without a state: add [" + inflow + "] with density, pressure and velocity.");
  require(law.name != MovingWall::name || law.wall, at,
          what + " is a moving wall without a motion: add [" + wall + "] with speed or history.");
  if (law.inflow) check_inflow(*law.inflow, gas, inflow);
  if (law.far_field) check_state(gas, law.far_field->at, what, law.far_field->density, law.far_field->pressure);
  if (law.wall) {
    require(law.wall->history.empty() || law.wall->speed == 0, law.wall->at,
            wall + ": give either a constant `speed` or a `history` of it.");
    check_times(law.wall->history, wall);
  }
}

void check_wall(LawOfSide const& law, Grid const& grid, int direction, Location const& at, std::string const& what,
                Real end) {
  if (law.name != MovingWall::name) return;
  Real const distance = wall_history(*law.wall).largest_displacement(end), cell = grid.spacing[direction];
  require(distance < cell, at,
          what + " is a wall that moves by " + number(distance) + " m until the end, but the cells are " +
              number(cell) +
              " m wide, and the side of the grid stays where it is. Let it move by less, or use a "
              "[[solid.body]] with a prescribed motion.");
}

std::string name_of(std::size_t patch) { return "fluid.patch[" + std::to_string(patch) + "]"; }

}  // namespace

LawOfSide law_of(FlowConfig const& config, int direction, int side) {
  auto const pointer = [](auto const& given) { return given ? &*given : nullptr; };
  return {config.boundary.side(direction, side), pointer(config.inflow.side(direction, side)),
          pointer(config.far_field.side(direction, side)), pointer(config.moving_wall.side(direction, side))};
}

LawOfSide law_of(PatchConfig const& patch) {
  auto const pointer = [](auto const& given) { return given ? &*given : nullptr; };
  return {patch.law, pointer(patch.inflow), pointer(patch.far_field), pointer(patch.moving_wall)};
}

WallHistory wall_history(WallMotion const& motion) {
  if (motion.history.empty()) return {{{0}, {{motion.speed}}}};
  WallHistory wall;
  for (TimedSpeed const& s : motion.history) wall.table.times.push_back(s.time), wall.table.values.push_back({s.speed});
  return wall;
}

int side_index(std::string const& name) {
  for (int s = 0; s < 6; ++s)
    if (name == side_names[s]) return s;
  return -1;
}

bool covers(PatchConfig const& patch, Grid const& grid, int direction, CellIndex c) {
  Vec3 const x = grid.centre(c);
  Real distance2 = 0;
  for (int d = 0; d < grid.dimension; ++d) {
    if (d == direction) continue;
    if (patch.shape == "box" && (x[d] < (*patch.low)[d] || x[d] >= (*patch.high)[d])) return false;
    if (patch.shape == "ball") distance2 += square(x[d] - (*patch.centre)[d]);
  }
  return patch.shape == "box" || distance2 < square(*patch.radius);
}

void check_sides(FlowConfig const& config) {
  Gas const gas = make_gas(config);
  int const n = dimension(config);
  for (int d = 0; d < n; ++d)
    for (int side = 0; side < 2; ++side) {
      std::string const name = side_names[2 * d + side];
      check_law(law_of(config, d, side), gas, config.boundary.at, "fluid.boundary." + name, "fluid.inflow." + name,
                "fluid.moving_wall." + name);
    }
  for (std::size_t p = 0; p < config.patch.size(); ++p) {
    PatchConfig const& patch = config.patch[p];
    std::string const name = name_of(p);
    if (patch.shape == "box")
      require(patch.low && patch.high, patch.at, name + ": a box needs `low` and `high`.");
    else
      require(patch.centre && patch.radius, patch.at, name + ": a ball needs `centre` and `radius`.");
    int const direction = side_index(patch.side) / 2;
    require(direction < n, patch.at, name + ": there are no cells along the normal of " + patch.side + ".");
    require(n > 1, patch.at, name + ": in one dimension a side is one face; set its law in [fluid.boundary].");
    require(config.boundary.side(direction, side_index(patch.side) % 2) != "periodic", patch.at,
            name + ": " + patch.side + " is periodic and has no faces to give a law to.");
    check_law(law_of(patch), gas, patch.at, name, name + ".inflow", name + ".moving_wall");
  }
}

void check_patches(FlowConfig const& config, Grid const& grid) {
  for (std::size_t p = 0; p < config.patch.size(); ++p) {
    PatchConfig const& patch = config.patch[p];
    int const direction = side_index(patch.side) / 2;
    CellIndex end = grid.cells, c{};
    end[static_cast<std::size_t>(direction)] = 1;
    bool any = false;
    for (c[2] = 0; c[2] < end[2] && !any; ++c[2])
      for (c[1] = 0; c[1] < end[1] && !any; ++c[1])
        for (c[0] = 0; c[0] < end[0] && !any; ++c[0]) any = covers(patch, grid, direction, c);
    require(any, patch.at,
            name_of(p) + ": no centre of a face of " + patch.side +
                " lies in its shape. Enlarge it, move it onto the side, or refine the grid.");
  }
}

void check_walls(FlowConfig const& config, Grid const& grid, Real end) {
  for (int d = 0; d < grid.dimension; ++d)
    for (int side = 0; side < 2; ++side)
      check_wall(law_of(config, d, side), grid, d, config.boundary.at,
                 std::string("fluid.boundary.") + side_names[2 * d + side], end);
  for (std::size_t p = 0; p < config.patch.size(); ++p)
    check_wall(law_of(config.patch[p]), grid, side_index(config.patch[p].side) / 2, config.patch[p].at, name_of(p),
               end);
}

std::string const& BoundaryConfig::side(int d, int side) const {
  std::string const* const all[6] = {&x_low, &x_high, &y_low, &y_high, &z_low, &z_high};
  return *all[2 * d + side];
}

void BoundaryConfig::keys(Keys<BoundaryConfig>& k) {
  std::string BoundaryConfig::*const members[6] = {&BoundaryConfig::x_low, &BoundaryConfig::x_high,
                                                   &BoundaryConfig::y_low, &BoundaryConfig::y_high,
                                                   &BoundaryConfig::z_low, &BoundaryConfig::z_high};
  for (int s = 0; s < 6; ++s)
    k(side_names[s], members[s], "", "what stands at this side of the grid")
        .one_of({"reflecting", "outflow", "far_field", "inflow", "moving_wall", "periodic"});
}

void TimedState::keys(Keys<TimedState>& k) {
  k("time", &TimedState::time, "s", "time of this entry").required();
  k("density", &TimedState::density, "kg/m3", "density then").required().at_least(0);
  k("pressure", &TimedState::pressure, "Pa", "absolute pressure then").required().at_least(0);
  k("velocity", &TimedState::velocity, "m/s", "velocity then");
}

void FrontConfig::keys(Keys<FrontConfig>& k) {
  k("point", &FrontConfig::point, "m", "a point of the plane at time 0").required();
  k("normal", &FrontConfig::normal, "1", "direction in which the plane moves, away from the state behind it")
      .required();
  k("speed", &FrontConfig::speed, "m/s", "speed along the normal");
  k("density", &FrontConfig::density, "kg/m3", "density behind the plane").required().at_least(0);
  k("pressure", &FrontConfig::pressure, "Pa", "absolute pressure behind the plane").required().at_least(0);
  k("velocity", &FrontConfig::velocity, "m/s", "velocity behind the plane");
}

void InflowState::keys(Keys<InflowState>& k) {
  declare(k);
  k("history", &InflowState::history, "",
    "states in time instead of a constant one: linear in density, velocity and pressure, constant beyond both ends");
  k("front", &InflowState::front, "", "a moving plane with another state behind it");
}

void TimedSpeed::keys(Keys<TimedSpeed>& k) {
  k("time", &TimedSpeed::time, "s", "time of this entry").required();
  k("speed", &TimedSpeed::speed, "m/s", "speed along the axis then").required();
}

void WallMotion::keys(Keys<WallMotion>& k) {
  k("speed", &WallMotion::speed, "m/s", "speed along the axis; inwards is positive at a low side");
  k("history", &WallMotion::history, "", "speeds in time instead of a constant one: linear, constant beyond both ends");
}

void PatchConfig::keys(Keys<PatchConfig>& k) {
  k("side", &PatchConfig::side, "", "side of the grid it is a part of")
      .required()
      .one_of({"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"});
  k("law", &PatchConfig::law, "", "what stands there")
      .one_of({"reflecting", "outflow", "far_field", "inflow", "moving_wall"});
  k("shape", &PatchConfig::shape, "", "form; faces whose centre is inside belong to it").one_of({"box", "ball"});
  k("low", &PatchConfig::low, "m", "box: its low corner");
  k("high", &PatchConfig::high, "m", "box: its high corner");
  k("centre", &PatchConfig::centre, "m", "ball: its centre");
  k("radius", &PatchConfig::radius, "m", "ball: its radius").above(0);
  k("inflow", &PatchConfig::inflow, "", InflowState::meaning);
  k("far_field", &PatchConfig::far_field, "", FarState::meaning);
  k("moving_wall", &PatchConfig::moving_wall, "", WallMotion::meaning);
}

}  // namespace brisance::fluid
