// Rows of primitive values and the viscous fluxes of rows of faces: the formulas of theory/fluid.md 5.1, in loops along
// x that compilers turn into vectors. Every face is one expression of its stencil, so its bits do not depend on where a
// block begins.
#pragma once
#include "fluid/diffusion/transport.hpp"

namespace brisance::fluid::diffusion {

/// Columns of a row of cells: velocity, temperature, viscosity.
enum : std::ptrdiff_t { vel = 0, temp = 3, visc = 4, columns = 5 };
/// Columns of a row of faces: stress on the three components of momentum, and the energy flux.
constexpr std::ptrdiff_t flux_columns = 4;

/// Cells first..last-1 of a row: velocity (m/s), temperature (K) and viscosity (Pa s) of conserved means. In vacuum all
/// are 0, and faces with a cell of no viscosity pass nothing.  Shape: columns `pitch` apart.
template <class Law>
void primitives(std::array<Real const*, 5> const& u, Index first, Index last, Gas const& gas, Law const& law,
                Real* __restrict__ out, std::ptrdiff_t pitch) {
  Real const vacuum_density = gas.vacuum_density, vacuum_energy = gas.vacuum_energy;
  Real const per_energy = gas.kappa() / gas.gas_constant;
  for (Index i = first; i < last; ++i) {
    Real const density = u[0][i];
    Real const some = density > vacuum_density ? density : 1.0;
    Real const inverse = 1 / some;
    Real const x = u[1][i] * inverse, y = u[2][i] * inverse, z = u[3][i] * inverse;
    Real const internal = u[4][i] - 0.5 * (u[1][i] * x + u[2][i] * y + u[3][i] * z);
    Real const there = internal > vacuum_energy ? 1.0 : 0.0;
    Real const full = density > vacuum_density ? there : 0.0;
    Real const temperature = full * (per_energy * internal * inverse);
    out[vel * pitch + i] = full * x;
    out[(vel + 1) * pitch + i] = full * y;
    out[(vel + 2) * pitch + i] = full * z;
    out[temp * pitch + i] = temperature;
    out[visc * pitch + i] = full * law(temperature);
  }
}

/// The cells around a row of faces normal to `Normal`: those on its low and high side, and for each transverse
/// direction the neighbours of both. Pointers are at face 0.
struct FaceStencil {
  Real const *low, *high;
  struct Beside {
    Real const *low_before, *low_after, *high_before, *high_after;
  };
  std::array<Beside, 3> beside;  ///< by direction; unused in that of the normal and in absent ones
};

/// n faces: mean viscosity, compact normal differences, 4-point transverse ones.
/// Units: `inverse` = 1 / spacing, 1/m.  Shape: cell and flux columns `pitch` apart.
template <int Dimension, int Normal>
void face_fluxes(FaceStencil const& s, Index n, std::array<Real, 3> const& inverse, Real conductivity_ratio,
                 Real* __restrict__ flux, std::ptrdiff_t pitch) {
  constexpr int one = Normal == 0 ? 1 : 0, two = Normal == 2 ? 1 : 2;  // the transverse directions
  constexpr bool has_one = one < Dimension, has_two = two < Dimension;
  Real const *const a = s.low, *const b = s.high;
  FaceStencil::Beside const &t1 = s.beside[one], &t2 = s.beside[two];
  Real const along = inverse[Normal], q1 = 0.25 * inverse[one], q2 = 0.25 * inverse[two];
  auto const slope = [](FaceStencil::Beside const& t, std::ptrdiff_t column, Real quarter) {
    return quarter * ((t.low_after[column] - t.low_before[column]) + (t.high_after[column] - t.high_before[column]));
  };
  for (Index i = 0; i < n; ++i) {
    Real const mu_a = a[visc * pitch + i], mu_b = b[visc * pitch + i];
    Real const both = mu_a > 0 ? 0.5 * (mu_a + mu_b) : 0.0;
    Real const mu = mu_b > 0 ? both : 0.0;
    Real const un = along * (b[Normal * pitch + i] - a[Normal * pitch + i]);
    Real u1 = along * (b[one * pitch + i] - a[one * pitch + i]);
    Real u2 = along * (b[two * pitch + i] - a[two * pitch + i]);
    Real spread = 0;  // divergence of the transverse velocity
    if constexpr (has_one) {
      spread = slope(t1, one * pitch + i, q1);
      u1 += slope(t1, Normal * pitch + i, q1);
    }
    if constexpr (has_two) {
      spread += slope(t2, two * pitch + i, q2);
      u2 += slope(t2, Normal * pitch + i, q2);
    }
    Real const normal = mu * (4.0 / 3 * un - 2.0 / 3 * spread), shear1 = mu * u1, shear2 = mu * u2;
    Real const heat = mu * conductivity_ratio * (along * (b[temp * pitch + i] - a[temp * pitch + i]));
    Real const work =
        0.5 * ((a[Normal * pitch + i] + b[Normal * pitch + i]) * normal +
               (a[one * pitch + i] + b[one * pitch + i]) * shear1 + (a[two * pitch + i] + b[two * pitch + i]) * shear2);
    flux[Normal * pitch + i] = normal;
    flux[one * pitch + i] = shear1;
    flux[two * pitch + i] = shear2;
    flux[3 * pitch + i] = work + heat;
  }
}

}  // namespace brisance::fluid::diffusion
