// The solid in its reference state: particles, links and boundary faces of all bodies, the same on every rank.
#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/solid/polyhedron.hpp"
#include "core/solid/solid_config.hpp"
#include "core/solid/supports/rigid_motion.hpp"

namespace brisance::solid {

/// E, nu, density and the constants that links use.  Units: Pa, 1, kg/m3.
struct Material {
  std::string name;
  Real density = 0, young_modulus = 0, poisson_ratio = 0;
  Real shear() const { return young_modulus / (2 * (1 + poisson_ratio)); }             ///< G
  Real lame() const { return 2 * shear() * poisson_ratio / (1 - 2 * poisson_ratio); }  ///< lambda
  Real free_ratio() const { return poisson_ratio / (1 - 2 * poisson_ratio); }          ///< lambda / 2G
};

/// Geometry common to all particles that are translates of each other, relative to their mass centre.
struct Shape {
  Polyhedron polyhedron;
  Real volume = 0;
  Mat3 second{};  ///< K of theory/solid.md section 2
  Vec3 pole{};    ///< Voronoi generator; the mass centre elsewhere
  std::vector<FaceGeometry> faces;
  /// rho (tr K 1 - K), kg m2
  Mat3 inertia(Real density) const {
    return density * (Mat3::diagonal(trace(second), trace(second), trace(second)) - second);
  }
};

enum class Freedom : std::int32_t { free = 0, fixed = 1, prescribed = 2 };

/// A rigid particle in the reference state. Its GlobalId is its place in Mesh::particles.
struct Particle {
  Index body = 0, material = 0, shape = 0;
  Freedom freedom = Freedom::free;
  Vec3 centre{};              ///< X, m
  Real mass = 0;              ///< kg
  Real effective_volume = 0;  ///< volume plus the share of free faces (theory/solid.md section 3), m3
  Vec3 velocity{}, spin{};    ///< initial; m/s, rad/s
  Index motion = -1;          ///< prescribed: of Mesh::motions; -1: constant velocity
};

/// Where the far end of some links lies.  Source: theory/solid.md section 7.
struct FarSide {
  enum class Kind {
    moving_wall,  ///< the link ends at a wall that moves: `motion` of Mesh::motions
    mirror,       ///< at the mirror image of particle i in the plane through `point` with unit normal `vector`
    shifted       ///< at the image of particle j shifted by `vector`
  };
  Kind kind = Kind::moving_wall;
  Index motion = -1;
  Vec3 point{}, vector{};
  /// The image of a place, m.
  Vec3 image(Vec3 const& x) const {
    return kind == Kind::mirror ? x + (2 * dot(vector, point - x)) * vector : x + vector;
  }
};

/// Elastic link of two particles (i < j) through a common face, or of a particle and the wall (j == wall) through a
/// clamped face or one on a plane of symmetry.
struct Link {
  static constexpr GlobalId wall = -1;
  GlobalId i = 0, j = 0;
  int face_i = 0, face_j = 0;  ///< faces of the two shapes; face_j = -1 at a wall
  Real rest_length = 0;        ///< D, m
  Real weight = 0.5;           ///< w_IJ
  Real stiffness = 0;          ///< k = 2 G S / D, N/m
  Index far = -1;              ///< of Mesh::far_sides; -1: particle j where it is, or the wall at rest
};

/// Boundary face: no unbroken link goes through it.
struct FreeFace {
  GlobalId particle = 0;
  int face = 0;
  Real distance = 0;  ///< d_f from the pole, m
  bool clamped =
      false;  ///< held by a link to a wall or mirror: boundary of the body, but no free face of the elastic law
};

/// A face of a particle.
struct FaceId {
  GlobalId particle = 0;
  int face = 0;
  auto operator<=>(FaceId const&) const = default;
};

struct Body {
  std::string name;
  GlobalId particles = 0;
  Real mass = 0;
  Vec3 centre{};
  Real whole_volume = 0;  ///< of the shape that the particles fill, m3; 0: not known
};

/// The whole solid, numbered along a space-filling curve; links sorted by (i, j), walls last; free faces by particle.
struct Mesh {
  int dimension = 3;
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<Shape> shapes;
  std::vector<Particle> particles;
  std::vector<Link> links;
  std::vector<FreeFace> free_faces;
  std::vector<std::size_t> first_link, link_of;  ///< links of particle p: link_of[first_link[p] .. first_link[p + 1])
  std::vector<std::size_t> first_free;           ///< free faces of particle p: [first_free[p], first_free[p + 1])
  /// Faces of the physical surfaces (2D: curves) of mesh files, by name; sorted. A face inside a body is there with
  /// both its sides.
  std::map<std::string, std::vector<FaceId>> face_groups;
  Real torsion_ratio = 1;
  std::vector<RigidMotion> motions;
  std::vector<FarSide> far_sides;
  /// m. Mass centres are multiples of it, and so are the arms of links: differences of places are exact, the gap of an
  /// undisturbed link is exactly zero.
  Real grain = 0;

  GlobalId size() const { return static_cast<GlobalId>(particles.size()); }
  Particle const& particle(GlobalId p) const { return particles[static_cast<std::size_t>(p)]; }
  Shape const& shape(GlobalId p) const { return shapes[static_cast<std::size_t>(particle(p).shape)]; }
  Material const& material(GlobalId p) const { return materials[static_cast<std::size_t>(particle(p).material)]; }
  Mat3 inertia(GlobalId p) const { return shape(p).inertia(material(p).density); }
  FaceGeometry const& face(GlobalId p, int face) const { return shape(p).faces[static_cast<std::size_t>(face)]; }
  FarSide const* far_side(Link const& l) const {
    return l.far < 0 ? nullptr : &far_sides[static_cast<std::size_t>(l.far)];
  }
  bool is_mirror(Link const& l) const { return l.far >= 0 && far_side(l)->kind == FarSide::Kind::mirror; }
  /// What is added to the place of particle j, m.
  Vec3 shift(Link const& l) const {
    return l.far >= 0 && far_side(l)->kind == FarSide::Kind::shifted ? far_side(l)->vector : Vec3{};
  }
  bool has(FarSide::Kind kind) const {
    for (FarSide const& side : far_sides)
      if (side.kind == kind) return true;
    return false;
  }
  /// Links of a particle, in global order, as indices into `links`.
  std::span<std::size_t const> links_of(GlobalId p) const {
    auto const at = static_cast<std::size_t>(p);
    return std::span(link_of).subspan(first_link[at], first_link[at + 1] - first_link[at]);
  }
  std::span<FreeFace const> free_faces_of(GlobalId p) const {
    auto const at = static_cast<std::size_t>(p);
    return std::span(free_faces).subspan(first_free[at], first_free[at + 1] - first_free[at]);
  }
  /// The faces of a physical surface; nothing when no file has it.
  std::span<FaceId const> face_group(std::string const& name) const {
    auto const found = face_groups.find(name);
    return found == face_groups.end() ? std::span<FaceId const>() : found->second;
  }
};

/// (2/D) C of a link, the bending and twisting tensor, N m.  Source: theory/solid.md sections 4 and 8.
Mat3 bending_tensor(Mesh const& mesh, Link const& link);

/// Throws the scene error of the user `of` of a physical surface that no mesh file has.
void require_face_group(Mesh const& mesh, std::string const& name, Location const& at, std::string const& of);

/// Distance (m) of the face of a link from the pole of its particle `p`; D w of one material.
Real face_distance(Mesh const& mesh, Link const& link, GlobalId p);

/// The multiple of mesh.grain nearest to a place or an arm, never -0.
Vec3 on_grain(Mesh const& mesh, Vec3 const& v);

/// Does a face lie in the plane of a 2D run (or across a 1D one)? Such faces are neither linked nor free.
bool is_side_of_slab(FaceGeometry const& face, int dimension);

/// Builds all bodies of the scene.  Errors: Failure::scene naming the body, the cell and the place: missing dimensions,
/// unknown material, non-convex cells, overlapping bodies.
Mesh build_mesh(SolidConfig const& config, int dimension);

}  // namespace brisance::solid
