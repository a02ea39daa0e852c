// Which boundary faces a load acts on.
#pragma once
#include <string>
#include <vector>

#include "core/base/location.hpp"
#include "core/solid/mesh.hpp"

namespace brisance::solid {

/// A boundary face: a particle and a face of its shape.
struct FaceRef {
  GlobalId particle = 0;
  int face = 0;
  auto operator<=>(FaceRef const&) const = default;
};

/// The selected boundary faces in global order, judged in the reference state; clamped ones are not among them.
/// Errors: scene error at `at` naming `load`: no such body, or no face selected.
std::vector<FaceRef> select_faces(FaceSelection const& selection, Mesh const& mesh, std::string const& load,
                                  Location const& at);

/// Index of the body called `name`.  Errors: scene error at `at` naming `load` and the nearest name.
Index find_body(Mesh const& mesh, std::string const& name, std::string const& load, Location const& at);

}  // namespace brisance::solid
