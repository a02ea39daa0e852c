#include "fluid/ghosts.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>

#include "fluid/boundary/products.hpp"

namespace brisance::fluid {
namespace {

/// A box of local cells.
struct CellRange {
  CellIndex first, size;
  std::size_t cells() const { return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1] * size[2]); }
};

GhostRange range_of(Block const& block, int direction, GhostShape const& shape) {
  std::size_t const d = static_cast<std::size_t>(direction);
  GhostRange range{shape.depth > 0 ? shape.depth : block.ghost()[d]};
  if (shape.edges)
    for (std::size_t e = 0; e < d; ++e) range.margin[e] = range.depth;
  return range;
}

CellRange slab_at(Block const& block, int direction, int side, GhostRange const& ghosts, Index first_from_side) {
  std::size_t const d = static_cast<std::size_t>(direction);
  CellRange range{{0, 0, 0}, block.size()};
  for (std::size_t e = 0; e < 3; ++e) range.first[e] -= ghosts.margin[e], range.size[e] += 2 * ghosts.margin[e];
  range.size[d] = ghosts.depth;
  range.first[d] = side == 0 ? first_from_side : block.size()[d] - first_from_side - range.size[d];
  return range;
}
CellRange ghost_slab(Block const& block, int d, int side, GhostShape const& shape) {
  GhostRange const range = range_of(block, d, shape);
  return slab_at(block, d, side, range, -range.depth);
}
CellRange inner_slab(Block const& block, int d, int side, GhostShape const& shape) {
  return slab_at(block, d, side, range_of(block, d, shape), 0);
}

template <class Visit>
void for_rows(Block const& block, CellRange const& range, Visit&& visit) {
  for (int q = 0; q < block.components(); ++q)
    for (Index k = 0; k < range.size[2]; ++k)
      for (Index j = 0; j < range.size[1]; ++j) visit(q, range.first[0], range.first[1] + j, range.first[2] + k);
}

/// Rows of an x slab are as short as the ghosts are deep: a call for each would cost more than the copy.
Real* copy_row(Real const* from, Index n, Real* to) {
  switch (n) {
    case 3:
      std::memcpy(to, from, 3 * sizeof(Real));
      break;
    case 4:
      std::memcpy(to, from, 4 * sizeof(Real));
      break;
    case 5:
      std::memcpy(to, from, 5 * sizeof(Real));
      break;
    case 6:
      std::memcpy(to, from, 6 * sizeof(Real));
      break;
    default:
      std::copy_n(from, n, to);
  }
  return to + n;
}

void copy(Block const& from, CellRange const& source, Block& to, CellRange const& target) {
  CellIndex const shift{target.first[0] - source.first[0], target.first[1] - source.first[1],
                        target.first[2] - source.first[2]};
  for_rows(from, source, [&](int q, Index i, Index j, Index k) {
    copy_row(from.component(q) + from.at(i, j, k), source.size[0],
             to.component(q) + to.at(i + shift[0], j + shift[1], k + shift[2]));
  });
}

void fill(Block& block, CellRange const& range, State const& u) {
  for_rows(block, range, [&](int q, Index i, Index j, Index k) {
    std::fill_n(block.component(q) + block.at(i, j, k), range.size[0], u[static_cast<std::size_t>(q)]);
  });
}

bool holds_only(Block const& block, CellRange const& range, State const& u) {
  for (std::size_t q = 0; q < 5; ++q) {
    auto const wanted = std::bit_cast<std::uint64_t>(u[q]);
    for (Index k = 0; k < range.size[2]; ++k)
      for (Index j = 0; j < range.size[1]; ++j) {
        Real const* const row =
            block.component(static_cast<int>(q)) + block.at(range.first[0], range.first[1] + j, range.first[2] + k);
        std::uint64_t difference = 0;
        for (Index i = 0; i < range.size[0]; ++i) difference |= std::bit_cast<std::uint64_t>(row[i]) ^ wanted;
        if (difference != 0) return false;
      }
  }
  return true;
}

Real* pack(Block const& block, CellRange const& range, Real* out) {
  for_rows(block, range, [&](int q, Index i, Index j, Index k) {
    out = copy_row(block.component(q) + block.at(i, j, k), range.size[0], out);
  });
  return out;
}

Real const* unpack(Block& block, CellRange const& range, Real const* in) {
  for_rows(block, range, [&](int q, Index i, Index j, Index k) {
    copy_row(in, range.size[0], block.component(q) + block.at(i, j, k));
    in += range.size[0];
  });
  return in;
}

}  // namespace

Ghosts::Ghosts(Grid const& grid, std::vector<int> const& owner, std::vector<Block>& blocks,
               Boundaries const& boundaries, parallel::Comm& comm, GhostShape shape, FillSide fill_side)
    : blocks_(blocks),
      boundaries_(boundaries),
      comm_(comm),
      shape_(shape),
      fill_side_(std::move(fill_side)),
      ends_(blocks.size()) {
  for (int d = 0; d < grid.dimension; ++d) {
    build(grid, owner, d);
    Grid pencil;
    pencil.dimension = grid.dimension;
    auto const along = static_cast<std::size_t>(d);
    Index const depth = blocks.empty() ? 1 : blocks.front().ghost()[along];
    pencil.cells[along] = 2 * depth;
    for (std::size_t e = 0; e < 3; ++e) pencil.cuts[e] = {0, pencil.cells[e]};
    pencils_.emplace_back(pencil, 0, depth);
  }
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
    for (Slab const& s : slabs)
      n += 1 + static_cast<std::size_t>(blocks_[s.block].components()) *
                   ghost_slab(blocks_[s.block], direction, s.side, shape_).cells();
    return n;
  };
  for (Partner& p : exchange.partners) {
    p.out.resize(doubles(p.sends));
    p.in.resize(doubles(p.receives));
    exchange.sends.push_back({p.rank, std::as_bytes(std::span(p.out))});
    exchange.receives.push_back({p.rank, std::as_writable_bytes(std::span(p.in))});
  }
}

void Ghosts::set_end(Slab const& slab, int direction, State const& state) {
  if (sleepy(slab.block))
    ends_[slab.block][static_cast<std::size_t>(slab.side)] = {true, false, state};
  else
    fill(blocks_[slab.block], ghost_slab(blocks_[slab.block], direction, slab.side, shape_), state);
}

/// The ghosts of `slab` are filled: does it matter to a uniform block that they hold one state?
void Ghosts::look_at_end(Slab const& slab, int direction) {
  if (!sleepy(slab.block)) return;
  Block const& block = blocks_[slab.block];
  CellRange const ghosts = ghost_slab(block, direction, slab.side, shape_);
  State const first = block.load(ghosts.first[0], ghosts.first[1], ghosts.first[2]);
  ends_[slab.block][static_cast<std::size_t>(slab.side)] = {holds_only(block, ghosts, first), true, first};
}

/// The ghosts of a uniform block at a side of the domain, without a look at the block, which is in no cache. False
/// where they must be filled to know.
bool Ghosts::find_end(Slab const& slab, int direction, Real time) {
  if (!sleepy(slab.block) || !boundaries_.same_along(direction, slab.side)) return false;
  State const& inside = *uniform_->state(slab.block);
  auto known = std::find_if(tried_.begin(), tried_.end(),
                            [&](Tried const& t) { return t.side == slab.side && same_bits(t.inside, inside); });
  if (known == tried_.end()) {
    Block& pencil = pencils_[static_cast<std::size_t>(direction)];
    pencil.fill(inside);
    boundaries_.fill(pencil, direction, slab.side, time);
    CellRange const ghosts = ghost_slab(pencil, direction, slab.side, shape_);
    State const first = pencil.load(ghosts.first[0], ghosts.first[1], ghosts.first[2]);
    bool const one_state = holds_only(pencil, ghosts, first);
    tried_.push_back({slab.side, inside, one_state ? std::optional(first) : std::nullopt});
    known = tried_.end() - 1;
  }
  if (!known->ghosts) return false;
  set_end(slab, direction, *known->ghosts);
  return true;
}

void Ghosts::complete(std::size_t block, int direction) {
  if (!sleepy(block)) return;
  for (int side = 0; side < 2; ++side) {
    End& end = ends_[block][static_cast<std::size_t>(side)];
    if (!end.filled) fill(blocks_[block], ghost_slab(blocks_[block], direction, side, shape_), end.state);
    end.filled = true;
  }
}

void Ghosts::start(int direction, Real time, UniformBlocks const* uniform) {
  Exchange& exchange = exchanges_[static_cast<std::size_t>(direction)];
  uniform_ = uniform;
  for (std::size_t m = 0; m < exchange.partners.size(); ++m) {
    Partner& p = exchange.partners[m];
    Real* out = p.out.data();
    for (Slab const& s : p.sends) {
      *out++ = sleepy(s.block) ? 1 : 0;
      out = sleepy(s.block) ? std::ranges::copy(*uniform_->state(s.block), out).out
                            : pack(blocks_[s.block], inner_slab(blocks_[s.block], direction, s.side, shape_), out);
    }
    std::span<Real const> const message(p.out.data(), out);
    // Whole where the transport cuts messages into pieces, whose number both ends must agree on.
    bool const whole = p.out.size() * sizeof(Real) > parallel::Comm::longest_variable;
    exchange.sends[m].data = std::as_bytes(whole ? std::span<Real const>(p.out) : message);
  }
  if (!exchange.sends.empty()) pending_ = comm_.start(exchange.sends, exchange.receives, direction);
  for (Copy const& c : exchange.copies) {
    Block const& from = blocks_[c.from];
    if (sleepy(c.from)) {
      set_end({c.to, c.side}, direction, *uniform_->state(c.from));
      continue;
    }
    copy(from, inner_slab(from, direction, 1 - c.side, shape_), blocks_[c.to],
         ghost_slab(blocks_[c.to], direction, c.side, shape_));
    look_at_end({c.to, c.side}, direction);
  }
  tried_.clear();
  for (Slab const& s : exchange.domain) {
    if (find_end(s, direction, time)) continue;
    Block& block = blocks_[s.block];
    if (fill_side_)
      fill_side_(block, direction, s.side, time, range_of(block, direction, shape_));
    else
      boundaries_.fill(block, direction, s.side, time, range_of(block, direction, shape_));
    if (block.components() > 5) fill_products(block, direction, s.side, boundaries_.law(direction, s.side));
    look_at_end(s, direction);
  }
}

void Ghosts::finish(int direction) {
  if (!pending_) return;
  pending_->finish();
  pending_.reset();
  for (Partner& p : exchanges_[static_cast<std::size_t>(direction)].partners) {
    Real const* in = p.in.data();
    for (Slab const& s : p.receives) {
      bool const one_state = *in++ != 0;
      if (one_state) {
        State state;
        std::copy_n(in, 5, state.begin());
        in += 5;
        set_end(s, direction, state);
      } else {
        in = unpack(blocks_[s.block], ghost_slab(blocks_[s.block], direction, s.side, shape_), in);
        look_at_end(s, direction);
      }
    }
  }
}

std::size_t Ghosts::bytes() const {
  std::size_t n = 0;
  for (Exchange const& e : exchanges_)
    for (Partner const& p : e.partners) n += (p.in.size() + p.out.size()) * sizeof(Real);
  return n;
}

}  // namespace brisance::fluid
