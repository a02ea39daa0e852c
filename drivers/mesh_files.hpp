// The mesh files of a scene beside its results, so that a run can be continued without its surroundings.
#pragma once
#include <string>

#include "drivers/scene.hpp"

namespace brisance::drivers {

/// Copies the mesh files of all bodies to `directory`/meshes and lets `scene` name these copies, relative to
/// `directory`. Collective.  Errors: Failure::system when a file cannot be copied.
void keep_mesh_files(Scene& scene, std::string const& directory, parallel::Comm& comm);

}  // namespace brisance::drivers
