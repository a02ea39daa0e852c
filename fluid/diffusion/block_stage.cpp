#include "fluid/diffusion/block_stage.hpp"

#include <utility>

#include "fluid/diffusion/face_stress.hpp"

namespace brisance::fluid {
namespace {

using namespace diffusion;

constexpr std::ptrdiff_t pad = 8;  // before cell 0 of a row, so that it stands at the beginning of a cache line

/// The fluxes on both sides of a row of cells.
struct RowFluxes {
  Real const* x;
  Real const *y_low, *y_high, *z_low, *z_high;
};

/// u -> u + tau D, and what else the stage asks for. `before`: four columns of n values.
template <int Dimension, DiffusionStage stage>
void update_row(std::array<Real*, 4> const& u, Real* __restrict__ before, RowFluxes const& f, Index n, Real tau,
                std::array<Real, 3> const& inverse, std::ptrdiff_t pitch) {
  for (std::ptrdiff_t q = 0; q < 4; ++q) {
    Real* __restrict__ const cell = u[static_cast<std::size_t>(q)];
    Real* __restrict__ const kept = before + q * n;
    Real const* const x = f.x + q * pitch;
    Real const *const y0 = f.y_low + q * pitch, *const y1 = f.y_high + q * pitch;
    Real const *const z0 = f.z_low + q * pitch, *const z1 = f.z_high + q * pitch;
    for (Index i = 0; i < n; ++i) {
      Real sum = inverse[0] * (x[i + 1] - x[i]);
      if constexpr (Dimension > 1) sum += inverse[1] * (y1[i] - y0[i]);
      if constexpr (Dimension > 2) sum += inverse[2] * (z1[i] - z0[i]);
      Real const old = cell[i], next = old + tau * sum;
      if constexpr (stage == DiffusionStage::heun_first) kept[i] = old;
      cell[i] = stage == DiffusionStage::heun_second ? 0.5 * (kept[i] + next) : next;
    }
  }
}

/// Adds a row of faces to the flux through one end of the block.
void add_row(State& through, Real const* stress, Index n, std::ptrdiff_t pitch) {
  for (std::ptrdiff_t q = 0; q < 4; ++q) {
    Real sum = 0;
    for (Index i = 0; i < n; ++i) sum += stress[q * pitch + i];
    through[static_cast<std::size_t>(q) + 1] -= sum;
  }
}

/// Cells of a row outside phi >= -1e-13 |E|, or not finite: 2 rho phi against its band.
std::int64_t count_inadmissible(Block const& block, Index j, Index k) {
  std::ptrdiff_t const at = block.at(0, j, k);
  Real const *const r = block.component(0) + at, *const x = block.component(1) + at, *const y = block.component(2) + at;
  Real const *const z = block.component(3) + at, *const e = block.component(4) + at;
  std::int64_t bad = 0;
  for (Index i = 0; i < block.size()[0]; ++i) {
    Real const both = r[i] * e[i];
    Real const twice = 2 * both - (x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
    bad += twice >= -2e-13 * std::abs(both) ? 0 : 1;
  }
  return bad;
}

}  // namespace

Real* BlockStage::row(Index j, Index k) {
  std::ptrdiff_t const plane = planes_ == 1 ? 0 : (k + 3) % 3, line = rows_ == 1 ? 0 : j + 1;
  return scratch_.data() + (plane * rows_ + line) * (columns * pitch_) + pad;
}

template <int Dimension>
void BlockStage::load_plane(Block const& block, Index k) {
  Index const beyond = Dimension > 1 ? 1 : 0;
  for (Index j = -beyond; j < block.size()[1] + beyond; ++j) {
    std::array<Real const*, 5> u;
    for (int q = 0; q < 5; ++q) u[static_cast<std::size_t>(q)] = block.component(q) + block.at(0, j, k);
    if (transport_.sutherland)
      primitives(u, -1, block.size()[0] + 1, transport_.gas, transport_.law_sutherland, row(j, k), pitch_);
    else
      primitives(u, -1, block.size()[0] + 1, transport_.gas, transport_.law_constant, row(j, k), pitch_);
  }
}

template <int Dimension>
std::int64_t BlockStage::run_in(Block& block, Real tau, DiffusionStage stage, std::span<Real> before,
                                std::array<bool, 6> const& sides, std::array<State, 6>& through, FaceSink* sink) {
  auto const [nx, ny, nz] = block.size();
  pitch_ = (nx + 1 + pad - 1) / pad * pad + pad;
  rows_ = Dimension > 1 ? ny + 2 : 1;
  planes_ = Dimension > 2 ? 3 : 1;
  std::ptrdiff_t const flux_row = flux_columns * pitch_;
  auto const cells = static_cast<std::size_t>(planes_ * rows_ * columns * pitch_);
  scratch_.resize(cells + static_cast<std::size_t>((3 + (Dimension > 2 ? 2 * ny : 0)) * flux_row));
  Real* const x_faces = scratch_.data() + cells;
  Real *y_low = x_faces + flux_row, *y_high = y_low + flux_row;
  Real *z_low = y_high + flux_row, *z_high = z_low + (Dimension > 2 ? ny * flux_row : 0);
  std::array<Real, 3> const inverse{1 / grid_.spacing.x, 1 / grid_.spacing.y, 1 / grid_.spacing.z};
  Real const ratio = transport_.conductivity_ratio;

  auto const beside_x = [](Real const* low, Real const* high) {
    return FaceStencil::Beside{low - 1, low + 1, high - 1, high + 1};
  };
  auto const x_row = [&](Index j, Index k) {
    FaceStencil s{row(j, k) - 1, row(j, k), {}};
    if constexpr (Dimension > 1) s.beside[1] = {row(j - 1, k) - 1, row(j + 1, k) - 1, row(j - 1, k), row(j + 1, k)};
    if constexpr (Dimension > 2) s.beside[2] = {row(j, k - 1) - 1, row(j, k + 1) - 1, row(j, k - 1), row(j, k + 1)};
    face_fluxes<Dimension, 0>(s, nx + 1, inverse, ratio, x_faces, pitch_);
    for (std::size_t q = 0; q < 4; ++q) {
      if (sides[0]) through[0][q + 1] -= x_faces[static_cast<std::ptrdiff_t>(q) * pitch_];
      if (sides[1]) through[1][q + 1] -= x_faces[static_cast<std::ptrdiff_t>(q) * pitch_ + nx];
    }
    if (sink) sink->add(0, j, k, nx + 1, x_faces, pitch_);
  };
  auto const y_row = [&](Index j, Index k, Real* faces) {  // below row j
    FaceStencil s{row(j - 1, k), row(j, k), {}};
    s.beside[0] = beside_x(s.low, s.high);
    if constexpr (Dimension > 2) s.beside[2] = {row(j - 1, k - 1), row(j - 1, k + 1), row(j, k - 1), row(j, k + 1)};
    face_fluxes<Dimension, 1>(s, nx, inverse, ratio, faces, pitch_);
    if (sides[2] && j == 0) add_row(through[2], faces, nx, pitch_);
    if (sides[3] && j == ny) add_row(through[3], faces, nx, pitch_);
    if (sink) sink->add(1, j, k, nx, faces, pitch_);
  };
  auto const z_row = [&](Index j, Index k, Real* faces) {  // below plane k
    FaceStencil s{row(j, k - 1), row(j, k), {}};
    s.beside[0] = beside_x(s.low, s.high);
    s.beside[1] = {row(j - 1, k - 1), row(j + 1, k - 1), row(j - 1, k), row(j + 1, k)};
    face_fluxes<Dimension, 2>(s, nx, inverse, ratio, faces, pitch_);
    if (sides[4] && k == 0) add_row(through[4], faces, nx, pitch_);
    if (sides[5] && k == nz) add_row(through[5], faces, nx, pitch_);
    if (sink) sink->add(2, j, k, nx, faces, pitch_);
  };

  if constexpr (Dimension > 2) load_plane<Dimension>(block, -1);
  load_plane<Dimension>(block, 0);
  if constexpr (Dimension > 2)
    for (Index j = 0; j < ny; ++j) z_row(j, 0, z_low + j * flux_row);
  std::int64_t bad = 0;
  for (Index k = 0; k < nz; ++k) {
    if constexpr (Dimension > 2) load_plane<Dimension>(block, k + 1);
    if constexpr (Dimension > 1) y_row(0, k, y_low);
    for (Index j = 0; j < ny; ++j) {
      x_row(j, k);
      if constexpr (Dimension > 1) y_row(j + 1, k, y_high);
      std::ptrdiff_t const plane = Dimension > 2 ? j * flux_row : 0;
      if constexpr (Dimension > 2) z_row(j, k + 1, z_high + plane);
      std::array<Real*, 4> u;
      for (int q = 0; q < 4; ++q) u[static_cast<std::size_t>(q)] = block.component(q + 1) + block.at(0, j, k);
      RowFluxes const fluxes{x_faces, y_low, y_high, z_low + plane, z_high + plane};
      Real* const kept = stage == DiffusionStage::euler
                             ? nullptr
                             : before.data() + 4 * std::ptrdiff_t{nx} * (j + std::ptrdiff_t{ny} * k);
      switch (stage) {
        case DiffusionStage::euler:
          update_row<Dimension, DiffusionStage::euler>(u, kept, fluxes, nx, tau, inverse, pitch_);
          break;
        case DiffusionStage::heun_first:
          update_row<Dimension, DiffusionStage::heun_first>(u, kept, fluxes, nx, tau, inverse, pitch_);
          break;
        case DiffusionStage::heun_second:
          update_row<Dimension, DiffusionStage::heun_second>(u, kept, fluxes, nx, tau, inverse, pitch_);
          break;
      }
      if (stage != DiffusionStage::heun_first) bad += count_inadmissible(block, j, k);
      std::swap(y_low, y_high);
    }
    std::swap(z_low, z_high);
  }
  return bad;
}

std::int64_t BlockStage::run(Block& block, Real tau, DiffusionStage stage, std::span<Real> before,
                             std::array<bool, 6> const& sides, std::array<State, 6>& through, FaceSink* sink) {
  switch (grid_.dimension) {
    case 1:
      return run_in<1>(block, tau, stage, before, sides, through, sink);
    case 2:
      return run_in<2>(block, tau, stage, before, sides, through, sink);
    default:
      return run_in<3>(block, tau, stage, before, sides, through, sink);
  }
}

}  // namespace brisance::fluid
