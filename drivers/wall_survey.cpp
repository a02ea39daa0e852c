#include "drivers/wall_survey.hpp"

#include <fmt/format.h>

#include "coupling/cut_cells/wall_record.hpp"
#include "parallel/error.hpp"

namespace brisance::drivers {

namespace {

/// Price of a cut cell in plain cells, as measured on whole runs (coupling/README.md). Constants, and not the times of
/// this run: the same scene gets the same partition.
std::int64_t price(int dimension, bool moves) {
  if (dimension == 3) return moves ? 150 : 40;
  return moves ? 150 : 30;
}

}  // namespace

WallSurvey survey_walls(fluid::Grid const& grid, solid::Mesh const& mesh, solid::Surface const& surface) {
  std::vector<coupling::SurfaceTriangle> triangles;
  std::vector<bool> moves;
  for (solid::Element const& t : surface.elements()) {
    coupling::SurfaceTriangle triangle;
    triangle.id = t.id;
    for (std::size_t a = 0; a < static_cast<std::size_t>(grid.dimension); ++a) {
      triangle.vertex[a] = t.vertex[a];
      triangle.x_new[a] = surface.reference(t.vertex[a], mesh);
    }
    triangle.x_old = triangle.x_new;
    triangles.push_back(triangle);
    moves.push_back(mesh.particle(t.particle).freedom != solid::Freedom::fixed);
  }
  coupling::Lattice const lattice{grid.dimension, grid.low, grid.spacing};
  coupling::CellBox const all{{0, 0, 0}, grid.cells};
  coupling::Geometry geometry;
  coupling::build(lattice, triangles, std::span(&all, 1), geometry);
  coupling::require_closed(lattice, geometry);
  require(geometry.inverted == 0, Failure::scene, "the surface of a body is inside out, or folds through itself");

  WallSurvey survey;
  survey.cells.assign(static_cast<std::size_t>(grid.block_count()), 0);
  survey.work.assign(survey.cells.size(), 0);
  for (coupling::CutCell const& c : geometry.cells) {
    auto const block = static_cast<std::size_t>(grid.block_of(c.cell));
    bool moving = false;
    for (Index f = c.first_piece; f < c.last_piece; ++f)
      moving = moving || moves[static_cast<std::size_t>(geometry.pieces[static_cast<std::size_t>(f)].triangle)];
    ++survey.cells[block];
    survey.work[block] += price(grid.dimension, moving);
  }
  coupling::CellParts parts;
  coupling::divide(lattice, geometry, coupling::covered_fraction * grid.cell_volume(), parts);
  Vec3 const at = grid.centre(parts.undivided_cell);
  if (parts.undivided > 0)
    survey.thin = fmt::format(
        "coupling.cut_cells: in {} of {} cut cells, one of them at ({:.6g}, {:.6g}, {:.6g}) m, walls that overlap or "
        "run along grid planes leave the gas on their sides one state: there it leaks. Move the body by a part of a "
        "cell, or use cells that are smaller than half the wall",
        parts.undivided, geometry.cells.size(), at.x, at.y, at.z);
  return survey;
}

}  // namespace brisance::drivers
