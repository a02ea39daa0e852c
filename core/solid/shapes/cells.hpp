// A body cut into convex cells with matching faces: what every tessellation returns.
#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/solid/mesh.hpp"

namespace brisance::solid {

/// Cells of one body. Cell c is `shapes[shape[c]]` moved to `centre[c]`; neighbour[first[c] + f] is the cell behind its
/// face f, or -1.
struct Cells {
  std::vector<Shape> shapes;
  std::vector<Index> shape;
  std::vector<Vec3> centre;
  std::vector<std::size_t> first{0};
  std::vector<Index> neighbour;
  // Of mesh files: names of physical groups.
  std::vector<std::vector<std::string>> region_names;           ///< sets of names of physical volumes
  std::vector<Index> region;                                    ///< of each cell, into region_names; may be empty
  std::map<std::string, std::vector<std::size_t>> face_groups;  ///< name -> places in `neighbour`
  Real whole_volume = 0;                                        ///< of the shape that the cells fill; 0: not known
  bool checked = false;                                         ///< convex and closed to the precision of its file

  std::size_t count() const { return centre.size(); }
  /// Adds a cell with a shape of its own; `neighbours` may be empty (none known yet).
  void add(Polyhedron const& absolute, std::vector<Index> const& neighbours);
  /// The same with a pole (absolute) other than the mass centre.
  void add(Polyhedron const& absolute, std::vector<Index> const& neighbours, Vec3 const& pole);
};

/// Volume, inertia and faces of a polyhedron, moved so that its mass centre is the origin; returns that centre.
std::pair<Shape, Vec3> make_shape(Polyhedron const& absolute);

/// Fills `neighbour` by pairs of faces with the same centre and opposite normals, to a small fraction of their size.
void match_faces(Cells& cells);

/// A right-handed frame (u, v, axis); for axis = z it is (x, y, z).
Mat3 frame_about(Vec3 const& axis);

/// Regular bricks of the box [low, high], x fastest.
Cells cartesian_box(Vec3 const& low, Vec3 const& high, std::array<Index, 3> const& cells);
/// Bricks between planes at `cuts` along x, y and z, ascending; x fastest.
Cells graded_box(std::array<std::vector<Real>, 3> const& cuts);
/// Bricks of a plate about `centre`, sides `length` x `width`, `thickness` along `normal`.
Cells cartesian_plate(BodyConfig const& body);
/// One convex prism over the corners of a polygon.
Cells prism(BodyConfig const& body, Real low, Real high);
/// Wedges with straight sides and corners on the two circles: tube, or cylinder when the inner radius is 0.
Cells polar_tube(Vec3 const& centre, Vec3 const& axis, Real inner, Real outer, Real length, Real phase,
                 std::array<Index, 3> const& cells);
/// Pyramids and frusta with apex at the centre, between meridians and parallels: shell, or ball when the inner radius
/// is 0.
Cells polar_shell(Vec3 const& centre, Vec3 const& axis, Real inner, Real outer, Real phase,
                  std::array<Index, 3> const& cells);

/// A body for Voronoi cells. Flat pieces of its boundary are half-spaces; curved ones mirror the generators.
class Domain {
 public:
  struct Wall {
    Vec3 point{}, normal{};  ///< outward
  };
  virtual ~Domain() = default;
  virtual Vec3 low() const = 0;  ///< of a box around the body
  virtual Vec3 high() const = 0;
  virtual bool contains(Vec3 const& p) const = 0;
  virtual Real volume() const = 0;
  virtual std::vector<Wall> walls() const = 0;
  /// Images of a generator in the curved pieces.
  virtual std::vector<Vec3> images(Vec3 const& p) const = 0;
};

/// Centroidal Voronoi cells fitted to the boundary by mirrored generators.  Source: theory/solid.md section 9.
/// In 2D the generators lie in the plane z = 1/2 and the cells are prisms over 0 <= z <= 1, in 1D slabs.
Cells voronoi(Domain const& domain, int particles, std::int64_t seed, int lloyd, int dimension);

/// The cells of one body of the scene.  Errors: Failure::scene.
Cells tessellate(BodyConfig const& body, int dimension);

}  // namespace brisance::solid
