#include "fluid/boundary/boundaries.hpp"

namespace brisance::fluid {
namespace {

template <class Law>
std::function<void(Block&, int, int)> filler(Law const& law) {
  return [law](Block& block, int direction, int side) { fill_ghosts(law, block, direction, side); };
}

}  // namespace

Boundaries::Boundaries(FlowConfig const& config, Gas const& gas) {
  int const n = dimension(config);
  for (int d = 0; d < n; ++d)
    for (int s = 0; s < 2; ++s) {
      Side& side = sides_[static_cast<std::size_t>(2 * d + s)];
      side.name = config.boundary.side(d, s);
      if (side.name == Reflecting::name) side.fill = filler(Reflecting{});
      if (side.name == Outflow::name) side.fill = filler(Outflow{});
      if (side.name == Inflow::name) {
        GasState const& given = config.inflow.side(d, s).value();
        side.fill = filler(Inflow{gas.conserved(given.density, given.velocity, given.pressure)});
      }
    }
}

}  // namespace brisance::fluid
