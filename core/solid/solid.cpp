#include "core/solid/solid.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/solid/surface.hpp"

namespace brisance::solid {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }
std::size_t at(GlobalId i) { return static_cast<std::size_t>(i); }
Triple<double> triple(Vec3 const& v) { return {v.x, v.y, v.z}; }

std::array<double, 8> symmetric(Mat3 const& m) { return {m[0].x, m[1].y, m[2].z, m[0].y, m[0].z, m[1].z, 0, 0}; }

/// Inverse of a symmetric matrix by cofactors: entries that vanish by symmetry stay exactly zero.
Mat3 inverse(Mat3 const& m) {
  Vec3 const a = cross(m[1], m[2]), b = cross(m[2], m[0]), c = cross(m[0], m[1]);
  return (1 / dot(m[0], a)) * transpose(Mat3{{a, b, c}});
}

}  // namespace

Solid::Solid(Mesh const& mesh, SolidConfig const& config, std::vector<int> owner_of_particle, parallel::Comm& comm,
             int dimension, Surface const* surface, Opens opens)
    : mesh_(mesh),
      comm_(comm),
      dimension_(dimension),
      cfl_(config.motion.cfl),
      gravity_(config.gravity),
      owner_(std::move(owner_of_particle)) {
  if (gravity_)
    for (int d = dimension; d < 3; ++d) (*gravity_)[d] = 0;
  choose_particles(surface, opens);
  store_particles();
  store_links();
  if (volumetric_ && config.links && config.links->volumetric == "consistent" && ConsistentStrain::needed(mesh))
    consistent_ =
        std::make_unique<ConsistentStrain>(mesh, links_, ids_, mesh_link_, pose_.size(),
                                           [this](std::span<double> rows, auto width) { exchange_rows(rows, width); });
  everything_ = {0, owned_};
  if (!mesh_.far_sides.empty() && (config.motion.multirate || config.motion.step == "sharp"))
    scene_error(
        config.motion.at,
        "solid.motion: multirate and step = \"sharp\" do not know moving walls, symmetry and periodic faces yet. "
        "Leave one of them out.");
  bool const plastic = std::any_of(config.material.begin(), config.material.end(),
                                   [](auto const& m) { return m.second.plasticity.has_value(); });
  if ((consistent_ || plastic) && (config.motion.multirate || config.motion.step == "sharp"))
    scene_error(config.motion.at,
                "solid.motion: multirate and step = \"sharp\" know the basic elastic links only, not plasticity and "
                "consistent strains. Leave one of them out.");
  if (config.motion.multirate) assign_rates(config.motion.multirate->levels);
  // Images are placed to rounding only: links to them have gaps.
  sleep_allowed_ = config.sleep && !gravity_ && !rates_ && mesh_.far_sides.empty() && !consistent_ && !plastic;
  compute_forces();
  if (config.motion.step == "sharp") {
    Real bound = link_limit().dt;
    comm_.min(std::span(&bound, 1));
    sharp_limit_ = max(bound, 0.95 * estimated_limit());  // the products may leave the largest frequency 5 % short
  }
}

void Solid::choose_particles(Surface const* surface, Opens opens) {
  int const me = comm_.rank();
  // 1: owned, 2: first layer (its strains are computed here), 3: second layer and vertex groups (poses only).
  std::vector<char> layer(at(mesh_.size()), 0);
  std::vector<GlobalId> ghosts;
  for (GlobalId p = 0; p < mesh_.size(); ++p)
    if (owner(p) == me) {
      layer[at(p)] = 1;
      ids_.push_back(p);
    }
  auto add_neighbours = [&](std::span<GlobalId const> of, char mark) {
    std::vector<GlobalId> added;
    for (GlobalId p : of)
      for (std::size_t l : mesh_.links_of(p)) {
        Link const& link = mesh_.links[l];
        if (link.j == Link::wall) continue;
        GlobalId const other = link.i == p ? link.j : link.i;
        if (layer[at(other)]) continue;
        layer[at(other)] = mark;
        added.push_back(other);
      }
    return added;
  };
  owned_ = static_cast<Index>(ids_.size());
  std::vector<GlobalId> const first = add_neighbours(ids_, 2), second = add_neighbours(first, 3);
  ghosts.insert(ghosts.end(), first.begin(), first.end());
  ghosts.insert(ghosts.end(), second.begin(), second.end());
  if (surface)
    for (Index v = 0; v < surface->vertices(); ++v) {
      auto const group = surface->corners(v);
      if (std::none_of(group.begin(), group.end(), [&](Corner const& c) { return owner(c.particle) == me; })) continue;
      for (Corner const& c : group)
        if (!layer[at(c.particle)]) {
          layer[at(c.particle)] = 3;
          ghosts.push_back(c.particle);
        }
    }
  if (surface && opens == Opens::anywhere) {
    auto const neighbours = Surface::neighbours(mesh_);
    for (GlobalId p = 0; p < mesh_.size(); ++p) {
      if (owner(p) != me) continue;
      for (GlobalId const q : neighbours[at(p)])
        if (!layer[at(q)]) {
          layer[at(q)] = 3;
          ghosts.push_back(q);
        }
    }
  }
  std::sort(ghosts.begin(), ghosts.end());
  ids_.insert(ids_.end(), ghosts.begin(), ghosts.end());
  count_ = static_cast<Index>(ids_.size());
  local_.assign(at(mesh_.size()), -1);
  for (Index l = 0; l < count_; ++l) local_[at(id(l))] = l;
  std::vector<Halo::Ghost> wanted;
  for (GlobalId g : ghosts) wanted.push_back({local(g), g, owner(g)});
  halo_.connect(comm_, wanted, local_);

  // Links in global order: those of owned particles and of the first layer, whose strain needs all of theirs.
  for (std::size_t l = 0; l < mesh_.links.size(); ++l) {
    Link const& link = mesh_.links[l];
    bool const needed = (layer[at(link.i)] == 1 || layer[at(link.i)] == 2) ||
                        (link.j != Link::wall && (layer[at(link.j)] == 1 || layer[at(link.j)] == 2));
    if (needed) mesh_link_.push_back(l);
  }
}

void Solid::store_particles() {
  std::size_t const n = at(count_);
  pose_.resize(n + 1);
  wrench_.resize(n + 1);
  opened_.assign(n + 1, 0);
  pressure_.assign(n + 1, 0);
  motion_.resize(n);
  half_.resize(n);
  load_.resize(n);
  bulk_.resize(n);
  face_opening_.assign(n, 0);
  inertia_of_.resize(n);
  std::vector<Index> place(mesh_.shapes.size() * mesh_.materials.size(), -1);
  for (Index l = 0; l < count_; ++l) {
    Particle const& p = mesh_.particle(id(l));
    Mat3 const inertia = mesh_.inertia(id(l));
    Index& slot = place[at(p.shape) * mesh_.materials.size() + at(p.material)];
    if (slot < 0) {
      slot = static_cast<Index>(inertia_.size());
      inertia_.push_back({symmetric(inertia), symmetric(inverse(inertia))});
    }
    inertia_of_[at(l)] = slot;
    pose_[at(l)].x = p.centre;
    bool const free = p.freedom == Freedom::free;
    motion_[at(l)] = {p.velocity, free ? 1 / p.mass : 0, inertia * p.spin, free ? 1.0 : 0.0};
    half_[at(l)].v = p.velocity;
    half_[at(l)].omega = p.spin;
    bulk_[at(l)] = mesh_.material(id(l)).lame() / p.effective_volume;
    volumetric_ = volumetric_ || mesh_.material(id(l)).lame() != 0;
    if (!free && l < owned_) held_.push_back(l);
  }
}

LinkRest<double> Solid::rest_of(Link const& link) const {
  FaceGeometry const& face = mesh_.face(link.i, link.face_i);
  // A wall is a particle: at rest at the origin, or where its motion starts. An image has the arm of its far side.
  Vec3 const arm_i = on_grain(mesh_, face.centroid);
  Vec3 const place = mesh_.particle(link.i).centre + arm_i;
  Vec3 origin = link.j == Link::wall ? Vec3{} : mesh_.particle(link.j).centre + mesh_.shift(link);
  if (FarSide const* side = mesh_.far_side(link)) {
    if (side->kind == FarSide::Kind::moving_wall) origin = mesh_.motions[at(side->motion)].centre();
    if (side->kind == FarSide::Kind::mirror) origin = side->image(mesh_.particle(link.i).centre);
  }
  Vec3 const arm_j = place - origin;
  auto const bending = symmetric(bending_tensor(mesh_, link));
  LinkRest<double> rest{link.stiffness, link.weight, triple(face.area * face.normal), triple(arm_i), triple(arm_j), {}};
  std::copy_n(bending.begin(), 6, rest.bending);
  return rest;
}

Index Solid::far_end(Link const& link) {
  bool const wall = link.j == Link::wall;
  FarSide const* side = mesh_.far_side(link);
  if (!side) return wall ? count_ : local(link.j);
  bool const moves = side->kind == FarSide::Kind::moving_wall;
  Index const of = moves ? -1 : local(wall ? link.i : link.j);
  auto const [found, fresh] = entry_of_.try_emplace({link.far, of}, static_cast<Index>(pose_.size()));
  if (!fresh) return found->second;
  pose_.emplace_back();
  wrench_.emplace_back();
  opened_.push_back(0);
  pressure_.push_back(0);
  if (moves) {
    pose_.back().x = mesh_.motions[at(side->motion)].centre();
    walls_.push_back({found->second, side->motion, {}, {}, pose_.back()});
  } else {
    images_.push_back({found->second, of, link.far});
  }
  return found->second;
}

void Solid::store_links() {
  for (std::size_t l : mesh_link_) {
    Link const& link = mesh_.links[l];
    if (link.j == Link::wall && local(link.i) < owned_) clamps_.push_back(links_.count());
    links_.add(local(link.i), far_end(link), rest_of(link));
  }
}

void Solid::load_faces(std::span<FaceLoad const> loads) {
  face_tractions_.clear();
  std::fill(face_opening_.begin(), face_opening_.end(), 0.0);
  add_loaded_faces(loads);
}

std::size_t Solid::add_loaded_faces(std::span<FaceLoad const> loads) {
  std::size_t const first = face_tractions_.faces().size();
  for (FaceLoad const& load : loads)
    if (Index const l = local(load.particle); l >= 0)
      face_tractions_.add(mesh_, load.particle, load.face, l, load.traction);
  tractions_changed();
  return first;
}

Real Solid::gap_volume(std::size_t link) const {
  return opened_volume(links_.rest(link), ends_of(pose_[at(links_.end_i(link))], pose_[at(links_.end_j(link))]));
}

void Solid::start_exchange() { halo_.start(comm_, pose_, half_); }
void Solid::finish_exchange() {
  halo_.finish(pose_, half_);
  place_images();
  if (sleep_) wake_moved_ghosts();
}

void Solid::place_images() {
  for (Image const& image : images_) {
    FarSide const& side = mesh_.far_sides[at(image.far)];
    Pose const& from = pose_[at(image.of)];
    Pose& to = pose_[at(image.entry)];
    to = from;
    to.x = side.image(from.x);
    // Turns are axial: a mirror keeps what is along its normal.
    if (side.kind == FarSide::Kind::mirror) to.q.v = (2 * dot(side.vector, from.q.v)) * side.vector - from.q.v;
  }
}

void Solid::compute_strains() {
  place_images();
  if (sleep_) return compute_strains_awake();
  if (!volumetric_) return;
  std::size_t const n = at(count_);
  std::copy(face_opening_.begin(), face_opening_.end(), opened_.begin());
  std::fill(opened_.begin() + count_, opened_.end(), 0.0);
  links_.add_opened_volume(pose_, opened_);
  for (Image const& image : images_)  // what links to images shifted from j open belongs to j
    if (mesh_.far_sides[at(image.far)].kind == FarSide::Kind::shifted)
      opened_[at(image.of)] += opened_[at(image.entry)];
  if (consistent_) consistent_->move_volume(pose_, opened_);
  if (plastic_) plastic_->add_opened_volume(opened_);
  for (std::size_t p = 0; p < n; ++p) pressure_[p] = bulk_[p] * opened_[p];
  if (consistent_) consistent_->take_pressure(pressure_);
  for (Image const& image : images_) pressure_[at(image.entry)] = pressure_[at(image.of)];
}

void Solid::compute_forces() {
  compute_strains();
  if (sleep_) {
    add_wrench_awake();
  } else {
    std::fill(wrench_.begin(), wrench_.end(), Wrench{});
    if (rates_)
      add_shared_wrench();
    else if (damageable())
      links_.add_wrench(pose_, pressure_, wrench_, gaps_, links_.all());
    else
      links_.add_wrench(pose_, pressure_, wrench_);
  }
  if (consistent_) consistent_->add_wrench(pose_, wrench_);
  if (plastic_) plastic_->add_wrench(pose_, wrench_, gaps_);
  for (Image const& image : images_)
    if (mesh_.far_sides[at(image.far)].kind == FarSide::Kind::shifted) {
      wrench_[at(image.of)].force += wrench_[at(image.entry)].force;
      wrench_[at(image.of)].torque += wrench_[at(image.entry)].torque;
    }
  face_tractions_.add_wrench(pose_, wrench_);
}

}  // namespace brisance::solid
