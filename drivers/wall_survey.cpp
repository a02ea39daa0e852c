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

/// Do two faces of one wall meet the same cell, with the solid between them?
bool two_sided(coupling::Geometry const& geometry, coupling::CutCell const& cut) {
  for (Index f = cut.first_piece; f < cut.last_piece; ++f)
    for (Index g = cut.first_piece; g < f; ++g) {
      coupling::Piece const& a = geometry.pieces[static_cast<std::size_t>(f)];
      coupling::Piece const& b = geometry.pieces[static_cast<std::size_t>(g)];
      if (dot(a.area, b.area) > -0.9 * norm(a.area) * norm(b.area)) continue;
      Vec3 const apart = b.centroid - a.centroid;
      if (dot(apart, a.area) < 0 && dot(apart, b.area) > 0) return true;
    }
  return false;
}

}  // namespace

WallSurvey survey_walls(fluid::Grid const& grid, solid::Mesh const& mesh, solid::Surface const& surface, bool divides) {
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
  Index thin = 0;
  Vec3 where;
  for (coupling::CutCell const& c : geometry.cells) {
    auto const block = static_cast<std::size_t>(grid.block_of(c.cell));
    bool moving = false;
    for (Index f = c.first_piece; f < c.last_piece; ++f)
      moving = moving || moves[static_cast<std::size_t>(geometry.pieces[static_cast<std::size_t>(f)].triangle)];
    ++survey.cells[block];
    survey.work[block] += price(grid.dimension, moving);
    if (divides || !two_sided(geometry, c)) continue;
    if (thin++ == 0) where = grid.centre(c.cell);
  }
  if (thin > 0)
    survey.thin = fmt::format(
        "coupling.cut_cells: in {} of {} cut cells, the first at ({:.6g}, {:.6g}, {:.6g}) m, both faces of a wall meet "
        "the one state of the gas in the cell: there it leaks. A wall of 0.8 cells loses half of a tenfold pressure, "
        "one of 1.6 cells nothing. Nothing leaks where cells have a state for every part of their gas: with scheme "
        "\"lag\" or \"semi\", small_cells \"merging\", profile \"constant\" and no viscosity; else use cells that are "
        "smaller than half the wall",
        thin, geometry.cells.size(), where.x, where.y, where.z);
  if (divides) {
    coupling::CellParts parts;
    coupling::divide(lattice, geometry, coupling::covered_fraction * grid.cell_volume(), parts);
    Vec3 const at = grid.centre(parts.undivided_cell);
    if (parts.undivided > 0)
      survey.thin = fmt::format(
          "coupling.cut_cells: in {} of {} cut cells, one of them at ({:.6g}, {:.6g}, {:.6g}) m, walls that overlap or "
          "run along grid planes leave the gas on their sides one state: there it leaks. Move the body by a part of a "
          "cell, or use cells that are smaller than half the wall",
          parts.undivided, geometry.cells.size(), at.x, at.y, at.z);
  }
  return survey;
}

}  // namespace brisance::drivers
