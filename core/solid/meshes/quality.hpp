// What a mesh does to the answer, told before the run.
#pragma once
#include <optional>

#include "core/solid/mesh.hpp"
#include "core/solid/meshes/patch.hpp"

namespace brisance::solid {

/// A figure and the particle where it is worst.
struct Worst {
  Real value = 0;
  GlobalId particle = -1;
};

/// Figures of one body.
struct MeshQuality {
  Index body = 0;
  GlobalId parts = 1;      ///< pieces without a link between them
  Real volume = 0;         ///< of the particles over that of the shape they fill, minus 1; 0: not known
  Worst angle;             ///< between a face normal and the line of poles, degrees
  Real offset = 0;         ///< rms of the face offset tau over the mean spacing h (theory/solid.md section 9)
  Worst aspect;            ///< longest over shortest axis of a particle
  Real poisson_ratio = 0;  ///< of the material of the body where |nu| is largest
  Real single_layer = 0;   ///< share of the particles that are a whole plate or shell thick
  int rod_layers = 0;      ///< particles across a rod; 0: the body is none
  Real stairs = 0;         ///< inward corners of 90 degrees over boundary faces
  std::optional<PatchModuli> moduli;  ///< absent where the mesh is exact (all angles and offsets zero)
  GlobalId patch = 0;                 ///< particles they were measured on
};

/// Looks at every body; patches of at most `patch` particles are measured.
/// Cost: 6 static solutions of a patch, about 2 s for 1000 particles.
std::vector<MeshQuality> measure_quality(Mesh const& mesh, GlobalId patch = 600);

/// A line of figures, and the warnings that follow from them (theory/solid.md sections 9 and 13.4); in words, without
/// the name of the body.
std::string describe(MeshQuality const& q, Mesh const& mesh);
std::vector<std::string> warnings(MeshQuality const& q, Mesh const& mesh);

class Solid;
/// The particle of this rank that allows the shortest step, and how far below the median it is, in words and as the
/// ratio of both; empty and 1 when no particle limits the step.
struct StepLimit {
  std::string text;
  Real share_of_median = 1;
};
StepLimit describe_step_limit(Solid const& solid);

}  // namespace brisance::solid
