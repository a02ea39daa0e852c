// The vocabulary of a coupled step, in the order of the algorithm (theory/coupling.md section 5).
#pragma once
#include <cstddef>

namespace brisance {

enum class Stage {
  source,         ///< first half of the sources, on the state at t^n
  set_off,        ///< what acts on the solid before the first kick of a (sub-)step
  predict,        ///< X*: kick and drift under the fluid load of the last step
  boundary,       ///< deformed boundary = geometry of record at t^{n+1}; triangles on their way
  diffuse,        ///< first half of the viscous terms
  sweeps,         ///< one task per sweep
  diffuse_again,  ///< second half of the viscous terms
  cut_cells,      ///< fractions, apertures, swept volumes of the new geometry
  load_solid,     ///< wall pressure -> vertices -> force and torque on particles
  kick,           ///< from X^n, V^n again: V^{n+1/2}
  drift,          ///< X^{n+1}; velocities of the boundary vertices
  flow_update,    ///< contents of cut cells
  mix,            ///< small cut cells, conservatively
  fill,           ///< the new geometry becomes the record; mirror states
  source_again,   ///< second half of the sources, on the state at t^{n+1}
  forces,         ///< internal forces at t^{n+1}
  contact,        ///< forces between bodies at t^{n+1}
  kick_again,     ///< V^{n+1}
  fracture,       ///< links over their criterion leave
  open,           ///< faces of links that left become boundary
  count
};

char const* name(Stage stage);

}  // namespace brisance
