// The cells of all bodies before particles are numbered.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/solid/mesh.hpp"
#include "core/solid/shapes/cells.hpp"

namespace brisance::solid {

/// Cells of each body; per cell, body after body: its body, its number there, its mass centre (m).
struct Draft {
  std::vector<Cells> cells;
  std::vector<Index> body_of;
  std::vector<std::size_t> cell_of, offset;  // offset of the first cell of a body
  std::vector<Vec3> centre;
};

/// Errors: Failure::scene naming a cell that is no convex polyhedron, and its place.
Draft tessellate_all(SolidConfig const& config, int dimension);

/// The material of a body, or of the physical volume of a cell where the body has none.
/// Errors: Failure::scene when no group, or several, bear the name of a material.
Index cell_material(BodyConfig const& body, Cells const& cells, std::size_t c,
                    std::map<std::string, Index> const& material_of);

/// Fills Mesh::face_groups with the faces of physical surfaces; `number`: particle of each cell of the draft.
void name_faces(Mesh& mesh, Draft const& draft, std::vector<GlobalId> const& number);

}  // namespace brisance::solid
