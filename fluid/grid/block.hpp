// One block of cells with ghosts: [component][k][j][i], x contiguous, rows padded to whole vectors. Five components, or
// seven where detonation products mix with the gas (gas/mixture.hpp).
#pragma once
#include <cstddef>
#include <memory>
#include <span>

#include "fluid/gas/mixture.hpp"
#include "fluid/grid/grid.hpp"

namespace brisance::fluid {

/// Conserved means of one block. Local cells run from 0 to size-1, ghosts from -ghost[d] to size[d]-1+ghost[d].
class Block {
 public:
  static constexpr Index row_pad = 8;  ///< stored cells before and after a row, whatever the ghost depth
  static constexpr int max_components = 7;
  Block(Grid const& grid, Index id, Index ghost_depth, int components = 5);

  Index id() const { return id_; }
  int components() const { return components_; }
  CellIndex first() const { return first_; }  ///< global index of local cell (0, 0, 0)
  std::array<Index, 3> size() const { return size_; }
  std::array<Index, 3> ghost() const { return ghost_; }  ///< 0 in absent directions
  std::array<std::ptrdiff_t, 3> stride() const { return stride_; }
  std::ptrdiff_t at(Index i, Index j, Index k) const { return i * stride_[0] + j * stride_[1] + k * stride_[2]; }
  /// Component q at local cell (0, 0, 0); index it with at(i, j, k), negative for ghosts.
  Real* component(int q) { return origin_[static_cast<std::size_t>(q)]; }
  Real const* component(int q) const { return origin_[static_cast<std::size_t>(q)]; }
  State load(Index i, Index j, Index k) const {
    std::ptrdiff_t const a = at(i, j, k);
    return {origin_[0][a], origin_[1][a], origin_[2][a], origin_[3][a], origin_[4][a]};
  }
  void store(Index i, Index j, Index k, State const& u) {
    std::ptrdiff_t const a = at(i, j, k);
    for (std::size_t q = 0; q < 5; ++q) origin_[q][a] = u[q];
  }
  /// All components, of a block that has seven.
  MixtureState load_mixture(Index i, Index j, Index k) const {
    std::ptrdiff_t const a = at(i, j, k);
    MixtureState x;
    for (std::size_t q = 0; q < 7; ++q) x[q] = origin_[q][a];
    return x;
  }
  void store_mixture(Index i, Index j, Index k, MixtureState const& x) {
    std::ptrdiff_t const a = at(i, j, k);
    for (std::size_t q = 0; q < 7; ++q) origin_[q][a] = x[q];
  }
  std::size_t bytes() const { return bytes_; }
  /// All stored doubles, ghosts and padding included.
  std::span<Real> storage() { return {static_cast<Real*>(storage_.get()), bytes_ / sizeof(Real)}; }
  std::span<Real const> storage() const { return {static_cast<Real const*>(storage_.get()), bytes_ / sizeof(Real)}; }
  /// Sets every stored cell, ghosts and padding included: lanes beyond the last cell of a row then never compute with
  /// rubbish. There are no products.
  void fill(State const& u);

 private:
  Index id_;
  CellIndex first_{};
  std::array<Index, 3> size_{}, ghost_{};
  std::array<std::ptrdiff_t, 3> stride_{};
  std::array<Real*, max_components> origin_{};
  int components_;
  std::size_t bytes_ = 0;
  std::ptrdiff_t array_length_ = 0, origin_offset_ = 0;
  struct Free {
    void operator()(void* p) const;
  };
  std::unique_ptr<void, Free> storage_;
};

}  // namespace brisance::fluid
