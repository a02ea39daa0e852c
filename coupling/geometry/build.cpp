#include <algorithm>
#include <cstdio>

#include "coupling/geometry/clip.hpp"
#include "parallel/error.hpp"

namespace brisance::coupling {
namespace {

using detail::cell_key;

/// Whether a cell is in the union of boxes; neighbours in the order of visit mostly share a box.
class Region {
 public:
  explicit Region(std::span<CellBox const> boxes) : boxes_(boxes) {}
  bool holds(CellIndex const& c) {
    if (last_ < boxes_.size() && boxes_[last_].holds(c)) return true;
    for (std::size_t b = 0; b < boxes_.size(); ++b)
      if (boxes_[b].holds(c)) {
        last_ = b;
        return true;
      }
    return false;
  }

 private:
  std::span<CellBox const> boxes_;
  std::size_t last_ = 0;
};

bool by_key(Geometry::Row const& a, Geometry::Row const& b) {
  return a.key != b.key ? a.key < b.key : a.place < b.place;
}

/// Groups the pieces by cell and sums them in the order of their triangles.
void sum_cells(std::span<CellBox const> keep, Geometry& g) {
  g.order.clear();
  for (std::size_t p = 0; p < g.clipped.size(); ++p)
    g.order.push_back({cell_key(g.clipped[p].cell, 2, 1, 0), static_cast<Index>(p)});
  std::sort(g.order.begin(), g.order.end(), by_key);
  g.sums.clear();
  Region region(keep);
  for (std::size_t i = 0, end = 0; i < g.order.size(); i = end) {
    Geometry::Sum sum{};
    for (end = i; end < g.order.size() && g.order[end].key == g.order[i].key; ++end) {
      auto const& piece = g.clipped[static_cast<std::size_t>(g.order[end].place)];
      sum.area += piece.area;
      sum.moment += piece.moment;
      sum.cell = piece.cell;
    }
    sum.first = static_cast<Index>(i);
    sum.last = static_cast<Index>(end);
    sum.kept = region.holds(sum.cell);
    g.sums.push_back(sum);
  }
}

/// Adds the part of the solid cells from `first` to `last` (excluded) along x that lies in the region. True if any.
bool add_solid(CellIndex const& first, Index last, std::span<CellBox const> keep, Geometry& g) {
  g.intervals.clear();
  for (CellBox const& box : keep) {
    if (first[1] < box.low[1] || first[1] >= box.high[1] || first[2] < box.low[2] || first[2] >= box.high[2]) continue;
    Index const a = std::max(first[0], box.low[0]), b = std::min(last, box.high[0]);
    if (a < b) g.intervals.push_back({a, b});
  }
  std::sort(g.intervals.begin(), g.intervals.end());
  for (std::size_t i = 0, end = 0; i < g.intervals.size(); i = end) {  // boxes may overlap
    Index const a = g.intervals[i][0];
    Index b = g.intervals[i][1];
    for (end = i + 1; end < g.intervals.size() && g.intervals[end][0] <= b; ++end) b = std::max(b, g.intervals[end][1]);
    g.solid.push_back({{a, first[1], first[2]}, b - a});
  }
  return !g.intervals.empty();
}

/// Running sums of the apertures along direction d, in faces; `moment` becomes the fluid volume by the formula of d.
void sum_rows(std::size_t d, std::span<CellBox const> keep, Geometry& g) {
  std::size_t const middle = d == 0 ? 1 : 0, slow = d == 2 ? 1 : 2;
  int const along = static_cast<int>(d);
  g.rows.clear();
  for (std::size_t s = 0; s < g.sums.size(); ++s)
    g.rows.push_back({cell_key(g.sums[s].cell, slow, middle, d), static_cast<Index>(s)});
  if (d > 0) std::sort(g.rows.begin(), g.rows.end(), by_key);
  for (std::size_t i = 0, end = 0; i < g.rows.size(); i = end) {
    Real open = 1, running = 1, defect = 0;  // bodies are finite: all fluid before the first piece
    CellIndex where{};
    bool complete = false;
    for (end = i; end < g.rows.size() && g.rows[end].key >> 20 == g.rows[i].key >> 20; ++end) {
      auto& cell = g.sums[static_cast<std::size_t>(g.rows[end].place)];
      complete = complete || cell.kept;
      cell.aperture[d][0] = open;
      running += cell.area[along];
      open = running;
      bool const last = end + 1 == g.rows.size() || g.rows[end + 1].key >> 20 != g.rows[i].key >> 20;
      if (last || g.rows[end + 1].key != g.rows[end].key + 1) {
        Real const level = last ? 1 : std::nearbyint(running);  // 0 in one body, -1 in two at once, 2 inside out
        if (std::abs(running - level) > defect) {
          defect = std::abs(running - level);
          where = cell.cell;
        }
        running = level;
        open = level > 0 ? 1 : 0;
        if (level > 1 && cell.kept) ++g.inverted;
        if (d == 0 && !last && level <= 0) {
          CellIndex first = cell.cell;
          first[0] += 1;
          bool const seen = add_solid(first, g.sums[static_cast<std::size_t>(g.rows[end + 1].place)].cell[0], keep, g);
          complete = complete || seen;
          if (seen && level < 0) ++g.overlapped;
        }
      }
      cell.aperture[d][1] = open;
      cell.moment[along] = running - cell.moment[along];
    }
    if (complete && defect > g.residual) {
      g.residual = defect;
      g.residual_cell = where;
      g.residual_direction = along;
    }
  }
}

/// Hands out the pieces and cells of the region, in SI units.
void deliver(Lattice const& lattice, std::span<SurfaceTriangle const> triangles, Geometry& g) {
  Vec3 const face{lattice.face_area(0), lattice.face_area(1), lattice.face_area(2)};
  auto const in_m2 = [&](Vec3 const& s) { return Vec3{s.x * face.x, s.y * face.y, s.z * face.z}; };
  bool const solid_3d = lattice.dimension == 3;
  for (auto const& sum : g.sums) {
    if (!sum.kept) continue;
    CutCell cell;
    cell.cell = sum.cell;
    cell.first_piece = static_cast<Index>(g.pieces.size());
    for (Index i = sum.first; i < sum.last; ++i) {
      auto const& from = g.clipped[static_cast<std::size_t>(g.order[static_cast<std::size_t>(i)].place)];
      auto const& x = triangles[static_cast<std::size_t>(from.triangle)].x_new;
      auto const& b = from.bary_centroid;
      Vec3 centroid = b[0] * x[0] + b[1] * x[1];
      if (solid_3d) centroid += b[2] * x[2];
      g.pieces.push_back({from.triangle, from.cell, from.first_corner, from.corners, in_m2(from.area), centroid, b});
    }
    cell.last_piece = static_cast<Index>(g.pieces.size());
    cell.area = in_m2(sum.area);
    Vec3 const& v = sum.moment;
    Real volume = 0.5 * (v.x + v.y), mismatch = std::abs(v.x - v.y);
    if (solid_3d) {
      volume = (v.x + v.y + v.z) / 3;
      mismatch = max(mismatch, max(std::abs(v.x - v.z), std::abs(v.y - v.z)));
    }
    g.volume_mismatch = max(g.volume_mismatch, mismatch);
    cell.volume = volume * lattice.cell_volume();
    for (std::size_t d = 0; d < static_cast<std::size_t>(lattice.dimension); ++d)
      for (std::size_t side = 0; side < 2; ++side)
        cell.aperture[d][side] = sum.aperture[d][side] * face[static_cast<int>(d)];
    g.cells.push_back(cell);
  }
}

}  // namespace

void build(Lattice const& lattice, std::span<SurfaceTriangle const> triangles, std::span<CellBox const> keep,
           Geometry& out) {
  out.pieces.clear();
  out.cells.clear();
  out.solid.clear();
  out.residual = out.volume_mismatch = 0;
  out.overlapped = out.inverted = 0;
  detail::clip(lattice, triangles, out);
  sum_cells(keep, out);
  for (std::size_t d = 0; d < static_cast<std::size_t>(lattice.dimension); ++d) sum_rows(d, keep, out);
  deliver(lattice, triangles, out);
}

Index Geometry::find(CellIndex const& c) const {
  auto const key = cell_key(c, 2, 1, 0);
  auto const at = std::lower_bound(cells.begin(), cells.end(), key,
                                   [](CutCell const& a, std::uint64_t k) { return cell_key(a.cell, 2, 1, 0) < k; });
  return at != cells.end() && at->cell == c ? static_cast<Index>(at - cells.begin()) : -1;
}

void require_closed(Lattice const& lattice, Geometry const& geometry) {
  if (geometry.residual <= tightness) return;
  auto const& c = geometry.residual_cell;
  Vec3 const x = lattice.position({c[0] + 0.5, c[1] + 0.5, lattice.dimension == 3 ? c[2] + 0.5 : 0.0});
  char text[240];
  std::snprintf(
      text, sizeof text,
      "the boundary is not watertight: along %c through (%.6g, %.6g, %.6g) m the area vectors leave %.3g of a face",
      "xyz"[geometry.residual_direction], x.x, x.y, x.z, geometry.residual);
  throw Error(Failure::numerical, text);
}

}  // namespace brisance::coupling
