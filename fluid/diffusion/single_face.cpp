#include "fluid/diffusion/single_face.hpp"

#include "fluid/diffusion/face_stress.hpp"

namespace brisance::fluid {

namespace {

using Primitives = std::array<Real, diffusion::columns>;

Primitives primitives_of(Transport const& transport, State const& u) {
  std::array<Real const*, 5> const from{&u[0], &u[1], &u[2], &u[3], &u[4]};
  Primitives out;
  if (transport.sutherland)
    diffusion::primitives(from, 0, 1, transport.gas, transport.law_sutherland, out.data(), 1);
  else
    diffusion::primitives(from, 0, 1, transport.gas, transport.law_constant, out.data(), 1);
  return out;
}

template <int Dimension>
void flux_in(int direction, diffusion::FaceStencil const& stencil, std::array<Real, 3> const& inverse, Real ratio,
             Real* flux) {
  if (direction == 0) return diffusion::face_fluxes<Dimension, 0>(stencil, 1, inverse, ratio, flux, 1);
  if constexpr (Dimension > 1)
    if (direction == 1) return diffusion::face_fluxes<Dimension, 1>(stencil, 1, inverse, ratio, flux, 1);
  if constexpr (Dimension > 2) diffusion::face_fluxes<Dimension, 2>(stencil, 1, inverse, ratio, flux, 1);
}

}  // namespace

std::array<Real, 4> viscous_flux(Transport const& transport, Grid const& grid, int direction,
                                 FaceStates const& states) {
  Primitives const low = primitives_of(transport, states.low), high = primitives_of(transport, states.high);
  std::array<std::array<Primitives, 4>, 3> around;
  diffusion::FaceStencil stencil{low.data(), high.data(), {}};
  for (int d = 0; d < grid.dimension; ++d) {
    if (d == direction) continue;
    auto const at = static_cast<std::size_t>(d);
    FaceStates::Beside const& b = states.beside[at];
    around[at] = {primitives_of(transport, b.low_before), primitives_of(transport, b.low_after),
                  primitives_of(transport, b.high_before), primitives_of(transport, b.high_after)};
    stencil.beside[at] = {around[at][0].data(), around[at][1].data(), around[at][2].data(), around[at][3].data()};
  }
  std::array<Real, 3> const inverse{1 / grid.spacing.x, 1 / grid.spacing.y, 1 / grid.spacing.z};
  std::array<Real, 4> flux{};
  Real const ratio = transport.conductivity_ratio;
  if (grid.dimension == 1)
    flux_in<1>(direction, stencil, inverse, ratio, flux.data());
  else if (grid.dimension == 2)
    flux_in<2>(direction, stencil, inverse, ratio, flux.data());
  else
    flux_in<3>(direction, stencil, inverse, ratio, flux.data());
  return flux;
}

std::array<Real, 4> viscous_flux(Transport const& transport, Grid const& grid, int direction, State const& low,
                                 State const& high) {
  FaceStates states{low, high, {}};
  for (FaceStates::Beside& b : states.beside) b = {low, low, high, high};
  return viscous_flux(transport, grid, direction, states);
}

}  // namespace brisance::fluid
