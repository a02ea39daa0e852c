#include "coupling/cut_cells/start_exchange.hpp"

#include <algorithm>
#include <map>

#include "coupling/cut_cells/cell_geometry.hpp"

namespace brisance::coupling {

void StartExchange::begin(WallRecord const& record) {
  auto const& pieces = record.geometry.pieces;
  shares_.assign(pieces.size(), {});
  of_triangle_.clear();
  for (std::size_t p = 0; p < pieces.size(); ++p)
    of_triangle_.emplace_back(record.triangles[static_cast<std::size_t>(pieces[p].triangle)].id, static_cast<Index>(p));
  std::sort(of_triangle_.begin(), of_triangle_.end());
}

std::size_t StartExchange::first_of(GlobalId triangle) const {
  return static_cast<std::size_t>(
      std::lower_bound(of_triangle_.begin(), of_triangle_.end(), std::pair<GlobalId, Index>{triangle, 0}) -
      of_triangle_.begin());
}

void StartExchange::give(WallRecord const& record, std::size_t piece, Share const& received) {
  Piece const& p = record.geometry.pieces[piece];
  Real const share = part_of(record.geometry.corners_of(p)).share;
  if (share > 0)
    shares_[piece] = {received.force / share, received.heat / share, norm(p.area) / share, received.beyond / share,
                      received.beyond_power / share};
}

void StartExchange::exchange(WallRecord const& record, fluid::Flow const& flow, parallel::Comm& comm) {
  if (comm.size() == 1) return;
  // Pieces of a cell are listed in the same order on every rank that has them.
  struct Row {
    GlobalId cell;
    Index place;
    Share share;
  };
  fluid::Grid const& grid = flow.grid();
  std::map<int, parallel::Bytes> to;
  for (CutCell const& cut : record.geometry.cells) {
    if (!grid.inside(cut.cell) || flow.owner(grid.block_of(cut.cell)) != comm.rank()) continue;
    std::vector<int> told{comm.rank()};
    for_neighbourhood(grid, cut.cell, 1, [&](CellIndex n) {
      if (!grid.inside(n)) return;
      int const rank = flow.owner(grid.block_of(n));
      if (std::find(told.begin(), told.end(), rank) != told.end()) return;
      told.push_back(rank);
      for (Index f = cut.first_piece; f < cut.last_piece; ++f)
        parallel::put(to[rank], Row{grid.cell_id(cut.cell), f - cut.first_piece, shares_[static_cast<std::size_t>(f)]});
    });
  }
  std::vector<parallel::Message> out;
  for (auto& [rank, data] : to) out.push_back({rank, std::move(data)});
  for (parallel::Message const& message : comm.deliver(std::move(out)))
    for (std::span<std::byte const> in(message.data); !in.empty();) {
      Row const row = parallel::take<Row>(in);
      Index const cut = record.cut_index(cell_from_id(grid, row.cell));
      if (cut < 0) continue;
      shares_[static_cast<std::size_t>(record.cut(cut).first_piece + row.place)] = row.share;
    }
}

}  // namespace brisance::coupling
