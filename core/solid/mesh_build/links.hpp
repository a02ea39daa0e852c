// Links and free faces of the mesh.
#pragma once
#include <vector>

#include "core/solid/mesh_build/draft.hpp"
#include "core/solid/mesh_build/supports.hpp"

namespace brisance::solid {

/// Links through shared faces, through touching faces of bonded bodies and at supports; all other faces are boundary.
/// `number`: particle of each cell of the draft.
void connect(Mesh& mesh, Draft const& draft, SolidConfig const& config, std::vector<GlobalId> const& number,
             Supports& supports);

}  // namespace brisance::solid
