// A value per grid cell over a box of cells, with a default everywhere else.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "coupling/geometry/surface.hpp"

namespace brisance::coupling {

inline bool empty(CellBox const& b) { return b.low[0] >= b.high[0] || b.low[1] >= b.high[1] || b.low[2] >= b.high[2]; }
inline bool contains(CellBox const& outer, CellBox const& inner) {
  for (std::size_t d = 0; d < 3; ++d)
    if (inner.low[d] < outer.low[d] || inner.high[d] > outer.high[d]) return false;
  return true;
}

template <class T>
class CellMap {
 public:
  /// Covers `range`; all cells hold `nothing`.
  void cover(CellBox const& range, T nothing) {
    nothing_ = nothing;
    range_ = range;
    stride_y_ = static_cast<std::ptrdiff_t>(range.high[0] - range.low[0]);
    stride_z_ = stride_y_ * (range.high[1] - range.low[1]);
    data_.assign(empty(range) ? 0 : static_cast<std::size_t>(stride_z_ * (range.high[2] - range.low[2])), nothing);
  }
  CellBox const& range() const { return range_; }
  T at(CellIndex c) const { return range_.holds(c) ? data_[offset(c)] : nothing_; }
  /// Expects: c inside the range.
  void set(CellIndex c, T value) { data_[offset(c)] = value; }
  std::size_t bytes() const { return data_.size() * sizeof(T); }

 private:
  std::size_t offset(CellIndex c) const {
    return static_cast<std::size_t>((c[0] - range_.low[0]) + stride_y_ * (c[1] - range_.low[1]) +
                                    stride_z_ * (c[2] - range_.low[2]));
  }
  CellBox range_;
  std::ptrdiff_t stride_y_ = 0, stride_z_ = 0;
  T nothing_{};
  std::vector<T> data_;
};

/// A bit per cell of a box: which cells of a row along x are marked, many at a time.
class CellBits {
 public:
  /// Covers `range`; no cell is marked.
  void cover(CellBox const& range) {
    range_ = range;
    row_ = empty(range) ? 0 : static_cast<std::size_t>(range.high[0] - range.low[0] + 2 * margin) / 8 + 8;
    data_.assign(empty(range) ? 0
                              : row_ * static_cast<std::size_t>(range.high[1] - range.low[1]) *
                                    static_cast<std::size_t>(range.high[2] - range.low[2]),
                 0);
  }
  /// Expects: c inside the range.
  void mark(CellIndex c) { data_[byte(c, 0)] |= bit(c); }
  void unmark(CellIndex c) { data_[byte(c, 0)] &= static_cast<std::uint8_t>(~bit(c)); }
  /// Marks of the cells from c[0] - `within` to c[0] + `within` of the row of c, the first one in the lowest bit.
  /// Expects: within < 16.
  std::uint64_t around(CellIndex c, Index within) const {
    if (c[1] < range_.low[1] || c[1] >= range_.high[1] || c[2] < range_.low[2] || c[2] >= range_.high[2] ||
        c[0] + within < range_.low[0] || c[0] - within >= range_.high[0])
      return 0;
    std::uint64_t bits;
    std::memcpy(&bits, data_.data() + byte(c, within), sizeof bits);
    return (bits >> ((c[0] - within - range_.low[0] + margin) & 7)) & ((std::uint64_t{2} << (2 * within)) - 1);
  }
  std::size_t bytes() const { return data_.size(); }

 private:
  static constexpr Index margin = 32;  ///< unmarked cells at both ends of a row: reads need not ask for its ends
  std::size_t byte(CellIndex c, Index before) const {
    auto const row =
        static_cast<std::size_t>(c[1] - range_.low[1] + (range_.high[1] - range_.low[1]) * (c[2] - range_.low[2]));
    return row * row_ + static_cast<std::size_t>(c[0] - before - range_.low[0] + margin) / 8;
  }
  std::uint8_t bit(CellIndex c) const {
    return static_cast<std::uint8_t>(1u << (static_cast<unsigned>(c[0] - range_.low[0] + margin) & 7));
  }
  CellBox range_{};
  std::size_t row_ = 0;
  std::vector<std::uint8_t> data_;
};

/// A set of cells: each is taken once, in any order; a mark per cell keeps it cheap.
class CellSet {
 public:
  /// Empties the set and makes room for the cells of `range`.
  void start(CellBox const& range) {
    for (CellIndex const& c : cells_) marks_.set(c, 0);
    cells_.clear();
    if (!contains(marks_.range(), range)) marks_.cover(range, 0);
  }
  /// Expects: c within the range.
  void insert(CellIndex c) {
    if (marks_.at(c)) return;
    marks_.set(c, 1);
    cells_.push_back(c);
  }
  bool holds(CellIndex c) const { return marks_.at(c) != 0; }
  std::vector<CellIndex> const& cells() const { return cells_; }

 private:
  CellMap<std::uint8_t> marks_;
  std::vector<CellIndex> cells_;
};

/// Where the cells of a sparse list are in it.
class CellPlaces {
 public:
  /// The list becomes that of `cells`.
  void list(std::span<CellIndex const> cells) {
    for (CellIndex const& c : cells_) places_.set(c, -1);
    cells_.assign(cells.begin(), cells.end());
    if (cells.empty()) return;
    CellBox box{cells.front(), cells.front()};
    for (CellIndex const& c : cells)
      for (std::size_t d = 0; d < 3; ++d) {
        box.low[d] = std::min(box.low[d], c[d]);
        box.high[d] = std::max(box.high[d], c[d] + 1);
      }
    if (!contains(places_.range(), box)) places_.cover(box, -1);
    for (std::size_t i = 0; i < cells.size(); ++i) places_.set(cells[i], static_cast<Index>(i));
  }
  /// -1: not in the list.
  Index of(CellIndex const& c) const { return cells_.empty() ? -1 : places_.at(c); }
  std::size_t bytes() const { return places_.bytes() + cells_.capacity() * sizeof(CellIndex); }

 private:
  CellMap<Index> places_;
  std::vector<CellIndex> cells_;
};

}  // namespace brisance::coupling
