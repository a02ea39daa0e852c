// What the solid does on this machine: link-steps a second of whole steps.
#pragma once
#include "core/base/real.hpp"

namespace brisance::solid {

/// Rate of one core, from processor time, best of several.
struct LinkRate {
  Real items_per_s = 0;     ///< link-steps: links times whole steps (strains, forces, kicks, drift and rotation)
  Real bytes_per_item = 0;  ///< what must move when nothing stays in cache
  Real flops_per_item = 0;  ///< a multiply-add is two; divide and square root are one
};

/// A vibrating and turning block of side^3 unit cubes on one rank: 10 stays in cache, 96 comes from memory.
/// Cost: about 8 s and 1.5 GB for 96.
LinkRate bench_links(Index side);

}  // namespace brisance::solid
