#include "coupling/cut_cells/wall_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/wall_centroids.hpp"

namespace brisance::coupling {

using fluid::State;

namespace {

/// Apertures below this share of a face let no neighbour be seen.
constexpr Real seen = 1e-6;

/// Full slopes up to this relative jump between neighbours, none from twice that on.
constexpr Real smooth_jump = 0.5;

Real relative_jump(Real a, Real b) { return std::abs(a - b) / min(std::abs(a), std::abs(b)); }

}  // namespace

bool sees(WallRecord const& record, CellIndex c, CellIndex to) {
  if (c == to) return true;
  fluid::Grid const& grid = record.grid();
  for (int d = 0; d < grid.dimension; ++d) {
    auto const dir = static_cast<std::size_t>(d);
    if (c[dir] == to[dir]) continue;
    int const side = to[dir] > c[dir] ? 1 : 0;
    if (!(record.aperture(c, d, side) > seen * grid.face_area(d))) continue;
    CellIndex next = c;
    next[dir] = to[dir];
    if (!record.solid(next) && sees(record, next, to)) return true;
  }
  return false;
}

State moved_within(fluid::Gas const& gas, State const& u, State const& change) {
  State v = u;
  for (std::size_t q = 0; q < 5; ++q) v[q] += change[q];
  if (!(v[0] > 0.1 * u[0]) || !(gas.internal_energy(v) > 0.1 * gas.internal_energy(u)) || gas.vacuum(v)) return u;
  return v;
}

State flux_change(fluid::Gas const& gas, State const& u, State const& change, int d) {
  State const v = moved_within(gas, u, change);
  auto const normal = 1 + static_cast<std::size_t>(d);
  Real const p = gas.pressure(u), q = gas.pressure(v);
  Real const before = u[normal] / u[0], after = v[normal] / v[0];
  State f;
  for (std::size_t k = 0; k < 5; ++k) f[k] = after * v[k] - before * u[k];
  f[normal] += q - p;
  f[4] += after * q - before * p;
  return f;
}

void WallSlopes::plan(parallel::Comm& comm, fluid::Flow& flow, WallRecord const& record, std::vector<GlobalId> cells) {
  fluid::Grid const& grid = flow.grid();
  planned_ = true;
  dimension_ = grid.dimension;
  gas_ = flow.gas();
  spacing_ = grid.spacing;
  ids_ = std::move(cells);
  cells_.assign(ids_.size(), {});
  neighbours_.clear();
  std::vector<Vec3> centroid(record.geometry.cells.size());
  std::vector<bool> known(record.geometry.cells.size(), false);
  auto const place = [&](CellIndex c) {
    Index const i = record.cut_index(c);
    if (i < 0) return Vec3{};
    auto const at = static_cast<std::size_t>(i);
    if (!known[at]) centroid[at] = fluid_centroid(record, c), known[at] = true;
    return centroid[at];
  };
  std::vector<GlobalId> of, wanted;  // of each neighbour
  std::vector<GlobalId> sources(ids_.size());
  for (std::size_t n = 0; n < ids_.size(); ++n) {
    CellIndex const c = cell_from_id(grid, ids_[n]);
    Cell& p = cells_[n];
    p.first = p.last = static_cast<Index>(neighbours_.size());
    CellIndex source = c;
    if (record.solid(c)) {
      // What is about to open: the profile of the nearest fluid.
      Real nearest = -1;
      for_neighbourhood(grid, c, 1, [&](CellIndex m) {
        if (!grid.inside(m) || record.solid(m)) return;
        Real const r2 = norm2(grid.centre(m) + place(m) - grid.centre(c));
        if (nearest < 0 || r2 < nearest) nearest = r2, source = m;
      });
      if (nearest < 0) continue;
    }
    sources[n] = grid.cell_id(source);
    Vec3 const centroid = grid.centre(source) + place(source);
    p.slot = 0;
    p.centroid = centroid - grid.centre(c);
    wanted.push_back(sources[n]);
    for_neighbourhood(grid, source, 1, [&](CellIndex m) {
      if (m == source || !grid.inside(m) || record.solid(m) || !sees(record, source, m)) return;
      neighbours_.push_back({0, grid.centre(m) + place(m) - centroid});
      of.push_back(grid.cell_id(m));
    });
    p.last = static_cast<Index>(neighbours_.size());
  }
  wanted.insert(wanted.end(), of.begin(), of.end());
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  states_.plan(comm, flow, std::move(wanted));
  for (std::size_t n = 0; n < ids_.size(); ++n)
    if (cells_[n].slot >= 0) cells_[n].slot = states_.slot(sources[n]);
  for (std::size_t n = 0; n < of.size(); ++n) neighbours_[n].slot = states_.slot(of[n]);
}

void WallSlopes::clear() {
  planned_ = false;
  ids_.clear();
  cells_.clear();
  neighbours_.clear();
}

void WallSlopes::refresh(parallel::Comm& comm, ReadCell const& read, ProfileKind kind) {
  states_.refresh(comm, read);
  for (Cell& p : cells_) fit(p, kind);
}

bool fit_profile(ProfileKind kind, fluid::Gas const& gas, Vec3 const& spacing, int dimension, State const& u,
                 std::span<PlacedState const> neighbours, Profile& profile) {
  if (gas.vacuum(u)) return false;
  Real const pressure = gas.pressure(u) + gas.curve.stiffness;
  Real jump = 0;
  State most{};
  std::array<std::array<Real, 3>, 3> matrix{};
  std::array<State, 3> right{};
  for (PlacedState const& n : neighbours) {
    State const& v = n.state;
    if (gas.vacuum(v)) return false;
    jump = max(jump, max(relative_jump(u[0], v[0]), relative_jump(pressure, gas.pressure(v) + gas.curve.stiffness)));
    std::array<Real, 3> const x{n.offset.x / spacing.x, n.offset.y / spacing.y, n.offset.z / spacing.z};
    Real const r2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    if (!(r2 > 1e-6)) continue;
    Real const w = 1 / r2;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j <= i; ++j) matrix[i][j] += w * x[i] * x[j];
      for (std::size_t q = 0; q < 5; ++q) right[i][q] += w * x[i] * (v[q] - u[q]);
    }
    for (std::size_t q = 0; q < 5; ++q) most[q] = max(most[q], std::abs(v[q] - u[q]));
  }
  if (!(jump < 2 * smooth_jump)) return false;
  // Cholesky; an axis along which the neighbours tell nothing has no slope.
  auto const axes = static_cast<std::size_t>(dimension);
  std::array<std::array<Real, 3>, 3> low{};
  for (std::size_t i = 0; i < axes; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      Real sum = matrix[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= low[i][k] * low[j][k];
      if (i == j)
        low[i][i] = sum > 0.02 * matrix[i][i] && sum > 1e-3 ? std::sqrt(sum) : 0;
      else
        low[i][j] = low[j][j] > 0 ? sum / low[j][j] : 0;
    }
  for (std::size_t q = 0; q < 5; ++q) {
    std::array<Real, 3> s{};
    for (std::size_t i = 0; i < axes; ++i) {
      if (low[i][i] == 0) continue;
      s[i] = right[i][q];
      for (std::size_t k = 0; k < i; ++k) s[i] -= low[i][k] * s[k];
      s[i] /= low[i][i];
    }
    for (std::size_t i = axes; i-- > 0;) {
      if (low[i][i] == 0) continue;
      for (std::size_t k = i + 1; k < axes; ++k) s[i] -= low[k][i] * s[k];
      s[i] /= low[i][i];
    }
    for (std::size_t i = 0; i < axes; ++i) profile[i][q] = s[i];
  }
  if (kind == ProfileKind::density) {
    // At the velocity and pressure of the cell.
    Real const step = 1e-3 * u[0], p = gas.pressure(u);
    Real energy = 0.5 * (u[1] * u[1] + u[2] * u[2] + u[3] * u[3]) / (u[0] * u[0]);
    if (!gas.curve.zero())
      energy += (gas.energy_at_rest(u[0] + step, p) - gas.energy_at_rest(u[0] - step, p)) / (2 * step);
    for (std::size_t i = 0; i < axes; ++i) {
      for (std::size_t q = 1; q < 4; ++q) profile[i][q] = profile[i][0] * u[q] / u[0];
      profile[i][4] = profile[i][0] * energy;
    }
    most[4] = most[0] * std::abs(energy);
  }
  // One factor for all components, so that a contact stays one: no change across half a cell beyond what is seen.
  Real factor = min(1, 2 - jump / smooth_jump);
  for (std::size_t const q : {std::size_t{0}, std::size_t{4}}) {
    Real reach = 0;
    for (std::size_t i = 0; i < axes; ++i) reach += 0.5 * std::abs(profile[i][q]);
    if (reach > most[q]) factor = min(factor, most[q] / reach);
  }
  for (std::size_t i = 0; i < axes; ++i)
    for (Real& g : profile[i]) g *= factor / spacing[static_cast<int>(i)];
  return true;
}

State change_along(Profile const& profile, Vec3 const& offset) {
  State change{};
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t q = 0; q < 5; ++q) change[q] += offset[static_cast<int>(d)] * profile[d][q];
  return change;
}

void WallSlopes::fit(Cell& cell, ProfileKind kind) const {
  std::array<PlacedState, 26> around;
  auto const n = static_cast<std::size_t>(cell.last - cell.first);
  for (std::size_t i = 0; i < n; ++i) {
    Neighbour const& neighbour = neighbours_[static_cast<std::size_t>(cell.first) + i];
    around[i] = {states_[neighbour.slot], neighbour.offset};
  }
  cell.flat = cell.slot < 0 ||
              !fit_profile(kind, gas_, spacing_, dimension_, states_[cell.slot], {around.data(), n}, cell.profile);
}

WallSlopes::Cell const* WallSlopes::find(GlobalId cell) const {
  auto const at = std::lower_bound(ids_.begin(), ids_.end(), cell);
  return at != ids_.end() && *at == cell ? &cells_[static_cast<std::size_t>(at - ids_.begin())] : nullptr;
}

State WallSlopes::value(GlobalId cell, State const& u, Vec3 const& x) const {
  Cell const* const p = find(cell);
  if (!p || p->flat) return u;
  return moved_within(gas_, u, change_along(p->profile, x - p->centroid));
}

Profile const* WallSlopes::profile(GlobalId cell) const {
  Cell const* const p = find(cell);
  return p && !p->flat ? &p->profile : nullptr;
}

State const* WallSlopes::mean(GlobalId cell) const {
  Cell const* const p = find(cell);
  return p && p->slot >= 0 ? &states_[p->slot] : nullptr;
}

std::size_t WallSlopes::bytes() const {
  return ids_.capacity() * sizeof(GlobalId) + cells_.capacity() * sizeof(Cell) +
         neighbours_.capacity() * sizeof(Neighbour);
}

}  // namespace brisance::coupling
