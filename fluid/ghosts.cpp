#include "fluid/ghosts.hpp"

#include <algorithm>
#include <map>

namespace brisance::fluid {
namespace {

/// A box of local cells.
struct CellRange {
  CellIndex first, size;
  std::size_t cells() const { return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1] * size[2]); }
};

CellRange slab_at(Block const& block, int direction, int side, Index first_from_side) {
  std::size_t const d = static_cast<std::size_t>(direction);
  CellRange range{{0, 0, 0}, block.size()};
  range.size[d] = block.ghost()[d];
  range.first[d] = side == 0 ? first_from_side : block.size()[d] - first_from_side - range.size[d];
  return range;
}
CellRange ghost_slab(Block const& block, int d, int side) {
  return slab_at(block, d, side, -block.ghost()[static_cast<std::size_t>(d)]);
}
CellRange inner_slab(Block const& block, int d, int side) { return slab_at(block, d, side, 0); }

template <class Visit>
void for_rows(CellRange const& range, Visit&& visit) {
  for (int q = 0; q < 5; ++q)
    for (Index k = 0; k < range.size[2]; ++k)
      for (Index j = 0; j < range.size[1]; ++j) visit(q, range.first[0], range.first[1] + j, range.first[2] + k);
}

void copy(Block const& from, CellRange const& source, Block& to, CellRange const& target) {
  CellIndex const shift{target.first[0] - source.first[0], target.first[1] - source.first[1],
                        target.first[2] - source.first[2]};
  for_rows(source, [&](int q, Index i, Index j, Index k) {
    std::copy_n(from.component(q) + from.at(i, j, k), source.size[0],
                to.component(q) + to.at(i + shift[0], j + shift[1], k + shift[2]));
  });
}

Real* pack(Block const& block, CellRange const& range, Real* out) {
  for_rows(range, [&](int q, Index i, Index j, Index k) {
    out = std::copy_n(block.component(q) + block.at(i, j, k), range.size[0], out);
  });
  return out;
}

Real const* unpack(Block& block, CellRange const& range, Real const* in) {
  for_rows(range, [&](int q, Index i, Index j, Index k) {
    std::copy_n(in, range.size[0], block.component(q) + block.at(i, j, k));
    in += range.size[0];
  });
  return in;
}

}  // namespace

Ghosts::Ghosts(Grid const& grid, std::vector<int> const& owner, std::vector<Block>& blocks,
               Boundaries const& boundaries, parallel::Comm& comm)
    : blocks_(blocks), boundaries_(boundaries), comm_(comm) {
  for (int d = 0; d < grid.dimension; ++d) build(grid, owner, d);
}

Ghosts::Partner& Ghosts::partner(Exchange& exchange, int rank) {
  for (Partner& p : exchange.partners)
    if (p.rank == rank) return p;
  exchange.partners.push_back({rank, {}, {}, {}, {}});
  return exchange.partners.back();
}

void Ghosts::build(Grid const& grid, std::vector<int> const& owner, int direction) {
  Exchange& exchange = exchanges_[static_cast<std::size_t>(direction)];
  std::map<Index, std::size_t> position;
  for (std::size_t p = 0; p < blocks_.size(); ++p) position[blocks_[p].id()] = p;
  int const me = comm_.rank();
  std::vector<char> waits(blocks_.size(), 0);
  // Every rank walks all receiving blocks in the same order, so both ends of a message agree on its content.
  for (Index b = 0; b < grid.block_count(); ++b)
    for (int side = 0; side < 2; ++side) {
      int const receiver = owner[static_cast<std::size_t>(b)];
      Index const other = grid.neighbour(b, direction, side);
      if (other < 0) {
        if (receiver == me) exchange.domain.push_back({position.at(b), side});
        continue;
      }
      int const sender = owner[static_cast<std::size_t>(other)];
      if (receiver == me && sender == me) {
        exchange.copies.push_back({position.at(b), position.at(other), side});
      } else if (receiver == me) {
        partner(exchange, sender).receives.push_back({position.at(b), side});
        waits[position.at(b)] = 1;
      } else if (sender == me) {
        partner(exchange, receiver).sends.push_back({position.at(other), 1 - side});
      }
    }
  for (std::size_t p = 0; p < blocks_.size(); ++p) (waits[p] ? exchange.waiting : exchange.ready).push_back(p);
  auto const doubles = [&](std::vector<Slab> const& slabs) {
    std::size_t n = 0;
    for (Slab const& s : slabs) n += 5 * ghost_slab(blocks_[s.block], direction, s.side).cells();
    return n;
  };
  for (Partner& p : exchange.partners) {
    p.out.resize(doubles(p.sends));
    p.in.resize(doubles(p.receives));
    exchange.sends.push_back({p.rank, std::as_bytes(std::span(p.out))});
    exchange.receives.push_back({p.rank, std::as_writable_bytes(std::span(p.in))});
  }
}

void Ghosts::start(int direction, Real time) {
  Exchange& exchange = exchanges_[static_cast<std::size_t>(direction)];
  for (Partner& p : exchange.partners) {
    Real* out = p.out.data();
    for (Slab const& s : p.sends) out = pack(blocks_[s.block], inner_slab(blocks_[s.block], direction, s.side), out);
  }
  if (!exchange.sends.empty()) pending_ = comm_.start(exchange.sends, exchange.receives, direction);
  for (Copy const& c : exchange.copies) {
    Block const& from = blocks_[c.from];
    copy(from, inner_slab(from, direction, 1 - c.side), blocks_[c.to], ghost_slab(blocks_[c.to], direction, c.side));
  }
  for (Slab const& s : exchange.domain) boundaries_.fill(blocks_[s.block], direction, s.side, time);
}

void Ghosts::finish(int direction) {
  if (!pending_) return;
  pending_->finish();
  pending_.reset();
  for (Partner& p : exchanges_[static_cast<std::size_t>(direction)].partners) {
    Real const* in = p.in.data();
    for (Slab const& s : p.receives) in = unpack(blocks_[s.block], ghost_slab(blocks_[s.block], direction, s.side), in);
  }
}

std::size_t Ghosts::bytes() const {
  std::size_t n = 0;
  for (Exchange const& e : exchanges_)
    for (Partner const& p : e.partners) n += (p.in.size() + p.out.size()) * sizeof(Real);
  return n;
}

}  // namespace brisance::fluid
