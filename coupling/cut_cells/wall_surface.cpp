#include "coupling/cut_cells/wall_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "coupling/cut_cells/cell_geometry.hpp"

namespace brisance::coupling {

namespace {

/// Per element the lowest element of the closed surface it belongs to: elements that share vertices, however far.
std::vector<GlobalId> closed_surfaces(solid::Surface const& surface, int dimension) {
  auto const elements = surface.elements();
  std::vector<GlobalId> lowest(static_cast<std::size_t>(surface.vertices()), -1), parent(elements.size());
  auto const root = [&](GlobalId e) {
    while (parent[static_cast<std::size_t>(e)] != e) {
      auto& up = parent[static_cast<std::size_t>(e)];
      e = up = parent[static_cast<std::size_t>(up)];
    }
    return e;
  };
  for (std::size_t e = 0; e < elements.size(); ++e) {
    parent[e] = static_cast<GlobalId>(e);
    for (int a = 0; a < dimension; ++a) {
      GlobalId& at = lowest[static_cast<std::size_t>(elements[e].vertex[static_cast<std::size_t>(a)])];
      GlobalId const mine = root(static_cast<GlobalId>(e)), other = at < 0 ? mine : root(at);
      parent[static_cast<std::size_t>(std::max(mine, other))] = std::min(mine, other);
      at = std::min(mine, other);
    }
  }
  std::vector<GlobalId> out(elements.size());
  for (std::size_t e = 0; e < elements.size(); ++e)
    out[e] = elements[static_cast<std::size_t>(root(static_cast<GlobalId>(e)))].id;
  return out;
}

/// A triangle lies in one of the three beams of a box when it overlaps the box in all directions but at most one.
bool in_beam(int dimension, CellBox const& box, CellBox const& triangle) {
  int apart = 0;
  for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
    apart += triangle.high[d] <= box.low[d] || triangle.low[d] >= box.high[d];
  return apart <= 1;
}

}  // namespace

WallSurface::WallSurface(solid::Solid& solid, std::shared_ptr<solid::Surface const> surface, fluid::Flow& flow,
                         parallel::Comm& comm, Index margin)
    : solid_(solid), flow_(flow), comm_(comm) {
  replace(std::move(surface));
  fluid::Grid const& grid = flow.grid();
  std::map<int, CellBox> boxes;
  for (Index b = 0; b < grid.block_count(); ++b) {
    auto const p = grid.block_position(b);
    CellBox box;
    for (std::size_t d = 0; d < 3; ++d) {
      box.low[d] = grid.cuts[d][static_cast<std::size_t>(p[d])];
      box.high[d] = grid.cuts[d][static_cast<std::size_t>(p[d]) + 1];
    }
    auto const [at, first] = boxes.try_emplace(flow.owner(b), box);
    for (std::size_t d = 0; d < 3 && !first; ++d) {
      at->second.low[d] = std::min(at->second.low[d], box.low[d]);
      at->second.high[d] = std::max(at->second.high[d], box.high[d]);
    }
  }
  for (auto const& [rank, box] : boxes) reach_.push_back({rank, grown(grid, box, margin)});
}

Index WallSurface::find(std::vector<Vertex> const& vertices, GlobalId vertex) {
  auto const at = std::lower_bound(vertices.begin(), vertices.end(), vertex,
                                   [](Vertex const& v, GlobalId id) { return v.id < id; });
  return at != vertices.end() && at->id == vertex ? static_cast<Index>(at - vertices.begin()) : -1;
}

void WallSurface::replace(std::shared_ptr<solid::Surface const> surface) {
  surface_ = std::move(surface);
  vertices_.clear(), member_.clear(), triangles_.clear();
  sent_.clear();
  std::vector<GlobalId> needed;
  std::vector<GlobalId> const surfaces = closed_surfaces(*surface_, flow_.grid().dimension);
  for (std::size_t t = 0; t < surface_->elements().size(); ++t) {
    solid::Element const& triangle = surface_->elements()[t];
    if (solid_.owner(triangle.particle) != comm_.rank()) continue;
    triangles_.emplace_back();
    triangles_.back().element = t;
    triangles_.back().surface = surfaces[t];
    for (int a = 0; a < flow_.grid().dimension; ++a) needed.push_back(triangle.vertex[static_cast<std::size_t>(a)]);
  }
  for (Index v = 0; v < surface_->vertices(); ++v)
    for (solid::Corner const& c : surface_->corners(v))
      if (solid_.owner(c.particle) == comm_.rank()) needed.push_back(v);
  std::sort(needed.begin(), needed.end());
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  std::vector<Index> around(static_cast<std::size_t>(surface_->vertices()));
  for (solid::Element const& e : surface_->elements())
    for (int a = 0; a < flow_.grid().dimension; ++a)
      ++around[static_cast<std::size_t>(e.vertex[static_cast<std::size_t>(a)])];
  for (GlobalId const id : needed) {
    Vertex vertex;
    vertex.id = id;
    vertex.triangles = around[static_cast<std::size_t>(id)];
    vertex.first_member = static_cast<Index>(member_.size());
    for (solid::Corner const& c : surface_->corners(static_cast<Index>(id)))
      member_.push_back(solid_.local(c.particle));
    vertex.last_member = static_cast<Index>(member_.size());
    vertices_.push_back(vertex);
  }
  for (std::vector<Vec3>* arm : {&arm_, &arm_before_, &arm_middle_}) arm->assign(member_.size(), Vec3{});
  for (Triangle& t : triangles_)
    for (std::size_t a = 0; a < static_cast<std::size_t>(flow_.grid().dimension); ++a)
      t.vertex[a] = static_cast<std::size_t>(local(surface_->elements()[t.element].vertex[a]));
}

void WallSurface::open(std::shared_ptr<solid::Surface const> opened) {
  std::vector<Vertex> const before = std::move(vertices_);
  replace(std::move(opened));
  for (Vertex& v : vertices_) {
    auto const vertex = static_cast<Index>(v.id);
    solid::Surface::Origin const& origin = surface_->origin(vertex);
    if (origin.vertices.size() == 1) {
      v.record = before[static_cast<std::size_t>(find(before, origin.vertices[0]))].record;
    } else if (!origin.vertices.empty()) {
      Vec3 sum{};
      for (Index const old : origin.vertices) sum += before[static_cast<std::size_t>(find(before, old))].record;
      v.record = sum / static_cast<Real>(origin.vertices.size());
    } else {
      Vec3 sum{};
      for (solid::Corner const& c : origin.corners) {
        solid::Pose const& pose = std::as_const(solid_).pose()[static_cast<std::size_t>(solid_.local(c.particle))];
        sum += pose.x + rotate(pose.q, c.arm);
      }
      v.record = sum / static_cast<Real>(origin.corners.size());
    }
    v.position = v.record;
    Vec3 const jump = v.record - surface_->position(vertex, solid_);
    if (shortened(jump) != Vec3{}) v.lag = jump;  // else it is swept at once
    surface_->arms(vertex, solid_, of(v, arm_));
  }
  take_velocities();
}

Vec3 WallSurface::shortened(Vec3 const& lag) const {
  Real steps = 0;
  for (int d = 0; d < flow_.grid().dimension; ++d)
    steps = max(steps, std::abs(lag[d]) / (0.1 * flow_.grid().spacing[d]));
  return steps > 1 ? (1 - 1 / steps) * lag : Vec3{};
}

void WallSurface::start() {
  place();
  freeze_arms();
  take_velocities();
  accept();
}

void WallSurface::begin_step() {
  for (Vertex& v : vertices_) {
    v.lag = shortened(v.lag);
    surface_->arms(static_cast<Index>(v.id), solid_, of(v, arm_before_));
  }
}

void WallSurface::place() {
  for (Vertex& v : vertices_) v.position = surface_->position(static_cast<Index>(v.id), solid_) + v.lag;
}

void WallSurface::freeze_arms() {
  for (Vertex& v : vertices_) surface_->arms(static_cast<Index>(v.id), solid_, of(v, arm_));
  for (std::size_t m = 0; m < arm_.size(); ++m) arm_middle_[m] = 0.5 * (arm_before_[m] + arm_[m]);
}

void WallSurface::take_velocities(Real share, bool first) {
  for (Vertex& v : vertices_) {
    Vec3 const part = share * surface_->velocity(static_cast<Index>(v.id), solid_, of(v, arm_));
    v.velocity = first ? part : v.velocity + part;
    if (load_of_ == LoadOf::present) continue;
    Vec3 const middle = share * surface_->velocity(static_cast<Index>(v.id), solid_, of(v, arm_middle_));
    v.working = first ? middle : v.working + middle;
  }
}

void WallSurface::take_velocities_at_start() {
  for (Vertex& v : vertices_) v.velocity = surface_->velocity(static_cast<Index>(v.id), solid_, of(v, arm_before_));
}

Real WallSurface::away() const {
  Real farthest = 0;
  for (Vertex const& v : vertices_) {
    Vec3 const distance = surface_->position(static_cast<Index>(v.id), solid_) + v.lag - v.position;
    for (int d = 0; d < flow_.grid().dimension; ++d) {
      Real const cells = std::abs(distance[d]) / flow_.grid().spacing[d];
      if (!(cells <= farthest)) farthest = std::isnan(cells) ? std::numeric_limits<Real>::infinity() : cells;
    }
  }
  return farthest;
}

void WallSurface::accept() {
  for (Vertex& v : vertices_) v.record = v.position;
}

bool WallSurface::moved() const {
  return std::any_of(vertices_.begin(), vertices_.end(), [](Vertex const& v) { return !(v.record == v.position); });
}

bool WallSurface::news() const {
  return std::any_of(vertices_.begin(), vertices_.end(), [](Vertex const& v) {
    return !same_bits(v.record, v.position) || !same_bits(v.velocity, v.told);
  });
}

void WallSurface::repeat_triangles(std::vector<SurfaceTriangle> const& record,
                                   std::vector<SurfaceTriangle>& received) const {
  received = record;
  for (SurfaceTriangle& t : received) t.x_old = t.x_new;
}

std::optional<Vec3> WallSurface::beyond(Vec3 const& bound) const {
  for (Vertex const& v : vertices_)
    for (int d = 0; d < flow_.grid().dimension; ++d)
      if (!(std::abs(v.position[d] - v.record[d]) <= bound[d])) return v.record;
  return std::nullopt;
}

std::optional<Vec3> WallSurface::near_periodic_side() const {
  fluid::Grid const& grid = flow_.grid();
  Index const reach = fluid::ghost_depth(flow_.order()) + 3;
  for (Vertex const& v : vertices_) {
    CellIndex const c = cell_of(grid, v.position);
    for (std::size_t d = 0; d < static_cast<std::size_t>(grid.dimension); ++d)
      if (grid.periodic[d] && (c[d] < reach || c[d] >= grid.cells[d] - reach)) return v.position;
  }
  return std::nullopt;
}

void WallSurface::hold() {
  for (Vertex& v : vertices_) v.position = v.record;
}

Real WallSurface::fastest_vertex(int direction) const {
  Real fastest = 0;
  for (Vertex const& v : vertices_) fastest = max(fastest, std::abs(v.velocity[direction]));
  return fastest;
}

void WallSurface::send_triangles(std::vector<SurfaceTriangle>& received) {
  fluid::Grid const& grid = flow_.grid();
  auto const corners = static_cast<std::size_t>(grid.dimension);
  std::vector<SurfaceTriangle> triangles;
  triangles.reserve(triangles_.size());
  std::map<int, std::vector<std::size_t>> targets;
  for (std::size_t place = 0; place < triangles_.size(); ++place) {
    Triangle const& mine = triangles_[place];
    solid::Element const& t = surface_->elements()[mine.element];
    SurfaceTriangle triangle;
    triangle.id = t.id;
    triangle.surface = mine.surface;
    triangle.centring = centring(mine);
    triangle.turning = turning(mine);
    for (std::size_t a = 0; a < corners; ++a) triangle.vertex[a] = t.vertex[a];
    constexpr Index far = std::numeric_limits<Index>::max() / 2;
    CellBox box{{far, far, far}, {-far, -far, -far}};
    for (std::size_t a = 0; a < corners; ++a) {
      Vertex const& v = vertices_[mine.vertex[a]];
      triangle.x_old[a] = v.record;
      triangle.x_new[a] = v.position;
      triangle.velocity[a] = v.velocity;
      for (Vec3 const& x : {v.record, v.position}) {
        CellIndex const c = cell_of(grid, x);
        for (std::size_t d = 0; d < 3; ++d) {
          box.low[d] = std::min(box.low[d], c[d]);
          box.high[d] = std::max(box.high[d], c[d] + 1);
        }
      }
    }
    box = grown(grid, box, 1);
    for (Reach const& r : reach_)
      if (in_beam(grid.dimension, r.box, box)) targets[r.rank].push_back(place);
    triangles.push_back(triangle);
  }
  for (Vertex& v : vertices_) v.told = v.velocity;
  for (Triangle& t : triangles_) t.told = centring(t);
  sent_.assign(targets.begin(), targets.end());
  std::vector<parallel::Message> out;
  for (auto const& [rank, places] : sent_) {
    parallel::Message message{rank, {}};
    message.data.reserve(places.size() * sizeof(SurfaceTriangle));
    for (std::size_t const place : places) parallel::put(message.data, triangles[place]);
    out.push_back(std::move(message));
  }
  received.clear();
  for (parallel::Message const& message : comm_.deliver(std::move(out)))
    for (std::span<std::byte const> in(message.data); !in.empty();)
      received.push_back(parallel::take<SurfaceTriangle>(in));
  std::sort(received.begin(), received.end(), [](auto const& a, auto const& b) { return a.id < b.id; });
}

bool WallSurface::send_velocities(std::vector<SurfaceTriangle>& received) {
  struct Record {
    GlobalId triangle;
    std::array<Vec3, 3> velocity;
    Real centring;
  };
  auto const corners = static_cast<std::size_t>(flow_.grid().dimension);
  std::vector<parallel::Message> out;
  for (auto const& [rank, places] : sent_) {
    parallel::Message message{rank, {}};
    for (std::size_t const place : places) {
      Triangle const& t = triangles_[place];
      Record record{surface_->elements()[t.element].id, {}, centring(t)};
      bool news = record.centring != t.told;
      for (std::size_t a = 0; a < corners; ++a) {
        Vertex const& v = vertices_[t.vertex[a]];
        record.velocity[a] = v.velocity;
        news = news || !same_bits(v.velocity, v.told);
      }
      if (news) parallel::put(message.data, record);
    }
    if (!message.data.empty()) out.push_back(std::move(message));
  }
  for (Vertex& v : vertices_) v.told = v.velocity;
  for (Triangle& t : triangles_) t.told = centring(t);
  bool any = false;
  for (parallel::Message const& message : comm_.deliver(std::move(out)))
    for (std::span<std::byte const> in(message.data); !in.empty(); any = true) {
      Record const record = parallel::take<Record>(in);
      auto const at = std::lower_bound(received.begin(), received.end(), record.triangle,
                                       [](SurfaceTriangle const& t, GlobalId id) { return t.id < id; });
      at->velocity = record.velocity;
      at->centring = record.centring;
    }
  return any;
}

void WallSurface::write(parallel::ArchiveWriter& file) const {
  // A vertex is written by the owner of its first particle.
  std::vector<std::int64_t> ids;
  std::vector<double> rows;
  for (Vertex const& v : vertices_) {
    if (solid_.owner(surface_->corners(static_cast<Index>(v.id)).front().particle) != comm_.rank()) continue;
    ids.push_back(v.id);
    for (Vec3 const& x : {v.record, v.velocity, v.lag}) rows.insert(rows.end(), {x.x, x.y, x.z});
  }
  file.sparse("coupling/vertices", 9, ids, rows);
}

void WallSurface::read(parallel::ArchiveReader& file) {
  parallel::ArchiveReader::Sparse const stored = file.sparse("coupling/vertices", 9);
  for (std::size_t s = 0; s < stored.ids.size(); ++s) {
    Index const at = local(stored.ids[s]);
    if (at < 0) continue;
    double const* row = stored.data.data() + 9 * s;
    Vertex& v = vertices_[static_cast<std::size_t>(at)];
    v.record = v.position = {row[0], row[1], row[2]};
    v.velocity = {row[3], row[4], row[5]};
    v.lag = {row[6], row[7], row[8]};
  }
}

}  // namespace brisance::coupling
