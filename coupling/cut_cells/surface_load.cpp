// Pressures of the pieces become forces and torques of particles (theory/coupling.md 1.6), as those in the middle of
// the step.
#include <algorithm>
#include <map>

#include "coupling/cut_cells/wall_surface.hpp"

namespace brisance::coupling {

std::array<Vec3, 3> area_gained(int dimension, Real depth, std::array<Vec3, 3> const& before,
                                std::array<Vec3, 3> const& after) {
  std::array<Vec3, 3> gained{};
  if (dimension == 2) {
    for (std::size_t a = 0; a < 2; ++a) {
      Vec3 const d = (a == 0 ? -0.5 : 0.5) * depth * (after[a] - before[a]);
      gained[a] = {d.y, -d.x, 0};
    }
    return gained;
  }
  std::array<Vec3, 3> x;  // an area is quadratic: its difference is the derivative half way, here at 3/4 of the step
  for (std::size_t a = 0; a < 3; ++a) x[a] = after[a] - 0.25 * (after[a] - before[a]);
  for (std::size_t a = 0; a < 3; ++a) gained[a] = 0.25 * cross(after[a] - before[a], x[(a + 1) % 3] - x[(a + 2) % 3]);
  return gained;
}

void WallSurface::gather_forces(std::vector<CellForce> const& forces) {
  auto const corners = static_cast<std::size_t>(flow_.grid().dimension);
  std::map<int, parallel::Bytes> to_owner;
  for (CellForce const& f : forces)
    parallel::put(to_owner[solid_.owner(surface_->elements()[static_cast<std::size_t>(f.triangle)].particle)], f);
  std::vector<parallel::Message> out;
  for (auto& [rank, data] : to_owner) out.push_back({rank, std::move(data)});
  std::vector<CellForce> mine;
  for (parallel::Message const& message : comm_.deliver(std::move(out)))
    for (std::span<std::byte const> in(message.data); !in.empty();) mine.push_back(parallel::take<CellForce>(in));
  std::sort(mine.begin(), mine.end(), [](CellForce const& a, CellForce const& b) {
    return a.triangle != b.triangle ? a.triangle < b.triangle : a.cell < b.cell;
  });
  auto f = mine.begin();
  for (Triangle& t : triangles_) {
    t.given = {};
    t.wetted = 0;
    t.loaded = f != mine.end() && f->triangle == surface_->elements()[t.element].id;
    for (; f != mine.end() && f->triangle == surface_->elements()[t.element].id; ++f) {
      for (std::size_t a = 0; a < corners; ++a) t.given[a] += f->force[a];
      t.wetted += f->area;
    }
    t.force = t.given;
  }
}

template <class Row>
std::vector<Row> WallSurface::to_members(std::function<Row(Triangle const&, std::size_t)> const& row) {
  auto const corners = static_cast<std::size_t>(flow_.grid().dimension);
  std::map<int, parallel::Bytes> to;
  for (Triangle const& t : triangles_) {
    if (!t.loaded) continue;
    for (std::size_t a = 0; a < corners; ++a) {
      Row const r = row(t, a);
      std::vector<int> ranks;
      for (solid::Corner const& m : surface_->corners(surface_->elements()[t.element].vertex[a])) {
        int const rank = solid_.owner(m.particle);
        if (std::find(ranks.begin(), ranks.end(), rank) == ranks.end()) ranks.push_back(rank);
      }
      for (int const rank : ranks) parallel::put(to[rank], r);
    }
  }
  std::vector<parallel::Message> out;
  for (auto& [rank, data] : to) out.push_back({rank, std::move(data)});
  std::vector<Row> rows;
  for (parallel::Message const& message : comm_.deliver(std::move(out)))
    for (std::span<std::byte const> in(message.data); !in.empty();) rows.push_back(parallel::take<Row>(in));
  std::sort(rows.begin(), rows.end(), [](Row const& a, Row const& b) {
    return a.vertex != b.vertex ? a.vertex < b.vertex : a.triangle < b.triangle;
  });
  return rows;
}

std::array<std::array<Vec3, 3>, 2> WallSurface::places(Triangle const& t) const {
  std::array<std::array<Vec3, 3>, 2> x{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(flow_.grid().dimension); ++a)
    x[0][a] = vertices_[t.vertex[a]].record, x[1][a] = vertices_[t.vertex[a]].position;
  return x;
}

void WallSurface::centre() {
  int const dimension = flow_.grid().dimension;
  auto const corners = static_cast<std::size_t>(dimension);
  struct Pressed {
    GlobalId vertex, triangle;
    Real force, area;
  };
  auto const pressed = to_members<Pressed>([&](Triangle const& t, std::size_t a) {
    std::array<Vec3, 3> x{};
    Vec3 force;
    for (std::size_t c = 0; c < corners; ++c) {
      Vertex const& v = vertices_[t.vertex[c]];
      x[c] = load_of_ == LoadOf::start ? v.record : v.position;
      force += t.given[c];
    }
    Vec3 const area = dimension == 2 ? Vec3{x[1].y - x[0].y, x[0].x - x[1].x, 0} : cross(x[1] - x[0], x[2] - x[0]);
    Real const size = norm(area);
    solid::Element const& e = surface_->elements()[t.element];
    return Pressed{e.vertex[a], e.id, size > 0 ? -dot(force, area) / size : 0, t.wetted};
  });
  for (std::size_t p = 0; p < pressed.size();) {
    Vertex& v = vertices_[static_cast<std::size_t>(local(pressed[p].vertex))];
    Real force = 0, area = 0;
    Index wet = 0;
    for (; p < pressed.size() && pressed[p].vertex == v.id; ++p)
      force += pressed[p].force, area += pressed[p].area, wet += pressed[p].area > 0;
    v.bears = wet == v.triangles;
    if (v.bears) v.pressure = force / area;
  }
  for (Triangle& t : triangles_) {
    auto const [record, position] = places(t);
    std::array<Vec3, 3> const gained = load_of_ == LoadOf::start
                                           ? area_gained(dimension, flow_.grid().spacing.z, position, record)
                                           : area_gained(dimension, flow_.grid().spacing.z, record, position);
    Vec3 share;
    for (std::size_t a = 0; a < corners; ++a) share += vertices_[t.vertex[a]].pressure * gained[a];
    for (std::size_t a = 0; a < corners; ++a) t.force[a] += share / static_cast<Real>(corners);
  }
}

void WallSurface::apply(std::vector<CellForce> const& forces, LoadOf of) {
  load_of_ = of;
  gather_forces(forces);
  for (Vertex& v : vertices_) v.pressure = 0, v.bears = false;
  bool const centred = of != LoadOf::present;
  if (centred) centre();
  struct CornerForce {
    GlobalId vertex, triangle;
    Vec3 force;
  };
  auto const loads = to_members<CornerForce>([&](Triangle const& t, std::size_t a) {
    solid::Element const& e = surface_->elements()[t.element];
    return CornerForce{e.vertex[a], e.id, t.force[a]};
  });

  std::span<solid::Wrench> const load = solid_.load();
  std::fill(load.begin(), load.end(), solid::Wrench{});
  std::vector<Vec3> const& arm = centred ? arm_middle_ : arm_;
  for (std::size_t l = 0; l < loads.size();) {
    GlobalId const id = loads[l].vertex;
    Vec3 force;
    for (; l < loads.size() && loads[l].vertex == id; ++l) force += loads[l].force;
    Vertex const& v = vertices_[static_cast<std::size_t>(local(id))];
    Vec3 const share = force / static_cast<Real>(v.last_member - v.first_member);
    for (Index m = v.first_member; m < v.last_member; ++m) {
      auto const at = static_cast<std::size_t>(m);
      if (member_[at] >= solid_.owned()) continue;
      solid::Wrench& w = load[static_cast<std::size_t>(member_[at])];
      w.force += share;
      w.torque += cross(arm[at], share);
    }
  }
}

Real WallSurface::centring(Triangle const& t) const {
  if (load_of_ == LoadOf::present || !(t.wetted > 0)) return 0;
  Real power = 0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(flow_.grid().dimension); ++a) {
    Vertex const& v = vertices_[t.vertex[a]];
    power += dot(t.force[a], v.working) - dot(t.given[a], v.velocity);
  }
  return power / t.wetted;
}

Vec3 WallSurface::turning(Triangle const& t) const {
  if (load_of_ != LoadOf::start || !(t.wetted > 0)) return {};
  int const dimension = flow_.grid().dimension;
  auto const [record, position] = places(t);
  auto const to_end = area_gained(dimension, flow_.grid().spacing.z, record, position);
  auto const to_start = area_gained(dimension, flow_.grid().spacing.z, position, record);
  Vec3 force;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
    if (Vertex const& v = vertices_[t.vertex[a]]; v.bears)
      force -= (v.pressure + beyond_loads) * (to_end[a] - to_start[a]);
  return force / t.wetted;
}

}  // namespace brisance::coupling
