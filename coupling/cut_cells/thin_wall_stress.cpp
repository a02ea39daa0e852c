#include "coupling/cut_cells/thin_wall_stress.hpp"

#include <algorithm>
#include <tuple>

#include "coupling/cut_cells/openings.hpp"
#include "fluid/diffusion/single_face.hpp"
#include "fluid/diffusion/viscous_sides.hpp"

namespace brisance::coupling {

using fluid::State;

namespace {
auto order(int direction, CellIndex const& at) { return std::tuple(direction, at[2], at[1], at[0]); }
}  // namespace

ApartFace const* ThinWallStress::apart(CellIndex const& cell, int direction, int side) const {
  ApartFace key;
  key.cell = cell, key.direction = direction, key.side = side;
  auto const at = std::lower_bound(walls_.begin(), walls_.end(), key);
  return at != walls_.end() && !(key < *at) ? &*at : nullptr;
}

State ThinWallStress::mirrored(State const& u, ApartFace const& face) const {
  if (!face.mirrors) return u;
  return fluid::wall_mirror(u, transport_.gas, config_.slip, config_.temperature, face.wall_velocity, face.normal);
}

State ThinWallStress::next(CellIndex const& cell, int direction, int side) const {
  CellIndex const there = beside(cell, direction, side == 0 ? -1 : 1);
  if (ApartFace const* const wall = apart(cell, direction, side))
    return mirrored(block_->load(cell[0], cell[1], cell[2]), *wall);
  return block_->load(there[0], there[1], there[2]);
}

std::array<Real, 4> ThinWallStress::joined(Face const& face) const {
  CellIndex const high = face.at, low = beside(high, face.direction, -1);
  fluid::FaceStates s{block_->load(low[0], low[1], low[2]), block_->load(high[0], high[1], high[2]), {}};
  for (int d = 0; d < grid_.dimension; ++d)
    if (d != face.direction)
      s.beside[static_cast<std::size_t>(d)] = {next(low, d, 0), next(low, d, 1), next(high, d, 0), next(high, d, 1)};
  return fluid::viscous_flux(transport_, grid_, face.direction, s);
}

std::array<Real, 4> ThinWallStress::at_wall(ApartFace const& face) const {
  CellIndex const& c = face.cell;
  State const u = block_->load(c[0], c[1], c[2]), ghost = mirrored(u, face);
  fluid::FaceStates s{face.side == 0 ? ghost : u, face.side == 0 ? u : ghost, {}};
  for (int d = 0; d < grid_.dimension; ++d) {
    if (d == face.direction) continue;
    State const before = next(c, d, 0), after = next(c, d, 1);
    State const behind_before = mirrored(before, face), behind_after = mirrored(after, face);
    if (face.side == 0)
      s.beside[static_cast<std::size_t>(d)] = {behind_before, behind_after, before, after};
    else
      s.beside[static_cast<std::size_t>(d)] = {before, after, behind_before, behind_after};
  }
  return fluid::viscous_flux(transport_, grid_, face.direction, s);
}

void ThinWallStress::find(fluid::Block const& block, WallBlock const& wall) {
  faces_.clear();
  felt_.clear();
  if (wall.apart.empty()) return;
  block_ = &block;
  walls_ = wall.apart;
  auto const offer = [&](int d, CellIndex const& at) {
    for (int e = 0; e < 3; ++e) {
      Index const i = at[static_cast<std::size_t>(e)], n = wall.size[static_cast<std::size_t>(e)];
      if (i < 0 || i >= n + (e == d)) return;
    }
    faces_.push_back({d, at, {}});
  };
  for (ApartFace const& a : walls_)
    for (int d = 0; d < grid_.dimension; ++d)  // its own face, and those along it of the cell
      for (int side = 0; side < 2; ++side)
        if (d != a.direction || side == a.side) offer(d, beside(a.cell, d, side));
  auto const less = [](Face const& a, Face const& b) { return order(a.direction, a.at) < order(b.direction, b.at); };
  std::sort(faces_.begin(), faces_.end(), less);
  faces_.erase(std::unique(faces_.begin(), faces_.end(), [&](auto const& a, auto const& b) { return !less(a, b); }),
               faces_.end());
  auto const inside = [&](CellIndex const& c) {
    for (std::size_t d = 0; d < 3; ++d)
      if (c[d] < 0 || c[d] >= wall.size[d]) return false;
    return true;
  };
  for (Face& face : faces_) {
    int const d = face.direction;
    ApartFace const *const low = apart(beside(face.at, d, -1), d, 1), *const high = apart(face.at, d, 0);
    if (!low && !high) {
      face.flux = joined(face);
    } else if (low && low->solid) {
      face.flux = at_wall(*low);
    } else if (high && high->solid) {
      face.flux = at_wall(*high);
    } else {
      for (ApartFace const* const a : {low, high})
        if (a && inside(a->cell)) felt_.push_back({a->cell, d, a->side, at_wall(*a)});
    }
  }
}

void ThinWallStress::replace(int direction, Index j, Index k, Real* stress, std::ptrdiff_t pitch) const {
  if (faces_.empty()) return;
  auto const before = [](Face const& f, auto const& key) { return order(f.direction, f.at) < key; };
  auto const row = [&](Index i) {
    return std::lower_bound(faces_.begin(), faces_.end(), order(direction, {i, j, k}), before);
  };
  for (auto face = row(0); face != faces_.end() && face->direction == direction && face->at[1] == j && face->at[2] == k;
       ++face)
    for (std::size_t q = 0; q < 4; ++q) stress[static_cast<std::ptrdiff_t>(q) * pitch + face->at[0]] = face->flux[q];
}

void ThinWallStress::finish(fluid::Block& block, Real time) const {
  for (Felt const& f : felt_) {
    State u = block.load(f.cell[0], f.cell[1], f.cell[2]);
    Real const share = (f.side == 0 ? -1 : 1) * time / grid_.spacing[f.direction];
    for (std::size_t q = 0; q < 4; ++q) u[q + 1] += share * f.flux[q];
    block.store(f.cell[0], f.cell[1], f.cell[2], u);
  }
}

}  // namespace brisance::coupling
