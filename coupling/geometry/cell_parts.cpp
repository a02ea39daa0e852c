#include "coupling/geometry/cell_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupling/geometry/clip.hpp"
#include "coupling/geometry/face_parts.hpp"

namespace brisance::coupling {
namespace {

constexpr Real tolerance = 1e-9;  ///< of a cell or face: larger defects leave a cell undivided

std::uint64_t key_of(CellIndex const& c) { return detail::cell_key(c, 2, 1, 0); }

/// Two pieces of a wall that is thin here look away from each other; those of a smooth one do not.
bool holds_opposed(Geometry const& g, CutCell const& cell) {
  for (Index f = cell.first_piece; f < cell.last_piece; ++f)
    for (Index e = f + 1; e < cell.last_piece; ++e)
      if (dot(g.pieces[static_cast<std::size_t>(f)].area, g.pieces[static_cast<std::size_t>(e)].area) < 0) return true;
  return false;
}

/// First moments against the low planes of the cell, as detail::clip has them, in grid units.
Vec3 moment(Geometry const& g, Piece const& piece) {
  auto const p = g.corners_of(piece);
  Vec3 const base{static_cast<Real>(piece.cell[0]), static_cast<Real>(piece.cell[1]), static_cast<Real>(piece.cell[2])};
  if (p.size() == 2) {
    Vec3 const a = p[0].point - base, b = p[1].point - base, mean = 0.5 * (a + b);
    return {(b.y - a.y) * mean.x, (a.x - b.x) * mean.y, 0};
  }
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    Vec3 const o = p[0].point - base, a = p[i].point - base, b = p[i + 1].point - base;
    Vec3 const s = 0.5 * cross(a - o, b - o), mean = (o + a + b) / 3;
    sum += Vec3{s.x * mean.x, s.y * mean.y, s.z * mean.z};
  }
  return sum;
}

/// Pieces and corners of one cell, united where fluid joins them.
class Divider {
 public:
  Divider(Lattice const& lattice, Geometry const& g, CutCell const& cell)
      : lattice_(lattice), g_(g), cell_(cell), pieces_(static_cast<std::size_t>(cell.last_piece - cell.first_piece)) {
    parent_.resize(pieces_ + 8);
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /// Number of sheets: pieces joined along edges, in 2D at ends.
  std::size_t join_sheets() {
    for (std::size_t f = 0; f < pieces_; ++f)
      for (std::size_t e = f + 1; e < pieces_; ++e)
        if (root(f) != root(e) && adjacent(corners(f), corners(e))) unite(f, e);
    std::size_t sheets = 0;
    for (std::size_t f = 0; f < pieces_; ++f) sheets += root(f) == f;
    return sheets;
  }

  /// False where faces, or parts, do not make up the cell.
  bool divide(PartedCell& out, std::array<std::array<std::vector<FacePart>, 2>, 3>& faces,
              std::vector<std::uint8_t>& of_piece) {
    for (int d = 0; d < lattice_.dimension; ++d)
      for (int side = 0; side < 2; ++side) {
        auto& face = faces[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)];
        if (!open_parts(lattice_, g_, cell_, d, side, face)) return false;
        for (FacePart const& part : face) {
          std::size_t const node = node_of(part);
          for (Index const f : part.pieces) unite(node, local(f));
          for (unsigned k = 0; k < 8; ++k)
            if (part.corners >> k & 1u) unite(node, pieces_ + k);
        }
      }
    return number(faces) && measure(out, faces, of_piece);
  }

  std::size_t part(FacePart const& part) { return part_of_[root(node_of(part))]; }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::span<Corner const> corners(std::size_t f) const {
    return g_.corners_of(g_.pieces[static_cast<std::size_t>(cell_.first_piece) + f]);
  }
  std::size_t local(Index piece) const { return static_cast<std::size_t>(piece - cell_.first_piece); }
  std::size_t node_of(FacePart const& part) const {
    if (!part.pieces.empty()) return local(part.pieces.front());
    unsigned k = 0;
    while (!(part.corners >> k & 1u)) ++k;
    return pieces_ + k;
  }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t a, std::size_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  static bool adjacent(std::span<Corner const> a, std::span<Corner const> b) {
    std::size_t common = 0;
    for (Corner const& x : a)
      for (Corner const& y : b) common += x.point == y.point;
    return common >= (a.size() == 2 ? 1u : 2u);
  }

  bool number(std::array<std::array<std::vector<FacePart>, 2>, 3>& faces) {
    part_of_.assign(parent_.size(), none);
    count_ = 0;
    auto const take = [&](std::size_t node) {
      std::size_t const r = root(node);
      if (part_of_[r] == none) part_of_[r] = count_++;
    };
    for (std::size_t f = 0; f < pieces_; ++f) take(f);
    for (auto const& both : faces)
      for (auto const& face : both)
        for (FacePart const& part : face) take(node_of(part));
    return count_ <= most_parts;
  }

  bool measure(PartedCell& out, std::array<std::array<std::vector<FacePart>, 2>, 3>& faces,
               std::vector<std::uint8_t>& of_piece) {
    std::array<std::array<std::array<Real, 2>, 3>, most_parts> open{};
    std::array<Vec3, most_parts> normal{}, moments{};
    std::array<Vec3, most_parts> area{};
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t side = 0; side < 2; ++side)
        for (FacePart const& p : faces[d][side]) open[part(p)][d][side] += p.area;
    Vec3 const face{lattice_.face_area(0), lattice_.face_area(1), lattice_.face_area(2)};
    for (std::size_t f = 0; f < pieces_; ++f) {
      Piece const& piece = g_.pieces[static_cast<std::size_t>(cell_.first_piece) + f];
      std::size_t const p = part_of_[root(f)];
      normal[p] += Vec3{piece.area.x / face.x, piece.area.y / face.y, piece.area.z / face.z};
      area[p] += piece.area;
      moments[p] += moment(g_, piece);
    }
    std::array<Real, most_parts> volume{};
    for (std::size_t p = 0; p < count_; ++p) {
      for (int d = 0; d < lattice_.dimension; ++d) {
        auto const& a = open[p][static_cast<std::size_t>(d)];
        if (!(std::abs(a[1] - a[0] - normal[p][d]) <= tolerance)) return false;
        volume[p] += (a[1] - moments[p][d]) / lattice_.dimension;
      }
      for (int d = 0; d < lattice_.dimension; ++d)
        if (!(std::abs(open[p][static_cast<std::size_t>(d)][1] - moments[p][d] - volume[p]) <= tolerance)) return false;
    }
    Real const whole = cell_.volume / lattice_.cell_volume();
    std::array<std::size_t, most_parts> order{};  // the largest first; ties as the pieces come
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count_),
                     [&](std::size_t a, std::size_t b) { return volume[a] > volume[b]; });
    if (volume[order[count_ - 1]] < -tolerance) return false;  // a body within the cell: it bounds no part of its own
    Real rest = whole;
    for (std::size_t k = 1; k < count_; ++k) rest -= volume[order[k]];
    if (!(std::abs(rest - volume[order[0]]) <= tolerance)) return false;
    volume[order[0]] = rest;
    out.cell = cell_.cell;
    out.first_piece = cell_.first_piece;
    out.last_piece = cell_.last_piece;
    out.first_part = static_cast<Index>(of_piece.size());
    out.parts = count_;
    std::array<std::size_t, most_parts> place{};
    for (std::size_t k = 0; k < count_; ++k) {
      place[order[k]] = k;
      out.volume[k] = volume[order[k]] * lattice_.cell_volume();
      out.area[k] = area[order[k]];
      for (std::size_t d = 0; d < 3; ++d)
        for (std::size_t side = 0; side < 2; ++side)
          out.aperture[k][d][side] = open[order[k]][d][side] * face[static_cast<int>(d)];
    }
    for (std::size_t& p : part_of_)
      if (p != none) p = place[p];
    for (std::size_t f = 0; f < pieces_; ++f) of_piece.push_back(static_cast<std::uint8_t>(part_of_[root(f)]));
    return true;
  }

  Lattice const& lattice_;
  Geometry const& g_;
  CutCell const& cell_;
  std::size_t pieces_, count_ = 0;
  std::vector<std::size_t> parent_, part_of_;
};

/// Components of the six faces of a divided cell, as the cell sees them.
struct Seen {
  PartedCell cell;
  std::vector<std::uint8_t> of_piece;
  std::array<std::array<std::vector<std::pair<Real, std::uint8_t>>, 2>, 3> face;
  bool dropped = false;
};

}  // namespace

void CellParts::index() {
  std::vector<CellIndex> listed;
  slots_.clear();
  std::size_t cell = 0, opening = 0;
  while (cell < cells.size() || opening < openings.size()) {
    bool const next_is_cell = opening == openings.size() ||
                              (cell < cells.size() && key_of(cells[cell].cell) <= key_of(openings[opening].low));
    CellIndex const c = next_is_cell ? cells[cell].cell : openings[opening].low;
    Slot slot;
    if (next_is_cell) slot.cell = static_cast<Index>(cell++);
    for (int d = 0; d < 3; ++d) {
      slot.opening[static_cast<std::size_t>(d)] = static_cast<Index>(opening);
      while (opening < openings.size() && openings[opening].low == c && openings[opening].direction == d) ++opening;
    }
    slot.opening[3] = static_cast<Index>(opening);
    listed.push_back(c);
    slots_.push_back(slot);
  }
  places_.list(listed);
}

std::size_t CellParts::bytes() const {
  return cells.capacity() * sizeof(PartedCell) + of_piece.capacity() + openings.capacity() * sizeof(Opening) +
         places_.bytes() + slots_.capacity() * sizeof(Slot);
}

PartedCell const* CellParts::find(CellIndex const& c) const {
  Index const place = places_.of(c);
  if (place < 0) return nullptr;
  Index const cell = slots_[static_cast<std::size_t>(place)].cell;
  return cell >= 0 ? &cells[static_cast<std::size_t>(cell)] : nullptr;
}

std::span<Opening const> CellParts::through(CellIndex const& low, int direction) const {
  Index const place = places_.of(low);
  if (place < 0) return {};
  auto const& opening = slots_[static_cast<std::size_t>(place)].opening;
  auto const d = static_cast<std::size_t>(direction);
  return {openings.data() + opening[d], openings.data() + opening[d + 1]};
}

bool CellParts::joined(CellIndex const& low, int direction) const {
  if (empty()) return true;
  CellIndex high = low;
  high[static_cast<std::size_t>(direction)] += 1;
  if (!find(low) && !find(high)) return true;
  auto const open = through(low, direction);
  return std::any_of(open.begin(), open.end(), [](Opening const& o) { return o.low_part == 0 && o.high_part == 0; });
}

bool CellParts::any_within(CellBox const& box) const {
  if (empty()) return false;
  for (Index k = box.low[2]; k < box.high[2]; ++k)
    for (Index j = box.low[1]; j < box.high[1]; ++j) {
      std::uint64_t const low = key_of({box.low[0], j, k}), high = key_of({box.high[0], j, k});
      auto const cell = std::lower_bound(cells.begin(), cells.end(), low,
                                         [](PartedCell const& p, std::uint64_t key) { return key_of(p.cell) < key; });
      if (cell != cells.end() && key_of(cell->cell) < high) return true;
    }
  return false;
}

void divide(Lattice const& lattice, Geometry const& geometry, Real covered_volume, CellParts& out) {
  out.cells.clear();
  out.of_piece.clear();
  out.openings.clear();
  out.undivided = 0;
  std::vector<Seen> seen;
  for (CutCell const& cell : geometry.cells) {
    if (cell.volume <= covered_volume) continue;
    if (!holds_opposed(geometry, cell)) continue;
    Divider divider(lattice, geometry, cell);
    if (divider.join_sheets() < 2) continue;
    Seen s;
    std::array<std::array<std::vector<FacePart>, 2>, 3> faces;
    if (!divider.divide(s.cell, faces, s.of_piece)) {
      ++out.undivided;
      out.undivided_cell = cell.cell;
      continue;
    }
    if (s.cell.parts < 2) continue;
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t side = 0; side < 2; ++side)
        for (FacePart const& p : faces[d][side])
          s.face[d][side].emplace_back(p.area, static_cast<std::uint8_t>(divider.part(p)));
    seen.push_back(std::move(s));
  }
  std::sort(seen.begin(), seen.end(),
            [](Seen const& a, Seen const& b) { return key_of(a.cell.cell) < key_of(b.cell.cell); });
  auto const find = [&](CellIndex const& c) -> Seen* {
    auto const at = std::lower_bound(seen.begin(), seen.end(), key_of(c),
                                     [](Seen const& s, std::uint64_t k) { return key_of(s.cell.cell) < k; });
    return at != seen.end() && at->cell.cell == c ? &*at : nullptr;
  };
  // Two cells must see the same components in their common face.
  for (Seen& s : seen)
    for (std::size_t d = 0; d < static_cast<std::size_t>(lattice.dimension); ++d) {
      CellIndex high = s.cell.cell;
      high[d] += 1;
      Seen* const other = find(high);
      if (!other) continue;
      bool same = s.face[d][1].size() == other->face[d][0].size();
      for (std::size_t k = 0; same && k < s.face[d][1].size(); ++k)
        same = s.face[d][1][k].first == other->face[d][0][k].first;
      if (!same) s.dropped = other->dropped = true;
    }
  for (Seen const& s : seen)
    if (s.dropped) ++out.undivided, out.undivided_cell = s.cell.cell;
  std::erase_if(seen, [](Seen const& s) { return s.dropped; });
  auto const add = [&](CellIndex const& low, std::size_t d, std::uint8_t a, std::uint8_t b, Real area) {
    if (!(area > 1e-14)) return;  // rounding of a closed face
    Real const metres = area * lattice.face_area(static_cast<int>(d));
    out.openings.push_back({low, static_cast<int>(d), a, b, metres});
  };
  for (Seen& s : seen) {
    s.cell.first_part = static_cast<Index>(out.of_piece.size());
    out.of_piece.insert(out.of_piece.end(), s.of_piece.begin(), s.of_piece.end());
    out.cells.push_back(s.cell);
    for (std::size_t d = 0; d < static_cast<std::size_t>(lattice.dimension); ++d) {
      CellIndex low = s.cell.cell, high = s.cell.cell;
      low[d] -= 1;
      high[d] += 1;
      if (!find(low))
        for (auto const& [area, part] : s.face[d][0]) add(low, d, 0, part, area);
      Seen const* const next = find(high);
      for (std::size_t k = 0; k < s.face[d][1].size(); ++k)
        add(s.cell.cell, d, s.face[d][1][k].second, next ? next->face[d][0][k].second : std::uint8_t{0},
            s.face[d][1][k].first);
    }
  }
  std::stable_sort(out.openings.begin(), out.openings.end(), [](Opening const& a, Opening const& b) {
    return a.low != b.low ? key_of(a.low) < key_of(b.low) : a.direction < b.direction;
  });
  out.index();
}

}  // namespace brisance::coupling
