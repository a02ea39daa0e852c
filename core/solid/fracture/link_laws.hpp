// Which link follows which law.
#pragma once
#include <array>
#include <optional>
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

/// Which law of the scene a link follows: the last that fits it.
class LawFinder {
 public:
  /// Errors: scene errors for unknown bodies and materials.
  LawFinder(FractureConfig const& config, Mesh const& mesh);
  /// Its place in FractureConfig::law; nothing when the link never breaks.
  std::optional<std::size_t> operator()(Link const& link) const;

 private:
  struct Selector {
    bool clamps = true;
    std::optional<Index> body, material;
    std::array<Index, 2> pair{-1, -1};
  };
  bool fits(Selector const& law, Link const& link) const;
  Mesh const& mesh_;
  std::vector<Selector> selectors_;
};

/// The constants of a link of the mesh.
Section section_of(Mesh const& mesh, Link const& link);

/// Groups by law, in the order of the scene.
/// Errors: scene errors, the same on every rank: unknown body or material, no or several criteria, a cohesive link
/// longer than it can be.
std::vector<LawGroup> assign_laws(FractureConfig const& config, Solid const& solid);

}  // namespace brisance::solid
