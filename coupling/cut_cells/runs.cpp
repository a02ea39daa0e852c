// Where the runs of a block begin and end, and which states stand beyond their ends.
#include <algorithm>
#include <cmath>

#include "coupling/cut_cells/cell_geometry.hpp"
#include "coupling/cut_cells/openings.hpp"
#include "coupling/cut_cells/wall_sweeper.hpp"

namespace brisance::coupling {

using fluid::Block;

namespace {
/// Part of what the cells on both sides of a face hold that its opening must have for the sweeps to look through. They
/// take faces as open all over: the jet through a slit, such as between bodies that begin to part, would fill the cell
/// behind it as if it came through the whole face, and the next sweep would find that pressure there.
constexpr Real slit = 0.1;
}  // namespace

bool WallSweeper::wide(CellIndex const& c, int direction, int side) const {
  CellIndex const other = beside(c, direction, side == 0 ? -1 : 1);
  Lattice const& lattice = record_->lattice();
  Real const open = record_->aperture(c, direction, side) / lattice.face_area(direction);
  if (!(open > covered_fraction)) return false;
  if (open >= slit) return true;
  return open >= slit * min(record_->volume(c), record_->volume(other)) / lattice.cell_volume();
}

bool WallSweeper::passes(CellIndex const& c, int direction, int side) const {
  CellIndex low = c, next = c;
  (side == 0 ? low : next)[static_cast<std::size_t>(direction)] += side == 0 ? -1 : 1;
  return wide(c, direction, side) && !record_->solid(side == 0 ? low : next) && record_->parts.joined(low, direction);
}

bool WallSweeper::reaches(CellIndex const& home, CellIndex const& image) const {
  int const dimension = flow_.grid().dimension;
  if (!flow_.grid().inside(home) || record_->solid(image)) return false;
  std::array<int, 3> axes{0, 1, 2};
  do {
    CellIndex c = home;
    bool open = true;
    for (int n = 0; n < 3 && open; ++n) {
      int const d = axes[static_cast<std::size_t>(n)];
      if (d >= dimension) continue;
      auto const at = static_cast<std::size_t>(d);
      for (int const side = image[at] > c[at] ? 1 : 0; open && c[at] != image[at]; c[at] += side == 0 ? -1 : 1)
        open = passes(c, d, side);
    }
    if (open) return true;
  } while (std::next_permutation(axes.begin(), axes.begin() + dimension));
  return false;
}

void WallSweeper::find_same_side(CellIndex const& home, std::span<CellIndex const> images, bool all) {
  fluid::Grid const& grid = flow_.grid();
  CellBox box{home, {home[0] + 1, home[1] + 1, home[2] + 1}};
  for (CellIndex const& image : images)
    for (std::size_t d = 0; d < 3; ++d) {
      box.low[d] = std::min(box.low[d], image[d]);
      box.high[d] = std::max(box.high[d], image[d] + 1);
    }
  box = grown(grid, box, 2);
  for (std::size_t d = 0; d < 3; ++d)
    box.low[d] = std::max(box.low[d], 0), box.high[d] = std::min(box.high[d], grid.cells[d]);
  // The marks cover the box and nothing else: a flood stops at its sides.
  same_side_.start(box);
  if (box.holds(home)) same_side_.insert(home);
  for (std::size_t next = 0; next < same_side_.cells().size(); ++next) {
    CellIndex const c = same_side_.cells()[next];
    for (int d = 0; d < grid.dimension; ++d)
      for (int side = 0; side < 2; ++side) {
        CellIndex n = c;
        n[static_cast<std::size_t>(d)] += side == 0 ? -1 : 1;
        if (box.holds(n) && !same_side_.holds(n) && passes(c, d, side)) same_side_.insert(n);
      }
    if (!all && std::all_of(images.begin(), images.end(), [&](CellIndex const& i) { return same_side_.holds(i); }))
      return;
  }
}

bool WallSweeper::wets(Index piece) const {
  Piece const& p = record_->geometry.pieces[static_cast<std::size_t>(piece)];
  if (same_side_.holds(p.cell)) {
    PartedCell const* const parts = record_->parts.find(p.cell);
    if (!parts || record_->parts.part_of(*parts, piece) == 0) return true;
  }
  // A piece of a small part or of a covered cell has its gas in front of it.
  std::size_t d = 0;
  for (std::size_t e = 1; e < 3; ++e)
    if (std::abs(p.area[static_cast<int>(e)]) > std::abs(p.area[static_cast<int>(d)])) d = e;
  CellIndex front = p.cell;
  front[d] += p.area[static_cast<int>(d)] > 0 ? 1 : -1;
  return same_side_.holds(front);
}

WallSweeper::Seen WallSweeper::look(CellIndex c, int direction, int side, Index& hint) const {
  fluid::Grid const& grid = flow_.grid();
  Seen seen{c, record_->project(c, direction, side, hint), {}, false};
  if (seen.wall.found) seen.image = into_domain(grid, cell_of(grid, 2.0 * seen.wall.point - grid.centre(c)));
  return seen;
}

bool WallSweeper::in_front(CellIndex const& n, Seen const& seen, int direction) const {
  fluid::Grid const& grid = flow_.grid();
  if (!grid.inside(n) || record_->solid(n)) return false;
  return direction < 0 || dot(grid.centre(n) - seen.wall.point, seen.wall.normal) > -0.5 * smallest_spacing(grid);
}

void WallSweeper::keep_to_own_side(CellIndex const& home, std::span<Seen> seen, int direction, int side) {
  // A wall has another side: where the gas of the run does not come to the image straight ahead, it is asked how far
  // it comes at all, and only what it wets mirrors it.
  std::array<CellIndex, 3> images{};
  std::size_t count = 0;
  bool all = false;
  for (Seen& s : seen) {
    s.flooded = s.wall.found && !reaches(home, s.image);
    if (!s.flooded) continue;
    images[count++] = s.image;
    all = all || !in_front(s.image, s, direction);
  }
  if (count == 0) return;
  find_same_side(home, std::span(images.data(), count), all);
  for (Seen& s : seen) {
    if (!s.flooded || same_side_.holds(s.image)) continue;
    Index none = -1;
    s.wall = record_->project(s.cell, direction, side, none, [this](Index piece) { return wets(piece); });
    fluid::Grid const& grid = flow_.grid();
    if (s.wall.found) s.image = into_domain(grid, cell_of(grid, 2.0 * s.wall.point - grid.centre(s.cell)));
  }
}

MirrorCell WallSweeper::mirror(Seen const& seen, int direction, std::vector<GlobalId>& wanted) const {
  if (!seen.wall.found) return {};
  fluid::Grid const& grid = flow_.grid();
  Projection const& p = seen.wall;
  CellIndex chosen = seen.image;
  Vec3 const image = 2.0 * p.point - grid.centre(seen.cell);
  auto const acceptable = [&](CellIndex n) {
    return in_front(n, seen, direction) && (!seen.flooded || same_side_.holds(n));
  };
  if (!acceptable(chosen)) {
    CellIndex const middle = chosen;
    Real best = -1;
    for_neighbourhood(grid, middle, 2, [&](CellIndex n) {
      if (!acceptable(n)) return;
      Real const r2 = norm2(grid.centre(n) - image);
      if (best < 0 || r2 < best || (r2 == best && grid.cell_id(n) < grid.cell_id(chosen))) best = r2, chosen = n;
    });
    if (best < 0) return {};
  }
  GlobalId const id = grid.cell_id(chosen);
  wanted.push_back(id);
  Vec3 offset = image - grid.centre(chosen);
  for (int d = 0; d < 3; ++d) offset[d] = d < grid.dimension ? clamp(offset[d], -grid.spacing[d], grid.spacing[d]) : 0;
  return {static_cast<Index>(wanted.size()) - 1, -1, offset, p.normal, dot(p.velocity, p.normal), p.velocity};
}

bool WallSweeper::two_sides(CellIndex low, int direction) const {
  fluid::Grid const& grid = flow_.grid();
  auto const d = static_cast<std::size_t>(direction);
  CellIndex high = low;
  ++high[d];
  if (low[d] < 0 || high[d] >= grid.cells[d] || record_->cut_index(low) < 0) return false;
  if (wide(low, direction, 1)) return false;
  if (record_->parts.find(low) || record_->parts.find(high)) return true;
  // Around the edge of the face, as over a crest of the wall, it is the same fluid.
  for (int e = 0; e < grid.dimension; ++e)
    for (int side = 0; e != direction && side < 2; ++side) {
      CellIndex beside = low;
      beside[static_cast<std::size_t>(e)] += side == 0 ? -1 : 1;
      CellIndex across = beside;
      ++across[d];
      // What opens there may be the gas of either side.
      if (record_->parts.find(beside) || record_->parts.find(across)) continue;
      if (wide(low, e, side) && wide(high, e, side) && wide(beside, direction, 1)) return false;
    }
  return true;
}

void WallSweeper::find_runs(Block const& block, WallBlock& wall, int direction) {
  auto const d = static_cast<std::size_t>(direction);
  std::size_t const t0 = d == 0 ? 1 : 0, t1 = d == 2 ? 1 : 2;
  auto& runs = wall.runs[d];
  auto& ends = wall.ends[d];
  runs.clear();
  ends.clear();
  wall.parted[d].clear();
  Index const n = block.size()[d], ghost = block.ghost()[d];
  fluid::Grid const& grid = flow_.grid();
  Index first_nearest[2] = {-1, -1};  // of the last run that ended at this side: mostly next to it
  auto const wall_end = [&](CellIndex last, int outwards) {
    WallBlock::RunEnd end;
    Index hint = first_nearest[outwards > 0];
    std::array<Seen, 3> seen;
    for (std::size_t m = 0; m < 3; ++m) {
      CellIndex c = last;
      c[d] += outwards * (static_cast<Index>(m) + 1);
      seen[m] = look(c, direction, -outwards, hint);
      if (m == 0) first_nearest[outwards > 0] = hint;
    }
    keep_to_own_side(last, seen, direction, -outwards);
    for (std::size_t m = 0; m < 3; ++m) {
      end.mirror[m] = mirror(seen[m], direction, wall.images);
      end.general[m] = end.mirror[m].place < 0 && m < 2 && record_->solid(seen[m].cell);
    }
    ends.push_back(end);
    return static_cast<Index>(ends.size()) - 1;
  };
  for (Index b = 0; b < block.size()[t1]; ++b)
    for (Index a = 0; a < block.size()[t0]; ++a) {
      CellIndex c = block.first();
      c[t0] += a;
      c[t1] += b;
      auto const global = [&](Index i) {
        CellIndex g = c;
        g[d] += i;
        return g;
      };
      // Beyond a side of the domain stand its ghosts: they continue the run that touches it.
      auto const is_solid = [&](Index i) {
        CellIndex g = global(i);
        if (g[d] < 0 || g[d] >= grid.cells[d]) g = into_domain(grid, g);
        return record_->solid(g);
      };
      Index i = -ghost;
      while (i < n + ghost) {
        while (i < n + ghost && is_solid(i)) ++i;
        if (i == n + ghost) break;
        WallBlock::Run run{i, i, {a, b}};
        do ++i;
        while (i < n + ghost && !is_solid(i) && !parted(global(i - 1), direction));
        run.end = i;
        if (i < n + ghost && i >= 0 && i <= n && !is_solid(i)) {
          CellIndex face{};
          face[d] = i, face[t0] = a, face[t1] = b;
          wall.parted[d].push_back(face);
        }
        if (run.end < 0 || run.begin > n) continue;
        if (run.begin > -ghost) run.low = wall_end(global(run.begin), -1);
        if (run.end < n + ghost) run.high = wall_end(global(run.end - 1), +1);
        runs.push_back(run);
      }
    }
  auto const length = [&](WallBlock::Run const& r) { return std::min(r.end, n) - std::max(r.begin, 0); };
  std::stable_sort(runs.begin(), runs.end(), [&](auto const& x, auto const& y) { return length(x) > length(y); });
}

void WallSweeper::find_solid(Block const& block, WallBlock& wall) {
  wall.solid.clear();
  fluid::Grid const& grid = flow_.grid();
  CellIndex const first = block.first();
  CellBox const own = box_of(block);
  near_.start(own);
  CellBox const around = grown(grid, own, 2);
  for (CutCell const& cut : record_->geometry.cells)
    if (around.holds(cut.cell))
      for_neighbourhood(grid, cut.cell, 2, [&](CellIndex c) {
        if (own.holds(c) && record_->solid(c)) near_.insert(c);
      });
  std::vector<GlobalId> near;
  for (CellIndex const& c : near_.cells()) near.push_back(grid.cell_id(c));
  std::sort(near.begin(), near.end());
  Index hint = -1;
  for (GlobalId const id : near) {
    CellIndex const c = cell_from_id(grid, id);
    MirrorCell const m = mirror(look(c, -1, 0, hint), -1, wall.images);
    wall.solid.emplace_back(CellIndex{c[0] - first[0], c[1] - first[1], c[2] - first[2]}, m);
  }
}

void WallSweeper::renew(Block const& block) {
  fluid::Grid const& grid = flow_.grid();
  // Two cells beyond the ghosts: what is cut after the next step has its fluxes kept too.
  if (!record_->touches(grown(grid, box_of(block), block.ghost()[0] + 2))) {
    blocks_.erase(block.id());
    return;
  }
  WallBlock& wall = blocks_[block.id()];
  wall.size = block.size();
  wall.images.clear();
  wall.beside_parted.clear();
  for (int d = 0; d < grid.dimension; ++d) {
    find_runs(block, wall, d);
    CellIndex const first = block.first();
    auto const dir = static_cast<std::size_t>(d);
    for (CellIndex const& high : wall.parted[dir]) {
      CellIndex const low = beside(high, d, -1);
      if (!two_gases({first[0] + low[0], first[1] + low[1], first[2] + low[2]}, d)) continue;
      for (CellIndex const& c : {low, high})
        if (c[dir] >= 0 && c[dir] < wall.size[dir]) wall.beside_parted.push_back(wall.cell(c[0], c[1], c[2]));
    }
  }
  std::sort(wall.beside_parted.begin(), wall.beside_parted.end());
  find_solid(block, wall);
  if (viscous_) find_apart(block, wall);
}

void WallSweeper::rebuild(WallRecord const& record) {
  record_ = &record;
  for (Block const& block : std::as_const(flow_).blocks()) renew(block);
  gather_images();
}

void WallSweeper::update(WallRecord const& record, std::span<CellBox const> changed) {
  record_ = &record;
  fluid::Grid const& grid = flow_.grid();
  std::vector<Index> stale;
  for (CellBox const& box : changed) {
    CellBox const around = grown(grid, box, wall_reach);
    CellIndex low{}, high{};  // runs and images do not reach through periodic sides
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::clamp(around.low[d], 0, grid.cells[d] - 1);
      high[d] = std::clamp(around.high[d] - 1, 0, grid.cells[d] - 1);
    }
    auto const b0 = grid.block_position(grid.block_of(low)), b1 = grid.block_position(grid.block_of(high));
    for (Index bz = b0[2]; bz <= b1[2]; ++bz)
      for (Index by = b0[1]; by <= b1[1]; ++by)
        for (Index bx = b0[0]; bx <= b1[0]; ++bx) stale.push_back(grid.block_id({bx, by, bz}));
  }
  std::sort(stale.begin(), stale.end());
  stale.erase(std::unique(stale.begin(), stale.end()), stale.end());
  for (Block const& block : std::as_const(flow_).blocks())
    if (std::binary_search(stale.begin(), stale.end(), block.id())) renew(block);
  gather_images();
}

void WallSweeper::gather_images() {
  std::vector<GlobalId> list;
  for (auto const& [id, wall] : blocks_) list.insert(list.end(), wall.images.begin(), wall.images.end());
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  image_cells_ = list;
  images_.plan(comm_, flow_, std::move(list));
  any_parted_ =
      std::any_of(blocks_.begin(), blocks_.end(), [](auto const& b) { return !b.second.beside_parted.empty(); });
  profiled_ = false;
  profiles_.clear();
  image_slopes_.clear();
  for (auto& [id, wall] : blocks_) {
    auto const to_slot = [&](MirrorCell& m) {
      if (m.place >= 0) m.slot = images_.slot(wall.images[static_cast<std::size_t>(m.place)]);
    };
    for (auto& ends : wall.ends)
      for (WallBlock::RunEnd& end : ends)
        for (MirrorCell& m : end.mirror) to_slot(m);
    for (auto& [cell, m] : wall.solid) to_slot(m);
  }
  refresh_mirrors();
}

void WallSweeper::keep(WallRecord const& record) {
  profiled_ = false;
  record_ = &record;
  refresh_mirrors();
}

void WallSweeper::refresh_mirrors() {
  set_mirrors([](fluid::State const& u, MirrorCell const& m) { return reflect(u, m); });
}

void WallSweeper::set_mirrors(std::function<fluid::State(fluid::State const&, MirrorCell const&)> const& mirrored) {
  images_.refresh(comm_, [](Block const& b, Index i, Index j, Index k) { return b.load(i, j, k); });
  for (auto& [id, wall] : blocks_) {
    Block& block = *flow_.find(id);
    for (auto const& [c, m] : wall.solid) block.store(c[0], c[1], c[2], m.slot >= 0 ? mirrored(image(m), m) : ambient);
  }
}

}  // namespace brisance::coupling
