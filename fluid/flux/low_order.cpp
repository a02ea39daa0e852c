#include "fluid/flux/low_order.hpp"

#include "fluid/flux/face.hpp"
#include "fluid/flux/sweep.hpp"

namespace brisance::fluid {

namespace {

/// The kernel's own text on one lane, so that the rule exists once.
template <class Curve>
State flux_of(State const& left, State const& right, int direction, Real sigma, Gas const& gas) {
  SweepConstants<Real, Curve> const constants(gas, sigma, {});
  auto const component = sweep_components(direction);
  Cell<Real, Curve> cell[2];
  bool vacuum = false;
  for (int side = 0; side < 2; ++side) {
    for (std::size_t q = 0; q < 5; ++q) cell[side].state[q] = (side == 0 ? left : right)[component[q]];
    primitives(cell[side], constants);
    if (bool const empty = is_vacuum(cell[side], constants)) {
      empty_cell(cell[side], empty, constants);
      vacuum = true;
    }
  }
  Face<Real, Curve> before{}, face{};
  Jump<Real> window{};
  form_face<1>(cell[0], cell[1], before, face, window, constants);
  if (vacuum) empty_face<1>(cell[0], cell[1], vacuum, before, face, window, constants);
  State flux;
  for (std::size_t q = 0; q < 5; ++q) flux[component[q]] = face.low_flux[q];
  return flux;
}

}  // namespace

State low_order_flux(State const& left, State const& right, int direction, Real sigma, Gas const& gas) {
  return gas.curve.zero() ? flux_of<IdealCurve>(left, right, direction, sigma, gas)
                          : flux_of<AnyCurve>(left, right, direction, sigma, gas);
}

}  // namespace brisance::fluid
