#include "core/solid/contact/contact_list.hpp"

#include <algorithm>

#include "core/solid/contact/meeting_spheres.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }
std::size_t at(GlobalId i) { return static_cast<std::size_t>(i); }

/// Where a candidate of another rank is.
struct Visitor {
  GlobalId id;
  Vec3 x;
};

/// What surrounds the candidates of a rank and their reach.
struct Box {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void add(Vec3 const& p, Real radius) {
    for (int d = 0; d < 3; ++d) low[d] = min(low[d], p[d] - radius), high[d] = max(high[d], p[d] + radius);
  }
  bool meets(Box const& other) const {
    for (int d = 0; d < 3; ++d)
      if (other.high[d] < low[d] || other.low[d] > high[d]) return false;
    return true;
  }
  bool meets(Vec3 const& p, Real radius) const {
    for (int d = 0; d < 3; ++d)
      if (p[d] + radius < low[d] || p[d] - radius > high[d]) return false;
    return true;
  }
};

/// Spheres of this radius that share no point cannot become near before the list is built anew.
Real skin_radius(Convex const& shape) { return shape.outer_radius + 2 * ContactList::reach(shape); }

}  // namespace

ContactList::ContactList(Solid& solid, parallel::Comm& comm, bool self)
    : solid_(solid),
      comm_(comm),
      self_(self),
      kin_(solid, comm),
      shapes_(solid.mesh().shapes.size()),
      actor_of_(at(solid.mesh().size()), -1) {}

Convex const& ContactList::convex(GlobalId particle) {
  Mesh const& mesh = solid_.mesh();
  auto& shape = shapes_[at(mesh.particle(particle).shape)];
  if (!shape) shape = std::make_unique<Convex>(make_convex(mesh.shape(particle), mesh.dimension));
  return *shape;
}

bool ContactList::moved_too_far() const {
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    Index const l = candidates_[c];
    Convex const& shape = *shapes_[at(solid_.mesh().particle(solid_.id(l)).shape)];
    if (!(norm2(solid_.pose()[at(l)].x - listed_at_[c]) <= square(0.5 * reach(shape)))) return true;
  }
  return false;
}

bool ContactList::update() {
  // Bit 0: the list is worn out; bit 1: the links are not what they were.
  bool const opened = breaks_seen_ != solid_.breaks();
  std::uint64_t wish = (!valid_ || moved_too_far() ? 1u : 0u) | (opened ? 2u : 0u);
  comm_.bit_or(std::span(&wish, 1));
  if (wish == 0) return false;
  if (wish & 2) {
    kin_.update();
    breaks_seen_ = solid_.breaks();
    choose_candidates();
  }
  build();
  valid_ = true;
  ++builds_;
  return true;
}

void ContactList::choose_candidates() {
  candidates_.clear();
  for (Index l = 0; l < solid_.owned(); ++l) {
    GlobalId const id = solid_.id(l);
    if (!solid_.mesh().free_faces_of(id).empty() || kin_.opened(id)) candidates_.push_back(l);
  }
}

/// Which bodies have anything to touch: themselves, or another whose box their own meets. Collective.
std::vector<bool> ContactList::engaged_bodies() {
  Mesh const& mesh = solid_.mesh();
  std::vector<Box> boxes(mesh.bodies.size());
  for (Index const l : candidates_) {
    GlobalId const id = solid_.id(l);
    boxes[at(mesh.particle(id).body)].add(solid_.pose()[at(l)].x, skin_radius(convex(id)));
  }
  std::vector<double> ends;
  for (Box const& b : boxes)
    for (int d = 0; d < 3; ++d) ends.push_back(b.low[d]), ends.push_back(-b.high[d]);
  comm_.min(std::span(ends));
  for (std::size_t b = 0; b < boxes.size(); ++b)
    for (int d = 0; d < 3; ++d) {
      boxes[b].low[d] = ends[6 * b + 2 * at(d)];
      boxes[b].high[d] = -ends[6 * b + 2 * at(d) + 1];
    }
  std::vector<bool> engaged(boxes.size());
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    engaged[a] = engaged[a] || (self_ && mesh.bodies[a].particles > 1) || kin_.in_pieces(static_cast<Index>(a));
    for (std::size_t b = a + 1; b < boxes.size(); ++b)
      if (boxes[a].meets(boxes[b])) engaged[a] = engaged[b] = true;
  }
  return engaged;
}

void ContactList::build() {
  Mesh const& mesh = solid_.mesh();
  std::vector<GlobalId> ids;
  std::vector<Sphere> spheres;
  auto const add = [&](GlobalId id, Vec3 const& x) {
    ids.push_back(id);
    spheres.push_back({x, skin_radius(convex(id))});
  };
  Box mine;
  listed_at_.clear();
  std::vector<bool> const engaged = engaged_bodies();
  for (Index const l : candidates_) {
    listed_at_.push_back(solid_.pose()[at(l)].x);
    if (!engaged[at(mesh.particle(solid_.id(l)).body)]) continue;
    add(solid_.id(l), listed_at_.back());
    mine.add(spheres.back().centre, spheres.back().radius);
  }
  std::size_t const owned = ids.size();

  // Candidates that reach into the box of another rank go there.
  parallel::Bytes box;
  parallel::put(box, mine);
  std::vector<parallel::Bytes> const boxes = comm_.all_gather(box);
  std::vector<parallel::Message> out;
  for (int r = 0; r < comm_.size(); ++r) {
    if (r == comm_.rank()) continue;
    std::span<std::byte const> in = boxes[at(r)];
    Box const theirs = parallel::take<Box>(in);
    parallel::Message message{r, {}};
    for (std::size_t c = 0; c < owned; ++c)
      if (theirs.meets(spheres[c].centre, spheres[c].radius))
        parallel::put(message.data, Visitor{ids[c], spheres[c].centre});
    if (!message.data.empty()) out.push_back(std::move(message));
  }
  for (parallel::Message const& message : comm_.deliver(std::move(out))) {
    std::span<std::byte const> in = message.data;
    while (!in.empty()) {
      auto const visitor = parallel::take<Visitor>(in);
      add(visitor.id, visitor.x);
    }
  }

  std::vector<std::pair<GlobalId, GlobalId>> listed;
  for (auto const& [s, t] : meeting_spheres(spheres)) {
    if (static_cast<std::size_t>(s) >= owned) continue;  // both of other ranks
    auto const pair = std::minmax(ids[at(s)], ids[at(t)]);
    if (mesh.particle(pair.first).freedom != Freedom::free && mesh.particle(pair.second).freedom != Freedom::free)
      continue;
    listed.push_back(pair);
  }
  std::sort(listed.begin(), listed.end());
  auto const excluded = [&](std::pair<GlobalId, GlobalId> const& pair) {
    Index const body = mesh.particle(pair.first).body;
    if (body != mesh.particle(pair.second).body) return false;
    return (!self_ && !kin_.in_pieces(body)) || kin_.excluded(pair.first, pair.second);
  };
  listed.erase(std::remove_if(listed.begin(), listed.end(), excluded), listed.end());

  // Actors: the ends of the pairs, by id; those of other ranks are asked for.
  for (ContactActor const& actor : actors_) actor_of_[at(actor.id)] = -1;
  std::vector<GlobalId> ends;
  for (auto const& [a, b] : listed) ends.push_back(a), ends.push_back(b);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  actors_.clear();
  std::vector<Halo::Ghost> foreign;
  for (GlobalId const id : ends) {
    auto const place = static_cast<Index>(actors_.size());
    actor_of_[at(id)] = place;
    Particle const& p = mesh.particle(id);
    bool const here = solid_.owner(id) == comm_.rank();
    actors_.push_back(
        {id, here ? solid_.local(id) : -1, &convex(id), mesh.material(id).density, p.mass, p.freedom != Freedom::free});
    if (!here) foreign.push_back({place, id, solid_.owner(id)});
  }
  pairs_.clear();
  for (auto const& [id_a, id_b] : listed) {
    Index const a = actor_of_[at(id_a)], b = actor_of_[at(id_b)];
    Convex const &shape_a = *actors_[at(a)].shape, &shape_b = *actors_[at(b)].shape;
    Real const radii = shape_a.outer_radius + shape_b.outer_radius;
    pairs_.push_back({a, b, square(radii), square(radii + reach(shape_a) + reach(shape_b))});
  }
  halo_.connect(comm_, foreign, actor_of_);
  pose_.assign(actors_.size(), {});
  half_.assign(actors_.size(), {});
  placed_.assign(actors_.size(), {});
}

void ContactList::exchange() {
  for (std::size_t k = 0; k < actors_.size(); ++k) {
    placed_[k].shape = nullptr;
    if (Index const l = actors_[k].local; l >= 0)
      pose_[k] = solid_.pose()[at(l)], half_[k] = solid_.half_velocity()[at(l)];
  }
  halo_.start(comm_, pose_, half_);
  halo_.finish(pose_, half_);
}

PlacedConvex const& ContactList::placed(Index actor) {
  PlacedConvex& placed = placed_[at(actor)];
  if (!placed.shape) placed.place(*actors_[at(actor)].shape, pose(actor).q);
  return placed;
}

std::size_t ContactList::bytes() const {
  return actors_.size() * (sizeof(ContactActor) + sizeof(Pose) + sizeof(HalfVelocity) + sizeof(PlacedConvex) + 600) +
         pairs_.size() * sizeof(ContactPair) + candidates_.size() * (sizeof(Index) + sizeof(Vec3)) +
         actor_of_.size() * sizeof(Index);
}

}  // namespace brisance::solid
