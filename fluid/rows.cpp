#include "fluid/rows.hpp"

namespace brisance::fluid {
namespace {

std::int64_t cells_of(CellIndex const& size) { return std::int64_t{size[0]} * size[1] * size[2]; }

std::size_t cells_of(Flow const& flow) {
  std::int64_t n = 0;
  for (Block const& block : flow.blocks()) n += cells_of(block.size());
  return static_cast<std::size_t>(n);
}

template <class Blocks, class Visit>
void for_cells(Blocks& blocks, Visit&& visit) {
  for (auto& block : blocks) {
    auto const [nx, ny, nz] = block.size();
    for (Index k = 0; k < nz; ++k)
      for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i) visit(block, i, j, k);
  }
}

}  // namespace

std::vector<parallel::Range> block_rows(Flow const& flow) {
  std::vector<parallel::Range> ranges;
  std::int64_t row = 0;
  for (Index b = 0; b < flow.grid().block_count(); ++b) {
    std::int64_t const count = cells_of(flow.grid().block_size(b));
    if (flow.owner(b) == flow.comm().rank()) ranges.push_back({row, count});
    row += count;
  }
  return ranges;
}

std::vector<double> pack_cells(Flow const& flow) {
  std::vector<double> data;
  data.reserve(static_cast<std::size_t>(flow.components()) * cells_of(flow));
  for_cells(flow.blocks(), [&](Block const& block, Index i, Index j, Index k) {
    for (int q = 0; q < block.components(); ++q) data.push_back(block.component(q)[block.at(i, j, k)]);
  });
  return data;
}

void unpack_cells(Flow& flow, std::span<double const> data) {
  std::size_t at = 0;
  for_cells(flow.blocks(), [&](Block& block, Index i, Index j, Index k) {
    for (int q = 0; q < block.components(); ++q) block.component(q)[block.at(i, j, k)] = data[at++];
  });
}

std::vector<parallel::ArchiveWriter::Box> cell_boxes(Flow const& flow) {
  std::vector<parallel::ArchiveWriter::Box> boxes;
  for (Block const& block : flow.blocks()) {
    CellIndex const first = block.first(), size = block.size();
    boxes.push_back({{first[0], first[1], first[2]}, {size[0], size[1], size[2]}});
  }
  return boxes;
}

}  // namespace brisance::fluid
