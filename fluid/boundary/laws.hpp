// The laws of sides as the scene gives them.
#pragma once
#include "fluid/boundary/far_field.hpp"
#include "fluid/boundary/inflow.hpp"
#include "fluid/boundary/moving_front.hpp"
#include "fluid/boundary/moving_wall.hpp"
#include "fluid/boundary/outflow.hpp"
#include "fluid/boundary/reflecting.hpp"
#include "fluid/flow_config.hpp"

namespace brisance::fluid {

/// One law and what the scene says of it; null where it says nothing.
struct LawOfSide {
  std::string name;
  InflowState const* inflow;
  FarState const* far_field;
  WallMotion const* wall;
};
LawOfSide law_of(FlowConfig const& config, int direction, int side);
LawOfSide law_of(PatchConfig const& patch);

WallHistory wall_history(WallMotion const& motion);

}  // namespace brisance::fluid
