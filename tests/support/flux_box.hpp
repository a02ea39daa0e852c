// A box of cells with ghosts on all sides in plain vectors, for tests of the sweeps.
#pragma once
#include <array>
#include <vector>

#include "fluid/flux/sweep.hpp"

namespace brisance::testing {

struct FluxBox {
  std::array<Index, 3> size;
  Index ghosts;
  std::array<std::vector<Real>, 5> u;

  FluxBox(std::array<Index, 3> size_, Index ghosts_) : size(size_), ghosts(ghosts_) {
    for (auto& x : u) x.assign(static_cast<std::size_t>(stride(2) * (size[2] + 2 * ghosts)), 0.0);
  }
  std::ptrdiff_t stride(int d) const {
    std::ptrdiff_t const row = size[0] + 2 * ghosts;
    return d == 0 ? 1 : d == 1 ? row : row * (size[1] + 2 * ghosts);
  }
  std::size_t at(Index i, Index j, Index k) const {
    return static_cast<std::size_t>((i + ghosts) + (j + ghosts) * stride(1) + (k + ghosts) * stride(2));
  }
  fluid::State get(Index i, Index j, Index k) const {
    fluid::State x;
    for (std::size_t q = 0; q < 5; ++q) x[q] = u[q][at(i, j, k)];
    return x;
  }
  void set(Index i, Index j, Index k, fluid::State const& x) {
    for (std::size_t q = 0; q < 5; ++q) u[q][at(i, j, k)] = x[q];
  }
  fluid::CellBox view() {
    fluid::CellBox box{{}, size, {stride(0), stride(1), stride(2)}, 3};
    for (std::size_t q = 0; q < 5; ++q) box.u[q] = u[q].data() + at(0, 0, 0);
    return box;
  }
};

}  // namespace brisance::testing
