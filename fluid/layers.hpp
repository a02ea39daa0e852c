// Layers of cells around blocks: one value per cell, exchanged with the neighbours of all directions at once.
#pragma once
#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "fluid/grid/block.hpp"
#include "parallel/comm.hpp"

namespace brisance::fluid {

/// One value per cell of a block and per ghost within `width` of its faces (none across absent directions).
template <class T>
class CellLayer {
 public:
  CellLayer(Block const& block, Index width) : size_(block.size()) {
    std::ptrdiff_t length = 1, first = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      ghost_[d] = block.ghost()[d] > 0 ? width : 0;
      stride_[d] = length;
      first += length * ghost_[d];
      length *= size_[d] + 2 * ghost_[d];
    }
    first_ = first;
    data_.assign(static_cast<std::size_t>(length), T{});
  }
  std::array<Index, 3> size() const { return size_; }
  std::array<Index, 3> ghost() const { return ghost_; }
  std::array<std::ptrdiff_t, 3> stride() const { return stride_; }
  T* at(Index i, Index j, Index k) { return data_.data() + first_ + i * stride_[0] + j * stride_[1] + k * stride_[2]; }
  T const* at(Index i, Index j, Index k) const {
    return data_.data() + first_ + i * stride_[0] + j * stride_[1] + k * stride_[2];
  }
  void fill(T value) { std::fill(data_.begin(), data_.end(), value); }
  std::size_t bytes() const { return data_.size() * sizeof(T); }

 private:
  std::array<Index, 3> size_, ghost_{};
  std::array<std::ptrdiff_t, 3> stride_{};
  std::ptrdiff_t first_ = 0;
  std::vector<T> data_;
};

/// Fills ghosts of the layers of all owned blocks across their faces, edges and corners left out.
template <class T>
class LayerExchange {
 public:
  /// `blocks`: owned blocks in ascending order of id; `width` ghosts are filled. `tag` tells exchanges apart that are
  /// under way at the same time.
  LayerExchange(Grid const& grid, std::vector<int> const& owner, std::vector<Block> const& blocks, Index width,
                parallel::Comm& comm, int tag)
      : width_(width), comm_(comm), tag_(tag) {
    int const me = comm.rank();
    auto const position = [&](Index id) {
      auto const at = std::lower_bound(blocks.begin(), blocks.end(), id,
                                       [](Block const& block, Index wanted) { return block.id() < wanted; });
      return static_cast<std::size_t>(at - blocks.begin());
    };
    // Every rank walks all receiving faces in the same order, so both ends of a message agree on its content.
    for (int d = 0; d < grid.dimension; ++d)
      for (Index b = 0; b < grid.block_count(); ++b)
        for (int side = 0; side < 2; ++side) {
          int const receiver = owner[static_cast<std::size_t>(b)];
          Index const other = grid.neighbour(b, d, side);
          if (other < 0) {
            if (receiver == me) domain_.push_back({position(b), d, side});
            continue;
          }
          int const sender = owner[static_cast<std::size_t>(other)];
          if (receiver == me && sender == me)
            copies_.push_back({{position(b), d, side}, position(other)});
          else if (receiver == me)
            partner(sender).receives.push_back({position(b), d, side});
          else if (sender == me)
            partner(receiver).sends.push_back({position(other), d, 1 - side});
        }
    for (Partner& p : partners_) {
      for (Face const& f : p.sends) p.out.resize(p.out.size() + cells(blocks[f.block], f));
      for (Face const& f : p.receives) p.in.resize(p.in.size() + cells(blocks[f.block], f));
    }
    for (Partner& p : partners_) {
      sends_.push_back({p.rank, std::as_bytes(std::span(p.out))});
      receives_.push_back({p.rank, std::as_writable_bytes(std::span(p.in))});
    }
  }

  /// Between neighbours; `at_domain(layer, direction, side)` fills the ghosts on a side of the domain. Only from blocks
  /// for which `fresh(position)` is true: the ghosts that look at the others hold their values already. Messages are
  /// sent whole. Afterwards received(position) tells whose ghosts were written.
  template <class AtDomain, class Fresh>
  void run(std::vector<CellLayer<T>>& layers, AtDomain at_domain, Fresh fresh) {
    received_.assign(layers.size(), 0);
    for (Partner& p : partners_) {
      T* out = p.out.data();
      for (Face const& f : p.sends)
        for_rows(layers[f.block], planes(layers[f.block], f, 0),
                 [&](T* row, Index n) { out = std::copy_n(row, n, out); });
    }
    std::unique_ptr<parallel::Comm::Pending> pending;
    if (!partners_.empty()) pending = comm_.start(sends_, receives_, tag_);
    for (auto const& [to, from] : copies_) {
      if (!fresh(from)) continue;
      received_[to.block] = 1;
      CellLayer<T>& source = layers[from];
      CellLayer<T>& target = layers[to.block];
      CellIndex const first = planes(source, {from, to.direction, 1 - to.side}, 0).begin;
      Planes const ghosts = planes(target, to, -width_);
      for_rows(target, ghosts, [&, j = Index{0}, k = Index{0}](T* row, Index n) mutable {
        std::copy_n(source.at(first[0], first[1] + j, first[2] + k), n, row);
        if (++j == ghosts.end[1] - ghosts.begin[1]) j = 0, ++k;
      });
    }
    for (Face const& f : domain_)
      if (fresh(f.block)) at_domain(layers[f.block], f.direction, f.side);
    if (pending) pending->finish();
    for (Partner& p : partners_) {
      T const* in = p.in.data();
      for (Face const& f : p.receives) {
        for_rows(layers[f.block], planes(layers[f.block], f, -width_), [&](T* row, Index n) {
          std::copy_n(in, n, row);
          in += n;
        });
        received_[f.block] = 1;
      }
    }
  }
  bool received(std::size_t position) const { return received_[position]; }
  std::size_t bytes() const {
    std::size_t n = 0;
    for (Partner const& p : partners_) n += p.in.size() + p.out.size();
    return n * sizeof(T);
  }

 private:
  struct Face {
    std::size_t block;
    int direction, side;
  };
  struct Copy {
    Face to;
    std::size_t from;
  };
  struct Partner {
    int rank;
    std::vector<Face> sends, receives;
    std::vector<T> out, in;
  };

  std::size_t cells(Block const& block, Face const& f) const {
    auto const [nx, ny, nz] = block.size();
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) *
           static_cast<std::size_t>(nz) / static_cast<std::size_t>(block.size()[static_cast<std::size_t>(f.direction)]);
  }
  struct Planes {
    CellIndex begin, end;
  };
  /// The `width` planes of cells at a face: those inside (`from` 0) or the ghosts (-width).
  Planes planes(CellLayer<T> const& layer, Face const& f, Index from) const {
    auto const d = static_cast<std::size_t>(f.direction);
    Planes p{{0, 0, 0}, layer.size()};
    p.begin[d] = f.side == 0 ? from : layer.size()[d] - from - width_;
    p.end[d] = p.begin[d] + width_;
    return p;
  }
  template <class Visit>
  static void for_rows(CellLayer<T>& layer, Planes const& p, Visit visit) {
    for (Index k = p.begin[2]; k < p.end[2]; ++k)
      for (Index j = p.begin[1]; j < p.end[1]; ++j) visit(layer.at(p.begin[0], j, k), p.end[0] - p.begin[0]);
  }
  Partner& partner(int rank) {
    for (Partner& p : partners_)
      if (p.rank == rank) return p;
    partners_.push_back({rank, {}, {}, {}, {}});
    return partners_.back();
  }

  Index width_;
  parallel::Comm& comm_;
  int tag_;
  std::vector<Copy> copies_;
  std::vector<Face> domain_;
  std::vector<Partner> partners_;
  std::vector<parallel::Comm::Send> sends_;
  std::vector<parallel::Comm::Receive> receives_;
  std::vector<char> received_;
};

}  // namespace brisance::fluid
