#include "fluid/boundary/products.hpp"

#include "fluid/boundary/inflow.hpp"
#include "fluid/boundary/moving_wall.hpp"
#include "fluid/boundary/outflow.hpp"
#include "fluid/boundary/reflecting.hpp"

namespace brisance::fluid {

bool carries_products(std::string const& law) {
  return law == Reflecting::name || law == MovingWall::name || law == Outflow::name || law == Inflow::name ||
         law == "periodic";
}

void fill_products(Block& block, int direction, int side, std::string const& law) {
  auto const d = static_cast<std::size_t>(direction);
  Index const n = block.size()[d];
  CellIndex end = block.size();
  end[d] = block.ghost()[d];
  bool const mirror = law == Reflecting::name || law == MovingWall::name, none = law == Inflow::name;
  CellIndex c{};
  for (int q = 5; q < block.components(); ++q)
    for (c[2] = 0; c[2] < end[2]; ++c[2])
      for (c[1] = 0; c[1] < end[1]; ++c[1])
        for (c[0] = 0; c[0] < end[0]; ++c[0]) {
          CellIndex from = c, to = c;
          Index const source = mirror ? c[d] : 0;
          to[d] = side == 0 ? -1 - c[d] : n + c[d];
          from[d] = side == 0 ? source : n - 1 - source;
          Real const inside = block.component(q)[block.at(from[0], from[1], from[2])];
          block.component(q)[block.at(to[0], to[1], to[2])] = none ? 0 : inside;
        }
}

}  // namespace brisance::fluid
