// What overlapping particles cost.
#pragma once
#include "core/base/real.hpp"

namespace brisance::solid {

/// Overlapping pairs a second in the stage of contact, with friction and damping: two layers of `side`^2 bricks pressed
/// together half a brick apart, so that each meets four.
Real bench_contact(Index side);

}  // namespace brisance::solid
