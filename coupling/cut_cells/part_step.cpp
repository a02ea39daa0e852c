#include "coupling/cut_cells/part_step.hpp"

#include <algorithm>
#include <limits>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/geometry/clip.hpp"
#include "coupling/geometry/swept.hpp"

namespace brisance::coupling {
namespace {

constexpr Real agreement = 1e-12;  ///< of a cell: what (G2) may miss; measured 1e-13

std::uint64_t key_of(CellIndex const& c) { return detail::cell_key(c, 2, 1, 0); }

std::size_t part_count(WallRecord const& record, CellIndex const& c) {
  PartedCell const* const p = record.parts.find(c);
  return p ? p->parts : 1;
}
Real part_volume(WallRecord const& record, CellIndex const& c, std::size_t part) {
  PartedCell const* const p = record.parts.find(c);
  return p ? p->volume[part] : record.volume(c);
}
std::size_t part_of(WallRecord const& record, CellIndex const& c, Index piece) {
  PartedCell const* const p = record.parts.find(c);
  return p ? p->parts > 1 ? static_cast<std::size_t>(record.parts.part_of(*p, piece)) : 0 : 0;
}

}  // namespace

/// What the wall swept in the parts of one cell, and how alike these are.
struct PartStep::Work {
  CellUnits units;
  std::array<Real, most_parts> volume_before{}, volume_after{}, swept_before{}, swept_after{};
  std::array<std::array<Real, most_parts>, most_parts> alike{};  ///< [before][after]
};

void PartStep::clear() {
  cells_.clear();
  places_.list({});
}

CellUnits const* PartStep::find(CellIndex const& c) const {
  Index const place = places_.of(c);
  return place >= 0 ? &cells_[static_cast<std::size_t>(place)] : nullptr;
}

std::size_t PartStep::unit_of(Index piece) const {
  CellIndex const& c = after_->geometry.pieces[static_cast<std::size_t>(piece)].cell;
  return part_of(*after_, c, piece);
}

PartStep::Label PartStep::label(CellIndex const& c, Index piece) const {
  Piece const& f = after_->geometry.pieces[static_cast<std::size_t>(piece)];
  GlobalId const triangle = after_->triangles[static_cast<std::size_t>(f.triangle)].id;
  if (f.cell == c) return {true, part_of(*after_, c, piece)};
  // The same triangle in the cell; else what is nearest of the pieces that face the same way.
  Label nearest{true, 0};
  Real best = std::numeric_limits<Real>::max();
  for (WallRecord const* r : {after_, before_}) {
    Index const at = r->cut_index(c);
    if (at < 0) continue;
    for (Index e = r->cut(at).first_piece; e < r->cut(at).last_piece; ++e) {
      Piece const& other = r->geometry.pieces[static_cast<std::size_t>(e)];
      if (r->triangles[static_cast<std::size_t>(other.triangle)].id == triangle)
        return {r == after_, part_of(*r, c, e)};
      if (dot(other.area, f.area) <= 0) continue;
      Real const distance = norm2(other.centroid - f.centroid);
      if (distance < best) best = distance, nearest = {r == after_, part_of(*r, c, e)};
    }
  }
  return nearest;
}

std::size_t PartStep::swept_unit(CellIndex const& c, Index piece) const {
  CellUnits const* const u = find(c);
  if (!u) return 0;
  Label const l = label(c, piece);
  return l.after ? l.part : u->unit[l.part];
}

void PartStep::settle(Work& w) {
  CellUnits& u = w.units;
  std::size_t const n = u.parts_before, m = u.after;
  Real const cell_volume = after_->lattice().cell_volume();
  // All assignments of parts at t^n to different parts at t^{n+1}, or to none.
  std::array<Index, most_parts> to{}, best{};
  Real best_defect = std::numeric_limits<Real>::max(), best_likeness = -1;
  auto const judge = [&] {
    Real defect = 0, likeness = 0;
    std::array<Index, most_parts> from;
    from.fill(-1);
    for (std::size_t p = 0; p < n; ++p) {
      if (to[p] < 0) {
        defect += std::abs(-w.volume_before[p] + w.swept_before[p]);
        continue;
      }
      from[static_cast<std::size_t>(to[p])] = static_cast<Index>(p);
      likeness += w.alike[p][static_cast<std::size_t>(to[p])];
    }
    for (std::size_t q = 0; q < m; ++q) {
      Real change = w.volume_after[q] + w.swept_after[q];
      if (from[q] >= 0) {
        auto const p = static_cast<std::size_t>(from[q]);
        change += w.swept_before[p] - w.volume_before[p];
      }
      defect += std::abs(change);
    }
    defect /= cell_volume;
    bool const clearer = defect < best_defect - agreement;
    if (clearer || (defect < best_defect + agreement && likeness > best_likeness)) {
      best_defect = min(best_defect, defect), best_likeness = likeness, best = to;
    }
  };
  auto const assign = [&](auto const& self, std::size_t p, unsigned taken) -> void {
    if (p == n) return judge();
    for (std::size_t q = 0; q < m; ++q) {
      if (taken >> q & 1u) continue;
      to[p] = static_cast<Index>(q);
      self(self, p + 1, taken | 1u << q);
    }
    to[p] = -1;
    self(self, p + 1, taken);
  };
  assign(assign, 0, 0);
  u.before.fill(-1);
  u.count = m;
  for (std::size_t p = 0; p < n; ++p) {
    std::size_t const unit = best[p] >= 0 ? static_cast<std::size_t>(best[p]) : u.count++;
    u.before[unit] = static_cast<Index>(p);
    u.unit[p] = unit;
  }
  u.share.fill(-1);
  if (!(best_defect <= agreement)) join(w);
}

void PartStep::join(Work& w) {
  CellUnits& u = w.units;
  Real const cell_volume = after_->lattice().cell_volume();
  // By common triangles; else by what faces the same way; else all.
  for (Real const least : {1.0, 2e-3, 0.0}) {
    std::array<std::size_t, CellUnits::most> group{};
    for (std::size_t i = 0; i < u.count; ++i) group[i] = i;
    auto const unite = [&](std::size_t a, std::size_t b) {
      std::size_t const from = std::max(group[a], group[b]), to = std::min(group[a], group[b]);
      for (std::size_t i = 0; i < u.count; ++i)
        if (group[i] == from) group[i] = to;
    };
    for (std::size_t p = 0; p < u.parts_before; ++p)
      for (std::size_t q = 0; q < u.after; ++q)
        if (w.alike[p][q] >= least) unite(u.unit[p], q);
    std::array<Real, CellUnits::most> defect{};
    std::array<Index, CellUnits::most> members{};
    for (std::size_t i = 0; i < u.count; ++i) {
      if (i < u.after) defect[group[i]] += w.volume_after[i] + w.swept_after[i];
      if (u.before[i] >= 0) {
        auto const p = static_cast<std::size_t>(u.before[i]);
        defect[group[i]] += w.swept_before[p] - w.volume_before[p];
      }
      ++members[group[i]];
    }
    bool const fits =
        std::all_of(defect.begin(), defect.end(), [&](Real x) { return std::abs(x) <= agreement * cell_volume; });
    if (!fits && least > 0) continue;
    for (std::size_t i = 0; i < u.count; ++i)
      u.share[i] = members[group[i]] > 1 ? static_cast<Index>(group[i]) : Index{-1};
    u.mixed = least == 0;
    return;
  }
}

void PartStep::match(WallRecord const& before, WallRecord const& after, std::span<CellBox const> near, bool moved) {
  before_ = &before;
  after_ = &after;
  clear();
  std::vector<CellIndex> divided;
  for (WallRecord const* r : {&before, &after})
    for (PartedCell const& p : r->parts.cells)
      if (std::any_of(near.begin(), near.end(), [&](CellBox const& b) { return b.holds(p.cell); }))
        divided.push_back(p.cell);
  if (divided.empty()) return;
  std::sort(divided.begin(), divided.end(), [](auto const& a, auto const& b) { return key_of(a) < key_of(b); });
  divided.erase(std::unique(divided.begin(), divided.end()), divided.end());

  std::vector<Work> work(divided.size());
  for (std::size_t i = 0; i < divided.size(); ++i) {
    Work& w = work[i];
    CellIndex const c = w.units.cell = divided[i];
    w.units.parts_before = part_count(before, c);
    w.units.after = part_count(after, c);
    for (std::size_t p = 0; p < w.units.parts_before; ++p) w.volume_before[p] = part_volume(before, c, p);
    for (std::size_t q = 0; q < w.units.after; ++q) w.volume_after[q] = part_volume(after, c, q);
    // Alike: bounded by the same triangles, or at least facing the same way.
    Index const a = before.cut_index(c), b = after.cut_index(c);
    for (std::size_t p = 0; p < w.units.parts_before; ++p)
      for (std::size_t q = 0; q < w.units.after; ++q) w.alike[p][q] = 1e-3;
    if (a < 0 || b < 0) continue;
    for (Index e = before.cut(a).first_piece; e < before.cut(a).last_piece; ++e)
      for (Index f = after.cut(b).first_piece; f < after.cut(b).last_piece; ++f) {
        Piece const& x = before.geometry.pieces[static_cast<std::size_t>(e)];
        Piece const& y = after.geometry.pieces[static_cast<std::size_t>(f)];
        bool const same = before.triangles[static_cast<std::size_t>(x.triangle)].id ==
                          after.triangles[static_cast<std::size_t>(y.triangle)].id;
        w.alike[part_of(before, c, e)][part_of(after, c, f)] += same ? 1 : dot(x.area, y.area) > 0 ? 1e-3 : 0;
      }
  }
  cells_.resize(divided.size());
  places_.list(divided);
  for (std::size_t i = 0; i < work.size(); ++i) cells_[i] = work[i].units;  // label() asks which cells are divided

  if (moved) {
    std::vector<Swept> swept_parts;
    Index last = -1;
    auto const place = [&](CellIndex const& c) -> Index {
      CellUnits const* const u = find(c);
      return u ? static_cast<Index>(u - cells_.data()) : -1;
    };
    fluid::Grid const& grid = after.grid();
    for (CutCell const& cut : after.geometry.cells) {
      bool beside = false;
      for_neighbourhood(grid, cut.cell, 1, [&](CellIndex n) { beside = beside || place(n) >= 0; });
      if (!beside) continue;
      for (Index f = cut.first_piece; f < cut.last_piece; ++f) {
        Piece const& piece = after.geometry.pieces[static_cast<std::size_t>(f)];
        SurfaceTriangle const& t = after.triangles[static_cast<std::size_t>(piece.triangle)];
        if (!t.moved(grid.dimension)) continue;
        swept_parts.clear();
        swept(after.lattice(), after.geometry, piece, t, swept_parts);
        for (Swept const& s : swept_parts) {
          last = place(s.cell);
          if (last < 0) continue;
          Label const l = label(s.cell, f);
          Work& w = work[static_cast<std::size_t>(last)];
          (l.after ? w.swept_after : w.swept_before)[l.part] += s.volume;
        }
      }
    }
  }
  for (std::size_t i = 0; i < work.size(); ++i) {
    settle(work[i]);
    cells_[i] = work[i].units;
  }
}

}  // namespace brisance::coupling
