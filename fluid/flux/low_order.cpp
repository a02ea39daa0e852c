#include "fluid/flux/low_order.hpp"

#include "fluid/flux/face.hpp"
#include "fluid/flux/sweep.hpp"

namespace brisance::fluid {

State low_order_flux(State const& left, State const& right, int direction, Real sigma, Gas const& gas) {
  // The kernel's own text on one lane, so that the rule exists once.
  SweepConstants<Real> const constants(gas, sigma);
  auto const component = sweep_components(direction);
  Cell<Real> cell[2];
  bool vacuum = false;
  for (int side = 0; side < 2; ++side) {
    for (std::size_t q = 0; q < 5; ++q) cell[side].state[q] = (side == 0 ? left : right)[component[q]];
    primitives(cell[side], constants);
    if (bool const empty = is_vacuum(cell[side], constants)) {
      empty_cell(cell[side], empty);
      vacuum = true;
    }
  }
  Face<Real> before{}, face{};
  ThirdOrder<Real> third{};
  form_face<1>(cell[0], cell[1], before, face, third, constants);
  if (vacuum) empty_face<1>(cell[0], cell[1], vacuum, before, face, third, sigma);
  State flux;
  for (std::size_t q = 0; q < 5; ++q) flux[component[q]] = face.low_flux[q];
  return flux;
}

}  // namespace brisance::fluid
