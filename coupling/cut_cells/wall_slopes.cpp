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

WaysAround::WaysAround(WallRecord const& record, CellIndex from)
    : low_{from[0] - profile_reach, from[1] - profile_reach, from[2] - profile_reach} {
  fluid::Grid const& grid = record.grid();
  // Nearer ones first, along every axis: the way comes from one step nearer.
  constexpr std::array<Index, width> outwards{0, 1, -1, 2, -2};
  static_assert(profile_reach == 2);
  auto const steps = [&](int axis) { return std::span(outwards).first(axis < grid.dimension ? width : 1); };
  for (Index const k : steps(2))
    for (Index const j : steps(1))
      for (Index const i : steps(0)) {
        CellIndex const by{i, j, k}, c{from[0] + i, from[1] + j, from[2] + k};
        bool& seen_here = seen_[place(c)];
        if (c == from) {
          seen_here = true;
          continue;
        }
        // A divided cell has another gas behind it.
        if (!grid.inside(c) || record.solid(c) || record.parts.find(c)) continue;
        for (int d = 0; d < grid.dimension && !seen_here; ++d) {
          auto const dir = static_cast<std::size_t>(d);
          if (by[dir] == 0) continue;
          CellIndex before = c;
          before[dir] -= by[dir] > 0 ? 1 : -1;
          seen_here = seen_[place(before)] && record.aperture(before, d, by[dir] > 0) > seen * grid.face_area(d);
        }
      }
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
  std::vector<Moments> moments(record.geometry.cells.size());
  std::vector<bool> known(record.geometry.cells.size(), false);
  Moments const whole = cell_moments(grid);
  auto const region = [&](CellIndex c) -> Moments const& {
    Index const i = record.cut_index(c);
    if (i < 0) return whole;
    auto const at = static_cast<std::size_t>(i);
    if (!known[at]) moments[at] = fluid_moments(record, c), known[at] = true;
    return moments[at];
  };
  std::vector<GlobalId> of, wanted;  // of each neighbour
  std::vector<GlobalId> sources(ids_.size());
  for (std::size_t n = 0; n < ids_.size(); ++n) {
    CellIndex const c = cell_from_id(grid, ids_[n]);
    Cell& p = cells_[n];
    p.first = p.last = static_cast<Index>(neighbours_.size());
    CellIndex source = c;
    if (record.parts.find(c)) continue;
    if (record.solid(c)) {
      // What is about to open: the profile of the nearest fluid.
      Real nearest = -1;
      for_neighbourhood(grid, c, 1, [&](CellIndex m) {
        if (!grid.inside(m) || record.solid(m) || record.parts.find(m)) return;
        Real const r2 = norm2(grid.centre(m) + region(m).mean - grid.centre(c));
        if (nearest < 0 || r2 < nearest) nearest = r2, source = m;
      });
      if (nearest < 0) continue;
    }
    sources[n] = grid.cell_id(source);
    p.slot = 0;
    p.region = moved(region(source), grid.centre(source) - grid.centre(c));
    wanted.push_back(sources[n]);
    for_seen(record, source, [&](CellIndex m) {
      if (m == source) return;
      neighbours_.push_back({0, moved(region(m), grid.centre(m) - grid.centre(c)), adjacent(source, m)});
      of.push_back(grid.cell_id(m));
    });
    p.last = static_cast<Index>(neighbours_.size());
  }
  // Cells side by side share most of their neighbours: what came last at a place of a small table needs no second look.
  constexpr std::size_t recent_cells = 4096;
  std::vector<std::pair<GlobalId, Index>> recent(recent_cells, {-1, -1});
  auto const place = [&](GlobalId id) -> auto& { return recent[static_cast<std::size_t>(id) % recent_cells]; };
  for (GlobalId const id : of)
    if (auto& last = place(id); last.first != id) last.first = id, wanted.push_back(id);
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  states_.plan(comm, flow, std::move(wanted));
  for (std::size_t n = 0; n < ids_.size(); ++n)
    if (cells_[n].slot >= 0) cells_[n].slot = states_.slot(sources[n]);
  recent.assign(recent_cells, {-1, -1});
  for (std::size_t n = 0; n < of.size(); ++n) {
    auto& last = place(of[n]);
    if (last.first != of[n]) last = {of[n], states_.slot(of[n])};
    neighbours_[n].slot = last.second;
  }
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

namespace {

/// Weighted least squares for the changes of the first `values` of five along up to nine terms.
class LeastSquares {
 public:
  LeastSquares(std::size_t terms, std::size_t values) : terms_(terms), values_(values) {}

  void add(std::array<Real, 9> const& term, State const& change, Real weight) {
    for (std::size_t i = 0; i < terms_; ++i) {
      for (std::size_t j = 0; j <= i; ++j) matrix_[i][j] += weight * term[i] * term[j];
      for (std::size_t q = 0; q < values_; ++q) right_[i][q] += weight * term[i] * change[q];
    }
  }

  /// Cholesky. A term that the others leave less than a share of `tight` of gets no value: false, when there is one.
  bool solve(Real tight, std::array<State, 9>& value) const {
    std::array<std::array<Real, 9>, 9> low{};
    bool all = true;
    for (std::size_t i = 0; i < terms_; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        Real sum = matrix_[i][j];
        for (std::size_t k = 0; k < j; ++k) sum -= low[i][k] * low[j][k];
        if (i == j)
          low[i][i] = sum > tight * matrix_[i][i] && sum > 1e-3 * tight ? std::sqrt(sum) : 0,
          all = all && low[i][i] > 0;
        else
          low[i][j] = low[j][j] > 0 ? sum / low[j][j] : 0;
      }
    value = {};
    for (std::size_t q = 0; q < values_; ++q) {
      std::array<Real, 9> s{};
      for (std::size_t i = 0; i < terms_; ++i) {
        if (low[i][i] == 0) continue;
        s[i] = right_[i][q];
        for (std::size_t k = 0; k < i; ++k) s[i] -= low[i][k] * s[k];
        s[i] /= low[i][i];
      }
      for (std::size_t i = terms_; i-- > 0;) {
        if (low[i][i] == 0) continue;
        for (std::size_t k = i + 1; k < terms_; ++k) s[i] -= low[k][i] * s[k];
        s[i] /= low[i][i];
      }
      for (std::size_t i = 0; i < terms_; ++i) value[i][q] = s[i];
    }
    return all;
  }

 private:
  std::size_t terms_, values_;
  std::array<std::array<Real, 9>, 9> matrix_{};
  std::array<State, 9> right_{};
};

/// Axes of the terms of a profile: the coordinates, then the products that the grid has.
struct Terms {
  std::size_t axes, count = 0;
  std::array<std::size_t, 6> product{};
  explicit Terms(int dimension) : axes(static_cast<std::size_t>(dimension)) {
    count = axes;
    for (std::size_t k = 0; k < 6; ++k)
      if (product_axes[k][0] < dimension && product_axes[k][1] < dimension) product[count++ - axes] = k;
  }
};

/// Change of the density from `u`, at `pressure` (stiffness included), to gas v brought to that pressure without
/// heat: what entropy makes of it. 0 along simple waves, where a profile at one pressure would be one of entropy.
Real entropic_change(fluid::Gas const& gas, State const& u, Real pressure, State const& v) {
  Real const there = gas.pressure(v) + gas.curve.stiffness;
  if (there == pressure) return v[0] - u[0];
  if (gas.curve.exponential()) {
    Real const c = gas.sound_speed(u);
    return v[0] - u[0] - (there - pressure) / (c * c);
  }
  return v[0] * std::pow(pressure / there, 1 / gas.gamma) - u[0];
}

}  // namespace

bool fit_profile(ProfileKind kind, fluid::Gas const& gas, Vec3 const& h, int dimension, PlacedState const& centre,
                 std::span<PlacedState const> neighbours, Profile& profile) {
  State const& u = centre.state;
  if (gas.vacuum(u)) return false;
  Real const pressure = gas.pressure(u) + gas.curve.stiffness;
  Real jump = 0;
  State most{};
  Terms const terms(dimension);
  std::size_t const values = kind == ProfileKind::density ? 1 : 5;
  LeastSquares full(terms.count, values), plain(terms.axes, values);
  std::size_t told = 0;
  bool varies = false;
  for (PlacedState const& n : neighbours) {
    State const& v = n.state;
    if (gas.vacuum(v)) {
      if (n.near) return false;
      continue;
    }
    Real const difference =
        max(relative_jump(u[0], v[0]), relative_jump(pressure, gas.pressure(v) + gas.curve.stiffness));
    if (n.near) jump = max(jump, difference);
    Moments const offset = n.region - centre.region;
    std::array<Real, 9> x{};
    Real r2 = 0;
    for (std::size_t d = 0; d < terms.axes; ++d) {
      x[d] = offset.mean[static_cast<int>(d)] / h[static_cast<int>(d)];
      r2 += x[d] * x[d];
    }
    for (std::size_t t = terms.axes; t < terms.count; ++t) {
      std::size_t const k = terms.product[t - terms.axes];
      x[t] = offset.product[k] / (h[product_axes[k][0]] * h[product_axes[k][1]]);
    }
    if (!(r2 > 1e-6)) continue;
    State change{};
    if (kind == ProfileKind::density)
      change[0] = entropic_change(gas, u, pressure, v);
    else
      for (std::size_t q = 0; q < 5; ++q) change[q] = v[q] - u[q];
    varies = varies || change != State{};
    full.add(x, change, 1 / (r2 * r2));
    ++told;
    if (!n.near) continue;
    plain.add(x, change, 1 / r2);
    for (std::size_t q = 0; q < 5; ++q) most[q] = max(most[q], std::abs(change[q]));
  }
  if (!(jump < 2 * smooth_jump) || !varies) return false;
  std::array<State, 9> value{};
  // Curved profiles of all variables feed waves along the wall.
  bool const curved = kind == ProfileKind::density && told > terms.count && full.solve(1e-3, value);
  if (!curved) plain.solve(0.02, value);  // an axis along which the neighbours tell nothing has no slope
  if (kind == ProfileKind::density) {
    // At the velocity and pressure of the cell.
    Real const step = 1e-3 * u[0], p = gas.pressure(u);
    Real energy = 0.5 * (u[1] * u[1] + u[2] * u[2] + u[3] * u[3]) / (u[0] * u[0]);
    if (!gas.curve.zero())
      energy += (gas.energy_at_rest(u[0] + step, p) - gas.energy_at_rest(u[0] - step, p)) / (2 * step);
    for (State& change : value) {
      for (std::size_t q = 1; q < 4; ++q) change[q] = change[0] * u[q] / u[0];
      change[4] = change[0] * energy;
    }
    most[4] = most[0] * std::abs(energy);
  }
  // One factor for all components, so that a contact stays one: no change across half a cell beyond what is seen.
  Real factor = min(1, 2 - jump / smooth_jump);
  for (std::size_t const q : {std::size_t{0}, std::size_t{4}}) {
    Real reach = 0;
    for (std::size_t i = 0; i < terms.axes; ++i) reach += 0.5 * std::abs(value[i][q]);
    if (reach > most[q]) factor = min(factor, most[q] / reach);
  }
  profile = {};
  for (std::size_t i = 0; i < terms.axes; ++i)
    for (std::size_t q = 0; q < 5; ++q) profile.slope[i][q] = factor / h[static_cast<int>(i)] * value[i][q];
  for (std::size_t t = terms.axes; curved && t < terms.count; ++t) {
    std::size_t const k = terms.product[t - terms.axes];
    Real const scale = factor / (h[product_axes[k][0]] * h[product_axes[k][1]]);
    for (std::size_t q = 0; q < 5; ++q) profile.curve[k][q] = scale * value[t][q];
  }
  return true;
}

State change_between(Profile const& profile, Moments const& difference) {
  State change{};
  for (std::size_t q = 0; q < 5; ++q) {
    for (std::size_t d = 0; d < 3; ++d) change[q] += difference.mean[static_cast<int>(d)] * profile.slope[d][q];
    for (std::size_t k = 0; k < 6; ++k) change[q] += difference.product[k] * profile.curve[k][q];
  }
  return change;
}

Profile operator+(Profile a, Profile const& b) {
  for (std::size_t q = 0; q < 5; ++q) {
    for (std::size_t d = 0; d < 3; ++d) a.slope[d][q] += b.slope[d][q];
    for (std::size_t k = 0; k < 6; ++k) a.curve[k][q] += b.curve[k][q];
  }
  return a;
}

Profile operator*(Real f, Profile p) {
  for (State& s : p.slope)
    for (Real& x : s) x *= f;
  for (State& s : p.curve)
    for (Real& x : s) x *= f;
  return p;
}

Profile moved(Profile profile, Vec3 const& by) {
  for (std::size_t k = 0; k < 6; ++k) {
    auto const [a, b] = product_axes[k];
    for (std::size_t q = 0; q < 5; ++q) {
      profile.slope[static_cast<std::size_t>(a)][q] += by[b] * profile.curve[k][q];
      profile.slope[static_cast<std::size_t>(b)][q] += by[a] * profile.curve[k][q];
    }
  }
  return profile;
}

void WallSlopes::fit(Cell& cell, ProfileKind kind) {
  around_.clear();
  for (Index i = cell.first; i < cell.last; ++i) {
    Neighbour const& neighbour = neighbours_[static_cast<std::size_t>(i)];
    around_.push_back({states_[neighbour.slot], neighbour.region, neighbour.near});
  }
  cell.flat = cell.slot < 0 || !fit_profile(kind, gas_, spacing_, dimension_, {states_[cell.slot], cell.region, true},
                                            around_, cell.profile);
}

WallSlopes::Cell const* WallSlopes::find(GlobalId cell) const {
  auto const at = std::lower_bound(ids_.begin(), ids_.end(), cell);
  return at != ids_.end() && *at == cell ? &cells_[static_cast<std::size_t>(at - ids_.begin())] : nullptr;
}

State WallSlopes::value(GlobalId cell, State const& u, Moments const& region) const {
  Cell const* const p = find(cell);
  if (!p || p->flat) return u;
  return moved_within(gas_, u, change_between(p->profile, region - p->region));
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
