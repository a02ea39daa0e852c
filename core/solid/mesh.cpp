#include "core/solid/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>

#include "core/base/errors.hpp"
#include "core/solid/bonds.hpp"
#include "core/solid/overlap.hpp"
#include "core/solid/shapes/cells.hpp"
#include "core/solid/space_curve.hpp"
#include "parallel/error.hpp"

namespace brisance::solid {
namespace {

std::string text(Vec3 const& p) {
  char s[96];
  std::snprintf(s, sizeof s, "(%.6g, %.6g, %.6g) m", p.x, p.y, p.z);
  return s;
}

bool inside(Vec3 const& p, Vec3 const& low, Vec3 const& high, int dimension, Real slack = 0) {
  for (int d = 0; d < dimension; ++d)
    if (p[d] < low[d] - slack || p[d] > high[d] + slack) return false;
  return true;
}

/// Makes the components out of the plane of a slab exactly zero, so that nothing ever leaks out of it.
void flatten(Shape& s, int dimension) {
  for (int d = dimension; d < 3; ++d) {
    for (Vec3& v : s.polyhedron.vertices) v[d] = v[d] > 0 ? 0.5 : -0.5;
    s.pole[d] = 0;
    auto diagonal_only = [&](Mat3& m) {
      for (int e = 0; e < 3; ++e)
        if (e != d) m[d][e] = m[e][d] = 0;
    };
    diagonal_only(s.second);
    for (FaceGeometry& f : s.faces) {
      if (std::abs(f.normal[d]) > 0.5) continue;
      f.normal[d] = f.centroid[d] = 0;
      diagonal_only(f.second);
    }
  }
}

/// Places of the cells of all bodies before numbering.
struct Draft {
  std::vector<Cells> cells;
  std::vector<Index> body_of;
  std::vector<std::size_t> cell_of, offset;  // offset of the first cell of a body
  std::vector<Vec3> centre;
};

Draft tessellate_all(SolidConfig const& config, int dimension) {
  Draft draft;
  for (std::size_t b = 0; b < config.body.size(); ++b) {
    BodyConfig const& body = config.body[b];
    Cells cells = tessellate(body, dimension);
    if (dimension < 3)
      for (Shape& s : cells.shapes) flatten(s, dimension);
    for (std::size_t c = 0; c < cells.count(); ++c) {
      for (int d = dimension; d < 3; ++d) cells.centre[c][d] = 0.5;
      // A shape used by many cells is looked at once, at its first one.
      auto const shape = static_cast<std::size_t>(cells.shape[c]);
      if (!cells.checked && (c == 0 || cells.shapes.size() > 1))
        if (auto const f = fault(cells.shapes[shape].polyhedron))
          throw Error(Failure::scene,
                      body.at.text() + ": solid.body \"" + body.name + "\": cell " + std::to_string(c) + " is " +
                          f->what + " at " + text(cells.centre[c] + f->place) +
                          ". Particles must be closed convex polyhedra: change the corners or the cells.");
    }
    draft.offset.push_back(draft.centre.size());
    for (std::size_t c = 0; c < cells.count(); ++c) {
      draft.body_of.push_back(static_cast<Index>(b));
      draft.cell_of.push_back(c);
      draft.centre.push_back(cells.centre[c]);
    }
    draft.cells.push_back(std::move(cells));
  }
  return draft;
}

/// The face of a cell behind which `other` lies; `twin` is its centroid seen from the other cell (a pair of cells may
/// share several faces).
int face_towards(Cells const& cells, std::size_t c, Index other, Vec3 const& twin) {
  Shape const& s = cells.shapes[static_cast<std::size_t>(cells.shape[c])];
  int best = -1;
  Real nearest = 0;
  for (std::size_t f = 0; f < s.faces.size(); ++f) {
    if (cells.neighbour[cells.first[c] + f] != other) continue;
    Real const d = norm2(cells.centre[c] + s.faces[f].centroid - twin);
    if (best < 0 || d < nearest) best = static_cast<int>(f), nearest = d;
  }
  return best;
}

/// The material of a body, or of the physical volume of a cell where the body has none.
Index cell_material(BodyConfig const& body, Cells const& cells, std::size_t c,
                    std::map<std::string, Index> const& material_of) {
  if (!body.material.empty()) return material_of.at(body.material);
  std::vector<Index> named;
  std::string names;
  if (!cells.region.empty())
    for (std::string const& name : cells.region_names[static_cast<std::size_t>(cells.region[c])]) {
      names += (names.empty() ? "\"" : ", \"") + name + "\"";
      auto const found = material_of.find(name);
      if (found != material_of.end()) named.push_back(found->second);
    }
  if (named.size() != 1)
    throw Error(Failure::scene,
                body.at.text() + ": solid.body \"" + body.name + "\" has no material, and cell " + std::to_string(c) +
                    " at " + text(cells.centre[c]) + " is in " +
                    (names.empty() ? "no physical group" : "the physical groups " + names) + ", of which " +
                    (named.empty() ? "none is" : "several are") +
                    " in solid.material. Give the body a material, or one to each physical group by its name.");
  return named[0];
}

/// Faces of physical surfaces, by particle.
void name_faces(Mesh& mesh, Draft const& draft, std::vector<GlobalId> const& number) {
  for (std::size_t b = 0; b < draft.cells.size(); ++b) {
    Cells const& cells = draft.cells[b];
    for (auto const& [name, slots] : cells.face_groups)
      for (std::size_t slot : slots) {
        auto const next = std::upper_bound(cells.first.begin(), cells.first.end(), slot);
        auto const c = static_cast<std::size_t>(next - cells.first.begin()) - 1;
        mesh.face_groups[name].push_back({number[draft.offset[b] + c], static_cast<int>(slot - cells.first[c])});
      }
  }
  for (auto& [name, faces] : mesh.face_groups) {
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  }
}

/// Link of two half links in series; the weights are by compliance, which of one material are those by distance.
/// Source: theory/solid.md section 1.
/// `shift`: of q across a periodic side, whose place in Mesh::far_sides is `far`.
Link series_link(Mesh const& mesh, GlobalId p, int face, GlobalId q, int twin, Vec3 const& shift, Index far) {
  FaceGeometry const& f = mesh.face(p, face);
  Vec3 const place = mesh.particle(p).centre + f.centroid;
  Vec3 const pole_i = mesh.particle(p).centre + mesh.shape(p).pole,
             pole_j = mesh.particle(q).centre + mesh.shape(q).pole + shift;
  Real const length = dot(pole_j - pole_i, f.normal), near = dot(place - pole_i, f.normal);
  Real const shear_i = mesh.material(p).shear(), shear_j = mesh.material(q).shear();
  if (shear_i == shear_j) return {p, q, face, twin, length, near / length, 2 * shear_i * f.area / length, far};
  Real const give_i = near / shear_i, give_j = (length - near) / shear_j;
  return {p, q, face, twin, length, give_i / (give_i + give_j), 2 * f.area / (give_i + give_j), far};
}

Link half_link(Mesh const& mesh, GlobalId p, int face, Real distance) {
  Real const area = mesh.face(p, face).area;
  return {p, Link::wall, face, -1, distance, 1, 2 * mesh.material(p).shear() * area / distance};
}

void index_links(Mesh& mesh) {
  auto const n = mesh.particles.size();
  // Links of one particle: by (i, j), the walls after all others.
  std::sort(mesh.links.begin(), mesh.links.end(), [n](Link const& a, Link const& b) {
    auto const key = [n](Link const& l) { return l.j == Link::wall ? static_cast<GlobalId>(n) : l.j; };
    return std::tuple(a.i, key(a), a.face_i) < std::tuple(b.i, key(b), b.face_i);
  });
  mesh.first_link.assign(n + 1, 0);
  auto for_each_end = [&](auto&& visit) {
    for (std::size_t l = 0; l < mesh.links.size(); ++l) {
      visit(static_cast<std::size_t>(mesh.links[l].i), l);
      if (mesh.links[l].j != Link::wall) visit(static_cast<std::size_t>(mesh.links[l].j), l);
    }
  };
  for_each_end([&](std::size_t p, std::size_t) { ++mesh.first_link[p + 1]; });
  for (std::size_t p = 0; p < n; ++p) mesh.first_link[p + 1] += mesh.first_link[p];
  mesh.link_of.resize(mesh.first_link[n]);
  auto next = mesh.first_link;
  for_each_end([&](std::size_t p, std::size_t l) { mesh.link_of[next[p]++] = l; });
}

/// Supports of the bodies: which face meets what.
class Supports {
 public:
  Supports(Mesh& mesh, SolidConfig const& config) : mesh_(mesh), config_(config) {
    for (BodyConfig const& body : config.body) {
      auto& prescribed = prescribed_.emplace_back();
      for (DrivenConfig const& box : body.prescribed)
        prescribed.push_back(box.turns() || !box.history.empty() ? motion(box) : -1);
      auto& walls = walls_.emplace_back();
      for (DrivenConfig const& box : body.clamp) {
        if (!box.moves()) {
          walls.push_back(-1);
          continue;
        }
        walls.push_back(static_cast<Index>(mesh.far_sides.size()));
        mesh.far_sides.push_back({FarSide::Kind::moving_wall, motion(box), {}, {}});
      }
    }
  }
  /// Of particles in a prescribed box: of Mesh::motions, -1 if its velocity is constant.
  Index motion_of(std::size_t body, std::size_t box) const { return prescribed_[body][box]; }

  /// The link of a boundary face that a support holds.
  std::optional<Link> link(std::size_t body, GlobalId p, FreeFace const& face) {
    BodyConfig const& of = config_.body[body];
    if (!config_.links) return std::nullopt;
    std::optional<Link> found;
    for (std::size_t c = 0; c < of.clamp.size(); ++c)
      if (lies_in(p, face, of.clamp[c].low, of.clamp[c].high)) {
        found = half_link(mesh_, p, face.face, face.distance);
        found->far = walls_[body][c];
      }
    if (!found && in_group(of.clamp_groups, p, face)) found = half_link(mesh_, p, face.face, face.distance);
    if (found) return found;
    if (in_group(of.symmetry_groups, p, face)) return mirror_link(p, face);
    for (HoldConfig const& box : of.symmetry)
      if (lies_in(p, face, box.low, box.high)) return mirror_link(p, face);
    return std::nullopt;
  }

  /// The index in Mesh::far_sides of a shift.
  Index shifted(Vec3 const& shift) { return side({FarSide::Kind::shifted, -1, {}, shift}); }

 private:
  Index motion(DrivenConfig const& box) {
    mesh_.motions.emplace_back(box, mesh_.dimension);
    return static_cast<Index>(mesh_.motions.size()) - 1;
  }
  bool in_group(std::vector<std::string> const& groups, GlobalId p, FreeFace const& face) const {
    return std::any_of(groups.begin(), groups.end(), [&](std::string const& name) {
      auto const faces = mesh_.face_group(name);
      return std::binary_search(faces.begin(), faces.end(), FaceId{p, face.face});
    });
  }
  bool lies_in(GlobalId p, FreeFace const& face, Vec3 const& low, Vec3 const& high) const {
    Polyhedron const& shape = mesh_.shape(p).polyhedron;
    for (int v : shape.faces[static_cast<std::size_t>(face.face)])
      if (!inside(mesh_.particle(p).centre + shape.vertices[static_cast<std::size_t>(v)], low, high, mesh_.dimension,
                  1e-9 * face.distance))
        return false;
    return true;
  }
  /// The whole link to the mirror image: its length is twice the distance of the plane, and particle I takes half of
  /// what it opens.
  Link mirror_link(GlobalId p, FreeFace const& face) {
    FaceGeometry const& of = mesh_.face(p, face.face);
    Link link = half_link(mesh_, p, face.face, 2 * face.distance);
    link.weight = 0.5;
    link.far = side({FarSide::Kind::mirror, -1, mesh_.particle(p).centre + of.centroid, of.normal});
    return link;
  }
  Index side(FarSide const& wanted) {
    // Planes are told apart by their distance from the origin, not by the point that names them.
    Vec3 const& v = wanted.vector;
    std::array<Real, 4> const key{v.x, v.y, v.z, dot(v, wanted.point)};
    auto const [at, fresh] = sides_.try_emplace({wanted.kind, key}, static_cast<Index>(mesh_.far_sides.size()));
    if (fresh) mesh_.far_sides.push_back(wanted);
    return at->second;
  }

  Mesh& mesh_;
  SolidConfig const& config_;
  std::vector<std::vector<Index>> prescribed_, walls_;  // of every box of every body
  std::map<std::pair<FarSide::Kind, std::array<Real, 4>>, Index> sides_;
};

/// The cell beyond a face of a periodic box, and the shift of its image.
struct Beyond {
  Index cell;
  Vec3 shift;
};
std::optional<Beyond> beyond(BodyConfig const& body, std::size_t cell, FaceGeometry const& face) {
  for (std::string const& axis : body.periodic) {
    int const d = axis[0] - 'x';
    if (std::abs(face.normal[d]) < 0.5) continue;
    Index const n = body.cells[static_cast<std::size_t>(d)];
    Index const stride = d == 0 ? 1 : d == 1 ? body.cells[0] : body.cells[0] * body.cells[1];
    Index const side = face.normal[d] > 0 ? 1 : -1;
    Vec3 shift{};
    shift[d] = static_cast<Real>(side) * ((*body.high)[d] - (*body.low)[d]);
    return Beyond{static_cast<Index>(cell) - side * (n - 1) * stride, shift};
  }
  return std::nullopt;
}

/// Links through shared faces; all other faces are boundary.
void connect(Mesh& mesh, Draft const& draft, SolidConfig const& config, std::vector<GlobalId> const& number,
             Supports& supports) {
  std::vector<std::size_t> draft_of(mesh.particles.size());
  for (std::size_t a = 0; a < number.size(); ++a) draft_of[static_cast<std::size_t>(number[a])] = a;
  mesh.first_free.assign(1, 0);
  auto const bonds = find_bonds(config, draft.cells, draft.offset, mesh.dimension);
  for (GlobalId p = 0; p < mesh.size(); ++p) {
    std::size_t const a = draft_of[static_cast<std::size_t>(p)];
    auto const b = static_cast<std::size_t>(draft.body_of[a]);
    Cells const& cells = draft.cells[b];
    std::size_t const c = draft.cell_of[a];
    Shape const& s = mesh.shape(p);
    for (std::size_t f = 0; f < s.faces.size(); ++f) {
      if (is_side_of_slab(s.faces[f], mesh.dimension)) continue;
      int const face = static_cast<int>(f);
      Index other = cells.neighbour[cells.first[c] + f];
      std::optional<Beyond> const wrapped = other < 0 ? beyond(config.body[b], c, s.faces[f]) : std::nullopt;
      if (wrapped) other = wrapped->cell;
      if (other >= 0 && config.links) {
        auto const o = static_cast<std::size_t>(other);
        GlobalId const q = number[draft.offset[b] + o];
        if (q < p) continue;  // made from its other end
        Vec3 const shift = wrapped ? wrapped->shift : Vec3{};
        Vec3 const place = mesh.particle(p).centre + s.faces[f].centroid;
        // Across a periodic side the twin is the face that looks the other way.
        int const twin = wrapped ? static_cast<int>(f ^ 1U) : face_towards(cells, o, static_cast<Index>(c), place);
        if (twin < 0) continue;  // a sliver of a face that rounding left on one side only
        mesh.links.push_back(series_link(mesh, p, face, q, twin, shift, wrapped ? supports.shifted(shift) : -1));
        continue;
      }
      if (auto const bond = bonds.find({a, face}); bond != bonds.end()) {
        GlobalId const q = number[bond->second.cell];
        if (q > p) mesh.links.push_back(series_link(mesh, p, face, q, bond->second.face, {}, -1));
        continue;
      }
      FreeFace free{p, face, dot(s.faces[f].centroid - s.pole, s.faces[f].normal), false};
      if (auto const link = supports.link(b, p, free)) {
        free.clamped = true;
        mesh.links.push_back(*link);
      }
      mesh.free_faces.push_back(free);
    }
    mesh.first_free.push_back(mesh.free_faces.size());
  }
  index_links(mesh);
}

void add_initial_velocity(BodyConfig const& body, int dimension, Particle& p) {
  constexpr Real far = std::numeric_limits<Real>::infinity();
  for (InitialVelocityConfig const& field : body.initial_velocity) {
    if (!inside(p.centre, field.low.value_or(Vec3{-far, -far, -far}), field.high.value_or(Vec3{far, far, far}),
                dimension))
      continue;
    p.velocity += field.velocity;
    if (field.gradient.empty()) continue;
    auto const& g = field.gradient;
    p.velocity +=
        Mat3{{Vec3{g[0], g[1], g[2]}, Vec3{g[3], g[4], g[5]}, Vec3{g[6], g[7], g[8]}}} * (p.centre - field.centre);
    p.spin += 0.5 * Vec3{g[7] - g[5], g[2] - g[6], g[3] - g[1]};  // half the curl
  }
}

/// 2^-50 of the extent of all bodies: 51 bits hold every place, so that a difference of two is exact.
void snap_centres(Mesh& mesh) {
  Real extent = 0;
  for (Particle const& p : mesh.particles) {
    Real reach = 0;
    for (Vec3 const& v : mesh.shapes[static_cast<std::size_t>(p.shape)].polyhedron.vertices)
      reach = max(reach, norm(v));
    for (int d = 0; d < 3; ++d) extent = max(extent, std::abs(p.centre[d]) + reach);
  }
  mesh.grain = std::ldexp(1.0, std::ilogb(extent) + 1 - 50);
  for (Particle& p : mesh.particles) p.centre = on_grain(mesh, p.centre);
}

}  // namespace

Vec3 on_grain(Mesh const& mesh, Vec3 const& v) {
  Vec3 snapped;
  for (int d = 0; d < 3; ++d) snapped[d] = mesh.grain * std::nearbyint(v[d] / mesh.grain) + 0.0;
  return snapped;
}

bool is_side_of_slab(FaceGeometry const& face, int dimension) {
  for (int d = dimension; d < 3; ++d)
    if (std::abs(face.normal[d]) > 0.5) return true;
  return false;
}

void require_face_group(Mesh const& mesh, std::string const& name, Location const& at, std::string const& of) {
  if (mesh.face_groups.contains(name)) return;
  std::vector<std::string> known;
  for (auto const& [other, faces] : mesh.face_groups) known.push_back(other);
  scene_error(at, of + ": no mesh file has a physical surface \"" + name + "\"" +
                      (known.empty() ? "" : "; the nearest is \"" + nearest(name, known) + "\"") +
                      ". Name one, or select faces by a box.");
}

Real face_distance(Mesh const& mesh, Link const& link, GlobalId p) {
  FaceGeometry const& f = mesh.face(link.i, link.face_i);
  Real const near = dot(f.centroid - mesh.shape(link.i).pole, f.normal);
  return p == link.i ? near : link.rest_length - near;
}

Mat3 bending_tensor(Mesh const& mesh, Link const& link) {
  FaceGeometry const& f = mesh.face(link.i, link.face_i);
  Real const polar = trace(f.second);
  Mat3 const nn = outer(f.normal, f.normal);
  auto const tensor = [&](Real shear, Real young) {
    return (mesh.torsion_ratio * shear * polar) * nn + young * (polar * (Mat3::identity() - nn) - f.second);
  };
  Material const& m = mesh.material(link.i);
  Mat3 c = tensor(m.shear(), m.young_modulus);
  if (link.j != Link::wall && mesh.particle(link.i).material != mesh.particle(link.j).material) {
    // Two half links in series: a modulus is the harmonic mean of both, by distance from the face.
    Material const& other = mesh.material(link.j);
    Real const share = face_distance(mesh, link, link.i) / link.rest_length;
    auto const mean = [&](Real a, Real b) { return 1 / (share / a + (1 - share) / b); };
    c = tensor(mean(m.shear(), other.shear()), mean(m.young_modulus, other.young_modulus));
  }
  return (2 / link.rest_length) * c;
}

Mesh build_mesh(SolidConfig const& config, int dimension) {
  Mesh mesh;
  mesh.dimension = dimension;
  if (config.links) mesh.torsion_ratio = config.links->torsion_ratio;
  std::map<std::string, Index> material_of;
  for (auto const& [name, m] : config.material) {
    material_of[name] = static_cast<Index>(mesh.materials.size());
    mesh.materials.push_back({name, m.density, m.young_modulus, m.poisson_ratio});
  }
  for (BodyConfig const& body : config.body)
    require(material_of.contains(body.material) || (body.mesh && body.material.empty()), Failure::scene,
            body.at.text() + ": solid.body \"" + body.name + "\": material \"" + body.material +
                "\" is not one of solid.material. Add it there or correct the name.");
  for (BodyConfig const& body : config.body) check_supports(body, dimension);
  Draft const draft = tessellate_all(config, dimension);

  std::vector<std::size_t> const order = curve_order(draft.centre);
  std::vector<GlobalId> number(order.size());
  for (std::size_t g = 0; g < order.size(); ++g) number[order[g]] = static_cast<GlobalId>(g);
  std::vector<Index> first_shape;
  for (Cells const& cells : draft.cells) {
    first_shape.push_back(static_cast<Index>(mesh.shapes.size()));
    mesh.shapes.insert(mesh.shapes.end(), cells.shapes.begin(), cells.shapes.end());
  }

  Supports supports(mesh, config);
  mesh.particles.resize(order.size());
  for (std::size_t a = 0; a < order.size(); ++a) {
    auto const b = static_cast<std::size_t>(draft.body_of[a]);
    BodyConfig const& body = config.body[b];
    Particle& p = mesh.particles[static_cast<std::size_t>(number[a])];
    p.body = draft.body_of[a];
    p.material = cell_material(body, draft.cells[b], draft.cell_of[a], material_of);
    p.shape = first_shape[b] + draft.cells[b].shape[draft.cell_of[a]];
    p.centre = draft.centre[a];
    Shape const& s = mesh.shapes[static_cast<std::size_t>(p.shape)];
    p.mass = mesh.materials[static_cast<std::size_t>(p.material)].density * s.volume;
    p.velocity = body.velocity;
    for (std::size_t n = 0; n < body.prescribed.size(); ++n) {
      DrivenConfig const& box = body.prescribed[n];
      if (!inside(p.centre, box.low, box.high, dimension)) continue;
      p.freedom = Freedom::prescribed;
      p.motion = supports.motion_of(b, n);
      p.velocity = box.velocity;
    }
    for (HoldConfig const& box : body.hold)
      if (inside(p.centre, box.low, box.high, dimension)) p.freedom = Freedom::fixed, p.velocity = {}, p.motion = -1;
  }
  name_faces(mesh, draft, number);
  for (BodyConfig const& body : config.body)
    for (auto const* groups : {&body.clamp_groups, &body.symmetry_groups})
      for (std::string const& name : *groups)
        require_face_group(mesh, name, body.at, "solid.body \"" + body.name + "\"");
  connect(mesh, draft, config, number, supports);
  snap_centres(mesh);

  for (std::size_t b = 0; b < config.body.size(); ++b)
    mesh.bodies.push_back({config.body[b].name, 0, 0, {}, draft.cells[b].whole_volume});
  for (Particle& p : mesh.particles) {
    Body& body = mesh.bodies[static_cast<std::size_t>(p.body)];
    ++body.particles;
    body.mass += p.mass;
    body.centre += p.mass * p.centre;
  }
  for (Body& body : mesh.bodies) body.centre = body.centre / body.mass;
  for (GlobalId id = 0; id < mesh.size(); ++id) {
    Particle& p = mesh.particles[static_cast<std::size_t>(id)];
    Real free_volume = 0;
    for (FreeFace const& f : mesh.free_faces_of(id))
      if (!f.clamped) free_volume += mesh.face(id, f.face).area * f.distance;
    p.effective_volume = mesh.shape(id).volume + mesh.material(id).free_ratio() * free_volume;
    auto const b = static_cast<std::size_t>(p.body);
    if (p.freedom == Freedom::free) {
      p.spin = config.body[b].spin;
      p.velocity += cross(p.spin, p.centre - mesh.bodies[b].centre);
      add_initial_velocity(config.body[b], dimension, p);
    }
    if (p.motion >= 0) {
      RigidMotion const& motion = mesh.motions[static_cast<std::size_t>(p.motion)];
      RigidMotion::State const now = motion.at(0);
      p.velocity = now.velocity(p.centre - motion.centre());
      p.spin = now.omega;
    }
    for (int d = dimension; d < 3; ++d) p.velocity[d] = 0;
    if (dimension < 3) p.spin = {0, 0, dimension == 2 ? p.spin.z : 0};
  }

  if (auto const meeting = find_overlap(mesh)) {
    auto const &a = config.body[static_cast<std::size_t>(meeting->body_a)],
               &b = config.body[static_cast<std::size_t>(meeting->body_b)];
    throw Error(Failure::scene, b.at.text() + ": solid.body \"" + a.name + "\" and \"" + b.name + "\" overlap by " +
                                    std::to_string(meeting->depth) + " m at " + text(meeting->place) +
                                    ". Bodies may touch: move one of them or change its dimensions.");
  }
  return mesh;
}

}  // namespace brisance::solid
