// Cells as rows of checkpoints; the boxes of output fields.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "fluid/flow.hpp"
#include "parallel/archive.hpp"

namespace brisance::fluid {

/// Rows of this rank in the block-major numbering: the cells of block b start after all those of blocks 0..b-1, x
/// fastest.
std::vector<parallel::Range> block_rows(Flow const& flow);
/// The means of those rows: Flow::components() numbers a cell.
std::vector<double> pack_cells(Flow const& flow);
/// Expects: what pack_cells() returned for the same grid and block owners.
void unpack_cells(Flow& flow, std::span<double const> data);

/// The owned blocks as boxes of the global array, for ArchiveWriter::grid.
std::vector<parallel::ArchiveWriter::Box> cell_boxes(Flow const& flow);

}  // namespace brisance::fluid
