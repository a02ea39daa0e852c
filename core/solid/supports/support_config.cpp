#include "core/solid/supports/support_config.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/base/keys.hpp"
#include "core/solid/solid_config.hpp"

namespace brisance::solid {

void HoldConfig::keys(Keys<HoldConfig>& k) {
  k("low", &HoldConfig::low, "m", "lower corner of the box").required();
  k("high", &HoldConfig::high, "m", "upper corner of the box").required();
}

void TimedMotion::keys(Keys<TimedMotion>& k) {
  k("time", &TimedMotion::time, "s", "time of this entry").required();
  k("velocity", &TimedMotion::velocity, "m/s", "velocity of the point `centre` then");
  k("spin", &TimedMotion::spin, "rad/s", "angular velocity then");
}

void DrivenConfig::keys(Keys<DrivenConfig>& k) {
  k("low", &DrivenConfig::low, "m", "lower corner of the box").required();
  k("high", &DrivenConfig::high, "m", "upper corner of the box").required();
  k("velocity", &DrivenConfig::velocity, "m/s", "constant velocity of what is in the box");
  k("spin", &DrivenConfig::spin, "rad/s", "constant angular velocity about `centre`");
  k("centre", &DrivenConfig::centre, "m", "the point, at time 0, that has `velocity` and about which it turns");
  k("history", &DrivenConfig::history, "",
    "velocity and spin in time instead of constant ones: linear, constant beyond both ends");
}

bool DrivenConfig::turns() const {
  return norm2(spin) > 0 ||
         std::any_of(history.begin(), history.end(), [](TimedMotion const& m) { return norm2(m.spin) > 0; });
}

bool DrivenConfig::moves() const { return norm2(velocity) > 0 || norm2(spin) > 0 || !history.empty(); }

void InitialVelocityConfig::keys(Keys<InitialVelocityConfig>& k) {
  k("low", &InitialVelocityConfig::low, "m", "lower corner of the box; not given: all of the body below `high`");
  k("high", &InitialVelocityConfig::high, "m", "upper corner of the box; not given: all of the body above `low`");
  k("velocity", &InitialVelocityConfig::velocity, "m/s", "velocity at `centre`, added to that of the body");
  k("centre", &InitialVelocityConfig::centre, "m", "where the velocity is `velocity`");
  k("gradient", &InitialVelocityConfig::gradient, "1/s",
    "dvx/dx, dvx/dy, dvx/dz, dvy/dx, ... of a velocity linear in space; not given: uniform");
}

namespace {

void check_driven(DrivenConfig const& box, std::string const& what) {
  require(box.history.empty() || (norm2(box.velocity) == 0 && norm2(box.spin) == 0), box.at,
          what + ": give either a constant `velocity` and `spin` or a `history` of them.");
  for (std::size_t i = 1; i < box.history.size(); ++i)
    require(box.history[i].time > box.history[i - 1].time, box.history[i].at,
            what + ".history: its times must ascend, but " + std::to_string(box.history[i].time) + " s comes after " +
                std::to_string(box.history[i - 1].time) + " s.");
  require(!box.turns() || box.centre, box.at,
          what + " turns: give the point about which it does as `centre` = [x, y, z].");
}

}  // namespace

void check_supports(BodyConfig const& body, int dimension) {
  std::string const who = "solid.body \"" + body.name + "\"";
  for (DrivenConfig const& box : body.prescribed) check_driven(box, who + ": prescribed");
  for (DrivenConfig const& box : body.clamp) check_driven(box, who + ": clamp");
  for (InitialVelocityConfig const& field : body.initial_velocity)
    require(field.gradient.empty() || field.gradient.size() == 9, field.at,
            who + ": initial_velocity.gradient needs 9 numbers, row by row, and has " +
                std::to_string(field.gradient.size()) + ".");
  for (std::string const& axis : body.periodic) {
    int const d = axis[0] - 'x';
    require(body.shape == "box" && body.tessellation != "voronoi", body.at,
            who + ": only a box of cartesian cells can be periodic: its opposite faces must match.");
    require(d < dimension, body.at,
            who + " is periodic along " + axis + ", which has no cells in " + std::to_string(dimension) +
                "D: leave it out.");
    require(body.cells[static_cast<std::size_t>(d)] >= 2, body.at,
            who + " is periodic along " + axis + " with one cell, which would be its own neighbour: take at least 2.");
  }
}

}  // namespace brisance::solid
