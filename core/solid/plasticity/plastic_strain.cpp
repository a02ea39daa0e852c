#include "core/solid/plasticity/plastic_strain.hpp"

#include <algorithm>
#include <map>

#include "core/solid/links/link_blocks.hpp"

namespace brisance::solid {
namespace {

using namespace blocks;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Symmetric part of t n^T of four links, as two records of four numbers for each: xx yy zz xy, xz yz 0 0.
struct Dyads {
  std::array<Lanes, lanes> low, high;
  Dyads(Triple<Lanes> const& t, Triple<Lanes> const& n) {
    Triple<Lanes> const half = Lanes(0.5) * n;
    Lanes a = t.x * n.x, b = t.y * n.y, c = t.z * n.z, d = multiply_add(t.x, half.y, t.y * half.x);
    transpose(a, b, c, d);
    low = {a, b, c, d};
    Lanes e = multiply_add(t.x, half.z, t.z * half.x), f = multiply_add(t.y, half.z, t.z * half.y), g(0.0), h(0.0);
    transpose(e, f, g, h);
    high = {e, f, g, h};
  }
};

}  // namespace

PlasticStrain::PlasticStrain(Mesh const& mesh, LinkStore const& links, std::span<GlobalId const> ids,
                             std::span<std::size_t const> mesh_link)
    : mesh_(mesh),
      links_(links),
      ids_(ids.begin(), ids.end()),
      mesh_link_(mesh_link.begin(), mesh_link.end()),
      particles_(ids.size()),
      strain_(particles_),
      changed_(particles_),
      free_faces_(particles_),
      blocks_(links.records().size()) {
  find_ends(ids);
  for (std::size_t k = 0; k < links.count(); ++k) {
    Link const& link = mesh.links[mesh_link_[k]];
    Vec3 const n = mesh.face(link.i, link.face_i).normal;
    OffsetBlock& b = blocks_[k / lanes];
    std::array<double, 5> const rest{n.x, n.y, n.z, face_distance(mesh, link, link.i),
                                     link.j == Link::wall ? 0 : face_distance(mesh, link, link.j)};
    for (std::size_t f = 0; f < rest.size(); ++f) b.field[f][k % lanes] = rest[f];
  }
  for (std::size_t p = 0; p < particles_; ++p) {
    slab_.push_back({mesh.shape(ids_[p]).volume, mesh.material(ids_[p]).shear()});
    gather_free_faces(p);
  }
}

void PlasticStrain::find_ends(std::span<GlobalId const> ids) {
  std::map<GlobalId, Index> local;
  if (mesh_.has(FarSide::Kind::shifted))
    for (std::size_t p = 0; p < ids.size(); ++p) local[ids[p]] = static_cast<Index>(p);
  for (std::size_t k = 0; k < links_.count(); ++k) {
    Link const& link = mesh_.links[mesh_link_[k]];
    Index const entry = links_.end_j(k);
    mirrored_.push_back(mesh_.is_mirror(link));
    if (link.j == Link::wall || link.far < 0) {
      strained_end_.push_back(link.j == Link::wall ? -1 : entry);
      continue;
    }
    strained_end_.push_back(local.at(link.j));
    auto const known = [&](Image const& image) { return image.entry == entry; };
    if (std::none_of(images_.begin(), images_.end(), known)) images_.push_back({entry, local.at(link.j)});
  }
}

void PlasticStrain::gather_free_faces(std::size_t particle) {
  // Anew and in global order, so that the bits do not depend on the order of the breaks.
  GlobalId const p = ids_[particle];
  Symmetric sum;
  for (FreeFace const& f : mesh_.free_faces_of(p)) {
    if (f.clamped) continue;
    FaceGeometry const& face = mesh_.face(p, f.face);
    sum = sum + (face.area * f.distance) * dyad(face.normal);
  }
  if (!lost_.empty())
    for (std::size_t const l : mesh_.links_of(p)) {
      auto const here = std::lower_bound(mesh_link_.begin(), mesh_link_.end(), l);
      if (here == mesh_link_.end() || *here != l) continue;  // a particle whose strain belongs to other ranks
      Real const lost = lost_[static_cast<std::size_t>(here - mesh_link_.begin())];
      Link const& link = mesh_.links[l];
      FaceGeometry const& face = mesh_.face(link.i, link.face_i);
      if (lost > 0) sum = sum + (lost * face.area * face_distance(mesh_, link, p)) * dyad(face.normal);
    }
  free_faces_[particle] = sum;
}

void PlasticStrain::free_share(std::size_t link, Real lost) {
  if (lost_.empty()) lost_.assign(links_.count(), 0);
  lost_[link] = lost;
  links_changed_ = true;
  for (Index const end : {links_.end_i(link), strained_end_[link]})
    if (end >= 0) gather_free_faces(at(end));
}

void PlasticStrain::follow() {
  if (!some_changed_) return;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    LinkBlock const& ends = links_.records()[b];
    OffsetBlock& block = blocks_[b];
    for (std::size_t k = 0; k < lanes && b * lanes + k < links_.count(); ++k) {
      std::size_t const i = at(ends.i[k]);
      Index const j = strained_end_[b * lanes + k];
      if (!changed_[i] && (j < 0 || !changed_[at(j)])) continue;
      Vec3 const n{block.field[0][k], block.field[1][k], block.field[2][k]};
      Vec3 const own = (block.field[3][k] * strain_[i]) * n;
      // The image shears the other way: what is left is twice the part along the normal.
      Vec3 const offset = mirrored_[b * lanes + k] ? (2 * dot(n, own)) * n
                          : j < 0                  ? own
                                                   : own + (block.field[4][k] * strain_[at(j)]) * n;
      for (std::size_t d = 0; d < 3; ++d) block.field[5 + d][k] = offset[static_cast<int>(d)];
      block.strained = links_changed_ = true;
    }
  }
  std::fill(changed_.begin(), changed_.end(), 0);
  some_changed_ = 0;
}

void PlasticStrain::add_opened_volume(std::span<double> opened) const {
  for (std::size_t p = 0; p < particles_; ++p) opened[p] += contract(free_faces_[p], strain_[p]);
}

LinkOffset<Lanes> PlasticStrain::read(OffsetBlock const& b) {
  auto const f = [&](std::size_t n) { return Lanes::load_aligned(b.field[n].data()); };
  return {{f(0), f(1), f(2)}, f(3), f(4), {f(5), f(6), f(7)}};
}

LinkOffset<double> PlasticStrain::offset_of(std::size_t link) const {
  auto const f = [&](std::size_t n) { return blocks_[link / lanes].field[n][link % lanes]; };
  return {{f(0), f(1), f(2)}, f(3), f(4), {f(5), f(6), f(7)}};
}

void PlasticStrain::add_wrench(std::span<Pose const> pose, std::span<Wrench> wrench, std::span<GapBlock> gaps) const {
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    if (!blocks_[n].strained) continue;
    LinkBlock const& b = links_.records()[n];
    LinkRest<Lanes> const rest = read_rest(b);
    LinkEnds<Lanes> const ends = read_ends(pose.data(), b);
    LinkOffset<Lanes> const plastic = read(blocks_[n]);
    add_to_ends(b, offset_wrench(rest, ends, plastic), wrench);
    if (gaps.empty()) continue;
    LinkGap<Lanes> const gap = elastic_gap(rest, ends, plastic);
    gap.opened.store_aligned(gaps[n].opened.data());
    gap.squared.store_aligned(gaps[n].squared.data());
  }
}

LinkWrench<double> PlasticStrain::wrench(std::size_t link, LinkEnds<double> const& ends) const {
  return offset_wrench(links_.rest(link), ends, offset_of(link));
}

Real PlasticStrain::link_energy(std::size_t link, LinkEnds<double> const& ends) const {
  if (!blocks_[link / lanes].strained) return 0;
  return offset_energy(links_.rest(link), ends, offset_of(link));
}

Real PlasticStrain::slab_energy(Index particle) const {
  Real sum = 0;
  for (int d = mesh_.dimension; d < 3; ++d) {
    Vec3 across{};
    across[d] = 1;
    sum += norm2(strain_[at(particle)] * across);
  }
  return slab_[at(particle)].shear * slab_[at(particle)].volume * sum;
}

void PlasticStrain::sum_links(std::span<Pose const> pose) {
  link_sum_.assign(pose.size(), {});
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    LinkBlock const& b = links_.records()[n];
    LinkOffset<Lanes> const plastic = read(blocks_[n]);
    Triple<Lanes> const t = driving_force(read_rest(b), read_ends(pose.data(), b), plastic);
    Dyads const dyads(t, plastic.normal);
    auto const add = [&](Index end, double reach, std::size_t k) {
      double* to = link_sum_[at(end)].c.data();
      multiply_add(Lanes(reach), dyads.low[k], Lanes::load_aligned(to)).store_aligned(to);
      multiply_add(Lanes(reach), dyads.high[k], Lanes::load_aligned(to + 4)).store_aligned(to + 4);
    };
    for (std::size_t k = 0; k < lanes; ++k) {
      add(b.i[k], blocks_[n].field[3][k], k);
      add(b.j[k], blocks_[n].field[4][k], k);
    }
  }
  for (Image const& image : images_)
    for (std::size_t c = 0; c < 6; ++c) link_sum_[at(image.of)].c[c] += link_sum_[at(image.entry)].c[c];
  links_changed_ = false;
}

void PlasticStrain::driving_stress(std::span<Pose const> pose, std::span<double const> pressure,
                                   std::span<Symmetric> to, bool same_poses) {
  if (!same_poses || links_changed_) sum_links(pose);
  for (std::size_t p = 0; p < to.size(); ++p) {
    std::copy_n(link_sum_[p].c.begin(), 6, to[p].c.begin());
    to[p] = to[p] - pressure[p] * free_faces_[p];
    for (int d = mesh_.dimension; d < 3; ++d) {
      Vec3 across{}, other;
      across[d] = 1;
      other = strain_[p] * across;
      Symmetric const sum_of_both = dyad(across + other) - dyad(across - other);  // 2 (a o^T + o a^T)
      to[p] = to[p] - (0.5 * slab_[p].shear * slab_[p].volume) * sum_of_both;
    }
  }
}

std::size_t PlasticStrain::bytes() const {
  return particles_ * (2 * sizeof(Symmetric) + sizeof(Slab)) + blocks_.size() * sizeof(OffsetBlock) +
         lost_.size() * sizeof(Real) + link_sum_.size() * sizeof(Tensor);
}

}  // namespace brisance::solid
