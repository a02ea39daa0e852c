// The census of fragments.
#pragma once
#include <string>
#include <vector>

#include "core/solid/fracture/fragments.hpp"

namespace brisance::solid {

/// One fragment. Its velocity is that of its mass centre.  Units: kg, m3, m, m/s, J, s.
struct FragmentFigures {
  GlobalId label = 0;  ///< smallest particle in it
  Index body = 0;
  std::int64_t particles = 0;
  Real mass = 0, volume = 0;
  Vec3 centre{}, velocity{};
  Real kinetic = 0, elastic = 0;
  Real separated = Fragments::never;
};

/// Collective. All fragments by label, on rank 0; the same bits on any number of ranks. `elastic` is that at the last
/// compute_forces.
std::vector<FragmentFigures> take_census(Solid const& solid, Fragments const& fragments, parallel::Comm& comm);

/// Header and rows of fragments.csv.
std::string census_header();
std::string census_row(FragmentFigures const& fragment, Mesh const& mesh, std::int64_t step, Real time);

}  // namespace brisance::solid
