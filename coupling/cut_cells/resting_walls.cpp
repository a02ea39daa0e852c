// The part of a wall record that rests is not cut again. Closed surfaces act on each other only where their cells
// touch: apertures are sums over runs of neighbouring cut cells, with whole numbers between the runs. So the cells of a
// surface that no other one is next to are a function of this surface alone, and the same bits whatever else is cut.
#include <algorithm>
#include <limits>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/wall_record.hpp"
#include "coupling/geometry/clip.hpp"

namespace brisance::coupling {

namespace {

bool has(std::vector<GlobalId> const& sorted, GlobalId id) {
  return std::binary_search(sorted.begin(), sorted.end(), id);
}

void sort_unique(std::vector<GlobalId>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/// Triangles of a surface mostly follow each other: most calls add nothing.
void note(std::vector<GlobalId>& ids, GlobalId id) {
  if (ids.empty() || ids.back() != id) ids.push_back(id);
}

}  // namespace

void WallRecord::forget(Extent const& from) {
  for (std::size_t i = from.cells; i < geometry.cells.size(); ++i)
    if (CellIndex const c = geometry.cells[i].cell; map_.range().holds(c)) {
      map_.set(c, uncut_fluid);
      for (CellBits& cells : facing_) cells.unmark(c);
    }
  for (std::size_t r = from.runs; r < geometry.solid.size(); ++r) {
    SolidRun const& run = geometry.solid[r];
    for (Index i = 0; i < run.count; ++i) {
      CellIndex const c{run.first[0] + i, run.first[1], run.first[2]};
      if (map_.range().holds(c)) map_.set(c, uncut_fluid);
    }
  }
}

void WallRecord::mark_facing(CutCell const& cell) {
  facing_[6].mark(cell.cell);
  for (Index f = cell.first_piece; f < cell.last_piece; ++f)
    for (int d = 0; d < grid_->dimension; ++d)
      for (int side = 0; side < 2; ++side)
        if (facets_[static_cast<std::size_t>(f)].faces(d, side == 0 ? -1 : 1))
          facing_[static_cast<std::size_t>(2 * d + side)].mark(cell.cell);
}

void WallRecord::enter(Extent const& from) {
  facets_.resize(from.pieces);
  for (std::size_t p = from.pieces; p < geometry.pieces.size(); ++p)
    facets_.push_back(facet(lattice_, geometry, geometry.pieces[p]));
  constexpr Index far = std::numeric_limits<Index>::max();
  CellBox box{{far, far, far}, {-far, -far, -far}};
  auto const enclose = [&](CellIndex c, Index count) {
    for (std::size_t d = 0; d < 3; ++d) {
      box.low[d] = std::min(box.low[d], c[d]);
      box.high[d] = std::max(box.high[d], c[d] + (d == 0 ? count : 1));
    }
  };
  for (CutCell const& c : geometry.cells) enclose(c.cell, 1);
  for (SolidRun const& run : geometry.solid) enclose(run.first, run.count);
  if (empty(box)) return;
  Extent begin = from;
  if (!contains(map_.range(), box)) {
    map_.cover(grown(*grid_, box, 4), uncut_fluid);
    for (CellBits& cells : facing_) cells.cover(map_.range());
    begin = {};
  }
  for (std::size_t r = begin.runs; r < geometry.solid.size(); ++r) {
    SolidRun const& run = geometry.solid[r];
    for (Index i = 0; i < run.count; ++i) map_.set({run.first[0] + i, run.first[1], run.first[2]}, uncut_solid);
  }
  for (std::size_t i = begin.cells; i < geometry.cells.size(); ++i) {
    map_.set(geometry.cells[i].cell, static_cast<Index>(i));
    mark_facing(geometry.cells[i]);
  }
}

void WallRecord::truncate(Extent const& kept) {
  forget(kept);
  geometry.pieces.resize(kept.pieces);
  geometry.corners.resize(kept.corners);
  geometry.cells.resize(kept.cells);
  geometry.solid.resize(kept.runs);
}

void WallRecord::clear() {
  truncate({});
  resting_.clear();
  known_.clear();
  rest_ = {};
}

std::vector<GlobalId> WallRecord::unmoved_surfaces() {
  std::vector<GlobalId> all, moved;
  std::size_t k = 0;
  for (SurfaceTriangle const& t : triangles) {
    note(all, t.surface);
    for (; k < known_.size() && known_[k].id < t.id; ++k) note(moved, known_[k].surface);
    bool const same = k < known_.size() && known_[k].id == t.id && same_bits(known_[k].x, t.x_new);
    if (!same) note(moved, t.surface);
    if (k < known_.size() && known_[k].id == t.id) {
      if (known_[k].surface != t.surface) note(moved, known_[k].surface), note(moved, t.surface);
      ++k;
    }
  }
  for (; k < known_.size(); ++k) note(moved, known_[k].surface);
  sort_unique(all);
  sort_unique(moved);
  std::vector<GlobalId> unmoved;
  std::set_difference(all.begin(), all.end(), moved.begin(), moved.end(), std::back_inserter(unmoved));
  if (!moved.empty() || known_.size() != triangles.size()) {
    known_.clear();
    for (SurfaceTriangle const& t : triangles) known_.push_back({t.id, t.surface, t.x_new});
  }
  return unmoved;
}

void WallRecord::append(Geometry const& part, std::vector<Index> const& place) {
  auto const pieces = static_cast<Index>(geometry.pieces.size());
  auto const corners = static_cast<Index>(geometry.corners.size());
  for (Piece p : part.pieces) {
    p.triangle = place[static_cast<std::size_t>(p.triangle)];
    p.first_corner += corners;
    geometry.pieces.push_back(p);
  }
  geometry.corners.insert(geometry.corners.end(), part.corners.begin(), part.corners.end());
  for (CutCell c : part.cells) {
    c.first_piece += pieces;
    c.last_piece += pieces;
    geometry.cells.push_back(c);
  }
  geometry.solid.insert(geometry.solid.end(), part.solid.begin(), part.solid.end());
}

void WallRecord::cut_resting() {
  truncate({});
  rest_piece_.clear();
  rest_cells_.clear();
  rest_residual_ = rest_mismatch_ = 0;
  rest_overlapped_ = rest_inverted_ = 0;
  if (!resting_.empty()) {
    part_triangles_.clear();
    for (Index const place : rest_place_) part_triangles_.push_back(triangles[static_cast<std::size_t>(place)]);
    build(lattice_, part_triangles_, region_, part_);
    require_closed(lattice_, part_);
    for (Piece const& p : part_.pieces) rest_piece_.push_back(p.triangle);
    append(part_, rest_place_);
    for (Geometry::Sum const& sum : part_.sums)
      for (Index i = sum.first; i < sum.last; ++i) {
        Index const piece = part_.order[static_cast<std::size_t>(i)].place;
        Index const triangle = part_.clipped[static_cast<std::size_t>(piece)].triangle;
        RestCell const here{detail::cell_key(sum.cell, 2, 1, 0),
                            part_triangles_[static_cast<std::size_t>(triangle)].surface};
        if (rest_cells_.empty() || rest_cells_.back() != here) rest_cells_.push_back(here);
      }
    rest_residual_ = part_.residual, rest_mismatch_ = part_.volume_mismatch;
    rest_overlapped_ = part_.overlapped, rest_inverted_ = part_.inverted;
  }
  rest_ = extent();
  enter({});
}

std::vector<GlobalId> WallRecord::resting_beside(Geometry const& moving) const {
  std::vector<GlobalId> found;
  // Beyond the kept cells too: a run may come in from there.
  for (Geometry::Sum const& sum : moving.sums) {
    std::uint64_t const here = detail::cell_key(sum.cell, 2, 1, 0);
    constexpr std::uint64_t steps[] = {1, std::uint64_t{1} << 20, std::uint64_t{1} << 40};
    auto const look = [&](std::uint64_t key) {
      auto at = std::lower_bound(rest_cells_.begin(), rest_cells_.end(), RestCell{key, 0});
      for (; at != rest_cells_.end() && at->first == key; ++at) note(found, at->second);
    };
    look(here);
    for (std::uint64_t const step : steps) look(here - step), look(here + step);
  }
  auto const inside = [&](CellIndex const& c) { return map_.at(c) != uncut_fluid; };
  bool one_in_another =
      std::any_of(moving.cells.begin(), moving.cells.end(), [&](CutCell const& c) { return inside(c.cell); });
  for (SolidRun const& run : moving.solid)
    for (Index i = 0; i < run.count && !one_in_another; ++i)
      one_in_another = inside({run.first[0] + i, run.first[1], run.first[2]});
  if (one_in_another) return resting_;
  sort_unique(found);
  return found;
}

void WallRecord::rebuild() {
  cut_all();
  divide(lattice_, geometry, covered_fraction * cell_volume_, parts);
}

void WallRecord::cut_all() {
  try {
    std::vector<GlobalId> const unmoved = unmoved_surfaces();
    if (++rebuilds_ % 64 == 0) beside_.clear();  // maybe they are alone again
    std::vector<GlobalId> rest;
    std::set_difference(unmoved.begin(), unmoved.end(), beside_.begin(), beside_.end(), std::back_inserter(rest));
    bool stale = rest != resting_;
    resting_ = std::move(rest);
    if (resting_.empty()) {
      forget({});
      build(lattice_, triangles, region_, geometry);
      require_closed(lattice_, geometry);
      rest_ = {};
      enter({});
      return;
    }
    for (;;) {
      std::vector<Index> rest_place, place;
      for (std::size_t t = 0; t < triangles.size(); ++t)
        (has(resting_, triangles[t].surface) ? rest_place : place).push_back(static_cast<Index>(t));
      bool const shifted = rest_place != rest_place_;
      rest_place_ = std::move(rest_place);
      if (stale) {
        cut_resting();
      } else {
        truncate(rest_);
        for (std::size_t p = 0; shifted && p < rest_.pieces; ++p)
          geometry.pieces[p].triangle = rest_place_[static_cast<std::size_t>(rest_piece_[p])];
      }
      part_triangles_.clear();
      for (Index const t : place) part_triangles_.push_back(triangles[static_cast<std::size_t>(t)]);
      build(lattice_, part_triangles_, region_, part_);
      require_closed(lattice_, part_);
      std::vector<GlobalId> const company = resting_beside(part_);
      if (company.empty()) {
        append(part_, place);
        enter(rest_);
        geometry.residual = max(part_.residual, rest_residual_);
        geometry.volume_mismatch = max(part_.volume_mismatch, rest_mismatch_);
        geometry.overlapped = part_.overlapped + rest_overlapped_;
        geometry.inverted = part_.inverted + rest_inverted_;
        return;
      }
      beside_.insert(beside_.end(), company.begin(), company.end());
      sort_unique(beside_);
      std::erase_if(resting_, [&](GlobalId s) { return has(company, s); });
      stale = true;
    }
  } catch (...) {
    clear();
    throw;
  }
}

std::vector<CellBox> WallRecord::differences(WallRecord const& a, WallRecord const& b) {
  std::vector<CellBox> boxes;
  auto const add = [&](SurfaceTriangle const& t) {
    constexpr Index far = std::numeric_limits<Index>::max();
    CellBox box{{far, far, far}, {-far, -far, -far}};
    for (std::size_t v = 0; v < static_cast<std::size_t>(a.grid_->dimension); ++v) {
      CellIndex const c = cell_of(*a.grid_, t.x_new[v]);
      for (std::size_t d = 0; d < 3; ++d) {
        box.low[d] = std::min(box.low[d], c[d]);
        box.high[d] = std::max(box.high[d], c[d] + 1);
      }
    }
    boxes.push_back(box);
  };
  auto i = a.triangles.begin();
  for (SurfaceTriangle const& t : b.triangles) {
    for (; i != a.triangles.end() && i->id < t.id; ++i) add(*i);
    bool const both = i != a.triangles.end() && i->id == t.id;
    if (!both || !same_bits(i->x_new, t.x_new) || !same_bits(i->velocity, t.velocity)) {
      if (both) add(*i);
      add(t);
    }
    if (both) ++i;
  }
  for (; i != a.triangles.end(); ++i) add(*i);
  return boxes;
}

}  // namespace brisance::coupling
