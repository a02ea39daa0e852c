// Which link follows which law.
#pragma once
#include <vector>

#include "core/solid/fracture/fracture_config.hpp"
#include "core/solid/solid.hpp"

namespace brisance::solid {

/// What tells at a glance that a link holds.
struct Watch {
  Index i = 0, j = 0;  ///< its ends; for a wall j is i
  Real k = 0, k_over_area = 0, safe = 0;
};

/// The links of this rank that follow one law, in global order.
struct LawGroup {
  Criterion criterion;
  std::vector<std::size_t> links;        ///< places among the links of the rank
  std::vector<Watch> watch;              ///< of each
  std::vector<Real> scatter;             ///< strength of each over the mean; empty: 1
  std::vector<CohesiveHistory> history;  ///< of each, for laws that soften
};

/// The constants of a link of the mesh.
Section section_of(Mesh const& mesh, Link const& link);

/// Groups by law, in the order of the scene.
/// Errors: scene errors, the same on every rank: unknown body or material, no or several criteria, a cohesive link
/// longer than it can be.
std::vector<LawGroup> assign_laws(FractureConfig const& config, Solid const& solid);

}  // namespace brisance::solid
