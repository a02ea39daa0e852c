#include "fluid/grid/block.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace brisance::fluid {
namespace {

constexpr std::ptrdiff_t doubles_per_line = 8, doubles_per_page = 512;
// The arrays start this much further into a page each, so that equal cells do not fall into the same cache sets.
constexpr std::ptrdiff_t shift_per_array = 104;
static_assert(shift_per_array % doubles_per_line == 0);

std::ptrdiff_t rounded_up(std::ptrdiff_t n, std::ptrdiff_t unit) { return (n + unit - 1) / unit * unit; }

}  // namespace

void Block::Free::operator()(void* p) const { std::free(p); }

Block::Block(Grid const& grid, Index id, Index ghost_depth, int components)
    : id_(id), first_(grid.block_first(id)), size_(grid.block_size(id)), components_(components) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(grid.dimension); ++d) ghost_[d] = ghost_depth;
  std::ptrdiff_t const row = rounded_up(size_[0], row_pad) + 2 * row_pad;
  std::ptrdiff_t const rows = size_[1] + 2 * ghost_[1], planes = size_[2] + 2 * ghost_[2];
  stride_ = {1, row, row * rows};
  array_length_ = rounded_up(row * rows * planes, doubles_per_page) + shift_per_array;
  origin_offset_ = row_pad + ghost_[1] * stride_[1] + ghost_[2] * stride_[2];
  bytes_ = static_cast<std::size_t>(rounded_up(components_ * array_length_, doubles_per_page)) * sizeof(Real);
  storage_.reset(std::aligned_alloc(doubles_per_page * sizeof(Real), bytes_));
  if (!storage_) throw std::bad_alloc();
  std::span<Real> const all = storage();
  std::fill(all.begin(), all.end(), 0.0);
  for (std::size_t q = 0; q < static_cast<std::size_t>(components_); ++q)
    origin_[q] = all.data() + static_cast<std::ptrdiff_t>(q) * array_length_ + origin_offset_;
}

void Block::fill(State const& u) {
  for (std::size_t q = 0; q < static_cast<std::size_t>(components_); ++q) {
    Real* const begin = origin_[q] - origin_offset_;
    std::fill(begin, begin + array_length_, q < 5 ? u[q] : 0.0);
  }
}

}  // namespace brisance::fluid
